// How far the scan is from the faces, square by square (heat_maps.json, as building.accuracy writes it), and what paints it onto them.

/** {cell, range, faces: Map of face to {corner, across, up, columns, rows, squares}}: metres in the page's frame; squares in metres, NaN: no points. */
export function readHeatMaps(json, frame) {
  if (json.atrium_heat_maps !== 1) throw new Error('it is of another version of the format');
  const faces = new Map();
  for (const face of json.faces) {
    const { columns, rows } = face;
    if (!(columns > 0 && rows > 0) || face.squares.length !== columns * rows) throw new Error(`the squares of face ${face.face} are not ${columns} times ${rows}`);
    faces.set(face.face, {
      columns, rows, corner: frame.place(face.corner.map((v, i) => v + json.origin[i])), across: frame.turn(face.across), up: frame.turn(face.up),
      squares: Float32Array.from(face.squares, (v) => (v === null ? NaN : v * json.step)),
    });
  }
  return { cell: json.cell, range: json.range, faces };
}

const STEP = 0.0001;  // metres: of the numbers in the texture
const MARGIN = 1;     // squares around each face that repeat its edge

/**
 * All faces' squares in one texture: {width, height, data, at: Map of face to its place, left: how many faces have none}. A texel's red
 * and green are a number of 16 bits, STEP times the distance from -32768; its alpha says whether it is known.
 */
export function makeAtlas(heat, largest) {
  const faces = [...heat.faces].sort(([a, x], [b, y]) => y.rows - x.rows || a - b);
  const squares = faces.reduce((sum, [, f]) => sum + (f.columns + 2 * MARGIN) * (f.rows + 2 * MARGIN), 0);
  const widest = faces.reduce((most, [, f]) => Math.max(most, f.columns + 2 * MARGIN), 1);
  const width = Math.min(largest, Math.max(widest, 2 ** Math.ceil(Math.log2(Math.sqrt(squares) + 1))));
  const at = new Map();
  let [x, y, high, left] = [0, 0, 0, 0];
  for (const [index, { columns, rows }] of faces) {
    const [w, h] = [columns + 2 * MARGIN, rows + 2 * MARGIN];
    if (x + w > width) { x = 0; y += high; high = 0; }
    if (w > width || y + h > largest) { left += 1; continue; }
    at.set(index, [x + MARGIN, y + MARGIN]);
    x += w;
    high = Math.max(high, h);
  }
  const height = Math.max(1, y + high);
  const data = new Uint8Array(4 * width * height);
  for (const [index, [left0, low0]] of at) {
    const { columns, rows, squares: values } = heat.faces.get(index);
    for (let j = -MARGIN; j < rows + MARGIN; ++j)
      for (let i = -MARGIN; i < columns + MARGIN; ++i) {
        const value = values[Math.min(rows - 1, Math.max(0, j)) * columns + Math.min(columns - 1, Math.max(0, i))];
        if (Number.isNaN(value)) continue;
        const number = Math.min(65535, Math.max(0, Math.round(value / STEP) + 32768));
        data.set([number >> 8, number & 255, 0, 255], 4 * (left0 + i + width * (low0 + j)));
      }
  }
  return { width, height, data, at, left };
}

/** Where in the texture each corner is of triangles whose `ids` begin with their face; -1: nowhere. */
export function placesInAtlas(positions, ids, heat, atlas) {
  const places = new Float32Array((positions.length / 3) * 2).fill(-1);
  for (let i = 0; i < places.length / 2; ++i) {
    const at = atlas.at.get(ids[3 * i]);
    if (!at) continue;
    const { corner, across, up } = heat.faces.get(ids[3 * i]);
    const d = [0, 1, 2].map((k) => positions[3 * i + k] - corner[k]);
    places[2 * i] = at[0] + (across[0] * d[0] + across[1] * d[1] + across[2] * d[2]) / heat.cell;
    places[2 * i + 1] = at[1] + (up[0] * d[0] + up[1] * d[1] + up[2] * d[2]) / heat.cell;
  }
  return places;
}
