// How long each node took, as stacked bars.
import { COLOURS, groupsOf } from './data.js';
import { choice, h } from './dom.js';
import { bytes, mean, seconds } from './quantities.js';

const FIRST = 30;

export function makeTimes(data, root, actions) {
  if (data.nodes.length === 0) {
    root.hidden = true;
    return { show() {} };
  }
  let measure = 'cpu';
  let variants = data.variants;
  let limit = FIRST;
  const select = choice('time', [['cpu', 'CPU time'], ['wall', 'wall time'], ['memory', 'highest memory']], measure, (value) => { measure = value; render(); });
  const legend = h('div', { class: 'legend' });
  const rows = h('div', { class: 'bars', role: 'table', 'aria-label': 'Time per node' });
  const more = h('button', { type: 'button', class: 'quiet', onclick: () => { limit += 200; render(); } });
  root.append(h('div', { class: 'tools' }, select.element), legend,
              h('p', { class: 'hint' }, 'Means over the seeds. A node that several variants share was run once and is counted in each; of one that the cache knew it is what it took when it was computed. Wall times are of nodes side by side.'), rows, more);

  const place = { wall: 2, cpu: 3, memory: 4 };
  const amount = (variant, node) => variant.nodes.find((n) => n[0] === node)?.[place[measure]] ?? 0;

  function render() {
    if (measure === 'memory') return renderMemory();
    const total = new Map();
    for (const variant of variants) for (const n of variant.nodes) total.set(n[0], (total.get(n[0]) ?? 0) + n[place[measure]]);
    const order = [...total].sort((a, b) => b[1] - a[1]).map(([node]) => node);
    const named = order.slice(0, COLOURS.length - 1);
    const rest = new Set(order.slice(COLOURS.length - 1));
    const parts = named.map((node, i) => ({ title: data.nodes[node], colour: COLOURS[i], of: (v) => amount(v, node) }));
    if (rest.size > 0) parts.push({ title: `${rest.size} others`, colour: COLOURS[COLOURS.length - 1], of: (v) => v.nodes.reduce((sum, n) => sum + (rest.has(n[0]) ? n[place[measure]] : 0), 0) });
    legend.replaceChildren(...parts.map((part) => h('span', { class: 'key' }, h('i', { class: 'swatch', style: `background:${part.colour}` }), part.title)));
    draw((group) => parts.map((part) => ({ ...part, value: mean(group.map(part.of)) })), seconds);
  }
  function renderMemory() {
    legend.replaceChildren();
    draw((group) => [{ title: 'highest resident memory while a node ran', colour: COLOURS[0], value: Math.max(...group.flatMap((v) => v.nodes.map((n) => n[4])), 0) }], bytes);
  }

  function draw(partsOf, text) {
    const groups = groupsOf(data, variants);
    const bars = groups.slice(0, limit).map((group) => ({ group, parts: partsOf(group) }));
    const sums = bars.map((bar) => bar.parts.reduce((sum, part) => sum + part.value, 0));
    const highest = Math.max(...sums, 1e-12);
    rows.replaceChildren(...bars.map(({ group, parts }, i) => h('div', { class: 'bar-row', role: 'row' },
      h('button', { type: 'button', class: 'link', role: 'rowheader', onclick: () => actions.details(group[0]) }, groupLabel(group)),
      h('div', { class: 'bar-track', role: 'cell' }, parts.filter((p) => p.value > 0).map((part) =>
        h('span', { class: 'bar-part', style: `width:${(part.value / highest) * 100}%;background:${part.colour}`, title: `${part.title}: ${text(part.value)}` }))),
      h('span', { class: 'bar-sum', role: 'cell' }, text(sums[i])))));
    more.hidden = groups.length <= limit;
    more.textContent = `Show more of ${groups.length}`;
  }
  function groupLabel(group) {
    if (group.length === 1) return group[0].label;
    return group[0].label.replace(/(, )?seed [^,]*$/, '') || group[0].label;
  }

  return { show(list) { variants = list; limit = FIRST; render(); } };
}
