// Each metric over what was varied: every variant a small mark, their means joined by a line, the standard deviation as a bar.
import { COLOURS, statistics } from './data.js';
import { check, choice, h, s } from './dom.js';
import { shown, ticks } from './quantities.js';

const WIDTH = 400, HEIGHT = 260;
const BOX = { left: 54, right: 12, top: 10, bottom: 40 };
const FIRST = 12;  // so many plots at first

const MARKS = [
  (x, y, r) => s('circle', { cx: x, cy: y, r }),
  (x, y, r) => s('rect', { x: x - r * 0.9, y: y - r * 0.9, width: r * 1.8, height: r * 1.8 }),
  (x, y, r) => s('path', { d: `M${x} ${y - r * 1.25}L${x + r * 1.15} ${y + r * 0.8}H${x - r * 1.15}Z` }),
  (x, y, r) => s('path', { d: `M${x} ${y - r * 1.3}L${x + r * 1.3} ${y}L${x} ${y + r * 1.3}L${x - r * 1.3} ${y}Z` }),
  (x, y, r) => s('path', { d: `M${x} ${y + r * 1.25}L${x + r * 1.15} ${y - r * 0.8}H${x - r * 1.15}Z` }),
];

export function makePlots(data, root, actions) {
  const metrics = data.metrics.map((metric, index) => ({ ...metric, index }))
    .filter((metric) => data.variants.some((v) => typeof v.cells[metric.index] === 'number'));
  if (metrics.length === 0 || data.variants.length < 2) {
    root.hidden = true;
    return { show() {} };
  }
  const dimensions = data.dimensions.length > 0 ? data.dimensions
    : [{ title: 'variant', axis: null, numeric: false, unit: '', places: data.variants.map((_, i) => i), place: (v) => v.index }];
  const seriesAxes = data.varying.filter((axis) => !axis.seed && axis.name !== 'sample');
  const longest = dimensions.find((d) => d.numeric) ?? dimensions.find((d) => d.axis?.name !== 'scene') ?? dimensions[0];
  let dimension = longest;
  let series = seriesAxes.find((axis) => axis !== dimension.axis) ?? null;
  let variants = data.variants;
  let zero = false;
  let logarithmic = suitsLogarithm(dimension);
  let all = metrics.length <= FIRST;
  let search = '';

  const x = choice('over', dimensions.map((d, i) => [i, d.title]), String(dimensions.indexOf(dimension)), (value) => {
    dimension = dimensions[value];
    logarithmic = log.input.checked = suitsLogarithm(dimension);
    if (series === dimension.axis) series = seriesAxes.find((axis) => axis !== dimension.axis) ?? null;
    by.select.value = series ? String(seriesAxes.indexOf(series)) : '';
    render();
  });
  const by = choice('a line per', [['', 'nothing'], ...seriesAxes.map((axis, i) => [i, axis.title])],
                    series ? String(seriesAxes.indexOf(series)) : '', (value) => { series = value === '' ? null : seriesAxes[value]; render(); });
  const log = check('logarithmic', logarithmic, (on) => { logarithmic = on; render(); });
  const fromZero = check('from zero', zero, (on) => { zero = on; render(); });
  const find = h('input', { type: 'search', placeholder: 'metric …', 'aria-label': 'Show metrics with this text', oninput: () => { search = find.value.toLowerCase(); render(); } });
  const legend = h('div', { class: 'legend' });
  const note = h('p', { class: 'hint' });
  const grid = h('div', { class: 'plots' });
  const more = h('button', { type: 'button', class: 'quiet', onclick: () => { all = true; render(); } });
  root.append(h('div', { class: 'tools' }, dimensions.length > 1 ? x.element : null, seriesAxes.length > 0 ? by.element : null, log.element, fromZero.element,
                metrics.length > FIRST ? find : null), legend, note, grid, more);

  function seriesList() {
    if (!series) return [{ label: 'all', colour: COLOURS[0], mark: MARKS[0], variants }];
    const list = series.labels.map((label, index) => ({ label, colour: COLOURS[index % COLOURS.length], mark: MARKS[index % MARKS.length],
                                                         variants: variants.filter((v) => v.choices[series.index] === index) }));
    return list.filter((entry) => entry.variants.length > 0);
  }

  function render() {
    const list = seriesList();
    log.element.hidden = !canLogarithm(dimension);
    by.element.hidden = seriesAxes.every((axis) => axis === dimension.axis);
    legend.replaceChildren(...(series ? list.map((entry) => h('span', { class: 'key' }, keyMark(entry), entry.label)) : []));
    note.textContent = pooled();
    const wanted = metrics.filter((metric) => metric.name.toLowerCase().includes(search));
    const shownMetrics = all || search ? wanted : wanted.slice(0, FIRST);
    grid.replaceChildren(...shownMetrics.map((metric) => plot(metric, list)));
    more.hidden = shownMetrics.length === wanted.length;
    more.textContent = `Show all ${wanted.length} metrics`;
  }

  /** Over what the means are taken. */
  function pooled() {
    const over = data.varying.filter((axis) => axis !== dimension.axis && axis !== series && new Set(variants.map((v) => v.choices[axis.index])).size > 1);
    if (over.length === 0) return '';
    return `Lines are means, bars standard deviations over ${over.map((axis) => (axis.seed ? 'the seeds' : axis.title)).join(' and ')}; small marks are single variants.`;
  }

  function plot(metric, list) {
    const points = list.map((entry) => ({ ...entry, groups: groups(entry.variants, metric.index) }));
    const title = h('figcaption', {}, metric.name, metric.unit ? h('span', { class: 'unit' }, ` ${metric.unit}`) : null);
    const numbers = points.flatMap((p) => p.groups.flatMap((g) => [g.mean - g.deviation, g.mean + g.deviation, ...g.singles.map((v) => v.cells[metric.index])]));
    if (numbers.length === 0) return h('figure', { class: 'plot' }, title, h('p', { class: 'empty' }, 'no values'));
    let [low, high] = [Math.min(...numbers), Math.max(...numbers)];
    if (zero) [low, high] = [Math.min(0, low), Math.max(0, high)];
    const space = high > low ? (high - low) * 0.06 : Math.max(Math.abs(high) * 0.1, 1e-9);
    const fixed = zero && low === 0;
    const y = scale(fixed ? 0 : low - space, high + space, HEIGHT - BOX.bottom, BOX.top);
    const xs = horizontal(points.flatMap((p) => p.groups.map((g) => g.place)));
    const picture = s('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': describe(metric, points) });
    picture.append(axesOf(xs, y, metric));
    points.forEach((entry, index) => picture.append(seriesOf(entry, index, points.length, xs, y, metric)));
    return h('figure', { class: 'plot' }, title, picture);
  }

  function groups(list, metric) {
    const byPlace = new Map();
    for (const variant of list) {
      const place = dimension.place(variant);
      if (!byPlace.has(place)) byPlace.set(place, []);
      byPlace.get(place).push(variant);
    }
    return [...byPlace].map(([place, members]) => ({ place, ...(statistics(members, metric) ?? { count: 0 }),
                                                     singles: members.filter((v) => v.status === 'ok' && typeof v.cells[metric] === 'number') }))
      .filter((group) => group.count > 0).sort((a, b) => a.place - b.place);
  }

  function horizontal(places) {
    const [left, right] = [BOX.left, WIDTH - BOX.right];
    if (!dimension.numeric) {
      const used = [...new Set(places)].sort((a, b) => a - b);
      const width = (right - left) / used.length;
      return { at: (place) => left + (used.indexOf(place) + 0.5) * width, width,
               ticks: used.map((place) => [place, dimension.axis ? dimension.axis.labels[place] : data.variants[place].label]) };
    }
    const used = [...new Set(places)].sort((a, b) => a - b);
    const lowest = used[0], highest = used[used.length - 1];
    const isLog = logarithmic && lowest > 0 && highest > lowest;
    const forward = isLog ? Math.log : (value) => value;
    const position = scale(forward(lowest), forward(highest) > forward(lowest) ? forward(highest) : forward(lowest) + 1, left + 14, right - 14);
    const labels = dimension.drawn || used.length > 12
      ? (isLog ? decades(lowest, highest) : ticks(lowest, highest, 5)).map((value) => [value, shown(value)])
      : used.map((value) => [value, dimension.axis.labels[dimension.places.indexOf(value)]]);
    return { at: (place) => position(forward(place)), width: 24, ticks: labels };
  }

  function axesOf(xs, y, metric) {
    const [left, right, bottom] = [BOX.left, WIDTH - BOX.right, HEIGHT - BOX.bottom];
    const parts = [];
    for (const value of ticks(y.low, y.high, 5)) {
      const at = y(value);
      parts.push(s('line', { class: 'gridline', x1: left, x2: right, y1: at, y2: at }),
                 s('text', { class: 'tick', x: left - 6, y: at + 3.5, 'text-anchor': 'end' }, compact(value)));
    }
    parts.push(s('line', { class: 'axis', x1: left, x2: right, y1: bottom, y2: bottom }));
    const room = xs.ticks.length > 0 ? (right - left) / xs.ticks.length : 0;
    const slanted = !dimension.numeric && xs.ticks.some(([, label]) => label.length * 5.6 > room);
    let last = -Infinity;
    for (const [value, label] of xs.ticks) {
      const at = xs.at(value);
      if (slanted) {
        const letters = xs.ticks.length > 8 ? 8 : Math.max(6, Math.floor(room / 5.6));
        const text = label.length > letters ? `${label.slice(0, letters - 1)}…` : label;
        if (at - last < 12) continue;
        parts.push(s('text', { class: 'tick', x: at, y: bottom + 14, 'text-anchor': 'middle' }, text, s('title', {}, label)));
      } else {
        const width = label.length * 5.8;
        parts.push(s('line', { class: 'axis', x1: at, x2: at, y1: bottom, y2: bottom + 3 }));
        if (at - width / 2 < last + 7) continue;
        parts.push(s('text', { class: 'tick', x: at, y: bottom + 14, 'text-anchor': 'middle' }, label));
        last = at + width / 2;
        continue;
      }
      last = at;
    }
    parts.push(s('text', { class: 'axis-title', x: (left + right) / 2, y: HEIGHT - 8, 'text-anchor': 'middle' },
                 dimension.title + (dimension.drawn && dimension.unit ? ` (${dimension.unit})` : '')));
    return s('g', {}, parts);
  }

  function seriesOf(entry, index, count, xs, y, metric) {
    // Side by side, so that bars do not hide each other.
    const step = dimension.numeric ? Math.min(5, 16 / count) : Math.min(xs.width / (count + 1), 26);
    const shift = (index - (count - 1) / 2) * step;
    const group = s('g', { style: `color:${entry.colour}`, class: 'series' });
    if (dimension.numeric && !dimension.drawn && entry.groups.length > 1)
      group.append(s('path', { class: 'mean-line', d: entry.groups.map((g, i) => `${i ? 'L' : 'M'}${xs.at(g.place) + shift} ${y(g.mean)}`).join(''), fill: 'none' }));
    for (const g of entry.groups) {
      const at = xs.at(g.place) + shift;
      if (g.count > 1) {
        for (const variant of g.singles) group.append(single(entry, at, y(variant.cells[metric.index]), variant, metric));
        const [low, high] = [y(g.mean - g.deviation), y(g.mean + g.deviation)];
        group.append(s('path', { class: 'whisker', d: `M${at - 3.5} ${low}h7M${at} ${low}V${high}M${at - 3.5} ${high}h7`, fill: 'none' }));
      }
      const mark = entry.mark(at, y(g.mean), 4);
      mark.classList.add('mean');
      mark.append(s('title', {}, `${series ? `${entry.label}, ` : ''}${dimension.title} ${placeLabel(g.place)}\n${metric.name} ${shown(g.mean, metric.digits)}${g.count > 1 ? ` ± ${shown(g.deviation, metric.digits)} (${g.count} variants)` : ''} ${metric.unit}`));
      if (g.count === 1) { mark.addEventListener('click', () => actions.details(g.singles[0])); mark.classList.add('clickable'); }
      group.append(mark);
    }
    return group;
  }

  function single(entry, at, height, variant, metric) {
    const mark = entry.mark(at, height, 2);
    mark.classList.add('single', 'clickable');
    mark.addEventListener('click', () => actions.details(variant));
    mark.append(s('title', {}, `${variant.label}\n${metric.name} ${shown(variant.cells[metric.index], metric.digits)} ${metric.unit}`));
    return mark;
  }

  function placeLabel(place) {
    if (!dimension.axis) return data.variants[place].label;
    return dimension.drawn ? shown(place) : dimension.axis.labels[dimension.places.indexOf(place)];
  }
  function describe(metric, points) {
    const lines = points.map((p) => `${series ? `${p.label}: ` : ''}${p.groups.map((g) => `${placeLabel(g.place)} ${shown(g.mean, metric.digits)}`).join(', ')}`);
    return `${metric.name} ${metric.unit} over ${dimension.title}. ${lines.join('; ')}`;
  }

  return { show(list) { variants = list; render(); } };
}

function keyMark(entry) {
  const mark = entry.mark(7, 7, 4.5);
  return s('svg', { width: 14, height: 14, 'aria-hidden': 'true', class: 'series', style: `color:${entry.colour}` }, mark);
}

function scale(low, high, from, to) {
  const map = (value) => from + ((value - low) / (high - low)) * (to - from);
  map.low = low;
  map.high = high;
  return map;
}

function canLogarithm(dimension) {
  return dimension.numeric && Math.min(...dimension.places) > 0;
}
/** Values over more than a decade are read on a logarithmic axis. */
function suitsLogarithm(dimension) {
  return canLogarithm(dimension) && Math.max(...dimension.places) / Math.min(...dimension.places) > 15;
}

function decades(low, high) {
  const result = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power)
    for (const m of high / low > 1000 ? [1] : [1, 2, 5]) {
      const value = m * 10 ** power;
      if (value >= low * 0.999 && value <= high * 1.001) result.push(Number(value.toPrecision(6)));
    }
  return result;
}

function compact(value) {
  const size = Math.abs(value);
  if (size >= 1e6) return `${Number((value / 1e6).toPrecision(4))}M`;
  if (size >= 1e4) return `${Number((value / 1e3).toPrecision(4))}k`;
  if (size > 0 && size < 1e-3) return value.toExponential(0);
  return String(Number(value.toPrecision(5)));
}

