// Elements from plain values: texts are always text, never markup.

/** h('td', {class: 'number', onclick: f}, 'text', element, …) */
export function h(name, attributes = {}, ...children) {
  return fill(document.createElement(name), attributes, children);
}

const SVG = 'http://www.w3.org/2000/svg';
/** The same for SVG. */
export function s(name, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, name), attributes, children);
}

function fill(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true ? '' : value);
  }
  for (const child of children.flat(Infinity)) if (child !== null && child !== undefined) element.append(child);
  return element;
}

/** A labelled <select>: options are [value, text]; change(value) is called. */
export function choice(label, options, value, change) {
  const select = h('select', { onchange: () => change(select.value) }, options.map(([v, text]) => h('option', { value: v }, text)));
  select.value = value;
  return { element: h('label', { class: 'control' }, h('span', {}, label), select), select };
}

/** A checkbox with its label. */
export function check(label, checked, change) {
  const input = h('input', { type: 'checkbox', onchange: () => change(input.checked) });
  input.checked = checked;
  return { element: h('label', { class: 'check' }, input, h('span', {}, label)), input };
}
