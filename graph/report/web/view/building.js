// building.json in the page's frame, with the names that the schedules give to doors and windows.
import { boxOf } from './frame.js';

/** Throws what is wrong in words that a reader of the page understands. */
export function checkBuilding(json) {
  if (json === null || typeof json !== 'object' || json.atrium_building === undefined) throw new Error('it is no building: it has no "atrium_building"');
  if (json.atrium_building !== 1) throw new Error('it is of another version of the format');
  for (const list of ['storeys', 'rooms', 'faces', 'openings', 'walls', 'vertices']) if (!Array.isArray(json[list])) throw new Error(`its list "${list}" is missing`);
  json.faces.forEach((face, index) => {
    if (!Array.isArray(face.outline) || face.outline.length < 3 || !face.outline.every((v) => json.vertices[v])) throw new Error(`the corners of face ${index} are missing`);
  });
}

export function readBuilding(json, frame) {
  checkBuilding(json);
  const vertices = json.vertices.map(frame.local);
  const ring = (indices) => indices.map((i) => vertices[i]);
  const faces = json.faces.map((face, index) => ({
    ...face, index, normal: frame.turn(face.normal), outline: ring(face.outline), holes: (face.holes ?? []).map(ring), openings: [],
    inferred: face.inferred ?? face.primitive < 0,
  }));
  for (const face of faces) face.offset = -dot(face.normal, face.outline[0]);
  const counts = {};
  const openings = json.openings.map((opening, index) => {
    const kind = opening.kind === 'slab' ? 'slab opening' : opening.kind;
    counts[kind] = (counts[kind] ?? 0) + 1;
    const value = { ...opening, index, name: `${kind} ${counts[kind]}`, outline_a: opening.outline_a.map(frame.local), outline_b: opening.outline_b.map(frame.local) };
    for (const face of new Set([opening.face_a, opening.face_b])) if (faces[face]) faces[face].openings.push(value);
    value.storey = faces[opening.face_a]?.storey ?? faces[opening.face_b]?.storey ?? 0;
    return value;
  });
  const base = frame.local([0, 0, 0])[2];
  const storeys = json.storeys.map((storey, index) => {
    const of = faces.filter((face) => face.storey === index);
    const box = boxOf(of.flatMap((face) => face.outline));
    return { ...storey, index, low: of.length ? box.min[2] : storey.elevation + base, high: of.length ? box.max[2] : storey.elevation + base + storey.height };
  });
  const rooms = json.rooms.map((room, index) => ({
    ...room, index, outline: room.outline.map(frame.local), holes: (room.holes ?? []).map((hole) => hole.map(frame.local)),
    openings: openings.filter((o) => o.room_a === index || o.room_b === index),
  }));
  return { faces, rooms, openings, storeys, walls: json.walls, confidence: json.confidence, doubts: json.doubts ?? [],
           unit: json.scan_unit?.metres ?? 1, box: boxOf(vertices.length ? vertices : [[0, 0, 0]]) };
}

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** "face 12": walls are called "wall 3" in walls.csv, which have two of them. */
export const faceName = (face) => `face ${face.index}`;
export const roomName = (building, room) => building.rooms[room]?.name ?? 'outside, or not known';

/** To the right as seen from the room; of a floor or ceiling any direction across. */
export function rightOf(face) {
  const [x, y] = face.normal;
  const length = Math.hypot(x, y);
  return length < 0.1 ? [1, 0, 0] : [-y / length, x / length, 0];
}

/** Where a place is on a wall: metres from its left corner as seen from the room, and over its foot. */
export function placeOn(face, place) {
  const right = rightOf(face);
  const across = face.outline.map((p) => dot(right, p));
  return { from: dot(right, place) - Math.min(...across), length: Math.max(...across) - Math.min(...across), over: place[2] - Math.min(...face.outline.map((p) => p[2])) };
}

export const meanOf = (places) => [0, 1, 2].map((i) => places.reduce((sum, p) => sum + p[i], 0) / places.length);

/** A place well inside of a level outline, at its height: the middle of the widest stretch over a line through it. */
export function placeIn({ outline, holes }) {
  const ys = outline.map((p) => p[1]);
  const [low, high] = [Math.min(...ys), Math.max(...ys)];
  let best = { width: -1, place: meanOf(outline) };
  for (const share of [0.5, 0.3, 0.7, 0.15, 0.85]) {
    const y = low + share * (high - low);
    const crossings = [outline, ...holes].flatMap((ring) => ring.flatMap((a, i) => {
      const b = ring[(i + 1) % ring.length];
      return (a[1] > y) === (b[1] > y) ? [] : [a[0] + ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1])];
    })).sort((a, b) => a - b);
    for (let i = 0; i + 1 < crossings.length; i += 2) {
      const width = crossings[i + 1] - crossings[i];
      if (width > 1.2 * best.width) best = { width, place: [(crossings[i] + crossings[i + 1]) / 2, y, best.place[2]] };
    }
  }
  return best.place;
}

/** Rooms on the other side of a room's walls and openings. */
export function neighbours(building, room) {
  const found = new Set();
  for (const wall of building.walls) {
    const [a, b] = [building.faces[wall.face_a]?.room, building.faces[wall.face_b]?.room];
    if (a === room.index && b >= 0) found.add(b);
    if (b === room.index && a >= 0) found.add(a);
  }
  for (const o of room.openings) for (const other of [o.room_a, o.room_b]) if (other >= 0) found.add(other);
  found.delete(room.index);
  return [...found].sort((a, b) => a - b).map((r) => building.rooms[r]);
}
