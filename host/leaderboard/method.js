// The picked method: its figures on each item, its pictures, its commands.

function pick(entry) {
  state.picked = entry;
  const view = byId('scatter').view;
  if (view) view.signal('picked', String(entry)).runAsync();
  renderMethods();
  renderMethod();
}

function pickItem(item) {
  state.item = item;
  renderMethod();
}

/// The item that is shown of a method: the one picked before, if it was measured on that.
function itemRow(entry) {
  const rows = itemRowsOf(entry);
  return rows.find((row) => row.item === state.item) || rows.find((row) => is(row.picture)) || rows[0];
}

function factsOf(entry, row) {
  const facts = [];
  if (isSubmitted(entry)) {
    const {version, authors, convention} = entry.submitted;
    facts.push(
        ['version', version], ['by', authors], ['images', convention], ['its device', entry.device],
        ['time, as stated', is(row.stated_ms) ? figure(row.stated_ms) + ' ms' : ''],
        ['its command, whole', is(row.whole_ms) ? figure(row.whole_ms) + ' ms' : ''],
        ['over gloam run, whole', is(row.whole_ratio) ? times(row.whole_ratio) : ''], ['error', errorFigure(row.error)],
        ['error at its best fit', is(row.fit_error) ? errorFigure(row.fit_error) : ''], ['best fit', fitWords(row)]);
  } else {
    facts.push(
        ['preset', entry.preset], ['variant', entry.variant], ['device', entry.device], ['reads', entry.reads],
        ['error', errorFigure(row.error)], ['time', is(row.ms) ? figure(row.ms) + ' ms' : ''],
        ['time / HBAO+', is(row.ratio) ? times(row.ratio) : ''],
        ['hard cases held', is(entry.held) ? `${entry.held} of ${entry.cases}` : '']);
  }
  const {width, height, radius, truth_noise: noise} = tableNow().items[row.item];
  facts.push(
      ['size', is(width) && is(height) ? `${width} × ${height}` : ''], ['radius', is(radius) ? setting(radius) : ''],
      ['noise of the truth', is(noise) ? errorFigure(noise) : '']);
  return facts.filter(([, value]) => value);
}

/// "1 − 0.83 (1 − AO^1.2)", "times 0.31"
function fitWords({fit_exponent: exponent, fit_strength: strength, fit_scale: scale}) {
  if (is(scale)) return 'times ' + figure(scale);
  return is(exponent) && is(strength) ? `1 \u2212 ${figure(strength)} (1 \u2212 AO^${figure(exponent)})` : '';
}

function renderFacts(entry, row) {
  const rows = itemRowsOf(state.picked);
  const select = element(
      'select', {'aria-label': 'Item', onchange: () => pickItem(Number(select.value))},
      rows.map((each) => element('option', {value: each.item}, tableNow().items[each.item].name)));
  select.value = row.item;
  const link = isSubmitted(entry) && entry.submitted.link;
  byId('facts-of-method')
      .replaceChildren(
          element('h3', {}, titleOf(entry)),
          ...(isSubmitted(entry) ?
                  [element(
                      'p', {}, element('span', {class: 'badge'}, 'submitted'),
                      ' Its images were scored; its time is not one of gloam\u2019s.')] :
                  []),
          element('label', {}, 'on ', select),
          element(
              'dl', {class: 'figures'},
              factsOf(entry, row).map(([name, value]) => [element('dt', {}, name), element('dd', {}, value)])),
          ...(link ? [element('p', {}, element('a', {href: link, rel: 'noreferrer'}, link))] : []));
}

function renderItems() {
  const rows = itemRowsOf(state.picked), itemOf = (row) => tableNow().items[row.item];
  const number = (name, key, text, most) => ({name, number: true, most, value: (row) => figureOf(row, key), text});
  const columns = [
    {name: 'item', value: (row) => itemOf(row).name}, {name: 'kind', value: (row) => itemOf(row).kind},
    {name: 'class', value: (row) => itemOf(row).class}, number('error', 'error', errorFigure),
    number('bias', 'bias', errorFigure), number('SSIM', 'ssim', three, true), number('FLIP', 'flip', three),
    number('time / HBAO+', 'ratio', times), number('ms', 'ms', figure), number('flicker', 'flicker', errorFigure),
    number('eyes differ', 'eyes', errorFigure), number('error at fit', 'fit_error', errorFigure),
    {name: 'best fit', value: (row) => fitWords(row) || null}
  ];
  // A kind or a class that all items share would take the room of figures.
  const differs = (column) => unique(rows.map(column.value)).length > 1;
  const isShown = (column) => column.name === 'item' ||
      (['kind', 'class'].includes(column.name) ? differs(column) : rows.some((row) => is(column.value(row))));
  sortedTable(
      byId('items-table'), columns.filter(isShown), rows,
      {isPicked: (row) => row.item === state.item, pick: (row) => pickItem(row.item)});
}

// --- Commands

/// Pages opened from disk may have no clipboard of their own; an older way then copies what is selected.
async function copy(text, place, button) {
  const done = (words) => {
    button.textContent = words;
    setTimeout(() => (button.textContent = 'Copy'), 1500);
  };
  try {
    await navigator.clipboard.writeText(text);
    done('Copied');
  } catch {
    getSelection().selectAllChildren(place);
    done(document.execCommand('copy') ? 'Copied' : 'Selected');
  }
}

function commandBox(title, text) {
  const code = element('code', {}, text);
  const button = element('button', {type: 'button', class: 'plain copy', onclick: () => copy(text, code, button)}, 'Copy');
  return element('div', {class: 'command'}, element('h3', {}, title), element('pre', {tabindex: 0}, code), button);
}

function renderCommands(entry, row) {
  const measured = row.measured_by || (isSubmitted(entry) ? null : data.files[row.file].measured_by);
  const boxes = [];
  if (row.run) boxes.push(commandBox('Make this image', row.run));
  if (measured) boxes.push(commandBox(isSubmitted(entry) ? 'Scored by' : 'Measured by', measured));
  if (!boxes.length) boxes.push(element('p', {class: 'remark'}, `${data.files[row.file].file} does not say which command made this row.`));
  byId('commands').replaceChildren(...boxes);
}

function renderMethod() {
  const row = is(state.picked) ? itemRow(state.picked) : null;
  byId('method').hidden = byId('items').hidden = !row;
  if (!row) return;
  const entry = tableNow().entries[state.picked], item = tableNow().items[row.item];
  state.item = row.item;
  byId('method-name').replaceChildren(titleOf(entry) + ' ', element('span', {class: 'scene-name'}, 'on ' + item.name));
  byId('items-name').textContent = titleOf(entry) + ' on each item';
  const hasPictures = tableNow().rows.some((each) => is(each.picture));
  byId('viewer').hidden = byId('size-switch').hidden = !hasPictures;
  byId('size-switch')
      .replaceChildren(...[[false, 'fit'], [true, 'pixel by pixel']].map(
          ([fullSize, text]) => pressButton(text, state.pictures.fullSize === fullSize, () => {
            state.pictures.fullSize = fullSize;
            renderMethod();
          })));
  showPictures(
      byId('viewer'), {name: titleOf(entry), picture: row.picture, truth: item.truth_picture, white: item.white},
      state.pictures);
  renderFacts(entry, row);
  renderItems();
  renderCommands(entry, row);
}
