// The parameters that are not the same in all variants.
import { h } from './dom.js';

const MANY = 8;

export function makeParameters(data, root) {
  if (data.parameters.length === 0) {
    root.hidden = true;
    return { show() {} };
  }
  const body = h('tbody');
  root.append(h('p', { class: 'hint' }, 'As the variants’ resolved files have them: number of variants with each value, of those that are shown.'),
              h('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Parameters that differ' },
                h('table', { class: 'parameters' }, h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, 'parameter'), h('th', { scope: 'col' }, 'values'))), body)));
  return { show(variants) { body.replaceChildren(...data.parameters.map((parameter) => line(parameter, variants))); } };
}

function line(parameter, variants) {
  const counts = new Map();
  for (const variant of variants) {
    const index = parameter.of[variant.index];
    counts.set(index, (counts.get(index) ?? 0) + 1);
  }
  const entries = [...counts].sort((a, b) => a[0] - b[0]);
  const chips = entries.slice(0, MANY).map(([index, count]) => h('span', { class: 'value' }, index < 0 ? h('em', {}, 'none') : parameter.values[index], h('span', { class: 'times' }, ` × ${count}`)));
  if (entries.length > MANY) chips.push(h('span', { class: 'hint' }, `and ${entries.length - MANY} more values`));
  return h('tr', {}, h('th', { scope: 'row' }, h('code', {}, parameter.address)), h('td', {}, chips));
}
