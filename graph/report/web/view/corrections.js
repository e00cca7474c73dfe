// Corrections by hand, gathered until they are saved as the file that building.correct reads (share/doc/corrections.md).
import { h } from '../src/dom.js';

/** Text in YAML; names are always in quotes, which are JSON's. */
function scalar(value) {
  if (Array.isArray(value)) return `[${value.map(scalar).join(', ')}]`;
  if (value !== null && typeof value === 'object') return `${value.number}${value.unit ? ` ${value.unit}` : ''}`;
  return typeof value === 'string' && !/^[a-z]+$/.test(value) ? JSON.stringify(value) : String(value);
}
const QUOTED = new Set(['room', 'rooms', 'name', 'names', 'opening', 'wall']);
const quoted = (value) => (Array.isArray(value) ? `[${value.map((v) => JSON.stringify(v)).join(', ')}]` : JSON.stringify(value));
const entry = ([key, value]) => `${key}: ${QUOTED.has(key) ? quoted(value) : scalar(value)}`;
const line = ({ name, keys }) => `${name}: {${Object.entries(keys).map(entry).join(', ')}}`;

export function yamlOf(title, corrections) {
  return `# Corrections of ${title.replace(/[^\x20-\x7e]/g, '?')}, made with atrium view: share/doc/corrections.md.\natrium_corrections: 1\ncorrections:\n${corrections.map((c) => `  - ${line(c)}\n`).join('')}`;
}

/** {add(name, keys), element}; `changed(corrections)` is called. */
export function makeCorrections(run, changed = () => {}) {
  const all = [];
  let saved = true;
  const element = h('div', { class: 'corrections', hidden: true });
  const remove = (index) => { all.splice(index, 1); render(); };
  function save() {
    const url = URL.createObjectURL(new Blob([yamlOf(run.data.title, all)], { type: 'text/yaml' }));
    const anchor = h('a', { href: url, download: 'corrections.yaml' });
    document.body.append(anchor);
    anchor.click();
    anchor.remove();
    setTimeout(() => URL.revokeObjectURL(url), 10000);
    saved = true;
    render();
  }
  function render() {
    element.hidden = all.length === 0;
    element.replaceChildren(
      h('div', { class: 'chosen-head' }, h('h4', {}, `Corrections (${all.length})`), h('span', { class: 'space' }), h('button', { type: 'button', class: 'primary', id: 'save', onclick: save }, 'Save corrections.yaml')),
      h('ol', {}, all.map((c, i) => h('li', {}, h('code', {}, line(c)), h('button', { type: 'button', class: 'link', 'aria-label': `Remove correction ${i + 1}`, onclick: () => remove(i) }, 'remove')))),
      h('p', { class: 'hint' }, 'Run the same command again with ', h('code', {}, '-s corrections=corrections.yaml'), '; what comes before the corrections is taken from the cache.'));
    changed(all);
  }
  addEventListener('beforeunload', (event) => { if (!saved && all.length > 0) event.preventDefault(); });
  return {
    element,
    all,
    add(name, keys) {
      all.push({ name, keys });
      saved = false;
      render();
    },
    text: () => yamlOf(run.data.title, all),
  };
}
