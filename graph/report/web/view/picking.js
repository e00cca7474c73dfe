// What lies under the pointer: a face, an opening, furniture, a point of the scan.
import { OUTSIDE } from './cloud.js';

/** pick(ray): {place, face, opening, thing} of what is nearest; null. */
export function makePicking(run, space, panes) {
  const { state } = space;
  let [low, high] = [[], []];
  const inside = (p) => p.every((v, i) => v >= low[i] && v <= high[i]);

  /** Calls found(distance, triangle) where the ray meets triangles; from both sides, or the front alone. */
  function meet(positions, ray, both, found) {
    const [ox, oy, oz] = ray.origin;
    const [dx, dy, dz] = ray.direction;
    for (let i = 0; i < positions.length; i += 9) {
      const [ax, ay, az] = [positions[i], positions[i + 1], positions[i + 2]];
      const [ux, uy, uz] = [positions[i + 3] - ax, positions[i + 4] - ay, positions[i + 5] - az];
      const [vx, vy, vz] = [positions[i + 6] - ax, positions[i + 7] - ay, positions[i + 8] - az];
      const [px, py, pz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
      const det = ux * px + uy * py + uz * pz;
      if (both ? Math.abs(det) < 1e-12 : det < 1e-12) continue;
      const [tx, ty, tz] = [ox - ax, oy - ay, oz - az];
      const u = (tx * px + ty * py + tz * pz) / det;
      if (u < 0 || u > 1) continue;
      const [qx, qy, qz] = [ty * uz - tz * uy, tz * ux - tx * uz, tx * uy - ty * ux];
      const v = (dx * qx + dy * qy + dz * qz) / det;
      if (v < 0 || u + v > 1) continue;
      const distance = (vx * qx + vy * qy + vz * qz) / det;
      if (distance > 0) found(distance, i / 9);
    }
  }

  return (ray, wanted = { model: true, panes: true, points: false }) => {
    let best = null;
    [low, high] = [space.cutLow(), space.cutHigh()];
    const offer = (distance, storey, make) => {
      if ((best && distance >= best.distance) || !(storey < 0 || state.storeys.has(storey))) return;
      const place = ray.origin.map((v, i) => v + distance * ray.direction[i]);
      if (inside(place)) best = { distance, place, ...make() };
    };
    if (wanted.model)
      for (const [name, of] of run.mesh?.classes ?? []) {
        if ((name === 'ceiling' && !state.ceilings) || (name === 'object' && !state.objects)) continue;
        meet(of.positions, ray, name !== 'floor' && name !== 'wall', (distance, t) => offer(distance, of.ids[9 * t + 2], () => {
          const face = of.ids[9 * t];
          return { face: face >= 0 ? face : null, opening: null, thing: name };
        }));
      }
    if (wanted.panes && panes && state.openings)
      meet(state.ceilings ? panes.positions : panes.positions.subarray(0, 9 * panes.upright), ray, true, (distance, t) => offer(distance, panes.ids[9 * t + 2], () => ({ face: null, opening: panes.openings[t], thing: 'opening' })));
    if (wanted.points && space.cloud) {
      const point = nearestPoint(space.cloud, ray, best?.distance ?? Infinity, state, inside);
      if (point) best = { ...point, face: best?.face ?? null, opening: null, thing: 'point' };
    }
    return best;
  };
}

/** The first point that is within five pixels of the ray, if it lies before `limit` (a little behind it counts as before). */
function nearestPoint(cloud, ray, limit, state, inside) {
  const { positions } = cloud;
  const [ox, oy, oz] = ray.origin;
  const [dx, dy, dz] = ray.direction;
  let best = null;
  let least = limit + 0.05;
  for (let i = 0, o = 0; i < cloud.count; ++i, o += 3) {
    const [x, y, z] = [positions[o] - ox, positions[o + 1] - oy, positions[o + 2] - oz];
    const along = x * dx + y * dy + z * dz;
    if (along <= 0 || along >= least) continue;
    const aside = x * x + y * y + z * z - along * along;
    const reach = 5 * (ray.slope * along + ray.width);
    if (aside > reach * reach) continue;
    const storey = cloud.kind[4 * i];
    if (storey === OUTSIDE ? !state.outside : !state.storeys.has(storey)) continue;
    if (cloud.kind[4 * i + 1] && !state.ceilings) continue;
    if (cloud.facing[4 * i] * dx + cloud.facing[4 * i + 1] * dy + cloud.facing[4 * i + 2] * dz > 0) continue;
    const place = [positions[o], positions[o + 1], positions[o + 2]];
    if (!inside(place)) continue;
    least = along;
    best = { distance: along, place };
  }
  return best;
}
