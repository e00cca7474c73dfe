// The model's triangles, by class, with the face, room and storey that each is of.
import { CLASSES, makeReader, readHeader } from '../src/ply.js';

/** {classes: Map of class to {positions, normals, ids}}; ids: face, room, storey (-1: none) of each corner. */
export function readMesh(buffer, frame, building, unit) {
  const bytes = new Uint8Array(buffer);
  const header = readHeader(bytes);
  const read = makeReader(bytes, header);
  let vertices = new Float64Array(0);
  let faces = [];
  for (const element of header.elements) {
    const names = element.properties.map((p) => p.name);
    const [x, y, z] = ['x', 'y', 'z'].map((name) => names.indexOf(name));
    const [list, kind, storey, primitive] = ['vertex_indices', 'class', 'storey', 'primitive'].map((name) => names.indexOf(name));
    if (element.name === 'vertex') vertices = new Float64Array(3 * element.count);
    for (let i = 0; i < element.count; ++i) {
      const row = element.properties.map((p) => (p.list ? Array.from({ length: read(p.list) }, () => read(p.type)) : read(p.type)));
      if (element.name === 'vertex') for (const [k, at] of [x, y, z].entries()) vertices[3 * i + k] = row[at] * unit;
      if (element.name === 'face' && list >= 0) faces.push([row[list], kind < 0 ? -1 : row[kind], storey < 0 ? -1 : row[storey], primitive < 0 ? -1 : row[primitive]]);
    }
  }
  if (vertices.length === 0) throw new Error('it has no vertices');
  if (!frame.settled) settle(frame, vertices);
  const places = new Float32Array(vertices.length);
  for (let i = 0; i < vertices.length; i += 3) places.set(frame.place(vertices.subarray(i, i + 3)), i);
  const corners = new Map();
  for (const [ring, kind, storey, primitive] of faces) {
    const name = CLASSES[kind] ?? 'model';
    if (!corners.has(name)) corners.set(name, { at: [], ids: [] });
    const of = corners.get(name);
    const face = name === 'object' ? undefined : building?.faces[primitive];
    for (let i = 2; i < ring.length; ++i)
      for (const v of [ring[0], ring[i - 1], ring[i]]) {
        if (!(3 * v + 2 < places.length)) throw new Error(`a face names the vertex ${v}, which there is not`);
        of.at.push(v);
        of.ids.push(face ? face.index : -1, face ? face.room : -1, face ? face.storey : storey);
      }
  }
  const classes = new Map();
  for (const name of [...corners.keys()].sort((a, b) => order(a) - order(b))) classes.set(name, geometryOf(corners.get(name), places, building, name));
  return { classes };
}
const order = (name) => ['floor', 'wall', 'ceiling', 'object', 'model'].indexOf(name);

function settle(frame, vertices) {
  const [min, max] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let i = 0; i < vertices.length; ++i) { min[i % 3] = Math.min(min[i % 3], vertices[i]); max[i % 3] = Math.max(max[i % 3], vertices[i]); }
  frame.settle([(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, min[2]]);
}

function geometryOf({ at, ids }, places, building, name) {
  const positions = new Float32Array(3 * at.length);
  at.forEach((v, i) => { for (let k = 0; k < 3; ++k) positions[3 * i + k] = places[3 * v + k]; });
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 9) {
    const [a, b, c] = [positions.subarray(i, i + 3), positions.subarray(i + 3, i + 6), positions.subarray(i + 6, i + 9)];
    const [u, w] = [[b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]];
    const n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
    const length = Math.hypot(...n) || 1;
    for (let corner = 0; corner < 3; ++corner) for (let k = 0; k < 3; ++k) normals[i + 3 * corner + k] = n[k] / length;
    // Furniture is on the storey where it stands.
    if (name === 'object' && building) {
      const storey = storeyAt(building, (a[2] + b[2] + c[2]) / 3);
      for (let corner = 0; corner < 3; ++corner) ids[i + 3 * corner + 2] = storey;
    }
  }
  return { positions, normals, ids: Float32Array.from(ids) };
}

/** The storey that a height is in: the highest that begins below. */
export function storeyAt(building, z) {
  let found = 0;
  for (const storey of building.storeys) if (z >= storey.low - 0.15) found = storey.index;
  return found;
}
