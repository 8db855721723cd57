// What is shown in the chart: its legend, the switch of its time axis, and the filters.

function renderLegend(shown) {
  const used = techniques.filter((name) => shown.some((row) => row.technique === name));
  const notes = [];
  if (used.some((name) => presetsOf.get(name).length > 1)) notes.push('larger: a later preset');
  if (shown.some((row) => row.variant)) notes.push('hollow: a variant');
  if (shown.some(isSubmitted)) notes.push('star: submitted');
  if (shown.length)
    notes.push(
        'line: Pareto front' + (showsVariants() || !data.rows.some((row) => row.variant) ? '' : ' of plain settings'));
  byId('legend').replaceChildren(
      ...used.map((name) => element('span', {}, swatch(techniques.indexOf(name)), name)),
      element('span', {class: 'of-front'}, notes.join(' · ')));
}

function renderTimeSwitch() {
  const choices = [['ratio', 'over HBAO+', hasRatios()], ['ms', 'in ms', state.mean === null]];
  byId('time-switch')
      .replaceChildren(...choices.filter(([, , possible]) => possible)
                           .map(([time, text]) => pressButton(text, timeShown() === time, () => {
                                  state.time = time;
                                  renderScatter();
                                })));
}

function renderFilters() {
  const boxes = [];
  for (const [what, title] of [['technique', 'Techniques'], ['preset', 'Presets'], ['variant', 'Variants']]) {
    const values = unique(rowsOfEffect(effectNow()).map((row) => row[what]));
    if (values.length < 2) continue;
    const hidden = state.hidden[what];
    const checks = values.map((value) => {
      const input = element('input', {
        type: 'checkbox',
        checked: !hidden.has(value),
        'data-filter': what,
        'data-value': value,
        onchange: () => {
          if (input.checked)
            hidden.delete(value);
          else
            hidden.add(value);
          renderShown();
        }
      });
      return element('label', {class: 'check'}, input, value || (what === 'variant' ? 'plain' : 'none'));
    });
    const all = element(
        'button', {
          type: 'button',
          onclick: () => {
            const everything = values.every((value) => !hidden.has(value));
            values.forEach((value) => (everything ? hidden.add(value) : hidden.delete(value)));
            renderFilters();
            renderShown();
          }
        },
        'all or none');
    boxes.push(element('fieldset', {}, element('legend', {}, title), element('div', {class: 'checks'}, checks, all)));
  }
  byId('filters').hidden = boxes.length === 0;
  byId('filter-boxes').replaceChildren(...boxes);
}
