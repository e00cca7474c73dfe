// The floor plan: the drawing that the run wrote, in which rooms can be clicked.
import { h } from '../src/dom.js';

/** `choose(room index)` is called. Gives {choose(room)}: shows which one is chosen. */
export function makePlan(run, root, choose) {
  root.append(h('h2', {}, 'Plan'));
  const svg = run.plan === null ? null : readDrawing(run);
  if (!svg) {
    root.append(h('p', { class: 'empty' }, 'There is no plan: floorplan.svg is lacking.'));
    return { choose() {} };
  }
  const sheet = h('div', { class: 'sheet', tabindex: '0', 'aria-label': 'Floor plan: wheel zooms, drag moves, click a room. Keys: arrows move, plus and minus zoom, tab goes to the rooms' }, svg);
  const whole = svg.viewBox.baseVal;
  const all = [whole.x, whole.y, whole.width, whole.height];
  let view = [...all];
  const show = (next) => { view = next; svg.setAttribute('viewBox', view.join(' ')); };
  const tools = h('div', { class: 'tools' });
  root.append(tools, sheet);

  const groups = (run.building?.storeys ?? []).map((storey) => svg.querySelector(`#storey-${storey.index}`));
  const fit = (element) => {
    const box = element?.getBBox();
    if (!box || !(box.width > 0)) return show([...all]);
    const margin = 0.03 * Math.max(box.width, box.height);
    return show([box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin]);
  };
  const button = (text, action) => h('button', { type: 'button', class: 'quiet', onclick: action }, text);
  tools.append(button('Sheet', () => show([...all])), ...groups.map((group, i) => (group ? button(groups.length > 1 ? `Storey ${i}` : 'Rooms', () => fit(group)) : null)).filter(Boolean));
  if (groups.length === 1 && groups[0]) requestAnimationFrame(() => fit(groups[0]));

  const rooms = new Map();
  for (const shape of svg.querySelectorAll('[data-room]')) {
    const storey = Number(/^storey-(\d+)$/.exec(shape.closest('[id^="storey-"]')?.id ?? '')?.[1] ?? -1);
    const room = run.building?.rooms.find((r) => r.name === shape.dataset.room && (storey < 0 || r.storey === storey));
    if (!room) continue;
    rooms.set(room.index, shape);
    shape.setAttribute('tabindex', '0');
    shape.setAttribute('role', 'button');
    shape.setAttribute('aria-label', room.name);
    shape.addEventListener('keydown', (event) => { if (event.key === 'Enter' || event.key === ' ') { event.preventDefault(); choose(room.index); } });
  }
  if (run.building && rooms.size === 0) root.append(h('p', { class: 'hint' }, 'This plan was written by an older version: its rooms cannot be clicked.'));

  // Drag moves, a click chooses, the wheel zooms about the pointer.
  const scale = () => Math.max(view[2] / sheet.clientWidth, view[3] / sheet.clientHeight);
  let held = null;
  sheet.addEventListener('pointerdown', (event) => { held = { x: event.clientX, y: event.clientY, view: [...view], moved: false, room: event.target.closest('[data-room]') }; sheet.setPointerCapture(event.pointerId); });
  sheet.addEventListener('pointermove', (event) => {
    if (!held) return;
    const [dx, dy] = [event.clientX - held.x, event.clientY - held.y];
    held.moved ||= Math.hypot(dx, dy) > 4;
    if (held.moved) show([held.view[0] - dx * scale(), held.view[1] - dy * scale(), held.view[2], held.view[3]]);
  });
  sheet.addEventListener('pointerup', () => {
    const index = [...rooms].find(([, shape]) => shape === held?.room)?.[0];
    if (held && !held.moved && index !== undefined) choose(index);
    held = null;
  });
  sheet.addEventListener('wheel', (event) => {
    event.preventDefault();
    const factor = Math.min(2, Math.max(0.5, 1.0015 ** event.deltaY));
    const matrix = svg.getScreenCTM().inverse();
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
    show([at.x - (at.x - view[0]) * factor, at.y - (at.y - view[1]) * factor, view[2] * factor, view[3] * factor]);
  }, { passive: false });

  sheet.addEventListener('keydown', (event) => {
    const [dx, dy] = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key] ?? [0, 0];
    const factor = { '+': 1 / 1.2, '=': 1 / 1.2, '-': 1.2 }[event.key];
    if (event.target !== sheet || event.ctrlKey || event.metaKey || event.altKey || !(dx || dy || factor)) return;
    const [width, height] = [view[2] * (factor ?? 1), view[3] * (factor ?? 1)];
    show([view[0] + dx * view[2] + (view[2] - width) / 2, view[1] + dy * view[3] + (view[3] - height) / 2, width, height]);
    event.preventDefault();
  });

  return {
    choose(room) {
      for (const [index, shape] of rooms) shape.classList.toggle('chosen', index === room);
    },
  };
}

/** The drawing as elements of this page: shapes and texts only. */
function readDrawing(run) {
  const drawn = new DOMParser().parseFromString(run.plan, 'image/svg+xml');
  const svg = drawn.documentElement;
  if (svg.nodeName !== 'svg' || drawn.querySelector('parsererror')) {
    run.notes.push('floorplan.svg cannot be shown: it is no SVG drawing.');
    return null;
  }
  const fine = new Set(['svg', 'g', 'defs', 'pattern', 'path', 'line', 'polygon', 'polyline', 'rect', 'circle', 'ellipse', 'text', 'tspan', 'title', 'clipPath', 'symbol', 'marker']);
  for (const element of [...svg.querySelectorAll('*')]) {
    if (!fine.has(element.nodeName)) element.remove();
    else for (const { name } of [...element.attributes]) if (name.startsWith('on') || name.includes('href')) element.removeAttribute(name);
  }
  for (const name of ['width', 'height']) svg.removeAttribute(name);
  return document.importNode(svg, true);
}
