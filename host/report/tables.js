// Elements, figures as text, tables that sort.

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

const byId = (id) => document.getElementById(id);
const is = (value) => value !== null && value !== undefined;

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

/// A table whose headings sort. A column: {name, value(row), text?(value, row), cell?(row), number?, words?, help?}. Rows without
/// a value come last in either order. `options.pick(row)`, if given, is called for a click on a row.
function sortedTable(place, columns, rows, options = {}) {
  const sorting = place.sorting || (place.sorting = {column: -1, down: false});
  const compare = (a, b) => {
    const value = columns[sorting.column].value, x = value(a), y = value(b);
    if (!is(x) || !is(y)) return is(x) - is(y) === 0 ? 0 : is(x) ? -1 : 1;
    const order = typeof x === 'number' && typeof y === 'number' ? x - y : String(x).localeCompare(String(y));
    return sorting.down ? -order : order;
  };
  const body = element('tbody');
  const heads = columns.map(
      (column, index) => element(
          'th', {scope: 'col', class: column.number ? 'number' : null, title: column.help},
          element('button', {type: 'button', onclick: () => sortBy(index)}, column.name)));

  function sortBy(index) {
    sorting.down = sorting.column === index ? !sorting.down : false;
    sorting.column = index;
    fill();
  }
  function cellOf(column, row) {
    const value = column.value(row);
    const content = column.cell ? column.cell(row) : column.text ? column.text(value, row) : is(value) ? String(value) : '–';
    return element('td', {class: column.number ? 'number' : column.words ? 'words' : null}, content);
  }
  function rowOf(row) {
    const made = element('tr', {}, columns.map((column) => cellOf(column, row)));
    if (options.pick) {
      made.className = 'can-pick' + (options.isPicked(row) ? ' is-picked' : '');
      made.tabIndex = 0;
      made.addEventListener('click', () => options.pick(row));
      made.addEventListener('keydown', (event) => event.key === 'Enter' && options.pick(row));
    }
    return made;
  }
  function fill() {
    heads.forEach(
        (head, index) => head.setAttribute(
            'aria-sort',
            index !== sorting.column ? 'none' :
                sorting.down         ? 'descending' :
                                       'ascending'));
    body.replaceChildren(...(sorting.column < 0 ? rows : [...rows].sort(compare)).map(rowOf));
  }
  fill();
  const scrolled = place.querySelector('.scroll');
  const kept = scrolled ? [scrolled.scrollLeft, scrolled.scrollTop] : [0, 0];
  const box =
      element('div', {class: 'scroll'}, element('table', {}, element('thead', {}, element('tr', {}, heads)), body));
  place.replaceChildren(box);
  [box.scrollLeft, box.scrollTop] = kept;
}
