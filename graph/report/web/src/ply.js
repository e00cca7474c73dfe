// Meshes in PLY (ascii and binary, little-endian), with the faces' property `class` and colours, as three's own reader has none.
import { BufferAttribute, BufferGeometry, Group, Mesh, MeshStandardMaterial, DoubleSide, FrontSide, Color } from 'three';

const SIZES = { char: 1, uchar: 1, int8: 1, uint8: 1, short: 2, ushort: 2, int16: 2, uint16: 2, int: 4, uint: 4, int32: 4, uint32: 4, float: 4, float32: 4, double: 8, float64: 8 };
export const CLASSES = ['object', 'wall', 'floor', 'ceiling'];
export const CLASS_COLOURS = { object: '#b5b5b5', wall: '#56b4e9', floor: '#e69f00', ceiling: '#009e73' };

export function readHeader(bytes) {
  const end = new TextDecoder('latin1').decode(bytes.subarray(0, 65536));
  const match = /end_header\r?\n/.exec(end);
  if (!end.startsWith('ply') || !match) throw new Error('this is no PLY file');
  const elements = [];
  let format = '';
  for (const line of end.slice(0, match.index).split(/\r?\n/)) {
    const words = line.trim().split(/\s+/);
    if (words[0] === 'format') format = words[1];
    if (words[0] === 'element') elements.push({ name: words[1], count: Number(words[2]), properties: [] });
    if (words[0] === 'property') elements.at(-1).properties.push(words[1] === 'list' ? { list: words[2], type: words[3], name: words[4] } : { type: words[1], name: words[2] });
  }
  if (format === 'binary_big_endian') throw new Error('big-endian PLY files are not shown');
  return { elements, ascii: format === 'ascii', start: match.index + match[0].length };
}

export function makeReader(bytes, header) {
  if (header.ascii) {
    const words = new TextDecoder().decode(bytes.subarray(header.start)).split(/\s+/).filter(Boolean);
    let next = 0;
    return () => Number(words[next++]);
  }
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = header.start;
  return (type) => {
    const here = at;
    at += SIZES[type];
    switch (type) {
      case 'char': case 'int8': return view.getInt8(here);
      case 'uchar': case 'uint8': return view.getUint8(here);
      case 'short': case 'int16': return view.getInt16(here, true);
      case 'ushort': case 'uint16': return view.getUint16(here, true);
      case 'int': case 'int32': return view.getInt32(here, true);
      case 'uint': case 'uint32': return view.getUint32(here, true);
      case 'float': case 'float32': return view.getFloat32(here, true);
      default: return view.getFloat64(here, true);
    }
  };
}

/** A group with a mesh per class, z up. */
export function parsePly(buffer) {
  const bytes = new Uint8Array(buffer);
  const header = readHeader(bytes);
  const read = makeReader(bytes, header);
  const places = [];
  const corners = new Map();
  for (const element of header.elements)
    for (let i = 0; i < element.count; ++i) {
      const row = {};
      for (const property of element.properties) {
        if (!property.list) row[property.name] = read(property.type);
        else row[property.name] = Array.from({ length: read(property.list) }, () => read(property.type));
      }
      if (element.name === 'vertex') places.push(row.x, row.y, row.z);
      if (element.name === 'face') addFace(row, corners);
    }
  const origin = [places[0] ?? 0, places[1] ?? 0, places[2] ?? 0].map(Math.round);  // float32 on the graphics card
  const group = new Group();
  for (const [name, list] of corners) {
    const positions = new Float32Array(list.length * 3);
    list.forEach((v, i) => { for (let k = 0; k < 3; ++k) positions[3 * i + k] = places[3 * v + k] - origin[k]; });
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.computeVertexNormals();
    const colour = new Color(CLASS_COLOURS[name] ?? '#b5b5b5').convertSRGBToLinear();
    const mesh = new Mesh(geometry, new MeshStandardMaterial({ color: colour, roughness: 1, metalness: 0, side: name === 'object' || name === 'model' ? DoubleSide : FrontSide }));
    mesh.userData.class = name;
    group.add(mesh);
  }
  return group;
}

function addFace(row, corners) {
  const vertices = row.vertex_indices ?? row.vertex_index ?? [];
  const name = row.class === undefined ? 'model' : CLASSES[row.class] ?? `class ${row.class}`;
  if (!corners.has(name)) corners.set(name, []);
  const list = corners.get(name);
  for (let i = 2; i < vertices.length; ++i) list.push(vertices[0], vertices[i - 1], vertices[i]);
}
