import { check, choice, h } from '../src/dom.js';
import { makeChosen } from './chosen.js';
import { DISTANCE_LEGEND } from './colours.js';
import { makeCorrections } from './corrections.js';
import { makeMeasuring } from './measuring.js';
import { makePlan } from './plan.js';
import { readRun } from './run.js';
import { makeSpace } from './space.js';
import { makeTables } from './tables.js';

const at = (id) => document.getElementById(id);
const marks = { begin: performance.now() };

function head(run) {
  at('title').textContent = run.data.title;
  const { building } = run;
  const figures = [];
  if (building) {
    const count = (kind) => building.openings.filter((o) => o.kind === kind).length;
    figures.push([building.rooms.length, building.rooms.length === 1 ? 'room' : 'rooms'], [`${building.rooms.reduce((sum, room) => sum + room.area, 0).toFixed(1)} m²`, 'area']);
    if (building.storeys.length > 1) figures.push([building.storeys.length, 'storeys']);
    const [doors, windows] = [count('door') + count('passage'), count('window')];
    figures.push([doors, doors === 1 ? 'door' : 'doors'], [windows, windows === 1 ? 'window' : 'windows']);
    if (building.confidence !== undefined) figures.push([`${Math.round(100 * building.confidence)} %`, 'confidence']);
  }
  at('figures').replaceChildren(...figures.map(([value, name]) => h('div', {}, h('dt', {}, name), h('dd', {}, value))));
}

/** What is lacking, what the run warned of, and why its confidence is not 1. */
function notes(run) {
  const warnings = [...(run.building?.doubts ?? []), ...run.data.warnings.map(([node, text]) => `${node}: ${text}`)];
  const group = (title, texts, kind) => (texts.length === 0 ? null
    : h('details', { class: kind, id: kind }, h('summary', {}, `${texts.length} ${title}${texts.length === 1 ? '' : 's'}`), h('ul', {}, texts.map((text) => h('li', {}, text)))));
  at('notes').replaceChildren(...[group('gap', run.notes, 'gaps'), group('warning', warnings, 'warnings')].filter(Boolean));
}

function legendOf(legend) {
  if (!legend) return [];
  const swatch = (colour) => { const box = h('span', { class: 'swatch' }); box.style.background = `rgb(${colour.join(' ')})`; return box; };
  const parts = [];
  if (legend.title) parts.push(h('span', {}, legend.title));
  if (legend.ramp) {
    const ramp = h('span', { class: 'ramp' });
    ramp.style.background = `linear-gradient(to right, ${legend.ramp.map((c) => `rgb(${c.join(' ')})`).join(', ')})`;
    parts.push(h('span', { class: 'key' }, legend.from, ramp, legend.to));
  }
  for (const [colour, text] of legend.keys ?? []) parts.push(h('span', { class: 'key' }, swatch(colour), text));
  return parts;
}

/** The pane with the stage and its tools. */
function makeStage(run, choose, alone) {
  const canvas = h('canvas', { id: 'canvas', tabindex: '0', 'aria-label': 'Scan and model: drag turns, wheel zooms, right button moves, click chooses' });
  const labels = h('div', { class: 'labels' });
  const legend = h('div', { class: 'legend' });
  const message = h('p', { class: 'stage-message', role: 'status' });
  const drawer = h('div', { class: 'drawer', id: 'section-box', hidden: true });
  const stage = h('div', { class: 'stage' }, canvas, labels, legend, message, drawer);
  const tools = h('div', { class: 'tools' });
  at('space').append(tools, stage);
  let space;
  try {
    space = makeSpace(run, stage, canvas, alone);
  } catch (error) {
    message.textContent = `Nothing can be shown in 3D: ${error.message}.`;
    return null;
  }
  const { state } = space;
  const measuring = makeMeasuring(space, stage, canvas);

  const modes = h('div', { class: 'segments', role: 'radiogroup', 'aria-label': 'What is shown' });
  const setMode = (mode) => {
    const before = state.mode;
    space.update({ mode });
    for (const button of modes.children) button.setAttribute('aria-checked', String(button.dataset.mode === mode));
    labels.replaceChildren(...(mode === 'split' ? ['Scan', 'Model'] : [{ scan: 'Scan', model: 'Model', both: 'Scan and model' }[mode]]).map((text) => h('span', {}, text)));
    labels.classList.toggle('two', mode === 'split');
    if ((before === 'split') !== (mode === 'split')) space.look(null);
  };
  const hasScan = run.data.parts.some((part) => part.part === 'scan' && part.path);
  const lacks = (mode) => (mode !== 'model' && !hasScan) || (mode !== 'scan' && !run.mesh);
  for (const [mode, text] of [['split', 'Side by side'], ['scan', 'Scan'], ['model', 'Model'], ['both', 'Both']])
    modes.append(h('button', { type: 'button', role: 'radio', 'data-mode': mode, disabled: lacks(mode), onclick: () => setMode(mode) }, text));

  const toggle = (text, key) => check(text, state[key], (on) => space.update({ [key]: on })).element;
  const storeys = run.building && run.building.storeys.length > 1
    ? h('div', { class: 'storeys', role: 'group', 'aria-label': 'Storeys' }, run.building.storeys.map((storey) => {
      const box = check(`Storey ${storey.index}`, true, (on) => { if (on) state.storeys.add(storey.index); else state.storeys.delete(storey.index); space.draw(); });
      box.input.dataset.storey = storey.index;
      return box.element;
    })) : null;
  const showLegend = () => legend.replaceChildren(...legendOf(space.modes[state.colour][2]), ...legendOf(state.cloud === 'distance' ? DISTANCE_LEGEND : null));
  const colour = run.mesh && run.building ? choice('faces by', Object.entries(space.modes).map(([key, [text]]) => [key, text]), 'class', (value) => { space.update({ colour: value }); showLegend(); }) : null;
  const cloud = choice('points by', [['own', 'their colours'], ['distance', 'distance from the model']], 'own', (value) => { space.update({ cloud: value }); showLegend(); });
  const button = (text, action, attributes = {}) => h('button', { type: 'button', class: 'quiet', onclick: action, ...attributes }, text);
  const section = button('Section box', () => { drawer.hidden = !drawer.hidden; section.setAttribute('aria-pressed', String(!drawer.hidden)); }, { 'aria-pressed': 'false', id: 'section' });
  const measure = button('Measure', () => { measuring.toggle(); measure.setAttribute('aria-pressed', String(measuring.active())); }, { 'aria-pressed': 'false', id: 'measure' });
  const more = h('details', { class: 'menu' }, h('summary', { class: 'quiet' }, 'More'), h('div', { class: 'menu-body' },
    [toggle('edges', 'edges'), toggle('doors and windows', 'openings'), run.mesh?.classes.has('object') ? toggle('furniture', 'objects') : null, toggle('points outside of rooms', 'outside'), toggle('parallel view', 'parallel'),
     colour?.element, cloud.element].filter(Boolean)));
  tools.append(...[modes, h('span', { class: 'gap' }), button('Corner', () => space.look('corner')), button('Top', () => space.look('top')), button('Front', () => space.look('front')), h('span', { class: 'gap' }),
    toggle('ceilings', 'ceilings'), storeys, section, measure, more].filter(Boolean));
  makeSection(space, drawer);

  // A click that is no drag chooses, or measures.
  let pressed = null;
  canvas.addEventListener('pointerdown', (event) => { pressed = [event.clientX, event.clientY, event.button]; });
  canvas.addEventListener('click', (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    const frame = canvas.getBoundingClientRect();
    const ray = space.ray(event.clientX - frame.left, event.clientY - frame.top);
    if (measuring.active()) {
      measuring.add(space.pick(ray, { model: ray.model, panes: false, points: ray.scan }));
      return;
    }
    // Points have no names: a click on them means the face that they are on.
    const hit = space.pick(ray, { model: true, panes: true, points: false });
    if (hit?.opening !== null && hit?.opening !== undefined) choose('opening', hit.opening, hit.place);
    else if (hit?.face !== null && hit?.face !== undefined) choose('face', hit.face, hit.place);
    else choose(null);
  });
  addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    if (measuring.active()) { measuring.toggle(); measure.setAttribute('aria-pressed', 'false'); } else choose(null);
  });
  /** So that a room is seen that is chosen elsewhere: its storey is on, those above it are off. */
  function uncover(storey) {
    for (const input of storeys?.querySelectorAll('input') ?? []) {
      const index = Number(input.dataset.storey);
      if (index < storey) continue;
      input.checked = index === storey;
      if (index === storey) state.storeys.add(index);
      else state.storeys.delete(index);
    }
    space.draw();
  }
  return { space, setMode, message, measuring, uncover };
}

/** Six sliders: what lies outside of them is cut away. */
function makeSection(space, drawer) {
  const { state, bounds } = space;
  const rows = [];
  ['x', 'y', 'z'].forEach((name, axis) => {
    const [least, most] = [bounds.min[axis], bounds.max[axis]];
    const slider = (key, value) => {
      const input = h('input', { type: 'range', min: least, max: most, step: 'any', 'aria-label': `${name} ${key === 'low' ? 'from' : 'to'}`, 'data-axis': `${name}-${key}` });
      input.value = value;
      input.addEventListener('input', () => {
        const other = key === 'low' ? state.high[axis] : state.low[axis];
        state[key][axis] = key === 'low' ? Math.min(Number(input.value), other - 0.05) : Math.max(Number(input.value), other + 0.05);
        text.textContent = described(axis);
        space.draw();
      });
      return input;
    };
    const text = h('output', {}, '');
    const inputs = [slider('low', least), slider('high', most)];
    rows.push({ text, inputs, axis });
    drawer.append(h('div', { class: 'slide' }, h('span', {}, ['along', 'across', 'height'][axis]), inputs, text));
  });
  const described = (axis) => `${(state.low[axis] - bounds.min[axis]).toFixed(2)} to ${(state.high[axis] - bounds.min[axis]).toFixed(2)} m`;
  const reset = () => {
    for (const { text, inputs, axis } of rows) {
      [state.low[axis], state.high[axis]] = [bounds.min[axis], bounds.max[axis]];
      [inputs[0].value, inputs[1].value] = [bounds.min[axis], bounds.max[axis]];
      text.textContent = described(axis);
    }
    space.draw();
  };
  drawer.append(h('button', { type: 'button', class: 'quiet', onclick: reset }, 'All'));
  for (const { text, axis } of rows) text.textContent = described(axis);
}

async function start() {
  const run = await readRun();
  marks.read = performance.now();
  head(run);
  let selection = null;
  const corrections = makeCorrections(run);
  let stage = null;
  let plan = null;
  let tables = null;
  let chosen = null;
  function choose(kind, index = 0, place = null) {
    selection = kind === null ? null : { kind, index, place };
    const of = { face: run.building?.faces, room: run.building?.rooms, opening: run.building?.openings }[kind];
    if (kind !== null && !of?.[index]) return;
    const face = kind === 'face' ? index : -1;
    const room = kind === 'room' ? index : kind === 'face' ? run.building.faces[index].room : -1;
    stage?.space.choose(kind === 'opening' ? -1000 - index : face, room);
    plan.choose(kind === 'opening' ? run.building.openings[index].room_a : room);
    tables.choose(selection);
    chosen.show(selection);
    document.documentElement.dataset.chosen = selection ? `${kind} ${index}` : '';
  }
  const hasScan = run.data.parts.some((part) => part.part === 'scan' && part.path);
  // Without anything else the scan says how large all is.
  const alone = hasScan && !run.building && !run.mesh ? await run.readCloud() : null;
  stage = makeStage(run, choose, alone);
  const elsewhere = (kind, index) => {
    const of = { face: run.building?.faces, room: run.building?.rooms, opening: run.building?.openings }[kind]?.[index];
    if (of) stage?.uncover(of.storey);
    choose(kind, index);
  };
  plan = makePlan(run, at('plan'), (room) => elsewhere('room', room));
  tables = makeTables(run, at('tables'), elsewhere);
  chosen = makeChosen(run, at('chosen'), { choose: elsewhere, look: (box, direction) => stage?.space.look(direction, grown(box)), corrections });
  chosen.list.replaceWith(corrections.element);
  chosen.show(null);
  notes(run);
  stage?.setMode(hasScan && run.mesh ? 'split' : hasScan ? 'scan' : 'model');
  stage?.space.look('corner');
  marks.model = performance.now();
  document.documentElement.dataset.ready = 'model';
  if (hasScan && stage) {
    stage.message.textContent = 'Reading the scan …';
    await new Promise((resolve) => { setTimeout(resolve, 30); });
    stage.space.setCloud(alone ?? await run.readCloud());
    stage.message.textContent = '';
    notes(run);
  }
  marks.all = performance.now();
  document.documentElement.dataset.times = JSON.stringify({ model: Math.round(marks.model - marks.begin), all: Math.round(marks.all - marks.begin) });
  document.documentElement.dataset.ready = 'yes';
}
const grown = (box) => ({ min: box.min.map((v) => v - 0.6), max: box.max.map((v) => v + 0.6) });

start().catch((error) => { at('notes').replaceChildren(h('p', { class: 'wrong' }, `This page cannot show the run: ${error.message}`)); throw error; });
