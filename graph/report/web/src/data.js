// The report's data, as the page holds them, and what follows from them.
import { deviation, mean, numbers } from './quantities.js';

export function readData() {
  const data = JSON.parse(document.getElementById('data').textContent);
  data.variants.forEach((variant, index) => { variant.index = index; });
  data.axes.forEach((axis, index) => {
    axis.index = index;
    axis.title = axisTitle(axis);
    axis.labels = axis.choices.map((choice) => shortLabel(axis, choice));
    axis.seed = axis.name === 'seed';
  });
  // That a node type is there in some variants only is seen from the nodes' types.
  data.parameters = data.parameters.filter((p) => !(p.address.endsWith("'s version") && p.values.length === 1));
  data.varying = data.axes.filter((axis) => axis.choices.length > 1);
  data.variants.forEach((variant) => { variant.label = labelOf(data, variant); });
  data.dimensions = dimensionsOf(data);
  return data;
}

const sameValues = (choice) => new Set(Object.values(choice.set)).size === 1;

/** Of several targets that are set side by side to the same value, their common last word. */
function axisTitle(axis) {
  const targets = Object.keys(axis.choices[0]?.set ?? {});
  if (axis.name !== targets.join(', ') || targets.length < 2) return axis.name;
  const words = new Set(targets.map((target) => target.split('.').pop()));
  return words.size === 1 && axis.choices.every(sameValues) ? [...words][0] : axis.name;
}

function shortLabel(axis, choice) {
  const targets = Object.keys(choice.set);
  return axis.title !== axis.name && targets.length > 1 ? choice.set[targets[0]] : choice.label;
}

export const labelAt = (axis, variant) => axis.labels[variant.choices[axis.index]] ?? '';

function labelOf(data, variant) {
  const named = new Set(['scene', 'variant', 'ablation']);
  const parts = data.varying.map((axis) => (named.has(axis.name) ? labelAt(axis, variant) : `${axis.title} ${labelAt(axis, variant)}`));
  return parts.filter(Boolean).join(', ') || variant.id;
}

/**
 * What metrics can be plotted over: the axes that vary (not the seeds), and what random samples drew. Each has a
 * `place(variant)`: a number, or the index of a category.
 */
function dimensionsOf(data) {
  const dimensions = [];
  for (const axis of data.varying) {
    const targets = Object.keys(axis.choices[0].set);
    if (axis.name === 'sample') {
      for (const target of targets) {
        const drawn = numbers(axis.choices.map((choice) => choice.set[target]));
        if (drawn) dimensions.push({ title: target, axis, numeric: true, drawn: true, unit: drawn.unit, places: drawn.values });
      }
    } else if (!axis.seed) {
      const values = numbers(axis.labels);
      const distinct = values && new Set(values.values).size === values.values.length;
      dimensions.push({ title: axis.title, axis, numeric: Boolean(distinct), unit: distinct ? values.unit : '',
                        places: distinct ? values.values : axis.labels.map((_, i) => i) });
    }
  }
  for (const dimension of dimensions) dimension.place = (variant) => dimension.places[variant.choices[dimension.axis.index]];
  return dimensions;
}

/** Variants that differ in their seed only, in the order of the first of each. */
export function groupsOf(data, variants) {
  const groups = new Map();
  for (const variant of variants) {
    const key = data.axes.map((axis) => (axis.seed ? '' : variant.choices[axis.index])).join('|');
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(variant);
  }
  return [...groups.values()];
}

/** {mean, deviation, count} of the variants that are ok and have the number; null if there is none. */
export function statistics(variants, metric) {
  const values = variants.filter((v) => v.status === 'ok').map((v) => v.cells[metric]).filter((value) => typeof value === 'number');
  return values.length === 0 ? null : { mean: mean(values), deviation: deviation(values), count: values.length };
}

/**
 * Differences from one choice of an axis: per variant that with the same choices else, the seed too; nothing for those that have
 * none. What the seeds have in common drops out.
 */
export function partnersOf(data, axis, choice) {
  const key = (variant) => variant.choices.map((c, i) => (i === axis.index ? '' : c)).join('|');
  const references = new Map(data.variants.filter((v) => v.choices[axis.index] === choice).map((v) => [key(v), v]));
  return (variant) => references.get(key(variant));
}

/** As statistics(), of the differences from each variant's partner. */
export function differences(variants, metric, partner) {
  const values = [];
  for (const variant of variants) {
    const other = partner(variant);
    const [a, b] = [variant.cells[metric], other?.cells[metric]];
    if (variant.status === 'ok' && other?.status === 'ok' && typeof a === 'number' && typeof b === 'number') values.push(a - b);
  }
  return values.length === 0 ? null : { mean: mean(values), deviation: deviation(values), count: values.length };
}

const decoded = new Map();

/** The bytes of one of the report's files, as a promise of a Blob. */
export function fileOf(data, index) {
  if (!decoded.has(index)) decoded.set(index, decode(data, index));
  return decoded.get(index);
}

async function decode(data, index) {
  const [type, deflated] = data.files[index];
  if (!document.getElementById(`file-${index}`) && document.readyState === 'loading')
    await new Promise((resolve) => { document.addEventListener('DOMContentLoaded', resolve, { once: true }); });
  const text = atob(document.getElementById(`file-${index}`).textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  if (!deflated) return new Blob([bytes], { type });
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Blob([await new Response(stream).arrayBuffer()], { type });
}

const urls = new Map();
/** The file as a URL for <img>. */
export async function urlOf(data, index) {
  if (!urls.has(index)) urls.set(index, fileOf(data, index).then((blob) => URL.createObjectURL(blob)));
  return urls.get(index);
}

/** Okabe and Ito's colours (of series), and marks that differ without them. */
export const COLOURS = Array.from({ length: 8 }, (_, i) => `var(--series-${i})`);
