import { readData } from './data.js';
import { makeDetails } from './details.js';
import { h } from './dom.js';
import { makeFilters } from './filters.js';
import { makeParameters } from './parameters.js';
import { makePictures } from './pictures.js';
import { makePlots } from './plots.js';
import { makeTable } from './table.js';
import { makeTimes } from './times.js';
import { makeViewer } from './viewer.js';

const at = (id) => document.getElementById(id);

function head(data) {
  at('title').textContent = data.title;
  at('summary').textContent = data.summary;
  at('notes').append(...data.notes.map((note) => h('p', { class: 'note' }, note)));
  const bad = data.variants.filter((v) => v.status !== 'ok').length;
  const figures = [['variants', data.variants.length]];
  if (bad > 0) figures.push(['not ok', bad]);
  for (const axis of data.varying) figures.push([axis.title, axis.choices.length]);
  figures.push(['metrics', data.metrics.length]);
  at('figures').append(...figures.map(([name, value]) => h('div', {}, h('dt', {}, name), h('dd', {}, value))));
  at('footer').textContent = `Made by atrium report, Atrium ${data.atrium}. This file needs no network.`;
}

function navigation() {
  const links = [...document.querySelectorAll('main > section:not([hidden])')].map((section) => h('a', { href: `#${section.id}` }, section.querySelector('h2').textContent));
  at('nav').append(...links);
}

/** As the system wants it, or light, or dark. */
function theme() {
  const names = { '': 'Theme: system', light: 'Theme: light', dark: 'Theme: dark' };
  const order = ['', 'light', 'dark'];
  const set = (value) => {
    if (value) document.documentElement.dataset.theme = value;
    else delete document.documentElement.dataset.theme;
    at('theme').textContent = names[value];
  };
  at('theme').addEventListener('click', () => set(order[(order.indexOf(document.documentElement.dataset.theme ?? '') + 1) % 3]));
  set('');
}

function start() {
  const data = readData();
  head(data);
  theme();
  let viewer = null;
  const actions = { details: makeDetails(data, () => viewer) };
  const parts = [makeTable(data, at('variants'), actions), makePlots(data, at('plots'), actions), makePictures(data, at('pictures'))];
  viewer = makeViewer(data, at('models'));
  parts.push(viewer, makeParameters(data, at('parameters')), makeTimes(data, at('times'), actions));
  navigation();
  makeFilters(data, at('filters'), (variants) => { for (const part of parts) part.show(variants); }).update();
  document.documentElement.dataset.ready = 'yes';
}

start();
