// Forms of corrections: fields with their values checked.
import { h } from '../src/dom.js';

/** One field of a form: {element, value()}, which throws what is wrong. `pick(take)`: the next click in 3D gives take(place in the scan). */
export function inputOf(field, pick) {
  const label = (input, ...more) => h('label', { class: 'field' }, h('span', {}, field.label), input, ...more);
  if (field.kind === 'check') {
    const input = h('input', { type: 'checkbox', name: field.key });
    return { element: h('label', { class: 'check' }, input, h('span', {}, field.label)), value: () => input.checked };
  }
  if (field.kind === 'choice') {
    const input = h('select', { name: field.key }, field.options.map((option) => h('option', {}, option)));
    if (field.value) input.value = field.value;
    return { element: label(input), value: () => input.value };
  }
  const input = h('input', { type: 'text', name: field.key, placeholder: field.hint ?? '', autocomplete: 'off', spellcheck: 'false' });
  input.value = field.value ?? '';
  if (field.kind === 'place') {
    const button = h('button', { type: 'button', class: 'quiet', onclick: () => pick((place) => { input.value = place.map((v) => v.toFixed(3)).join(', '); }, field.label) }, 'Pick');
    return { element: h('span', { class: 'picked' }, label(input), button), value: () => placeOf(field, input.value) };
  }
  return { element: label(input), value: () => (field.kind === 'text' ? textOf(field, input.value) : lengthOf(field, input.value)) };
}

function textOf(field, text) {
  const value = text.trim();
  if (!value) throw new Error(`${field.label} is empty`);
  return value;
}
/** Two or three numbers. */
function placeOf(field, text) {
  const numbers = text.trim().replaceAll('−', '-').split(/[\s,;]+/).filter(Boolean).map(Number);
  if (numbers.length < 2 || numbers.length > 3 || !numbers.every(Number.isFinite)) throw new Error(`${field.label}: ${text.trim() ? `"${text.trim()}" is no place` : 'a place is missing'}; right would be 1.25, 3.40 in the scan's own coordinates, or a click on Pick and one on the floor`);
  return numbers;
}
const UNITS = { mm: 0.001, cm: 0.01, m: 1, in: 0.0254, ft: 0.3048 };
/** A length as building.correct reads it: metres, or with a unit. */
export function lengthOf(field, text) {
  const value = text.trim().replace('−', '-').replace(',', '.');
  if (!value && field.optional) return null;
  const match = /^([-+]?(?:\d+\.?\d*|\.\d+))\s*(mm|cm|m|in|ft)?$/.exec(value);
  if (!match) throw new Error(`${field.label}: ${value ? `"${value}" is no length` : 'a length is missing'}; right would be 12 cm, 0.12 or 3 ft`);
  const size = Number(match[1]) * (UNITS[match[2]] ?? 1);
  if (size < field.least || size > field.most) throw new Error(`${field.label}: ${value} is not between ${field.least} m and ${field.most} m`);
  return { number: Number(match[1]), unit: match[2] ?? '' };
}

/** The forms: per entry [title, fields, correction from the fields' values]; `add(name, keys)` takes what they make. */
export function editor(entries, { add, pick }) {
  if (entries.length === 0) return null;
  return h('div', { class: 'editor' }, h('h4', {}, 'Correct'), entries.map(([title, fields, make]) => {
    const message = h('p', { class: 'wrong', role: 'alert' });
    const inputs = fields.map((field) => inputOf(field, pick));
    const submit = (event) => {
      event.preventDefault();
      try {
        add(...make(Object.fromEntries(fields.map((field, i) => [field.key, inputs[i].value()]))));
        message.textContent = '';
        event.target.closest('details')?.removeAttribute('open');
      } catch (error) {
        message.textContent = error.message;
      }
    };
    const form = h('form', { onsubmit: submit }, inputs.map((input) => input.element), h('button', { type: 'submit', class: 'quiet' }, fields.length === 0 ? title : 'Add'), message);
    return fields.length === 0 ? form : h('details', { 'data-action': title }, h('summary', {}, title), form);
  }));
}
