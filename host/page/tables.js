// Tables that sort.

/// A line that says what of a table is out of sight; empty where all is shown.
function noteOnScrolling(box) {
  const note = element('p', {class: 'scrolls'});
  const tell = () => {
    const more = [
      box.scrollHeight > box.clientHeight + 1 ? 'more rows below' : null,
      box.scrollWidth > box.clientWidth + 1 ? 'more columns to the right' : null
    ].filter(Boolean);
    note.hidden = !more.length;
    note.textContent = more.length ? `The table scrolls: ${more.join(', ')}.` : '';
  };
  new ResizeObserver(tell).observe(box);
  return note;
}

/// A table whose headings sort. A column: {name, value(row), text?(value, row), cell?(row), number?, words?, help?, most?}; `most`: most
/// is best, so a first click sorts downwards. Rows without a value come last in either order. The order stays while a place gets other
/// rows or columns: `place.sorting` = {column (its name), down}. `options.pick(row)`, if given, is called for a click on a row.
function sortedTable(place, columns, rows, options = {}) {
  const sorting = place.sorting || (place.sorting = {column: null, down: false});
  const sorted = () => columns.find((column) => column.name === sorting.column);
  const compare = (a, b) => {
    const value = sorted().value, x = value(a), y = value(b);
    if (!is(x) || !is(y)) return is(x) - is(y) === 0 ? 0 : is(x) ? -1 : 1;
    const order = typeof x === 'number' && typeof y === 'number' ? x - y : String(x).localeCompare(String(y));
    return sorting.down ? -order : order;
  };
  const body = element('tbody');
  const heads = columns.map(
      (column) => element(
          'th', {scope: 'col', class: column.number ? 'number' : null, title: column.help},
          element('button', {type: 'button', onclick: () => sortBy(column)}, column.name)));

  function sortBy(column) {
    sorting.down = sorting.column === column.name ? !sorting.down : Boolean(column.most);
    sorting.column = column.name;
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
      made.addEventListener('keydown', (event) => event.key === 'Enter' && event.target === made && options.pick(row));
    }
    return made;
  }
  function fill() {
    heads.forEach(
        (head, index) => head.setAttribute(
            'aria-sort',
            columns[index].name !== sorting.column ? 'none' :
                sorting.down         ? 'descending' :
                                       'ascending'));
    body.replaceChildren(...(!sorted() ? rows : [...rows].sort(compare)).map(rowOf));
  }
  fill();
  const scrolled = place.querySelector('.scroll');
  const kept = scrolled ? [scrolled.scrollLeft, scrolled.scrollTop] : [0, 0];
  const box =
      element('div', {class: 'scroll'}, element('table', {}, element('thead', {}, element('tr', {}, heads)), body));
  place.replaceChildren(box, noteOnScrolling(box));
  [box.scrollLeft, box.scrollTop] = kept;
}
