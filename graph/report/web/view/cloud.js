// The scan's points from a GLB file, and what of the building each is of.
import { boxOf } from './frame.js';

export const OUTSIDE = 32;  // of a point's storey: it is in no room
const REACH = 0.08;  // metres from a face, as building.accuracy has it
const COMPONENTS = { 5121: [Uint8Array, 255], 5123: [Uint16Array, 65535], 5126: [Float32Array, 1] };

function chunksOf(buffer) {
  const view = new DataView(buffer);
  if (buffer.byteLength < 20 || view.getUint32(0, true) !== 0x46546c67) throw new Error('it is no GLB file');
  const chunks = {};
  for (let at = 12; at + 8 <= buffer.byteLength;) {
    const length = view.getUint32(at, true);
    if (at + 8 + length > buffer.byteLength) throw new Error('it is cut short');
    chunks[view.getUint32(at + 4, true)] = [at + 8, length];
    at += 8 + length;
  }
  const [from, length] = chunks[0x4e4f534a];
  return { json: JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, from, length))), binary: chunks[0x004e4942]?.[0] ?? 0 };
}

/** An accessor's numbers as they stand, how far apart its rows are, and what makes shares of them. */
function rowsOf(buffer, json, binary, index) {
  const accessor = json.accessors[index];
  const view = json.bufferViews[accessor.bufferView];
  const [Type, whole] = COMPONENTS[accessor.componentType] ?? [];
  if (!Type) throw new Error(`numbers of kind ${accessor.componentType} are not read`);
  const size = Type.BYTES_PER_ELEMENT;
  const stride = (view.byteStride ?? 3 * size) / size;
  const from = binary + (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
  if (from % size !== 0) throw new Error('its numbers are not aligned');
  return { values: new Type(buffer, from, accessor.count === 0 ? 0 : (accessor.count - 1) * stride + 3), stride, count: accessor.count, whole };
}

/** The 8 bits of sRGB of a share of light. */
const srgb = (v) => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));

/** {count, positions, colours, own, facing, kind}: see assign(). Rows of four bytes, as graphics cards want them. */
export function readCloud(buffer, run) {
  const { json, binary } = chunksOf(buffer);
  const matrix = json.asset.extras?.to_true ?? [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1];
  const tiles = [];
  for (const node of json.nodes ?? [])
    for (const primitive of json.meshes?.[node.mesh]?.primitives ?? []) if (primitive.mode === 0) tiles.push([node, primitive.attributes]);
  const truly = (p) => [0, 1, 2].map((i) => matrix[i] * p[0] + matrix[4 + i] * p[1] + matrix[8 + i] * p[2] + matrix[12 + i]);
  if (!run.frame.settled && tiles.length) run.frame.settle(truly(tiles[0][0].translation ?? [0, 0, 0]));
  const count = tiles.reduce((sum, [, attributes]) => sum + json.accessors[attributes.POSITION].count, 0);
  const positions = new Float32Array(3 * count);
  const colours = new Uint8Array(4 * count);
  const own = tiles.length > 0 && tiles.every(([, attributes]) => attributes.COLOR_0 !== undefined);
  const table = Uint8Array.from({ length: 65536 }, (_, i) => srgb(i / 65535));
  let at = 0;
  for (const [node, attributes] of tiles) {
    const place = rowsOf(buffer, json, binary, attributes.POSITION);
    const [scale, shift] = [node.scale ?? [1, 1, 1], node.translation ?? [0, 0, 0]];
    // From the numbers as they stand to the page's frame: one matrix, its columns by their images.
    const to = (p) => run.frame.place(truly(p));
    const zero = to(shift);
    const axes = [0, 1, 2].map((k) => to(shift.map((v, i) => (i === k ? v + scale[k] : v))).map((v, i) => (v - zero[i]) / place.whole));
    for (let i = 0, j = 0, o = 3 * at; i < place.count; ++i, j += place.stride, o += 3) {
      const [a, b, c] = [place.values[j], place.values[j + 1], place.values[j + 2]];
      for (let k = 0; k < 3; ++k) positions[o + k] = zero[k] + axes[0][k] * a + axes[1][k] * b + axes[2][k] * c;
    }
    if (own) {
      const colour = rowsOf(buffer, json, binary, attributes.COLOR_0);
      for (let i = 0, j = 0, o = 4 * at; i < colour.count; ++i, j += colour.stride, o += 4)
        for (let k = 0; k < 3; ++k) colours[o + k] = table[Math.round((colour.values[j + k] * 65535) / colour.whole)];
    }
    at += place.count;
  }
  const cloud = { count, positions, colours, own };
  if (!own) byHeight(cloud);
  return Object.assign(cloud, assign(cloud, run.building));
}

/** A scan without colours: dark below, light above. */
function byHeight(cloud) {
  const heights = Float32Array.from({ length: Math.min(cloud.count, 20000) }, (_, i) => cloud.positions[3 * Math.floor((i * cloud.count) / Math.min(cloud.count, 20000)) + 2]).sort();
  const [low, high] = [heights[Math.floor(heights.length * 0.02)] ?? 0, heights[Math.floor(heights.length * 0.98)] ?? 1];
  for (let i = 0; i < cloud.count; ++i) {
    const share = Math.min(1, Math.max(0, (cloud.positions[3 * i + 2] - low) / Math.max(high - low, 0.01)));
    cloud.colours.set([70 + 150 * share, 92 + 126 * share, 128 + 82 * share], 4 * i);
  }
}

/** Which faces are near a place: lists per cell of a grid around the building. */
class FaceGrid {
  constructor(building) {
    const { min, max } = building.box;
    this.min = min.map((v) => v - REACH);
    const size = max.map((v, i) => v + REACH - this.min[i]);
    this.edge = Math.max(0.25, Math.cbrt((size[0] * size[1] * size[2]) / 3e6));
    this.cells = size.map((v) => Math.max(1, Math.ceil(v / this.edge)));
    this.lists = new Map();
    for (const face of building.faces) this.add(face);
  }
  add(face) {
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (const p of face.outline) for (let i = 0; i < 3; ++i) { low[i] = Math.min(low[i], p[i]); high[i] = Math.max(high[i], p[i]); }
    const from = low.map((v, i) => Math.max(0, Math.floor((v - REACH - this.min[i]) / this.edge)));
    const to = high.map((v, i) => Math.min(this.cells[i] - 1, Math.floor((v + REACH - this.min[i]) / this.edge)));
    const near = REACH + 0.87 * this.edge;
    const inside = polygonTest(face, this.edge * 0.5 + REACH);
    for (let z = from[2]; z <= to[2]; ++z)
      for (let y = from[1]; y <= to[1]; ++y)
        for (let x = from[0]; x <= to[0]; ++x) {
          const middle = [x, y, z].map((v, i) => this.min[i] + (v + 0.5) * this.edge);
          if (Math.abs(face.normal[0] * middle[0] + face.normal[1] * middle[1] + face.normal[2] * middle[2] + face.offset) > near || !inside(middle)) continue;
          const key = x + this.cells[0] * (y + this.cells[1] * z);
          if (!this.lists.has(key)) this.lists.set(key, []);
          this.lists.get(key).push(face);
        }
  }
  at(x, y, z) {
    const [i, j, k] = [Math.floor((x - this.min[0]) / this.edge), Math.floor((y - this.min[1]) / this.edge), Math.floor((z - this.min[2]) / this.edge)];
    if (i < 0 || j < 0 || k < 0 || i >= this.cells[0] || j >= this.cells[1] || k >= this.cells[2]) return undefined;
    return this.lists.get(i + this.cells[0] * (j + this.cells[1] * k));
  }
}

/** Whether a place lies over a face's polygon (its holes do not count), or beside it by `slack` at most. */
export function polygonTest(face, slack) {
  const [x, y] = [[1, 2, 0], [0, 2, 1], [0, 1, 2]][face.normal.map(Math.abs).reduce((best, v, i, all) => (v > all[best] ? i : best), 0)];
  const ring = face.outline;
  return (p) => {
    let inside = false;
    for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
      const [a, b] = [ring[i], ring[j]];
      if (a[y] > p[y] !== b[y] > p[y] && p[x] < ((b[x] - a[x]) * (p[y] - a[y])) / (b[y] - a[y]) + a[x]) inside = !inside;
      const [u, v] = [b[x] - a[x], b[y] - a[y]];
      const t = Math.min(1, Math.max(0, ((p[x] - a[x]) * u + (p[y] - a[y]) * v) / (u * u + v * v || 1)));
      if (Math.hypot(a[x] + t * u - p[x], a[y] + t * v - p[y]) <= slack) return true;
    }
    return inside;
  };
}

/**
 * Per point `facing`: the normal of the face that it is on (signed bytes; zero: it is on none), and `kind`: its storey
 * (OUTSIDE: it is in no room), 1 if it is on a ceiling, half millimetres from its face (-128: none).
 */
function assign(cloud, building) {
  const { count, positions } = cloud;
  const [facing, kind] = [new Int8Array(4 * count), new Int8Array(4 * count)];
  if (!building || building.faces.length === 0) {
    for (let o = 2; o < kind.length; o += 4) kind[o] = -128;
    return { facing, kind };
  }
  const grid = new FaceGrid(building);
  const roomAt = roomsFromAbove(building);
  for (let i = 0, o = 0; i < count; ++i, o += 4) {
    const [x, y, z] = [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
    let best = null;
    let least = REACH;
    for (const face of grid.at(x, y, z) ?? []) {
      const distance = face.normal[0] * x + face.normal[1] * y + face.normal[2] * z + face.offset;
      if (Math.abs(distance) < Math.abs(least)) { least = distance; best = face; }
    }
    if (best) {
      kind[o] = Math.min(best.storey, OUTSIDE - 1);
      kind[o + 1] = best.class === 'ceiling' ? 1 : 0;
      kind[o + 2] = Math.max(-127, Math.min(127, Math.round(2000 * least)));
      for (let k = 0; k < 3; ++k) facing[o + k] = Math.round(127 * best.normal[k]);
    } else {
      const room = roomAt(x, y, z);
      kind[o] = room ? Math.min(room.storey, OUTSIDE - 1) : OUTSIDE;
      kind[o + 2] = -128;
    }
  }
  return { facing, kind };
}

/** Gives roomAt(x, y, z): the room that a place is in; seen from above in cells of 10 cm or more, those beside a room are its own too. */
function roomsFromAbove(building) {
  const { min, max } = building.box;
  const edge = Math.max(0.1, Math.max(max[0] - min[0], max[1] - min[1]) / 2000);
  const [width, height] = [Math.ceil((max[0] - min[0]) / edge) + 3, Math.ceil((max[1] - min[1]) / edge) + 3];
  const lists = [[]];  // of rooms over each other, with their heights
  const numbers = new Map();
  const cells = new Uint32Array(width * height);  // which of the lists
  const cell = (v, low) => Math.floor((v - low) / edge) + 1;
  for (const room of building.rooms) {
    const span = boxOf(room.faces.flatMap((f) => building.faces[f].outline));
    const over = polygonTest({ outline: room.outline, normal: [0, 0, 1] }, 1.5 * edge);
    for (let j = Math.max(0, cell(span.min[1], min[1]) - 1); j <= Math.min(height - 1, cell(span.max[1], min[1]) + 1); ++j)
      for (let i = Math.max(0, cell(span.min[0], min[0]) - 1); i <= Math.min(width - 1, cell(span.max[0], min[0]) + 1); ++i) {
        if (!over([min[0] + (i - 0.5) * edge, min[1] + (j - 0.5) * edge, 0])) continue;
        const key = `${cells[i + width * j]} ${room.index}`;
        if (!numbers.has(key)) numbers.set(key, lists.push([...lists[cells[i + width * j]], { room, low: span.min[2] - REACH, high: span.max[2] + REACH }]) - 1);
        cells[i + width * j] = numbers.get(key);
      }
  }
  return (x, y, z) => {
    const [i, j] = [cell(x, min[0]), cell(y, min[1])];
    if (i < 0 || j < 0 || i >= width || j >= height) return undefined;
    return lists[cells[i + width * j]].find(({ low, high }) => z >= low && z <= high)?.room;
  };
}
