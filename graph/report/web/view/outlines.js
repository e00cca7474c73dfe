// Bands along the rims of faces and openings: of what is chosen, and of what was corrected by hand.
import { BufferAttribute, BufferGeometry, FrontSide, Mesh } from 'three';
import { lineMaterial } from './shaders.js';

const OFF = 0.004;  // metres before the face

/** Triangles along rings, `width` metres inwards of them; each {ring, normal, storey}: counter-clockwise about its normal. */
export function bandsOf(rims, width) {
  const positions = [];
  const storeys = [];
  for (const { ring, normal, storey } of rims) {
    const lifted = ring.map((p) => p.map((v, k) => v + OFF * normal[k]));
    lifted.forEach((a, i) => {
      const b = lifted[(i + 1) % lifted.length];
      const d = [0, 1, 2].map((k) => b[k] - a[k]);
      const length = Math.hypot(...d);
      if (length < 1e-6) return;
      const inwards = [normal[1] * d[2] - normal[2] * d[1], normal[2] * d[0] - normal[0] * d[2], normal[0] * d[1] - normal[1] * d[0]].map((v) => (width * v) / length);
      const [c, e] = [b, a].map((p) => p.map((v, k) => v + inwards[k]));
      for (const p of [a, b, c, a, c, e]) { positions.push(...p); storeys.push(storey); }
    });
  }
  return { positions: Float32Array.from(positions), storeys: Float32Array.from(storeys) };
}

const rimsOfFace = (face) => [face.outline, ...face.holes].map((ring) => ({ ring, normal: face.normal, storey: face.storey }));
/** Both sides of an opening: its outline is counter-clockwise seen from its room. */
function rimsOfOpening(building, opening) {
  return [[opening.outline_a, building.faces[opening.face_a]], [opening.outline_b, building.faces[opening.face_b]]]
    .filter(([ring, face]) => ring.length > 2 && face).map(([ring, face]) => ({ ring, normal: face.normal, storey: opening.storey }));
}

/** The rims of faces and openings by their numbers. */
export const rimsOf = (building, faces, openings) => [...faces.flatMap((f) => rimsOfFace(building.faces[f])), ...openings.flatMap((o) => rimsOfOpening(building, building.openings[o]))];

/** What was corrected: faces and openings that say so. */
export const correctedRims = (building) => rimsOf(building, building.faces.filter((f) => f.corrections?.length).map((f) => f.index),
                                                  building.openings.filter((o) => o.corrections?.length).map((o) => o.index));

/** A mesh of bands in one colour; it is empty until set(rims). Seen from the side that the faces look to. */
export function makeBands(scene, uniforms, colour, width) {
  const geometry = new BufferGeometry();
  const material = lineMaterial(uniforms, { colour: { value: colour }, opacity: { value: 1 } }, { side: FrontSide, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = 1;
  mesh.visible = false;
  scene.add(mesh);
  return (rims) => {
    const { positions, storeys } = bandsOf(rims, width);
    geometry.dispose();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setAttribute('storey', new BufferAttribute(storeys, 1));
    mesh.visible = positions.length > 0;
  };
}
