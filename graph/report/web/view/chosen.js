// What is chosen: what is known of it, its heat map, and what can be corrected.
import { h } from '../src/dom.js';
import { faceName, neighbours, placeOn, roomName } from './building.js';
import { distanceColour } from './colours.js';

const metres = (v) => `${v.toFixed(v < 10 ? 3 : 2).replace(/0$/, '')} m`;
const square = (v) => `${v.toFixed(2)} m²`;
const percent = (v) => `${Math.round(100 * v)} %`;
const millimetres = (text) => (text === '' || text === undefined ? '–' : `${Number(text).toFixed(1)} mm`);

/** `actions`: choose(kind, index), look(box), corrections. Gives {show(selection)}. */
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
  const head = (title, mark, box, direction = null) => h('div', { class: 'chosen-head' }, h('h3', {}, title), mark ? h('span', { class: 'mark' }, mark) : null,
                                       h('span', { class: 'space' }), h('button', { type: 'button', class: 'quiet', onclick: () => actions.look(box, direction) }, 'Go there'));

  function accuracyOf(index) {
    const table = run.tables.accuracy;
    const row = table?.rows.find((r) => Number(r[table.columns.indexOf('face')]) === index);
    return row ? Object.fromEntries(table.columns.map((column, i) => [column, row[i]])) : null;
  }

  function showFace(face, place) {
    const accuracy = accuracyOf(face.index);
    const openings = face.openings.reduce((sum, o) => sum + areaOf(o.face_a === face.index ? o.outline_a : o.outline_b), 0);
    return [
      head(faceName(face), face.inferred ? 'inferred, not seen' : null, boxAround(face.outline), from(face)),
      facts([
        ['room', roomLink(face.room)], building.storeys.length > 1 ? ['storey', face.storey] : null,
        ['area', openings > 0 ? `${square((face.area ?? 0) - openings)} and ${square(openings)} of openings` : square(face.area ?? 0)],
        ['seen', `${percent(face.observed)} of it`],
        ['plane fit (RMS)', face.residual > 0 ? `${(1000 * face.residual).toFixed(1)} mm` : '–'],
        accuracy ? ['scan: median', millimetres(accuracy.median_mm)] : null,
        accuracy ? ['scan: 95 % within', accuracy.loa ? `${millimetres(accuracy.p95_mm)}, ${accuracy.loa}` : millimetres(accuracy.p95_mm)] : null,
        accuracy ? ['scan: points', Number(accuracy.points).toLocaleString('en')] : null,
        place && face.class === 'wall' ? ['clicked at', `${metres(placeOn(face, place).from)} from its left corner, ${metres(placeOn(face, place).over)} up`] : null,
        face.openings.length > 0 ? ['openings', joined(face.openings.map((o) => link('opening', o.index, o.name)))] : null,
      ]),
      heatMapOf(run.heatMap, face.index),
      accuracy ? null : h('p', { class: 'hint' }, 'accuracy.csv is lacking: how far the scan is from this face is not known.'),
      editor(face.class === 'wall' ? wallActions(face, place) : levelActions(face)),
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
      editor(roomActions(room)),
    ];
  }

  function showOpening(opening) {
    const face = building.faces[opening.face_a] ?? building.faces[opening.face_b];
    const outline = opening.outline_a.length > 2 ? opening.outline_a : opening.outline_b;
    const sill = face?.class === 'wall' ? Math.min(...outline.map((p) => p[2])) - Math.min(...face.outline.map((p) => p[2])) : null;
    return [
      head(opening.name[0].toUpperCase() + opening.name.slice(1), null, boxAround(outline), from(face)),
      facts([
        ['from', roomLink(opening.room_a)], ['to', roomLink(opening.room_b)],
        opening.width > 0 ? ['width', metres(opening.width)] : null, opening.height > 0 ? ['height', metres(opening.height)] : null,
        sill !== null ? ['sill', metres(Math.max(0, sill))] : null,
        ['wall', opening.thickness > 0 ? `${metres(opening.thickness)} thick` : 'one face of it was seen'],
        ['in', joined([opening.face_a, opening.face_b].filter((f) => f >= 0).map((f) => link('face', f, faceName(building.faces[f]))))],
      ]),
      editor(openingActions(opening)),
    ];
  }

  // What can be corrected: per action [title, fields, keys from the fields' values]; see share/doc/corrections.md.
  const length = (key, label, value, limits = {}) => ({ key, label, value, kind: 'length', least: -100, most: 100, ...limits });
  const roomKey = (face) => building.rooms[face.room].name;
  const wallActions = (face, place) => {
    const at = place ? placeOn(face, place) : { from: 0 };
    return [
      ['Move the wall', [length('by', 'outwards by', '', { hint: '3 cm, −0.05' }), { key: 'both', label: 'the whole wall, with its other side', kind: 'check' }],
       (v) => ['move_wall', { room: roomKey(face), face: face.index, by: v.by, ...(v.both ? { both: true } : {}) }]],
      ['Add a door or window', [
        { key: 'kind', label: 'what', kind: 'choice', options: ['door', 'window', 'passage'] },
        length('width', 'width', '0.9 m', { least: 0.05 }), length('height', 'height', '2.1 m', { least: 0.05 }),
        length('sill', 'sill', '', { least: 0, optional: true, hint: 'windows: 0.9 m' }),
        length('distance', 'from the left corner to the jamb', `${Math.max(0, at.from - 0.45).toFixed(2)} m`, { least: 0 })],
       (v) => {
         if (v.kind === 'window' && !v.sill) throw new Error('a window needs its sill: how far its lower edge is over the wall\'s foot');
         return ['add_opening', { room: roomKey(face), face: face.index, kind: v.kind, distance: v.distance, width: v.width, height: v.height, ...(v.sill ? { sill: v.sill } : {}) }];
       }],
      ['Drop this face', [], () => ['drop_face', { room: roomKey(face), face: face.index }]],
    ];
  };
  const levelActions = (face) => (face.class === 'ceiling' || face.class === 'floor'
    ? [[face.class === 'ceiling' ? 'Move this ceiling' : 'Move this floor', [length('by', 'upwards by', '', { hint: '2 cm' })],
        (v) => [face.class === 'ceiling' ? 'set_ceiling' : 'set_floor', { room: roomKey(face), face: face.index, by: v.by }]]]
    : []);
  const roomActions = (room) => {
    const beside = neighbours(building, room);
    return [
      ['Rename', [{ key: 'name', label: 'name', value: room.name, kind: 'text' }], (v) => {
        if (building.rooms.some((r) => r.name === v.name)) throw new Error(`there is a room "${v.name}" already`);
        return ['rename_room', { room: room.name, name: v.name }];
      }],
      ['Set the ceiling\'s height', [length('height', 'over the floor', '', { least: 0.05, hint: metres(room.height) })], (v) => ['set_ceiling', { room: room.name, height: v.height }]],
      ['Set the floor\'s level', [length('level', 'over the storey\'s elevation', '', { hint: '2 cm' })], (v) => ['set_floor', { room: room.name, level: v.level }]],
      beside.length > 0 ? ['Merge with', [{ key: 'other', label: 'room', kind: 'choice', options: beside.map((r) => r.name) }, { key: 'name', label: 'name', value: room.name, kind: 'text' }],
                           (v) => ['merge_rooms', { rooms: [room.name, v.other], name: v.name }]] : null,
    ].filter(Boolean);
  };
  const openingActions = (opening) => {
    const sides = [opening.room_a, opening.room_b].filter((r) => r >= 0).map((r) => building.rooms[r].name);
    return [
      opening.kind === 'slab' ? null : ['Change', [
        { key: 'kind', label: 'what', kind: 'choice', options: ['door', 'window', 'passage'], value: opening.kind },
        length('width', 'width', '', { least: 0.05, optional: true, hint: metres(opening.width ?? 0) }), length('height', 'height', '', { least: 0.05, optional: true, hint: metres(opening.height ?? 0) }),
        length('sill', 'sill', '', { least: 0, optional: true }), length('by', 'to the right by', '', { optional: true }),
        sides.length > 1 ? { key: 'room', label: 'as seen from', kind: 'choice', options: sides } : null].filter(Boolean),
       (v) => {
         const keys = { opening: opening.name };
         if (v.by && v.room) keys.room = v.room;
         if (v.kind !== opening.kind) keys.kind = v.kind;
         for (const key of ['width', 'height', 'sill', 'by']) if (v[key]) keys[key] = v[key];
         if (Object.keys(keys).length < 2 || (keys.room && Object.keys(keys).length < 3)) throw new Error('nothing is changed: give one value at least');
         return ['change_opening', keys];
       }],
      ['Drop it', [], () => ['drop_opening', { opening: opening.name }]],
    ].filter(Boolean);
  };

  function editor(entries) {
    if (entries.length === 0) return null;
    if (run.corrected)
      return h('p', { class: 'hint' }, 'This run is corrected already, so its numbers are not those that corrections count by: view the run without corrections to write more.');
    return h('div', { class: 'editor' }, h('h4', {}, 'Correct'), entries.map(([title, fields, make]) => {
      const message = h('p', { class: 'wrong', role: 'alert' });
      const inputs = fields.map(inputOf);
      const submit = (event) => {
        event.preventDefault();
        try {
          const values = Object.fromEntries(fields.map((field, i) => [field.key, inputs[i].value()]));
          actions.corrections.add(...make(values));
          message.textContent = '';
          event.target.closest('details')?.removeAttribute('open');
        } catch (error) {
          message.textContent = error.message;
        }
      };
      const form = h('form', { onsubmit: submit }, inputs.map((input) => input.element), h('button', { type: 'submit', class: 'quiet' }, fields.length === 0 ? title : 'Add'), message);
      return fields.length === 0 ? form : h('details', { 'data-action': title }, h('summary', {}, title), form);
    }));
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
      const shown = kind === 'face' ? showFace(building.faces[index], place) : kind === 'room' ? showRoom(building.rooms[index]) : showOpening(building.openings[index]);
      body.replaceChildren(...shown.filter(Boolean));
      body.parentElement.scrollTop = 0;
    },
  };
}

/** One field of a form: {element, value()}, which throws what is wrong. */
function inputOf(field) {
  const label = (input) => h('label', { class: 'field' }, h('span', {}, field.label), input);
  if (field.kind === 'check') {
    const input = h('input', { type: 'checkbox', name: field.key });
    return { element: h('label', { class: 'check' }, input, h('span', {}, field.label)), value: () => input.checked };
  }
  if (field.kind === 'choice') {
    const input = h('select', { name: field.key }, field.options.map((option) => h('option', {}, option)));
    if (field.value) input.value = field.value;
    return { element: label(input), value: () => input.value };
  }
  const input = h('input', { type: 'text', name: field.key, placeholder: field.hint ?? '', autocomplete: 'off', spellcheck: 'false' });
  input.value = field.value ?? '';
  return { element: label(input), value: () => (field.kind === 'text' ? textOf(field, input.value) : lengthOf(field, input.value)) };
}
function textOf(field, text) {
  const value = text.trim();
  if (!value) throw new Error(`${field.label} is empty`);
  return value;
}
const UNITS = { mm: 0.001, cm: 0.01, m: 1, in: 0.0254, ft: 0.3048 };
/** A length as building.correct reads it: metres, or with a unit. */
export function lengthOf(field, text) {
  const value = text.trim().replace('−', '-').replace(',', '.');
  if (!value && field.optional) return null;
  const match = /^([-+]?(?:\d+\.?\d*|\.\d+))\s*(mm|cm|m|in|ft)?$/.exec(value);
  if (!match) throw new Error(`${field.label}: ${value ? `"${value}" is no length` : 'a length is missing'}; right would be 12 cm, 0.12 or 3 ft`);
  const size = Number(match[1]) * (UNITS[match[2]] ?? 1);
  if (size < field.least || size > field.most) throw new Error(`${field.label}: ${value} is not between ${field.least} m and ${field.most} m`);
  return { number: Number(match[1]), unit: match[2] ?? '' };
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

/** The face's part of accuracy.svg, drawn again. */
function heatMapOf(drawing, index) {
  const group = drawing?.getElementById(`face-${index}`);
  const frame = group?.querySelector('rect');
  if (!frame) return null;
  const [x, y, width, height] = ['x', 'y', 'width', 'height'].map((name) => Number(frame.getAttribute(name)));
  if (!(width > 0 && height > 0)) return null;
  const scale = Math.min(8, 720 / width, 320 / height);
  const canvas = h('canvas', { class: 'heat', width: Math.ceil(width * scale), height: Math.ceil(height * scale), role: 'img', 'aria-label': 'Mean distance of the scan from this face' });
  const pen = canvas.getContext('2d');
  pen.fillStyle = '#f4f4f4';
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.setTransform(scale, 0, 0, scale, -x * scale, -y * scale);
  for (const path of group.querySelectorAll('path')) {
    pen.fillStyle = path.getAttribute('fill');
    pen.fill(new Path2D(path.getAttribute('d')));
  }
  const ramp = `linear-gradient(to right, ${[-1, -0.5, 0, 0.5, 1].map((s) => `rgb(${distanceColour(s).join(' ')})`).join(', ')})`;
  const range = /(\d+) mm behind/.exec(drawing.documentElement.textContent)?.[1];
  const bar = h('span', { class: 'ramp' });
  bar.style.background = ramp;
  return h('figure', { class: 'heat-map' }, canvas, h('figcaption', {}, range ? `${range} mm behind` : 'behind', bar, range ? `${range} mm before it` : 'before it', h('span', { class: 'soft' }, ' · seen from the room')));
}


