// What is shown: a choice of values per axis, a state, and a text. All parts of the report follow it.
import { h } from './dom.js';

const MANY = 12;

export function makeFilters(data, root, changed) {
  const off = new Map(data.varying.map((axis) => [axis, new Set()]));  // the choices that are switched off
  let text = '';
  let state = '';
  const count = h('output', { class: 'count' });
  const reset = h('button', { type: 'button', class: 'quiet', onclick: clear }, 'Show all');

  const matches = (variant) =>
    (state === '' || (state === 'ok') === (variant.status === 'ok')) &&
    data.varying.every((axis) => !off.get(axis).has(variant.choices[axis.index])) &&
    (text === '' || `${variant.id} ${variant.label} ${variant.status} ${variant.message ?? ''}`.toLowerCase().includes(text));

  const current = () => data.variants.filter(matches);
  function update() {
    const shown = current();
    count.textContent = shown.length === data.variants.length ? `${shown.length} variants` : `${shown.length} of ${data.variants.length} variants`;
    reset.hidden = shown.length === data.variants.length;
    changed(shown);
  }

  let timer = 0;
  const later = () => { clearTimeout(timer); timer = setTimeout(update, 120); };

  const search = h('input', { type: 'search', id: 'search', placeholder: 'id, value, message …', 'aria-label': 'Show variants with this text',
                              oninput: () => { text = search.value.toLowerCase(); later(); } });
  const states = h('select', { id: 'state', 'aria-label': 'State', onchange: () => { state = states.value; update(); } },
                   h('option', { value: '' }, 'all states'), h('option', { value: 'ok' }, 'ok only'), h('option', { value: 'not' }, 'failed only'));
  const controls = data.varying.map((axis) => (axis.choices.length > MANY ? list(axis) : chips(axis)));

  function chips(axis) {
    const set = off.get(axis);
    return h('fieldset', { class: 'chips' }, h('legend', {}, axis.title), axis.labels.map((label, index) => {
      const input = h('input', { type: 'checkbox', onchange: () => { input.checked ? set.delete(index) : set.add(index); update(); } });
      input.checked = true;
      return h('label', { class: 'chip' }, input, h('span', {}, label));
    }));
  }
  function list(axis) {
    const set = off.get(axis);
    const select = h('select', { onchange: () => {
      set.clear();
      if (select.value !== '') axis.labels.forEach((_, index) => { if (String(index) !== select.value) set.add(index); });
      update();
    } }, h('option', { value: '' }, `all ${axis.choices.length}`), axis.labels.map((label, index) => h('option', { value: index }, label)));
    return h('label', { class: 'control' }, h('span', {}, axis.title), select);
  }
  function clear() {
    text = state = search.value = states.value = '';
    for (const set of off.values()) set.clear();
    for (const input of root.querySelectorAll('input[type=checkbox]')) input.checked = true;
    for (const select of root.querySelectorAll('select')) select.value = '';
    update();
  }

  if (data.variants.length > 1)
    root.append(h('div', { class: 'filter-row' }, h('div', { class: 'chipsets' }, controls),
                  h('div', { class: 'filter-end' }, search, data.variants.some((v) => v.status !== 'ok') ? states : null, count, reset)));
  else root.hidden = true;
  return { current, update };
}
