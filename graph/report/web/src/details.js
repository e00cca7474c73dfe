// All about one variant.
import { labelAt, urlOf } from './data.js';
import { h } from './dom.js';
import { seconds, shown } from './quantities.js';

export function makeDetails(data, getViewer) {
  const dialog = h('dialog', { class: 'details', 'aria-label': 'Variant', onclick: (event) => { if (event.target === dialog) dialog.close(); } });
  document.body.append(dialog);

  return (variant) => {
    const viewer = getViewer();
    const go = (beside) => { dialog.close(); viewer.open(variant, beside); };
    const button = (text, action) => h('button', { type: 'button', class: 'quiet', onclick: action }, text);
    const image = h('img', { class: 'preview', hidden: true, alt: '' });
    const [name, file] = variant.pictures.find(([path]) => !path.endsWith('.svg')) ?? variant.pictures[0] ?? [];
    if (name) urlOf(data, file).then((url) => { image.src = url; image.hidden = false; image.alt = name; });
    dialog.replaceChildren(h('div', {},
      h('div', { class: 'bar' }, h('h3', {}, variant.label), variant.models.length > 0 ? [button('Show in 3D', () => go(false)), button('Beside in 3D', () => go(true))] : null,
        button('Close', () => dialog.close())),
      variant.status === 'ok' ? null : h('p', { class: 'note bad-note' }, h('strong', {}, variant.status), variant.message ? `: ${variant.message}` : ''),
      h('p', { class: 'hint' }, data.sweep ? ['files in ', h('code', {}, `variants/${variant.id}`)] : null),
      h('div', { class: 'details-body' },
        h('div', {}, image, table('Varied', data.axes.map((axis) => [axis.title, labelAt(axis, variant)])),
          table('Parameters that differ', data.parameters.filter((p) => p.of[variant.index] >= 0).map((p) => [h('code', {}, p.address), p.values[p.of[variant.index]]]))),
        h('div', {}, table('Metrics', data.metrics.map((metric, i) => [metric.name, `${shown(variant.cells[i], metric.digits)} ${metric.unit}`])),
          table('Nodes', variant.nodes.map(([node, status, wall, cpu, , known]) => [data.nodes[node], status === 'ok' ? `${seconds(cpu)} CPU, ${seconds(wall)}${known ? ', in the cache' : ''}` : status]))))));
    dialog.showModal();
    dialog.scrollTop = 0;
  };
}

function table(title, rows) {
  if (rows.length === 0) return null;
  return [h('h4', {}, title), h('table', { class: 'facts' }, h('tbody', {}, rows.map(([name, value]) => h('tr', {}, h('th', { scope: 'row' }, name), h('td', {}, value)))))];
}
