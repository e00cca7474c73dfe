// What is chosen: what is known of it, its heat map, and what can be corrected.
import { h } from '../src/dom.js';
import { levelActions, metres, openingActions, roomActions, wallActions } from './actions.js';
import { faceName, neighbours, placeOn, roomName } from './building.js';
import { NO_POINTS, distanceColour, distanceRange } from './colours.js';
import { editor } from './forms.js';
import { fixed } from './tables.js';

const square = (v) => `${v.toFixed(2)} m²`;
const percent = (v) => `${Math.round(100 * v)} %`;
const millimetres = (text) => (text === '' || text === undefined ? '–' : `${fixed(Number(text), 1)} mm`);

/** `actions`: choose(kind, index), look(box), pick(take, of what), corrections. Gives {show(selection)}. */
export function makeChosen(run, root, actions) {
  const body = h('div', { class: 'chosen-body' });
  const list = h('div', { class: 'corrections' });
  root.append(h('h2', {}, 'Chosen'), h('div', { class: 'scroll chosen-scroll' }, body, list));
  const building = run.building;
  const link = (kind, index, text) => h('button', { type: 'button', class: 'link', onclick: () => actions.choose(kind, index) }, text);
  const roomLink = (index) => (building.rooms[index] ? link('room', index, building.rooms[index].name) : roomName(building, index));
  const facts = (rows) => h('dl', { class: 'facts' }, rows.filter(Boolean).map(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
  const joined = (items) => items.flatMap((item, i) => (i > 0 ? [', ', item] : [item]));
  // Walls are looked at from their room, a little from above.
  const from = (face) => (face && Math.hypot(face.normal[0], face.normal[1]) > 0.5 ? [face.normal[0], face.normal[1], 0.45] : null);
  const head = (title, label, box, direction = null) => h('div', { class: 'chosen-head' }, h('h3', {}, title), typeof label === 'string' ? h('span', { class: 'mark' }, label) : label,
                                       h('span', { class: 'space' }), h('button', { type: 'button', class: 'quiet', onclick: () => actions.look(box, direction) }, 'Go there'));

  const mark = (of) => (of.corrections?.length ? h('span', { class: 'mark by-hand', title: of.corrections.join('; ') }, 'corrected by hand') : null);
  const done = (of) => (of.corrections?.length ? h('ul', { class: 'doubts by-hand' }, of.corrections.map((text) => h('li', {}, text))) : null);
  /** Forms, unless the numbers are those after corrections: these count as the run without them does. */
  function correcting(entries) {
    if (entries.length === 0) return null;
    if (run.corrected)
      return h('p', { class: 'hint' }, 'This run is corrected already, so its numbers are not those that corrections count by: view the run without corrections to write more.');
    return editor(entries, { add: actions.corrections.add, pick: actions.pick });
  }

  function accuracyOf(index) {
    const table = run.tables.accuracy;
    const row = table?.rows.find((r) => Number(r[table.columns.indexOf('face')]) === index);
    return row ? Object.fromEntries(table.columns.map((column, i) => [column, row[i]])) : null;
  }

  function showFace(face, place) {
    const accuracy = accuracyOf(face.index);
    const openings = face.openings.reduce((sum, o) => sum + areaOf(o.face_a === face.index ? o.outline_a : o.outline_b), 0);
    return [
      head(`Face ${face.index}, a ${face.class}`, mark(face) ?? (face.inferred ? 'inferred, not seen' : null), boxAround(face.outline), from(face)),
      facts([
        ['room', roomLink(face.room)], building.storeys.length > 1 ? ['storey', face.storey] : null,
        ['area', openings > 0 ? `${square((face.area ?? 0) - openings)} and ${square(openings)} of openings` : square(face.area ?? 0)],
        ['seen', `${percent(face.observed)} of it`],
        ['plane fit (RMS)', face.residual > 0 ? `${(1000 * face.residual).toFixed(1)} mm` : '–'],
        accuracy ? ['scan: median', millimetres(accuracy.median_mm)] : null,
        accuracy ? ['scan: 95 % within', accuracy.loa ? `${millimetres(accuracy.p95_mm)}, ${accuracy.loa}` : millimetres(accuracy.p95_mm)] : null,
        accuracy ? ['scan: points', Number(accuracy.points).toLocaleString('en')] : null,
        place && face.class === 'wall' ? ['clicked at', `${metres(placeOn(face, place).from)} from its left corner, ${metres(placeOn(face, place).over)} up`] : null,
        wallsOf(face).length > 0 ? [wallsOf(face).length > 1 ? 'walls' : 'wall', joined(wallsOf(face).map((w) => link('wall', w.index, `${w.name}, ${metres(Number(w.row.thickness_m))}${w.row.thickness_assumed === 'yes' ? ' assumed' : ''}`)))] : null,
        face.openings.length > 0 ? ['openings', joined(face.openings.map((o) => link('opening', o.index, o.name)))] : null,
      ]),
      done(face),
      heatMapOf(run, face.index),
      accuracy ? null : h('p', { class: 'hint' }, 'accuracy.csv is lacking: how far the scan is from this face is not known.'),
      correcting(face.class === 'wall' ? wallActions(run, face, place) : levelActions(run, face)),
    ];
  }
  const wallsOf = (face) => run.walls.filter((wall) => wall.faces.includes(face.index));

  /** A row of walls.csv: its faces have cards of their own. */
  function showWall(wall) {
    const { row } = wall;
    const faces = wall.faces.map((f) => building.faces[f]);
    const room = (name) => building.rooms.find((r) => r.name === name && (row.storey === undefined || r.storey === Number(row.storey)));
    const side = (name) => (room(name) ? link('room', room(name).index, name) : name || 'outside, or not known');
    const hand = { corrections: faces.flatMap((f) => (f.corrections ?? []).map((text) => `face ${f.index}: ${text}`)) };
    return [
      head(wall.name[0].toUpperCase() + wall.name.slice(1), mark(hand), boxAround(faces.flatMap((f) => f.outline)), from(faces[0])),
      facts([
        ['between', [side(row.left_room), ' and ', side(row.right_room)]],
        ['length', metres(Number(row.length_m))], ['height', metres(Number(row.height_m))],
        ['thickness', `${metres(Number(row.thickness_m))}${row.thickness_assumed === 'yes' ? ', assumed: one face of it is known' : ''}`],
        ['side', `${square(Number(row.gross_m2))}, ${square(Number(row.net_m2))} without openings`],
        ['volume', `${Number(row.gross_m3).toFixed(2)} m³, ${Number(row.net_m3).toFixed(2)} m³ without openings`],
        ['faces', joined(faces.map((f) => link('face', f.index, `${faceName(f)}${f.inferred ? ' (inferred)' : ''}`)))],
      ]),
      done(hand),
      ...faces.map((f) => heatMapOf(run, f.index)),
      faces.length > 0 ? h('p', { class: 'hint' }, 'Corrections are written from its faces: choose one of them.') : null,
    ];
  }

  function showRoom(room) {
    const doubts = room.doubts ?? [];
    return [
      head(room.name, room.confidence === undefined ? null : `confidence ${percent(room.confidence)}`, boxAround(room.faces.flatMap((f) => building.faces[f].outline))),
      facts([
        building.storeys.length > 1 ? ['storey', room.storey] : null,
        ['area', square(room.area)], ['height', metres(room.height)], ['volume', `${room.volume.toFixed(2)} m³`],
        ['faces', `${room.faces.length}, ${room.faces.filter((f) => building.faces[f].inferred).length} of them inferred`],
        room.openings.length > 0 ? ['openings', joined(room.openings.map((o) => link('opening', o.index, o.name)))] : null,
        neighbours(building, room).length > 0 ? ['beside', joined(neighbours(building, room).map((r) => link('room', r.index, r.name)))] : null,
      ]),
      doubts.length > 0 ? h('ul', { class: 'doubts' }, doubts.map((doubt) => h('li', {}, doubt))) : null,
      correcting(roomActions(run, room)),
    ];
  }

  function showOpening(opening) {
    const face = building.faces[opening.face_a] ?? building.faces[opening.face_b];
    const outline = opening.outline_a.length > 2 ? opening.outline_a : opening.outline_b;
    const sill = face?.class === 'wall' ? Math.min(...outline.map((p) => p[2])) - Math.min(...face.outline.map((p) => p[2])) : null;
    return [
      head(opening.name[0].toUpperCase() + opening.name.slice(1), mark(opening), boxAround(outline), from(face)),
      facts([
        ['from', roomLink(opening.room_a)], ['to', roomLink(opening.room_b)],
        opening.width > 0 ? ['width', metres(opening.width)] : null, opening.height > 0 ? ['height', metres(opening.height)] : null,
        sill !== null ? ['sill', metres(Math.max(0, sill))] : null,
        ['wall', opening.thickness > 0 ? `${metres(opening.thickness)} thick` : 'one face of it is known'],
        ['in', joined([opening.face_a, opening.face_b].filter((f) => f >= 0).map((f) => link('face', f, faceName(building.faces[f]))))],
      ]),
      done(opening),
      correcting(openingActions(run, opening)),
    ];
  }

  return {
    list,
    show(selection) {
      body.classList.toggle('nothing', !selection);
      if (!building || !selection) {
        body.replaceChildren(h('p', { class: 'empty' }, building ? 'Click a face, a door or a window in the model, a room in the plan, or a row of a table.' : 'Without building.json faces and rooms are not known.'));
        return;
      }
      const { kind, index, place } = selection;
      const shown = { face: () => showFace(building.faces[index], place), room: () => showRoom(building.rooms[index]), opening: () => showOpening(building.openings[index]), wall: () => showWall(run.walls[index]) }[kind]();
      body.replaceChildren(...shown.filter(Boolean));
      body.parentElement.scrollTop = 0;
    },
  };
}

function areaOf(ring) {
  const sum = [0, 0, 0];
  ring.forEach((a, i) => {
    const b = ring[(i + 1) % ring.length];
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]].forEach((v, k) => { sum[k] += v / 2; });
  });
  return Math.hypot(...sum);
}
function boxAround(places) {
  return { min: [0, 1, 2].map((i) => Math.min(...places.map((p) => p[i]))), max: [0, 1, 2].map((i) => Math.max(...places.map((p) => p[i]))) };
}

/** The face's squares as a picture, seen from its room. */
function heatMapOf(run, index) {
  const face = run.heat?.faces.get(index);
  if (!face) return null;
  const { columns, rows, squares } = face;
  const canvas = h('canvas', { class: 'heat', width: columns, height: rows, role: 'img', 'aria-label': `Mean distance of the scan from face ${index}` });
  const scale = Math.max(1, Math.min(12, 360 / columns, 140 / rows));
  canvas.style.width = `${Math.round(columns * scale)}px`;
  canvas.style.aspectRatio = `${columns} / ${rows}`;
  const pen = canvas.getContext('2d');
  const pixels = pen.createImageData(columns, rows);
  squares.forEach((v, i) => {
    const row = rows - 1 - Math.floor(i / columns);
    pixels.data.set([...(Number.isNaN(v) ? NO_POINTS : distanceColour(v / run.heat.range)), 255], 4 * (row * columns + (i % columns)));
  });
  pen.putImageData(pixels, 0, 0);
  const bar = h('span', { class: 'ramp' });
  bar.style.background = `linear-gradient(to right, ${[-1, -0.5, 0, 0.5, 1].map((s) => `rgb(${distanceColour(s).join(' ')})`).join(', ')})`;
  const range = distanceRange(run);
  return h('figure', { class: 'heat-map' }, canvas, h('figcaption', {}, `${range} mm behind`, bar, `${range} mm before it`, h('span', { class: 'soft' }, ' · seen from the room')));
}
