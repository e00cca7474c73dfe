// Distances between places that are clicked on faces and points.
import { h } from '../src/dom.js';

const near = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

export function makeMeasuring(space, stage, canvas) {
  let on = false;
  let first = null;
  const pairs = [];
  const layer = h('div', { class: 'measures' });
  stage.append(layer);

  /** Labels follow the lines whenever a frame is drawn. */
  space.drawn = () => {
    layer.replaceChildren();
    const put = (place, text, kind) => {
      for (const at of space.project(place)) {
        if (!at) continue;
        const label = h('span', { class: `measure ${kind}` }, text);
        label.style.translate = `${at[0].toFixed(1)}px ${at[1].toFixed(1)}px`;
        layer.append(label);
      }
    };
    if (first) put(first, '', 'dot');
    for (const [a, b] of pairs) {
      put(a, '', 'dot');
      put(b, '', 'dot');
      const [flat, up] = [Math.hypot(a[0] - b[0], a[1] - b[1]), Math.abs(a[2] - b[2])];
      const more = flat > 0.02 && up > 0.02 ? ` (${flat.toFixed(3)} level, ${up.toFixed(3)} up)` : '';
      put(a.map((v, i) => (v + b[i]) / 2), `${near(a, b).toFixed(3)} m${more}`, 'text');
    }
  };

  return {
    active: () => on,
    toggle() {
      on = !on;
      first = null;
      if (!on) pairs.length = 0;
      canvas.classList.toggle('measuring', on);
      space.setMeasured(pairs);
    },
    add(hit) {
      if (!hit) return;
      if (first) { pairs.push([first, hit.place]); first = null; } else first = hit.place;
      space.setMeasured(pairs);
    },
    pairs,
  };
}
