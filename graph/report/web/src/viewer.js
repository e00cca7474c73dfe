// The model of a variant in 3D, and a second one beside it under the same camera.
import { AmbientLight, Box3, Color, DirectionalLight, HemisphereLight, Math as MathUtils, OrthographicCamera, PerspectiveCamera, Scene, Vector3,
         WebGLRenderer } from 'three';
import { OrbitControls } from 'three-modules/controls/OrbitControls.js';
import { fileOf } from './data.js';
import { check, choice, h } from './dom.js';
import { dispose, parse, prepare } from './models.js';

export function makeViewer(data, root) {
  const having = data.variants.filter((v) => v.models.length > 0);
  if (having.length === 0) {
    root.hidden = true;
    return { show() {}, open() {} };
  }
  const names = [...new Set(having.flatMap((v) => v.models.map(([path]) => path)))];
  const state = { left: having[0], right: null, name: names[0], hidden: new Set(), edges: true, parallel: false };
  const options = having.map((v) => [v.index, v.label]);
  const left = choice('variant', options, String(state.left.index), (value) => { state.left = data.variants[value]; load(); });
  const right = choice('beside', [['', 'nothing'], ...options], '', (value) => { state.right = value === '' ? null : data.variants[value]; load(true); });
  const model = choice('model', names.map((n) => [n, n]), state.name, (value) => { state.name = value; load(true); });
  const layers = h('div', { class: 'layers', role: 'group', 'aria-label': 'What is shown' });
  const edges = check('edges', state.edges, (on) => { state.edges = on; applyLayers(); });
  const parallel = check('parallel', state.parallel, (on) => { state.parallel = on; makeCamera(); });
  const canvas = h('canvas', { id: 'canvas', tabindex: '0', 'aria-label': 'Model in 3D: drag turns, wheel zooms, right button moves, arrow keys move' });
  const labels = [h('div', { class: 'stage-label' }), h('div', { class: 'stage-label right' })];
  const message = h('p', { class: 'stage-message', role: 'status' });
  const stage = h('div', { class: 'stage' }, canvas, labels, message);
  const view = (name, text) => h('button', { type: 'button', class: 'quiet', onclick: () => look(name) }, text);
  const full = h('button', { type: 'button', class: 'quiet', onclick: () => (document.fullscreenElement ? document.exitFullscreen() : stage.requestFullscreen()) }, 'Full screen');
  root.append(h('div', { class: 'tools' }, left.element, right.element, names.length > 1 ? model.element : null),
              h('div', { class: 'tools' }, layers, edges.element, parallel.element, view('corner', 'Corner'), view('top', 'Top'), view('front', 'Front'), full),
              stage, h('p', { class: 'hint' }, 'Drag to turn, wheel to zoom, right button or two fingers to move. Faces are seen from their front: one looks into the rooms from outside.'));

  let renderer = null, controls = null, camera = null, framed = false, request = 0;
  const scenes = [new Scene(), new Scene()];
  for (const scene of scenes) {
    scene.add(new HemisphereLight(new Color('#ffffff'), new Color('#8d8478').convertSRGBToLinear(), 0.51), new AmbientLight(0xffffff, 0.16));
    const sun = new DirectionalLight(0xffffff, 0.54);
    sun.position.set(2, 5, 3.3);
    scene.add(sun);
  }
  const shown = [null, null];
  const bounds = new Box3();

  function start() {
    if (renderer) return true;
    try {
      const context = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
      if (!context) throw new Error('no WebGL 2');
      renderer = new WebGLRenderer({ canvas, context });
      renderer.gammaOutput = true;
      renderer.gammaFactor = 2.2;
    } catch {
      message.textContent = 'This browser has no WebGL 2: models cannot be shown.';
      return false;
    }
    renderer.setScissorTest(true);
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    makeCamera();
    new ResizeObserver(draw).observe(stage);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
    new MutationObserver(draw).observe(document.documentElement, { attributes: true });
    return true;
  }

  function makeCamera() {
    if (!renderer) return;
    const before = camera ? { position: camera.position.clone(), target: controls.target.clone() } : null;
    controls?.dispose();
    camera = state.parallel ? new OrthographicCamera() : new PerspectiveCamera(40, 1, 0.05, 1000);
    controls = new OrbitControls(camera, canvas);
    controls.screenSpacePanning = true;
    controls.addEventListener('change', draw);
    if (before) {
      camera.position.copy(before.position);
      controls.target.copy(before.target);
      controls.update();
      draw();
    }
  }

  function look(name) {
    if (!controls) return;
    const centre = bounds.isEmpty() ? new Vector3() : bounds.getCenter(new Vector3());
    const direction = new Vector3(...{ corner: [0.75, 0.95, 1], top: [0, 1, 0.0001], front: [0, 0.08, 1] }[name]).normalize();
    camera.position.copy(centre).addScaledVector(direction, fittingDistance(centre, direction));
    controls.target.copy(centre);
    if (camera.isOrthographicCamera) camera.zoom = 1;
    controls.update();
    draw();
  }

  /** So far away that all of the models is seen. */
  function fittingDistance(centre, direction) {
    const across = new Vector3(0, 1, 0).cross(direction).normalize();
    const up = direction.clone().cross(across);
    const vertical = Math.tan(MathUtils.degToRad(20));
    const horizontal = (vertical * stage.clientWidth) / Math.max(stage.clientHeight, 1) / (state.right ? 2 : 1);
    let distance = 0.1;
    for (let i = 0; i < 8 && !bounds.isEmpty(); ++i) {
      const corner = new Vector3(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y, i & 4 ? bounds.max.z : bounds.min.z).sub(centre);
      const near = state.parallel ? 0 : corner.dot(direction);
      distance = Math.max(distance, near + Math.abs(corner.dot(across)) / horizontal, near + Math.abs(corner.dot(up)) / vertical);
    }
    return distance * 1.06;
  }

  function draw() {
    cancelAnimationFrame(request);
    request = requestAnimationFrame(() => {
      if (!renderer || !camera) return;
      const { clientWidth: width, clientHeight: height } = stage;
      renderer.setSize(width, height, false);
      const parts = state.right ? [[0, width / 2 - 1], [width / 2 + 1, width / 2 - 1]] : [[0, width]];
      const ground = new Color(getComputedStyle(stage).getPropertyValue('--stage').trim() || '#ffffff');
      renderer.setViewport(0, 0, width, height);
      renderer.setScissor(0, 0, width, height);
      renderer.setClearColor(new Color(getComputedStyle(stage).getPropertyValue('--line').trim() || '#cccccc'));
      renderer.clear();
      parts.forEach(([from, across], index) => {
        const aspect = across / Math.max(height, 1);
        if (camera.isPerspectiveCamera) camera.aspect = aspect;
        else {
          const half = camera.position.distanceTo(controls.target) * Math.tan(MathUtils.degToRad(20));
          Object.assign(camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: -1000, far: 1000 });
        }
        camera.updateProjectionMatrix();
        renderer.setViewport(from, 0, across, height);
        renderer.setScissor(from, 0, across, height);
        renderer.setClearColor(ground);
        renderer.render(scenes[index], camera);
      });
      canvas.dataset.drawn = String(Number(canvas.dataset.drawn ?? 0) + 1);
    });
  }

  async function place(index, variant) {
    const file = variant?.models.find(([path]) => path === state.name)?.[1];
    const group = file === undefined ? null : await parse(await fileOf(data, file));
    if (shown[index]) { scenes[index].remove(shown[index]); dispose(shown[index]); }
    shown[index] = group;
    if (group) { prepare(group); scenes[index].add(group); }
    labels[index].textContent = variant ? variant.label + (file === undefined ? ': its model is not in this file' : '') : '';
  }

  let loading = Promise.resolve();
  function load(again = false) {
    if (!start()) return loading;
    loading = loading.then(async () => {
      message.textContent = 'Loading …';
      try {
        await place(0, state.left);
        await place(1, state.right);
        message.textContent = '';
      } catch (error) {
        message.textContent = `The model cannot be shown: ${error.message}`;
      }
      stage.classList.toggle('two', Boolean(state.right));
      bounds.makeEmpty();
      for (const group of shown) if (group) bounds.expandByObject(group);
      showLayers();
      if (!framed || again) { framed = true; look('corner'); }
      draw();
      canvas.dataset.variant = state.left.id;
    });
    return loading;
  }

  function showLayers() {
    const found = new Set();
    for (const group of shown) group?.traverse((object) => { if (object.userData.layer) found.add(object.userData.layer); });
    layers.replaceChildren(...[...found].sort().map((name) => check(name, !state.hidden.has(name), (on) => {
      on ? state.hidden.delete(name) : state.hidden.add(name);
      applyLayers();
    }).element));
    applyLayers();
  }
  function applyLayers() {
    for (const group of shown)
      group?.traverse((object) => {
        if (!object.userData.layer) return;
        if (object.userData.edges) object.visible = state.edges;
        else object.visible = !state.hidden.has(object.userData.layer);
      });
    draw();
  }

  // The first model is loaded when one comes to it.
  const seen = new IntersectionObserver((entries) => { if (entries.some((e) => e.isIntersecting)) { seen.disconnect(); load(); } }, { rootMargin: '100px' });
  seen.observe(stage);

  return {
    show() {},
    has: (variant) => variant.models.length > 0,
    open(variant, beside) {
      if (beside) { state.right = variant; right.select.value = String(variant.index); }
      else { state.left = variant; left.select.value = String(variant.index); }
      root.scrollIntoView({ behavior: matchMedia('(prefers-reduced-motion: reduce)').matches ? 'auto' : 'smooth' });
      load(beside);
    },
  };
}

