// Elements, and figures as text.

/// element('p', {class: 'remark'}, 'text', child, ...): texts are never read as HTML.
function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name.startsWith('on'))
      made.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined && value !== false)
      made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return made;
}

/// A button that is pressed or not.
function pressButton(text, pressed, action, more = {}) {
  return element('button', {type: 'button', 'aria-pressed': String(pressed), onclick: action, ...more}, text);
}

const byId = (id) => document.getElementById(id);
const is = (value) => value !== null && value !== undefined;
const unique = (items) => [...new Set(items)];

/// Three significant digits, as people write them: 0.197, 12.4, 1320, 2.1e−6.
function figure(value) {
  if (!is(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e6) return minus(value.toExponential(1));
  return minus(value.toFixed(Math.max(0, 2 - Math.floor(Math.log10(size)))));
}

/// A number that was chosen, not measured: 0.6, not 0.600.
const setting = (value) => minus(String(Number(value.toPrecision(4))));

/// Errors are compared down a column: four decimals, unless they would all be 0.
function errorFigure(value) {
  if (!is(value)) return '–';
  return value !== 0 && Math.abs(value) < 5e-5 ? minus(value.toExponential(1)) : minus(value.toFixed(4));
}

const minus = (text) => text.replace(/-/g, '\u2212');
const times = (value) => (is(value) ? figure(value) + '\u202f×' : '–');
const percent = (share) => Math.round(100 * share) + '\u202f%';
const many = (count, one, several) => count + ' ' + (count === 1 ? one : several || one + 's');

/// "a, b and c"
function enumerate(items) {
  if (items.length < 2) return items.join('');
  return items.slice(0, -1).join(', ') + ' and ' + items[items.length - 1];
}
