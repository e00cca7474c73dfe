// The schedules and the accuracy of the faces: tables that sort, whose rows choose what they are of.
import { h } from '../src/dom.js';
import { TABLES } from './run.js';

const WORDS = { m: 'm', m2: 'm²', m3: 'm³', mm: 'mm' };
/** "walls_gross_m2" as words and a unit. */
function titleOf(column) {
  const match = /^(.*)_(m|m2|m3|mm)$/.exec(column);
  return [(match ? match[1] : column).replaceAll('_', ' '), match ? WORDS[match[2]] : ''];
}
const isNumber = (text) => text !== '' && Number.isFinite(Number(text));
/** Without a sign before nothing. */
export const fixed = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, '');
/** As many digits as say something. */
function shown(text, column) {
  if (!isNumber(text) || /^\d+$/.test(text)) return text;
  return fixed(Number(text), /_mm$/.test(column) ? 1 : /thickness|width|sill/.test(column) ? 3 : 2);
}

/** `choose(kind, index)` is called; gives {choose(selection)}: shows the row of what is chosen. */
export function makeTables(run, root, choose) {
  const having = TABLES.filter((name) => run.tables[name]);
  const tabs = h('div', { class: 'tabs', role: 'tablist', 'aria-label': 'Tables' });
  const scroll = h('div', { class: 'scroll', tabindex: '0', role: 'tabpanel', id: 'table' });
  root.append(h('div', { class: 'pane-head' }, h('h2', {}, 'Tables'), tabs), scroll);
  if (having.length === 0) {
    scroll.append(h('p', { class: 'empty' }, 'There are no tables: rooms.csv, doors.csv, windows.csv, walls.csv and accuracy.csv are lacking.'));
    return { choose() {} };
  }
  let current = '';
  let order = null;
  let chosen = new Set();  // the rows' `data-of`
  const rowOf = {
    rooms: (row, columns) => existing('room', run.building?.rooms, row[columns.indexOf('number')]),
    doors: (row, columns) => openingOf(row[columns.indexOf('name')]),
    windows: (row, columns) => openingOf(row[columns.indexOf('name')]),
    accuracy: (row, columns) => existing('face', run.building?.faces, row[columns.indexOf('face')]),
    walls: (row) => { const found = run.walls[run.tables.walls.rows.indexOf(row)]; return found?.faces.length > 0 ? ['wall', found.index] : null; },
  };
  const existing = (kind, all, number) => (number !== '' && all?.[Number(number)] ? [kind, Number(number)] : null);
  const openingOf = (name) => { const found = run.building?.openings.find((o) => o.name === name); return found ? ['opening', found.index] : null; };

  for (const name of having) {
    const tab = h('button', { type: 'button', role: 'tab', class: 'tab', id: `tab-${name}`, 'aria-controls': 'table', onclick: () => { order = null; show(name); } }, name, ' ', h('span', { class: 'count' }, run.tables[name].rows.length));
    tab.dataset.table = name;
    tabs.append(tab);
  }

  tabs.addEventListener('keydown', (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    const next = tabs.children[(having.indexOf(current) + step + having.length) % having.length];
    next.click();
    next.focus();
    event.preventDefault();
  });

  function show(name) {
    current = name;
    scroll.setAttribute('aria-labelledby', `tab-${name}`);
    for (const tab of tabs.children) {
      tab.setAttribute('aria-selected', String(tab.dataset.table === name));
      tab.tabIndex = tab.dataset.table === name ? 0 : -1;
    }
    const { columns, rows } = run.tables[name];
    const numeric = columns.map((_, c) => rows.some((row) => isNumber(row[c] ?? '')) && rows.every((row) => (row[c] ?? '') === '' || isNumber(row[c])));
    const sorted = rows.map((row) => row);
    if (order) {
      const { column, down } = order;
      const value = (row) => (numeric[column] ? (row[column] === '' ? -Infinity : Number(row[column])) : row[column]);
      sorted.sort((a, b) => (numeric[column] ? value(a) - value(b) : String(value(a)).localeCompare(String(value(b)), undefined, { numeric: true })) * (down ? -1 : 1));
    }
    const head = columns.map((column, c) => {
      const [title, unit] = titleOf(column);
      const arrow = order?.column === c ? (order.down ? '▼' : '▲') : '';
      return h('th', { class: numeric[c] ? 'number' : null, scope: 'col', 'aria-sort': arrow ? (order.down ? 'descending' : 'ascending') : null },
               h('button', { type: 'button', onclick: () => { order = { column: c, down: order?.column === c ? !order.down : numeric[c] }; show(name); } }, title, unit ? h('span', { class: 'unit' }, ` ${unit}`) : null, ` ${arrow}`));
    });
    const body = sorted.slice(0, 2000).map((row) => {
      const of = rowOf[name](row, columns);
      const tr = h('tr', of ? { tabindex: '0', class: 'clickable', onclick: () => choose(...of), onkeydown: (event) => { if (event.key === 'Enter' || event.key === ' ') { event.preventDefault(); choose(...of); } } } : {},
                   row.map((text, c) => h('td', { class: numeric[c] ? 'number' : null }, shown(text, columns[c]))));
      if (of) tr.dataset.of = of.join(' ');
      return tr;
    });
    scroll.replaceChildren(h('table', {}, h('thead', {}, h('tr', {}, head)), h('tbody', {}, body)));
    if (rows.length > 2000) scroll.append(h('p', { class: 'hint' }, `${rows.length - 2000} more rows are in ${name}.csv.`));
    mark(false);
  }
  function mark(scrolling) {
    for (const row of scroll.querySelectorAll('tr.chosen')) { row.classList.remove('chosen'); row.removeAttribute('aria-current'); }
    const rows = [...scroll.querySelectorAll('tr[data-of]')].filter((r) => chosen.has(r.dataset.of));
    for (const row of rows) { row.classList.add('chosen'); row.setAttribute('aria-current', 'true'); }
    if (rows.length > 0 && scrolling) rows[0].scrollIntoView({ block: 'nearest' });
  }
  show(having[0]);

  return {
    /** Turns to the table that has it, unless the one that is seen has it too. */
    choose(selection) {
      chosen = new Set(selection ? [`${selection.kind} ${selection.index}`] : []);
      if (!selection) return mark(false);
      // A face's walls are chosen with it, and a wall's faces with that.
      const { kind, index } = selection;
      if (kind === 'face') for (const wall of run.walls) if (wall.faces.includes(index)) chosen.add(`wall ${wall.index}`);
      if (kind === 'wall') for (const face of run.walls[index].faces) chosen.add(`face ${face}`);
      const table = { room: 'rooms', face: current === 'walls' ? 'walls' : 'accuracy', wall: current === 'accuracy' ? 'accuracy' : 'walls', opening: run.building?.openings[index]?.kind === 'window' ? 'windows' : 'doors' }[kind];
      if (run.tables[table] && table !== current) { order = null; show(table); }
      return mark(true);
    },
  };
}
