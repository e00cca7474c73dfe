// The page's own frame: metres, z up, x along most walls, zero in the middle of the building's lowest floor.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const length = Math.hypot(...a) || 1; return a.map((v) => v / length); };

/** Of a building (building.json's value), or of nothing: then that of the files, z up. */
export function makeFrame(json) {
  const origin = json?.origin ?? null;
  const up = unit(json?.up ?? [0, 0, 1]);
  // The file's axis that is least along `up` is turned least.
  const first = Math.abs(up[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0];
  let x = unit(first.map((v, i) => v - dot(first, up) * up[i]));
  let y = cross(up, x);
  let [c, s] = [0, 0];
  for (const face of json?.faces ?? []) {
    if (face.class !== 'wall' || Math.abs(dot(face.normal, up)) > 0.3) continue;
    const angle = 4 * Math.atan2(dot(face.normal, y), dot(face.normal, x));
    c += (face.area ?? 1) * Math.cos(angle);
    s += (face.area ?? 1) * Math.sin(angle);
  }
  const turn = Math.atan2(s, c) / 4;
  const turned = x.map((v, i) => Math.cos(turn) * v + Math.sin(turn) * y[i]);
  [x, y] = [turned, cross(up, turned)];
  const middle = [0, 0, 0];
  const frame = {
    x, y, z: up, origin, middle,
    /** A direction. */
    turn: (d) => [dot(x, d), dot(y, d), dot(up, d)],
    /** A place relative to the building's origin. */
    local: (p) => frame.turn([p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]]),
    /** A place with its true coordinates. */
    place: (p) => frame.local(origin ? [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]] : p),
    /** The true coordinates of a place of the page. */
    back: (p) => [0, 1, 2].map((i) => x[i] * p[0] + y[i] * p[1] + up[i] * p[2] + middle[i] + (origin ? origin[i] : 0)),
    /** Without a building: zero is the middle of what there is. */
    settle(centre) { for (let i = 0; i < 3; ++i) middle[i] = centre[i]; frame.settled = true; },
  };
  if (json?.vertices?.length) {
    const box = boxOf(json.vertices.map((v) => frame.turn(v)));
    const floor = Math.min(...json.storeys.map((storey) => storey.elevation), box.max[2]);
    const centre = [(box.min[0] + box.max[0]) / 2, (box.min[1] + box.max[1]) / 2, json.storeys.length ? floor : box.min[2]];
    frame.settle([0, 1, 2].map((i) => x[i] * centre[0] + y[i] * centre[1] + up[i] * centre[2]));
  }
  return frame;
}

export function boxOf(places) {
  const box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
  for (const p of places)
    for (let i = 0; i < 3; ++i) {
      box.min[i] = Math.min(box.min[i], p[i]);
      box.max[i] = Math.max(box.max[i], p[i]);
    }
  return box;
}
