// The table of variants, or of means over their seeds: sorted by any column, by mouse or keyboard.
import { differences, groupsOf, labelAt, partnersOf, statistics } from './data.js';
import { check, choice, h } from './dom.js';
import { quantity, shown } from './quantities.js';

const STEP = 400;  // rows are added by so many

export function makeTable(data, root, actions) {
  const seeds = data.varying.some((axis) => axis.seed);
  let means = false;
  let variants = data.variants;
  let sort = { column: null, down: false };
  let limit = STEP;
  let partner = null;

  const compared = data.varying.filter((axis) => !axis.seed && axis.name !== 'sample' && axis.choices.length <= 30);
  const from = choice('values', [['', 'as they are'], ...compared.flatMap((axis) => axis.labels.map((label, i) => [`${axis.index} ${i}`, `as differences from ${axis.title} ${label}`]))], '', (value) => {
    const [axis, index] = value.split(' ').map(Number);
    partner = value === '' ? null : partnersOf(data, data.axes[axis], index);
    render();
  });
  const body = h('tbody');
  const more = h('button', { type: 'button', class: 'quiet', onclick: () => { limit += 4 * STEP; render(); } });
  const head = h('tr');
  const caption = h('caption', { class: 'hidden' }, 'Variants with their metrics; the headings sort.');
  const toggle = check('means over the seeds', means, (on) => { means = on; sort = { column: null, down: false }; render(); });
  root.append(h('div', { class: 'tools' }, compared.length > 0 ? from.element : null, seeds ? toggle.element : null,
                h('span', { class: 'hint' }, 'Click a heading to sort; a row for its details.')),
              h('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Table of variants' },
                h('table', { id: 'table' }, caption, h('thead', {}, head), body)),
              more);

  const axesShown = () => (data.varying.length > 0 ? data.varying : []).filter((axis) => !(means && axis.seed));

  /** [title, unit, key of a row for sorting, cell of a row, class] */
  function columns() {
    const result = [];
    if (!means || data.varying.length === 0) result.push({ title: 'id', key: (row) => row[0].id, cell: (row) => h('code', {}, row[0].id.slice(0, 12)) });
    for (const axis of axesShown())
      result.push({ title: axis.title, key: (row) => quantity(labelAt(axis, row[0]))?.value ?? row[0].choices[axis.index], axis,
                    cell: (row) => labelAt(axis, row[0]), kind: quantity(axis.labels[0]) ? 'number' : '' });
    for (const dimension of data.dimensions.filter((d) => d.drawn))
      result.push({ title: dimension.title, unit: dimension.unit, key: (row) => dimension.place(row[0]), kind: 'number',
                    cell: (row) => dimension.axis.choices[row[0].choices[dimension.axis.index]].set[dimension.title] });
    data.metrics.forEach((metric, index) => result.push({ title: metric.name, unit: metric.unit, kind: 'number metric', metric: index,
                                                          key: (row) => keyOf(row, index), cell: (row) => cellOf(row, metric, index) }));
    result.push({ title: 'status', key: (row) => statusOf(row), cell: statusCell, kind: 'status' });
    return result;
  }

  function keyOf(row, index) {
    if (partner) return differences(row, index, partner)?.mean ?? null;
    if (row.length > 1) return statistics(row, index)?.mean ?? null;
    return row[0].cells[index] ?? null;
  }
  function cellOf(row, metric, index) {
    if (row.length === 1 && !partner) return shown(row[0].cells[index], metric.digits);
    const found = partner ? differences(row, index, partner) : statistics(row, index);
    if (!found) return '–';
    const sign = partner && found.mean > 0 ? '+' : '';
    const digits = metric.digits === undefined || !partner ? metric.digits : metric.digits + 1;  // small against the values
    return [sign + shown(found.mean, digits), found.count > 1 ? h('span', { class: 'spread' }, ` ± ${shown(found.deviation, digits)}`) : null];
  }
  function statusOf(row) {
    const bad = row.filter((v) => v.status !== 'ok');
    if (bad.length === 0) return 'ok';
    return (row.length > 1 ? `${bad.length} of ${row.length} ` : '') + bad[0].status;
  }
  function statusCell(row) {
    const bad = row.find((v) => v.status !== 'ok');
    if (!bad) return h('span', { class: 'ok' }, 'ok');
    return [h('span', { class: 'bad' }, statusOf(row)), bad.message ? h('span', { class: 'message' }, bad.message) : null];
  }

  // Numbers by size, texts after them by name, what is not there last.
  function compare(a, b) {
    if (a === b) return 0;
    if (a === null || a === undefined) return 1;
    if (b === null || b === undefined) return -1;
    if (typeof a === 'number' && typeof b === 'number') return sort.down ? b - a : a - b;
    if (typeof a === 'number') return -1;
    if (typeof b === 'number') return 1;
    return (sort.down ? -1 : 1) * a.localeCompare(b, 'en', { numeric: true });
  }

  function render() {
    const all = columns();
    const rows = means ? groupsOf(data, variants) : variants.map((v) => [v]);
    const by = all.find((column) => column.title === sort.column);
    if (by) {
      const keyed = rows.map((row, index) => ({ row, index, key: by.key(row) }));
      keyed.sort((a, b) => compare(a.key, b.key) || a.index - b.index);
      rows.splice(0, rows.length, ...keyed.map((k) => k.row));
    }
    head.replaceChildren(...all.map(heading));
    body.replaceChildren(...rows.slice(0, limit).map((row) => line(row, all)));
    if (rows.length === 0) body.append(h('tr', {}, h('td', { colspan: all.length, class: 'empty' }, 'No variant matches.')));
    more.hidden = rows.length <= limit;
    more.textContent = `Show ${Math.min(rows.length - limit, 4 * STEP)} more of ${rows.length} rows`;
  }

  function heading(column) {
    const active = sort.column === column.title;
    const button = h('button', { type: 'button', onclick: () => {
      sort = { column: column.title, down: active ? !sort.down : false };
      render();
      [...head.querySelectorAll('button')].find((b) => b.dataset.column === column.title)?.focus();
    } }, h('span', {}, column.title, column.unit ? h('span', { class: 'unit' }, ` ${column.unit}`) : null),
      h('span', { class: 'arrow', 'aria-hidden': 'true' }, active ? (sort.down ? '▼' : '▲') : ''));
    button.dataset.column = column.title;
    return h('th', { scope: 'col', class: column.kind ?? '', 'aria-sort': active ? (sort.down ? 'descending' : 'ascending') : null }, button);
  }

  function line(row, all) {
    const cells = all.map((column, index) => {
      const cell = h('td', { class: column.kind ?? '' }, column.cell(row));
      if (index === 0) cell.replaceChildren(h('button', { type: 'button', class: 'link', title: `Details of ${row[0].label}`, 'aria-label': `Details of ${row[0].label}` }, ...cell.childNodes));
      return cell;
    });
    return h('tr', { class: row.some((v) => v.status !== 'ok') ? 'failed' : '', onclick: () => actions.details(row[0]) }, cells);
  }

  return { show(list) { variants = list; limit = STEP; render(); } };
}
