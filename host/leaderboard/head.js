// What a newcomer has to know, and what can be chosen.

function renderHead() {
  const effect = effectTitle(tableNow().effect);
  byId('lead').textContent =
      `Each row is a way to compute ${effect} from what is on the screen; its images of the set’s items were compared with the ` +
      'truth, which is the same light traced by rays. Error is the distance from that truth (RMSE; 0 is perfect), SSIM and FLIP ' +
      'say how alike the two look, and time is a multiple of what HBAO+ at medium, a technique that many games use, takes on the ' +
      'same machine; what submitters state of their own time is set apart. A row has means only if it was measured on all items ' +
      'chosen above, so that nothing is won by leaving out hard ones: click a heading to sort, and a row for its pictures, ' +
      'figures and command.';
  const {set} = boardNow(), files = data.files.filter((file) => JSON.stringify(file.set) === JSON.stringify(set));
  const facts = [
    ['Set', boardNow().title], ['Hash of the set', set ? set.hash.slice(0, 16) : null],
    ['Items', choicesOfAll().length], ['Methods', unique(tableNow().entries.map((entry) => entry.technique)).length],
    ['Submitted', tableNow().entries.filter(isSubmitted).length || null],
    ['Devices', enumerate(unique(files.map((file) => file.device).filter(Boolean)))],
    ['Measured', enumerate(unique(files.map((file) => file.date).filter(Boolean)))]
  ];
  byId('facts').replaceChildren(
      ...facts.filter(([, value]) => is(value) && value !== '')
          .map(([name, value]) => element('div', {}, element('dt', {}, name), element('dd', {}, String(value)))));
}

/// Items on which any method has an error.
const choicesOfAll = () => tableNow().choices[0].items;

function chooser(label, options, chosen, action) {
  const made = element('select', {onchange: () => action(made.value)}, options);
  made.value = chosen;
  return element('label', {}, label, made);
}

function itemsChooser() {
  const option = (choice) => element(
      'option', {value: tableNow().choices.indexOf(choice)}, `${choiceTitle(choice)} (${choice.items.length})`);
  const group = (what, label) => {
    const choices = tableNow().choices.filter((choice) => choice.what === what);
    return choices.length ? element('optgroup', {label}, choices.map(option)) : [];
  };
  const hasKinds = tableNow().choices.some(({what}) => what === 'kind');
  const options = [
    option(tableNow().choices[0]), group('kind', 'by kind'),
    group('class', hasKinds ? 'single frames, by class' : 'by class')
  ].flat();
  return chooser('Items', options, state.choice, (value) => choose({choice: Number(value)}));
}

function renderChoices() {
  const parts = [], effects = boardNow().effects;
  if (data.boards.length > 1) {
    parts.push(...data.boards.map(
        (board, index) => pressButton(
            board.title, index === state.board, () => choose({board: index, effect: 0, device: ''}))));
    parts.push(element('span', {class: 'gap'}));
  }
  parts.push(...effects.map(
      (each, index) => pressButton(
          effectTitle(each.effect), index === state.effect, () => choose({effect: index, device: ''}),
          {class: 'effect'})));
  if (tableNow().choices.length > 1) parts.push(itemsChooser());
  if (devicesNow().length > 1) {
    const options = [['', 'all, apart'], ...devicesNow().map((name) => [name, name])];
    parts.push(chooser(
        'Device', options.map(([value, text]) => element('option', {value}, text)), state.device,
        (device) => choose({device})));
  }
  const focused = document.activeElement && byId('choices').contains(document.activeElement) ?
      [...byId('choices').querySelectorAll('button, select')].indexOf(document.activeElement) :
      -1;
  byId('choices').replaceChildren(...parts);
  if (focused >= 0) {
    const again = byId('choices').querySelectorAll('button, select')[focused];
    if (again) again.focus();
  }
}

/// Which rows are shown: only what makes a difference here.
function renderFilters() {
  const entries = tableNow().entries;
  const check = (id, text, field, help) => {
    const input = element('input', {
      type: 'checkbox',
      id,
      checked: state[field],
      onchange: () => {
        state[field] = input.checked;
        renderCosts();
        renderMethods();
        renderMethod();
      }
    });
    return element('label', {class: 'check', title: help}, input, text);
  };
  const made = [];
  if (entries.some((entry) => entry.variant))
    made.push(check('show-variants', 'variants', 'variants', 'other resolutions, mathematics and storage of a preset'));
  if (entries.some((entry) => entry.reads && entry.reads !== 'one layer'))
    made.push(check(
        'show-layers', 'more than one layer', 'layers', 'methods that read hidden surfaces or a second view, which few renderers give'));
  if (tableNow().choices.some((choice) => choice.rows.some((row) => is(row.fit_error))))
    made.push(check(
        'show-fit', 'submitted at their best fit', 'fit',
        'with the exponent and the strength at which the images are nearest to the truth'));
  byId('filters').replaceChildren(...made);
}
