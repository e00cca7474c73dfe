// Scan and model in 3D. Nothing is drawn unless something has changed: draw() asks for one frame.
import { BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, FrontSide, LineSegments, Mesh, OrthographicCamera, PerspectiveCamera, Points, Scene,
         Spherical, Vector2, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three-modules/controls/OrbitControls.js';
import { OUTSIDE } from './cloud.js';
import { CLASSES, CORRECTED, OPENINGS, distanceRange, faceColours } from './colours.js';
import { boxOf } from './frame.js';
import { makeAtlas, placesInAtlas } from './heat.js';
import { correctedRims, makeBands, rimsOf } from './outlines.js';
import { makePicking } from './picking.js';
import { faceMaterial, lineMaterial, pointMaterial } from './shaders.js';

const FIELD = 38;  // degrees
const HALF = Math.tan((FIELD / 2) * (Math.PI / 180));

/** `stage`: the element that is drawn into; `alone`: the cloud of a run that has neither building nor mesh. Throws where there is no WebGL 2. */
export function makeSpace(run, stage, canvas, alone = null) {
  const context = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
  if (!context) throw new Error('this browser has no WebGL 2');
  const renderer = new WebGLRenderer({ canvas, context });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setScissorTest(true);
  renderer.autoClear = false;

  const building = run.building;
  const box = building?.box ?? boxOf(alone ? triples(alone.positions) : [...(run.mesh?.classes.values() ?? [])].flatMap((of) => chunks(of.positions)));
  if (!Number.isFinite(box.min[0])) Object.assign(box, { min: [-1, -1, 0], max: [1, 1, 2] });
  const bounds = { min: box.min.map((v) => v - 0.3), max: box.max.map((v) => v + 0.3) };
  const state = { mode: 'split', ceilings: false, edges: true, openings: true, objects: true, outside: false, storeys: new Set(run.storeys),
                  low: [...bounds.min], high: [...bounds.max], colour: 'class', cloud: 'own', parallel: false, heated: false };
  const uniforms = {
    low: { value: new Vector3(...state.low) }, high: { value: new Vector3(...state.high) }, shown: { value: new Float32Array(OUTSIDE + 1) },
    face: { value: -1 }, other: { value: -1 }, room: { value: -1 }, light: { value: 1 },
    heated: { value: 0 }, range: { value: distanceRange(run) / 1000 }, squares: { value: null }, squaresSize: { value: new Vector2(1, 1) },
  };
  const atlas = run.heat ? makeAtlas(run.heat, Math.min(8192, renderer.capabilities.maxTextureSize)) : null;
  uniforms.squares.value = new DataTexture(atlas?.data ?? new Uint8Array(4), atlas?.width ?? 1, atlas?.height ?? 1);
  uniforms.squares.value.needsUpdate = true;
  if (atlas) uniforms.squaresSize.value.set(atlas.width, atlas.height);
  if (atlas?.left) run.notes.push(`The heat maps of ${atlas.left} faces are not painted on them: this graphics card has no room for them.`);
  const own = { solid: { value: 1 }, panes: { value: 0.42 }, lines: { value: 0.62 } };
  const cloudUniforms = { size: { value: 0.035 }, scale: { value: 1 }, least: { value: 1.8 * Math.min(devicePixelRatio, 2) }, ceilings: { value: 0 }, coloured: { value: 0 }, range: { value: distanceRange(run) }, parallel: { value: 0 }, eye: { value: new Vector3() } };
  const modes = faceColours(run);

  // One draw call for each class, one for all edges, one for all panes, one for all points.
  const model = new Scene();
  const scan = new Scene();
  const measured = new Scene();
  const meshes = new Map();
  for (const [name, of] of run.mesh?.classes ?? []) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(of.positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(of.normals, 3));
    geometry.setAttribute('ids', new BufferAttribute(of.ids, 3));
    geometry.setAttribute('tint', new BufferAttribute(new Uint8Array(of.positions.length), 3, true));
    geometry.setAttribute('square', new BufferAttribute(atlas ? placesInAtlas(of.positions, of.ids, run.heat, atlas) : new Float32Array((of.positions.length / 3) * 2).fill(-1), 2));
    const sides = name === 'floor' || name === 'wall' ? FrontSide : DoubleSide;
    const mesh = new Mesh(geometry, faceMaterial(uniforms, { opacity: own.solid }, { side: sides, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    mesh.frustumCulled = false;
    meshes.set(name, mesh);
    model.add(mesh);
  }
  const edges = building ? addLines(model, edgesOf(building), uniforms, { opacity: own.lines, colour: { value: new Color(0x20262e) } }) : null;
  const bands = building ? makeBands(model, uniforms, new Color(0xee6b0d), 0.035) : null;
  if (building) makeBands(model, uniforms, new Color(...CORRECTED.map((v) => v / 255)), 0.02)(correctedRims(building));
  const panes = building ? panesOf(building) : null;
  let paneMesh = null;
  if (panes?.positions.length) {
    const geometry = new BufferGeometry();
    for (const [name, size] of [['position', 3], ['normal', 3], ['ids', 3]]) geometry.setAttribute(name, new BufferAttribute(panes[name === 'ids' ? 'ids' : `${name}s`], size));
    geometry.setAttribute('tint', new BufferAttribute(panes.tints, 3, true));
    geometry.setAttribute('square', new BufferAttribute(new Float32Array((panes.positions.length / 3) * 2).fill(-1), 2));
    paneMesh = new Mesh(geometry, faceMaterial(uniforms, { opacity: own.panes }, { side: DoubleSide, transparent: true, depthWrite: false }));
    paneMesh.frustumCulled = false;
    paneMesh.renderOrder = 2;
    model.add(paneMesh);
  }
  let points = null;

  function paint() {
    for (const [name, mesh] of meshes) {
      const tints = mesh.geometry.attributes.tint;
      const ids = mesh.geometry.attributes.ids.array;
      for (let i = 0; i < tints.count; ++i) {
        const face = building?.faces[ids[3 * i]];
        tints.array.set(face ? modes[state.colour][1](face) : CLASSES[name] ?? CLASSES.model, 3 * i);
      }
      tints.needsUpdate = true;
    }
    uniforms.light.value = state.colour === 'class' ? 1 : 0.55;
  }
  paint();

  function setCloud(cloud) {
    if (!cloud || cloud.count === 0) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(cloud.positions, 3));
    geometry.setAttribute('tint', new BufferAttribute(cloud.colours, 4, true));
    geometry.setAttribute('facing', new BufferAttribute(cloud.facing, 4, true));
    geometry.setAttribute('kind', new BufferAttribute(cloud.kind, 4));
    points = new Points(geometry, pointMaterial(uniforms, cloudUniforms));
    points.frustumCulled = false;
    scan.add(points);
    space.cloud = cloud;
    draw();
  }

  let camera = null;
  let controls = null;
  function makeCamera() {
    const before = camera ? { position: camera.position.clone(), target: controls.target.clone() } : null;
    controls?.dispose();
    camera = state.parallel ? new OrthographicCamera() : new PerspectiveCamera(FIELD, 1, 0.05, 2000);
    camera.up.set(0, 0, 1);
    controls = new OrbitControls(camera, canvas);
    controls.screenSpacePanning = true;
    controls.enableKeys = false;  // turn() and its like
    controls.addEventListener('change', draw);
    if (!before) return;
    camera.position.copy(before.position);
    controls.target.copy(before.target);
    controls.update();
    draw();
  }

  const views = { corner: [-0.5, -0.95, 1.3], top: [0, -0.0001, 1], front: [0, -1, 0.12] };
  /** Looks at a box (the building's, without one) so that all of it is seen, from a direction: its name, itself, or today's. */
  function look(from, at = null) {
    const target = at ?? { min: state.low.map((v, i) => Math.max(v, box.min[i])), max: state.high.map((v, i) => Math.min(v, box.max[i])) };
    const centre = new Vector3(...target.min.map((v, i) => (v + target.max[i]) / 2));
    const direction = (from ? new Vector3(...(views[from] ?? from)) : camera.position.clone().sub(controls.target)).normalize();
    camera.position.copy(centre).addScaledVector(direction, fittingDistance(target, centre, direction));
    controls.target.copy(centre);
    if (camera.isOrthographicCamera) camera.zoom = 1;
    controls.update();
    draw();
  }
  function fittingDistance(target, centre, direction) {
    const across = new Vector3(0, 0, 1).cross(direction).normalize();
    const up = direction.clone().cross(across);
    const width = stage.clientWidth / (state.mode === 'split' ? 2 : 1);
    const horizontal = (HALF * width) / Math.max(stage.clientHeight, 1);
    let distance = 0.5;
    for (let i = 0; i < 8; ++i) {
      const corner = new Vector3(...[0, 1, 2].map((k) => (i & (1 << k) ? target.max : target.min)[k])).sub(centre);
      const near = state.parallel ? 0 : corner.dot(direction);
      distance = Math.max(distance, near + Math.abs(corner.dot(across)) / horizontal, near + Math.abs(corner.dot(up)) / HALF);
    }
    return distance * 1.05;
  }

  /** Turns the camera about what it looks at, by radians to the right and up. */
  function turn(right, up) {
    const place = new Spherical().setFromVector3(turned(camera.position.clone().sub(controls.target)));
    place.theta += right;
    place.phi = Math.min(Math.PI - 0.001, Math.max(0.001, place.phi - up));
    camera.position.copy(controls.target).add(turned(new Vector3().setFromSpherical(place), true));
    controls.update();
    draw();
  }
  /** Spherical has y up. */
  const turned = (v, back = false) => (back ? new Vector3(v.x, -v.z, v.y) : new Vector3(v.x, v.z, -v.y));
  /** Moves the camera to the right and up, by shares of what is seen; zoom(1.2) is nearer by a fifth. */
  function pan(right, up) {
    const reach = 2 * HALF * camera.position.distanceTo(controls.target) / (camera.isOrthographicCamera ? camera.zoom : 1);
    const motion = new Vector3().setFromMatrixColumn(camera.matrix, 0).multiplyScalar(right * reach).addScaledVector(new Vector3().setFromMatrixColumn(camera.matrix, 1), up * reach);
    camera.position.add(motion);
    controls.target.add(motion);
    controls.update();
    draw();
  }
  function zoom(factor) {
    if (camera.isOrthographicCamera) camera.zoom *= factor;
    else camera.position.sub(controls.target).multiplyScalar(1 / factor).add(controls.target);
    controls.update();
    draw();
  }

  /** What the section box leaves: where it is as wide as it can be, nothing is cut. */
  const cutLow = () => state.low.map((v, i) => (v <= bounds.min[i] ? -1e9 : v));
  const cutHigh = () => state.high.map((v, i) => (v >= bounds.max[i] ? 1e9 : v));

  let request = 0;
  function draw() {
    if (request) return;
    canvas.dataset.due = 'yes';
    request = requestAnimationFrame(render);
  }
  /** The parts of the stage, from left to right: from where, how wide, what is drawn. */
  function parts() {
    const width = stage.clientWidth;
    if (state.mode === 'split') return [[0, width / 2 - 1, [scan]], [width / 2 + 1, width / 2 - 1, [model]]];
    return [[0, width, { scan: [scan], model: [model], both: [scan, model] }[state.mode]]];
  }
  function aim(aspect) {
    if (camera.isPerspectiveCamera) {
      const distance = camera.position.distanceTo(controls.target);
      Object.assign(camera, { aspect, near: Math.max(0.02, distance / 400), far: distance + 2000 });
    } else {
      const half = camera.position.distanceTo(controls.target) * HALF;
      Object.assign(camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: -2000, far: 2000 });
    }
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }
  function render() {
    request = 0;
    delete canvas.dataset.due;
    const begin = performance.now();
    const { clientWidth: width, clientHeight: height } = stage;
    if (width < 2 || height < 2) return;
    if (canvas.clientWidth !== width || canvas.width !== Math.floor(width * renderer.getPixelRatio()) || canvas.height !== Math.floor(height * renderer.getPixelRatio())) renderer.setSize(width, height, false);
    uniforms.shown.value.fill(0);
    for (const storey of state.storeys) uniforms.shown.value[Math.min(storey, OUTSIDE - 1)] = 1;
    uniforms.shown.value[OUTSIDE] = state.outside ? 1 : 0;
    uniforms.low.value.set(...cutLow());
    uniforms.high.value.set(...cutHigh());
    uniforms.heated.value = state.heated ? 1 : 0;
    for (const [name, mesh] of meshes) mesh.visible = name === 'ceiling' ? state.ceilings : name === 'object' ? state.objects : true;
    if (edges) edges.visible = state.edges;
    if (paneMesh) {
      paneMesh.visible = state.openings;
      paneMesh.geometry.setDrawRange(0, 3 * (state.ceilings ? panes.openings.length : panes.upright));
    }
    const translucent = state.mode === 'both';
    own.solid.value = translucent ? 0.4 : 1;
    for (const mesh of meshes.values()) Object.assign(mesh.material, { transparent: translucent, depthWrite: !translucent });
    cloudUniforms.ceilings.value = state.ceilings ? 1 : 0;
    cloudUniforms.coloured.value = state.cloud === 'distance' ? 1 : 0;
    cloudUniforms.parallel.value = state.parallel ? 1 : 0;
    const style = getComputedStyle(stage);
    const ground = new Color(style.getPropertyValue('--stage').trim() || '#fff');
    renderer.setViewport(0, 0, width, height);
    renderer.setScissor(0, 0, width, height);
    renderer.setClearColor(new Color(style.getPropertyValue('--line').trim() || '#ccc'));
    renderer.clear();
    let calls = 0;
    for (const [from, across, scenes] of parts()) {
      aim(across / height);
      const span = camera.isOrthographicCamera ? camera.position.distanceTo(controls.target) / camera.zoom : 1;
      cloudUniforms.scale.value = (height * renderer.getPixelRatio()) / (2 * HALF * span);
      cloudUniforms.eye.value.copy(state.parallel ? camera.position.clone().sub(controls.target) : camera.position);
      renderer.setViewport(from, 0, across, height);
      renderer.setScissor(from, 0, across, height);
      renderer.setClearColor(ground);
      renderer.clear();
      for (const scene of [...scenes, measured]) {
        renderer.render(scene, camera);
        calls += renderer.info.render.calls;
      }
    }
    canvas.dataset.frames = String(Number(canvas.dataset.frames ?? 0) + 1);
    canvas.dataset.calls = String(calls);
    canvas.dataset.milliseconds = (performance.now() - begin).toFixed(2);
    space.drawn?.();
  }

  /** Where a place of the page is on the stage, once for each of its parts; nothing for what is behind the camera. */
  function project(place) {
    return parts().map(([from, across]) => {
      aim(across / stage.clientHeight);
      const p = new Vector3(...place).project(camera);
      return p.z > 1 ? null : [from + ((p.x + 1) / 2) * across, ((1 - p.y) / 2) * stage.clientHeight];
    });
  }
  /** The ray through a place of the stage, in the part that it is in. */
  function ray(x, y) {
    const [from, across, scenes] = parts().findLast(([start]) => x >= start) ?? parts()[0];
    aim(across / stage.clientHeight);
    const share = [((x - from) / across) * 2 - 1, 1 - (y / stage.clientHeight) * 2];
    const near = new Vector3(...share, -1).unproject(camera);
    const direction = new Vector3(...share, 1).unproject(camera).sub(near).normalize();
    return { origin: near.toArray(), direction: direction.toArray(), scan: scenes.includes(scan), model: scenes.includes(model),
             slope: camera.isPerspectiveCamera ? (2 * HALF) / stage.clientHeight : 0, width: camera.isPerspectiveCamera ? 0 : (camera.top - camera.bottom) / camera.zoom / stage.clientHeight };
  }

  /** Lines between places, over all else: what is measured. */
  function setMeasured(lines) {
    for (const child of [...measured.children]) { measured.remove(child); child.geometry.dispose(); child.material.dispose(); }
    if (lines.length > 0) {
      const positions = Float32Array.from(lines.flat(2));
      const wide = { low: { value: new Vector3(-1e9, -1e9, -1e9) }, high: { value: new Vector3(1e9, 1e9, 1e9) }, shown: { value: new Float32Array(OUTSIDE + 1).fill(1) } };
      addLines(measured, { positions, storeys: new Float32Array(positions.length / 3) }, wide, { opacity: { value: 1 }, colour: { value: new Color(0xd6006c) } }, { depthTest: false });
    }
    draw();
  }

  const space = {
    state, bounds, box, modes, draw, look, turn, pan, zoom, cutLow, cutHigh, setCloud, project, ray, setMeasured, cloud: null, drawn: null,
    /** Draws again after the state was changed. */
    update(changes = {}) {
      Object.assign(state, changes);
      if ('parallel' in changes) makeCamera();
      if ('colour' in changes) paint();
      draw();
    },
    /** Shows faces (two at most are painted, all have a rim), openings and a room as chosen. */
    choose({ faces = [], openings = [], room = -1 }) {
      uniforms.face.value = openings.length > 0 ? -1000 - openings[0] : faces[0] ?? -1;
      uniforms.other.value = faces[1] ?? -1;
      uniforms.room.value = room;
      bands?.(rimsOf(building, faces, openings));
      draw();
    },
    hasCloud: () => points !== null,
  };
  space.pick = makePicking(run, space, panes);
  makeCamera();
  new ResizeObserver(draw).observe(stage);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
  look('corner');
  return space;
}

function* triples(array) { for (let i = 0; i < array.length; i += 3) yield array.subarray(i, i + 3); }
const chunks = (array) => [...triples(array)];

function addLines(scene, { positions, storeys }, uniforms, own, settings = {}) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('storey', new BufferAttribute(storeys, 1));
  const lines = new LineSegments(geometry, lineMaterial(uniforms, own, settings));
  lines.frustumCulled = false;
  lines.renderOrder = 1;
  scene.add(lines);
  return lines;
}

/** The outlines of walls and floors (those of ceilings are theirs) and of openings. */
function edgesOf(building) {
  const positions = [];
  const storeys = [];
  const add = (ring, storey) => ring.forEach((p, i) => { positions.push(...p, ...ring[(i + 1) % ring.length]); storeys.push(storey, storey); });
  for (const face of building.faces) if (face.class !== 'ceiling') for (const ring of [face.outline, ...face.holes]) add(ring, face.storey);
  for (const opening of building.openings) for (const ring of [opening.outline_a, opening.outline_b]) if (ring.length > 2) add(ring, opening.storey);
  return { positions: Float32Array.from(positions), storeys: Float32Array.from(storeys) };
}

/** What closes openings: one pane in the middle of each. `openings`: which, per triangle; first the `upright` ones in walls. */
function panesOf(building) {
  const panes = { positions: [], normals: [], ids: [], tints: [], openings: [], upright: 0 };
  const faceOf = (opening) => building.faces[opening.face_a] ?? building.faces[opening.face_b];
  const inRoof = (opening) => faceOf(opening)?.class === 'ceiling';
  for (const opening of [...building.openings].sort((a, b) => inRoof(a) - inRoof(b))) {
    const a = opening.outline_a;
    if (a.length < 3 || opening.kind === 'slab') continue;
    const face = faceOf(opening);
    const normal = face?.normal ?? [0, 0, 1];
    const into = 0.5 * (opening.thickness || 0.1);
    const ring = a.map((p) => p.map((v, i) => v - normal[i] * into));
    for (let i = 2; i < ring.length; ++i) {
      for (const p of [ring[0], ring[i - 1], ring[i]]) {
        panes.positions.push(...p);
        panes.normals.push(...normal);
        panes.ids.push(-1000 - opening.index, -1, opening.storey);
        panes.tints.push(...(OPENINGS[opening.kind] ?? OPENINGS.passage));
      }
      panes.openings.push(opening.index);
    }
    if (!inRoof(opening)) panes.upright = panes.openings.length;
  }
  return { positions: Float32Array.from(panes.positions), normals: Float32Array.from(panes.normals), ids: Float32Array.from(panes.ids), tints: Uint8Array.from(panes.tints), openings: panes.openings, upright: panes.upright };
}
