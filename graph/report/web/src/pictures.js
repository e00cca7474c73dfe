// The pictures of variants side by side; decoded when they come into view.
import { urlOf } from './data.js';
import { choice, h } from './dom.js';

const STEP = 120;  // so many at once

export function makePictures(data, root) {
  const names = [...new Set(data.variants.flatMap((v) => v.pictures.map(([path]) => path)))];
  if (names.length === 0) {
    root.hidden = true;
    return { show() {} };
  }
  const counts = names.map((name) => data.variants.filter((v) => v.pictures.some(([path]) => path === name)).length);
  // What most variants have, drawn pictures before drawings that are files of their own.
  const rank = (n, i) => counts[i] * 2 + (n.endsWith('.svg') ? 0 : 1);
  let name = names.reduce((best, n, i) => (rank(n, i) > rank(best, names.indexOf(best)) ? n : best));
  let variants = data.variants;
  let limit = STEP;
  let open = [];

  const select = choice('picture', names.map((n) => [n, n]), name, (value) => { name = value; render(); });
  const size = h('input', { type: 'range', min: 120, max: 640, step: 20, value: 260, oninput: resize });
  const grid = h('div', { class: 'sheet' });
  const more = h('button', { type: 'button', class: 'quiet', onclick: () => { limit += 4 * STEP; render(); } });
  root.append(h('div', { class: 'tools' }, names.length > 1 ? select.element : null, h('label', { class: 'control' }, h('span', {}, 'size'), size)), grid, more);

  const seen = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      seen.unobserve(entry.target);
      load(entry.target);
    }
  }, { rootMargin: '300px' });
  async function load(image) { image.src = await urlOf(data, Number(image.dataset.file)); }
  addEventListener('beforeprint', () => grid.querySelectorAll('img:not([src])').forEach(load));

  function resize() { grid.style.setProperty('--cell', `${size.value}px`); }

  function render() {
    open = variants.map((variant) => ({ variant, file: variant.pictures.find(([path]) => path === name)?.[1] }));
    grid.replaceChildren(...open.slice(0, limit).map(cell));
    more.hidden = open.length <= limit;
    more.textContent = `Show ${Math.min(open.length - limit, 4 * STEP)} more of ${open.length}`;
  }

  function cell({ variant, file }, index) {
    if (file === undefined) {
      const why = variant.status === 'ok' ? 'no picture in this file' : `${variant.status}${variant.message ? `: ${variant.message}` : ''}`;
      return h('figure', { class: 'cell' }, h('div', { class: 'none' }, why), h('figcaption', {}, variant.label));
    }
    const image = h('img', { alt: `${name} of ${variant.label}`, 'data-file': file });
    seen.observe(image);
    return h('figure', { class: 'cell' }, h('button', { type: 'button', class: 'picture', onclick: () => enlarge(index) }, image), h('figcaption', {}, variant.label));
  }

  // Large, with the keys ← and → to the next.
  const large = h('img', {});
  const text = h('p', {});
  const dialog = h('dialog', { class: 'large', onclick: (event) => { if (event.target === dialog) dialog.close(); },
                               onkeydown: (event) => { if (event.key === 'ArrowRight') step(1); if (event.key === 'ArrowLeft') step(-1); } },
                   h('div', { class: 'bar' }, h('button', { type: 'button', class: 'quiet', onclick: () => step(-1), 'aria-label': 'Previous' }, '←'),
                     h('button', { type: 'button', class: 'quiet', onclick: () => step(1), 'aria-label': 'Next' }, '→'), text,
                     h('button', { type: 'button', class: 'quiet', onclick: () => dialog.close() }, 'Close')), large);
  document.body.append(dialog);
  let at = 0;
  async function enlarge(index) {
    at = index;
    const { variant, file } = open[at];
    text.textContent = variant.label;
    large.alt = `${name} of ${variant.label}`;
    large.src = await urlOf(data, file);
    if (!dialog.open) dialog.showModal();
  }
  function step(by) {
    for (let i = at + by; i >= 0 && i < open.length; i += by)
      if (open[i].file !== undefined) { enlarge(i); return; }
  }

  resize();
  return { show(list) { variants = list; limit = STEP; render(); } };
}
