// What can be corrected of a face, a room or an opening: forms that make corrections; see share/doc/corrections.md.
import { meanOf, neighbours, placeIn, placeOn } from './building.js';

export const metres = (v) => `${v.toFixed(v < 10 ? 3 : 2).replace(/0$/, '')} m`;
const length = (key, label, value, limits = {}) => ({ key, label, value, kind: 'length', least: -100, most: 100, ...limits });
const KINDS = ['door', 'window', 'passage'];
const CORNERS = ['left', 'right'];
/** One of two values, which both say where something is. */
function one(values, names) {
  const given = Object.entries(values).filter(([, value]) => value);
  if (given.length !== 1) throw new Error(`give ${names}: one of them`);
  return Object.fromEntries(given);
}

/** A place of the page as a file of corrections says it, in the scan's own frame and unit: numbers of rooms, faces, doors and windows
    change with the program and its parameters, places do not. With its height where there are storeys. */
function near(run, place) {
  const scan = run.frame.back(place).map((v) => Number((v / run.building.unit).toFixed(3)));
  return run.frame.z[2] > 0.999999 && run.building.storeys.length < 2 ? scan.slice(0, 2) : scan;
}
const BEFORE = 0.03; // metres before a face: on its room's side, whatever the rounding
const nearFace = (run, face, place) => near(run, (place ?? meanOf(face.outline)).map((v, i) => v + BEFORE * face.normal[i]));
const nearRoom = (run, room) => near(run, placeIn(room));
const nearOpening = (run, opening) => near(run, meanOf(opening.outline_a.length > 2 ? opening.outline_a : opening.outline_b));

/** Whether part of a wall's face has no other face behind it, as far as walls.csv says. */
function isOuter(run, face) {
  const walls = run.walls.filter((wall) => wall.faces.includes(face.index));
  return walls.length === 0 || walls.some((wall) => wall.faces.length === 1);
}

export function wallActions(run, face, place) {
  const room = run.building.rooms[face.room]?.name;
  if (room === undefined) return [];
  const at = place ? placeOn(face, place) : { from: 0 };
  const which = { room, face: face.index, near: nearFace(run, face, place) };
  return [
    ['Move the wall', [length('by', 'outwards by', '', { hint: '3 cm, −0.05' }), { key: 'both', label: 'the whole wall, with its other side', kind: 'check' }],
     (v) => ['move_wall', { ...which, by: v.by, ...(v.both ? { both: true } : {}) }]],
    isOuter(run, face) ? ['Set the thickness of this outer wall', [length('thickness', 'thickness', '', { least: 0.01, most: 2, hint: '36 cm' })],
                          (v) => ['set_thickness', { ...which, thickness: v.thickness }]] : null,
    ['Add a door or window', [
      { key: 'kind', label: 'what', kind: 'choice', options: KINDS },
      length('width', 'width', '0.9 m', { least: 0.05 }), length('height', 'height', '2.1 m', { least: 0.05 }),
      length('sill', 'sill', '', { least: 0, optional: true, hint: 'windows: 0.9 m' }),
      { key: 'corner', label: 'from the corner on the', kind: 'choice', options: CORNERS },
      length('distance', 'to the nearer jamb', `${Math.max(0, at.from - 0.45).toFixed(2)} m`, { least: 0 })],
     (v) => {
       if (v.kind === 'window' && !v.sill) throw new Error('a window needs its sill: how far its lower edge is over the wall\'s foot');
       return ['add_opening', { ...which, kind: v.kind, distance: v.distance, ...(v.corner === 'right' ? { corner: 'right' } : {}), width: v.width, height: v.height, ...(v.sill ? { sill: v.sill } : {}) }];
     }],
    ['Drop this face', [], () => ['drop_face', which]],
  ].filter(Boolean);
}

export function levelActions(run, face) {
  const room = run.building.rooms[face.room]?.name;
  if (room === undefined) return [];
  const which = { room, face: face.index, near: nearFace(run, face, placeIn(face)) };
  const by = length('by', 'or upwards by', '', { optional: true, hint: '2 cm' });
  if (face.class === 'ceiling')
    return [['Move this ceiling', [length('height', 'to a height over the floor of', '', { least: 0.05, optional: true }), by],
             (v) => ['set_ceiling', { ...which, ...one({ height: v.height, by: v.by }, 'a height, or by how much it moves') }]]];
  if (face.class === 'floor')
    return [['Move this floor', [length('level', 'to, over the storey\'s elevation', '', { optional: true }), by],
             (v) => ['set_floor', { ...which, ...one({ level: v.level, by: v.by }, 'a level, or by how much it moves') }]]];
  return [];
}

export function roomActions(run, room) {
  const { building } = run;
  const which = { room: room.name, near: nearRoom(run, room) };
  const beside = neighbours(building, room).filter((other) => other.storey === room.storey);
  const free = (name) => { if (building.rooms.some((r) => r !== room && r.name === name)) throw new Error(`there is a room "${name}" already`); };
  return [
    ['Rename', [{ key: 'name', label: 'name', value: room.name, kind: 'text' }], (v) => {
      free(v.name);
      if (v.name === room.name) throw new Error('that is its name already');
      return ['rename_room', { ...which, name: v.name }];
    }],
    ['Set the ceiling\'s height', [length('height', 'over the floor', '', { least: 0.05, optional: true, hint: metres(room.height) }), length('by', 'or upwards by', '', { optional: true })],
     (v) => ['set_ceiling', { ...which, ...one({ height: v.height, by: v.by }, 'a height, or by how much it moves') }]],
    ['Set the floor\'s level', [length('level', 'over the storey\'s elevation', '', { optional: true, hint: '2 cm' }), length('by', 'or upwards by', '', { optional: true })],
     (v) => ['set_floor', { ...which, ...one({ level: v.level, by: v.by }, 'a level, or by how much it moves') }]],
    ['Split along a line', [
      { key: 'from', label: 'from', kind: 'place', hint: 'x, y' }, { key: 'to', label: 'to', kind: 'place', hint: 'x, y' },
      { key: 'left', label: 'name of the part on its left', kind: 'text', value: room.name }, { key: 'right', label: 'name of the other', kind: 'text' },
      length('thickness', 'thickness of a wall on it', '', { least: 0, most: 2, optional: true, hint: 'none' })],
     (v) => {
       if (v.left === v.right) throw new Error('both parts have one name');
       free(v.left);
       free(v.right);
       if (Math.hypot(...v.from.map((x, i) => x - (v.to[i] ?? 0))) < 0.01) throw new Error('both places are one: the line runs through two of them');
       return ['split_room', { ...which, from: v.from, to: v.to, names: [v.left, v.right], ...(v.thickness ? { thickness: v.thickness } : {}) }];
     }],
    beside.length > 0 ? ['Merge with', [{ key: 'other', label: 'room', kind: 'choice', options: beside.map((r) => r.name) }, { key: 'name', label: 'name', value: room.name, kind: 'text' }],
                         (v) => ['merge_rooms', { rooms: [room.name, v.other], near: [which.near, nearRoom(run, beside.find((r) => r.name === v.other))], name: v.name }]] : null,
  ].filter(Boolean);
}

export function openingActions(run, opening) {
  const which = { opening: opening.name, near: nearOpening(run, opening) };
  const sides = [opening.room_a, opening.room_b].filter((r) => r >= 0).map((r) => run.building.rooms[r].name);
  return [
    opening.kind === 'slab' ? null : ['Change', [
      { key: 'kind', label: 'what', kind: 'choice', options: KINDS, value: opening.kind },
      length('width', 'width', '', { least: 0.05, optional: true, hint: metres(opening.width ?? 0) }), length('height', 'height', '', { least: 0.05, optional: true, hint: metres(opening.height ?? 0) }),
      length('sill', 'sill', '', { least: 0, optional: true }), length('by', 'to the right by', '', { optional: true }),
      { key: 'corner', label: 'or from the corner on the', kind: 'choice', options: CORNERS }, length('distance', 'to the nearer jamb', '', { least: 0, optional: true }),
      sides.length > 1 ? { key: 'room', label: 'as seen from', kind: 'choice', options: sides } : null].filter(Boolean),
     (v) => {
       if (v.by && v.distance) throw new Error('both say where it is: give one of them');
       const keys = { ...which };
       if ((v.by || v.distance) && v.room) keys.room = v.room;
       if (v.kind !== opening.kind) keys.kind = v.kind;
       for (const key of ['width', 'height', 'sill', 'by', 'distance']) if (v[key]) keys[key] = v[key];
       if (v.distance && v.corner === 'right') keys.corner = 'right';
       if (Object.keys(keys).length < 3) throw new Error('nothing is changed: give one value at least');
       return ['change_opening', keys];
     }],
    ['Drop it', [], () => ['drop_opening', which]],
  ].filter(Boolean);
}
