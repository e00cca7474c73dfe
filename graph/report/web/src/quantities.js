// Numbers with units, as labels of choices have them ("50 cm"), and numbers as people read them.

const UNITS = {
  m: ['length', 1], cm: ['length', 1e-2], mm: ['length', 1e-3], km: ['length', 1e3],
  deg: ['angle', 1], rad: ['angle', 180 / Math.PI],
  s: ['time', 1], ms: ['time', 1e-3], min: ['time', 60], h: ['time', 3600],
  '%': ['share', 1e-2], '': ['plain', 1],
};
const SHOWN = { length: 'm', angle: '°', time: 's', share: '', plain: '' };

/** "50 cm" gives {value: 0.5, kind: 'length'}; anything else null. */
export function quantity(label) {
  const match = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*([a-z%]*)$/i.exec(String(label).trim());
  if (!match || !(match[2] in UNITS)) return null;
  const [kind, factor] = UNITS[match[2]];
  return { value: Number((Number(match[1]) * factor).toPrecision(12)), kind };
}

/** Labels as numbers of one unit: {values, unit}, or null if one of them is none. */
export function numbers(labels) {
  const all = labels.map(quantity);
  if (all.length === 0 || all.some((q) => q === null)) return null;
  const kinds = new Set(all.map((q) => (q.kind === 'share' ? 'plain' : q.kind)));
  if (kinds.size > 1 && !(kinds.size === 2 && kinds.has('plain') && all.every((q) => q.kind !== 'plain' || q.value === 0))) return null;
  const kind = all.find((q) => q.kind !== 'plain')?.kind ?? 'plain';
  return { values: all.map((q) => q.value), unit: SHOWN[kind] };
}

/** With so many decimals, or with four significant digits. */
export function shown(value, digits) {
  if (value === null || value === undefined) return '–';
  if (typeof value !== 'number') return String(value);
  if (digits !== undefined) return value.toFixed(digits);
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return String(value);
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-5) return value.toExponential(3);
  return value.toFixed(Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(size)))));
}

export function mean(values) {
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}

/** Of a sample (n − 1); 0 for one value. */
export function deviation(values) {
  if (values.length < 2) return 0;
  const m = mean(values);
  return Math.sqrt(values.reduce((sum, value) => sum + (value - m) ** 2, 0) / (values.length - 1));
}

/** Round places within [low, high], about `count` of them. */
export function ticks(low, high, count = 5) {
  if (!(high > low)) return [low];
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((m) => m >= raw * 0.999);
  const result = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) result.push(Number((i * step).toPrecision(12)));
  return result;
}

export function bytes(size) {
  for (const [unit, factor] of [['GB', 1e9], ['MB', 1e6], ['kB', 1e3]]) if (size >= factor) return `${(size / factor).toFixed(size >= factor * 100 ? 0 : 1)} ${unit}`;
  return `${size} B`;
}

export function seconds(value) {
  if (value >= 100) return `${value.toFixed(0)} s`;
  if (value >= 1) return `${value.toFixed(1)} s`;
  return `${(value * 1000).toFixed(value >= 0.01 ? 0 : 1)} ms`;
}
