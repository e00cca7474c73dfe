import { check, choice, h } from '../src/dom.js';
import { makeChosen } from './chosen.js';
import { CORRECTED, faceLegend, isCorrected, pointLegend } from './colours.js';
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
  const canvas = h('canvas', { id: 'canvas', tabindex: '0', 'aria-label': 'Scan and model: drag turns, wheel zooms, right button moves, click chooses. Keys: arrows turn, shift and arrows move, plus and minus zoom, enter chooses what is in the middle' });
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

  const modes = h('div', { class: 'segments', role: 'group', 'aria-label': 'What is shown' });
  const setMode = (mode) => {
    const before = state.mode;
    space.update({ mode });
    for (const button of modes.children) button.setAttribute('aria-pressed', String(button.dataset.mode === mode));
    labels.replaceChildren(...(mode === 'split' ? ['Scan', 'Model'] : [{ scan: 'Scan', model: 'Model', both: 'Scan and model' }[mode]]).map((text) => h('span', {}, text)));
    labels.classList.toggle('two', mode === 'split');
    if ((before === 'split') !== (mode === 'split')) space.look(null);
  };
  const hasScan = run.data.parts.some((part) => part.part === 'scan' && part.path);
  const lacks = (mode) => (mode !== 'model' && !hasScan) || (mode !== 'scan' && !run.mesh);
  for (const [mode, text] of [['split', 'Side by side'], ['scan', 'Scan'], ['model', 'Model'], ['both', 'Both']])
    modes.append(h('button', { type: 'button', 'data-mode': mode, disabled: lacks(mode), onclick: () => setMode(mode) }, text));

  const toggle = (text, key) => check(text, state[key], (on) => space.update({ [key]: on })).element;
  const storeys = run.storeys.length > 1
    ? h('div', { class: 'storeys', role: 'group', 'aria-label': 'Storeys' }, run.storeys.map((storey) => {
      const box = check(`Storey ${storey}`, true, (on) => { if (on) state.storeys.add(storey); else state.storeys.delete(storey); space.draw(); });
      box.input.dataset.storey = storey;
      return box.element;
    })) : null;
  let painted = false;  // heat maps are seen, on the chosen faces or on all
  const byHand = isCorrected(run) ? { keys: [[CORRECTED, 'corrected by hand']] } : null;
  const showLegend = () => {
    const heated = run.heat && (state.heated || painted);
    legend.replaceChildren(...legendOf(heated ? faceLegend(run) : null), ...legendOf(state.heated ? null : space.modes[state.colour][2]),
                           ...legendOf(state.colour === 'corrected' ? null : byHand), ...legendOf(state.cloud === 'distance' && !heated ? pointLegend(run) : null));
  };
  const colour = run.mesh && run.building ? choice('faces by', Object.entries(space.modes).map(([key, [text]]) => [key, text]), 'class', (value) => { space.update({ colour: value }); showLegend(); }) : null;
  const cloud = choice('points by', [['own', 'their colours'], ['distance', 'distance from the model']], 'own', (value) => { space.update({ cloud: value }); showLegend(); });
  const button = (text, action, attributes = {}) => h('button', { type: 'button', class: 'quiet', onclick: action, ...attributes }, text);
  const section = button('Section box', () => { drawer.hidden = !drawer.hidden; section.setAttribute('aria-pressed', String(!drawer.hidden)); }, { 'aria-pressed': 'false', id: 'section' });
  const measure = button('Measure', () => { measuring.toggle(); measure.setAttribute('aria-pressed', String(measuring.active())); }, { 'aria-pressed': 'false', id: 'measure' });
  const more = h('details', { class: 'menu' }, h('summary', { class: 'quiet' }, 'More'), h('div', { class: 'menu-body' },
    [toggle('edges', 'edges'), toggle('doors and windows', 'openings'), run.mesh?.classes.has('object') ? toggle('furniture', 'objects') : null, toggle('points outside of rooms', 'outside'), toggle('parallel view', 'parallel'),
     colour?.element, cloud.element].filter(Boolean)));
  tools.append(...[modes, h('span', { class: 'gap' }), button('Corner', () => space.look('corner')), button('Top', () => space.look('top')), button('Front', () => space.look('front')), h('span', { class: 'gap' }),
    toggle('ceilings', 'ceilings'), run.heat && run.mesh ? check('residuals on faces', false, (on) => { space.update({ heated: on }); showLegend(); }).element : null, storeys, section, measure, more].filter(Boolean));
  makeSection(space, drawer);

  // A click that is no drag chooses, measures, or gives the place that a form asked for.
  let pressed = null;
  let picking = null;
  const ends = (found) => {
    if (!picking) return;
    const { take } = picking;
    picking = null;
    canvas.classList.remove('measuring');
    message.textContent = '';
    if (found) take(found);
  };
  function pick(take, what) {
    if (measuring.active()) measure.click();
    picking = { take };
    canvas.classList.add('measuring');
    message.textContent = `Click the place "${what}" on a floor or a wall; Escape leaves it.`;
    canvas.focus();
  }
  function chooseAt(x, y) {
    const ray = space.ray(x, y);
    if (measuring.active() || picking) {
      const hit = space.pick(ray, { model: ray.model || !ray.scan || picking !== null, panes: false, points: ray.scan && !picking });
      if (picking) { if (hit) ends(hit.place); } else measuring.add(hit);
      return;
    }
    // Points have no names: a click on them means the face that they are on.
    const hit = space.pick(ray, { model: true, panes: true, points: false });
    if (hit?.opening !== null && hit?.opening !== undefined) choose('opening', hit.opening, hit.place);
    else if (hit?.face !== null && hit?.face !== undefined) choose('face', hit.face, hit.place);
    else choose(null);
  }
  canvas.addEventListener('pointerdown', (event) => { pressed = [event.clientX, event.clientY, event.button]; });
  canvas.addEventListener('click', (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    const frame = canvas.getBoundingClientRect();
    chooseAt(event.clientX - frame.left, event.clientY - frame.top);
  });
  const STEP = Math.PI / 24;
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const [right, up] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [0, 0];
    if (right || up) { if (event.shiftKey) space.pan(0.1 * right, 0.1 * up); else space.turn(STEP * right, STEP * up); }
    else if (event.key === '+' || event.key === '=') space.zoom(1.2);
    else if (event.key === '-') space.zoom(1 / 1.2);
    else if (event.key === 'Enter') chooseAt(canvas.clientWidth * (state.mode === 'split' ? 0.75 : 0.5), canvas.clientHeight / 2);
    else return;
    event.preventDefault();
  });
  addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    const open = document.querySelector('.menu[open], .notes details[open]');
    if (picking) ends(null);
    else if (open) { open.removeAttribute('open'); open.querySelector('summary').focus(); }
    else if (event.target.matches?.('input, select')) event.target.blur();  // what was typed stays
    else if (measuring.active()) { measuring.toggle(); measure.setAttribute('aria-pressed', 'false'); } else choose(null);
  });
  // A click elsewhere closes what lies over the page.
  addEventListener('pointerdown', (event) => { for (const open of document.querySelectorAll('.menu[open], .notes details[open]')) if (!open.contains(event.target)) open.removeAttribute('open'); });
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
  // For scripts beside this one, as tests have: where a place with its true coordinates is on the stage, from its left and top.
  canvas.placeOf = (place) => space.project(run.frame.place(place)).at(-1);
  /** Shows what is chosen: faces, openings, a room. */
  function show(what) {
    painted = (what.faces ?? []).some((f) => run.heat?.faces.has(f)) && state.mode !== 'scan';
    space.choose(what);
    showLegend();
  }
  showLegend();
  return { space, setMode, message, measuring, uncover, show, pick };
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
    const of = thing(kind, index);
    if (kind !== null && !of) return;
    const room = { room: () => index, face: () => of.room, opening: () => of.room_a, wall: () => run.building.faces[of.faces[0]]?.room ?? -1 }[kind]?.() ?? -1;
    const faces = { face: () => [index], wall: () => of.faces }[kind]?.() ?? [];
    stage?.show({ faces, openings: kind === 'opening' ? [index] : [], room: kind === 'room' || kind === 'face' ? room : -1 });
    plan.choose(room);
    tables.choose(selection);
    chosen.show(selection);
    document.documentElement.dataset.chosen = selection ? `${kind} ${index}` : '';
  }
  const thing = (kind, index) => ({ face: run.building?.faces, room: run.building?.rooms, opening: run.building?.openings, wall: run.walls }[kind]?.[index]);
  const hasScan = run.data.parts.some((part) => part.part === 'scan' && part.path);
  // Without anything else the scan says how large all is.
  const alone = hasScan && !run.building && !run.mesh ? await run.readCloud() : null;
  stage = makeStage(run, choose, alone);
  const elsewhere = (kind, index) => {
    const of = thing(kind, index);
    if (of) stage?.uncover(kind === 'wall' ? run.building.faces[of.faces[0]]?.storey ?? 0 : of.storey);
    choose(kind, index);
  };
  /** The next place that is clicked, in the scan's own frame and unit: two numbers where its z points up. */
  const pick = (take, what) => stage?.pick((place) => {
    const true_ = run.frame.back(place).map((v) => v / run.building.unit);
    take(run.frame.z[2] > 0.999999 ? true_.slice(0, 2) : true_);
  }, what);
  plan = makePlan(run, at('plan'), (room) => elsewhere('room', room));
  tables = makeTables(run, at('tables'), elsewhere);
  chosen = makeChosen(run, at('chosen'), { choose: elsewhere, look: (box, direction) => stage?.space.look(direction, grown(box)), pick, corrections });
  chosen.list.replaceWith(corrections.element);
  chosen.show(null);
  notes(run);
  stage?.setMode(hasScan && run.mesh ? 'split' : hasScan ? 'scan' : 'model');
  stage?.space.look('corner');
  marks.model = performance.now();
  document.getElementById('loading')?.remove();
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

start().catch((error) => { document.getElementById('loading')?.remove(); at('notes').replaceChildren(h('p', { class: 'wrong' }, `This page cannot show the run: ${error.message}`)); throw error; });
