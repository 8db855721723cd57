// The table of methods.

const three = (value) => (is(value) ? minus(value.toFixed(3)) : '–');
const metrics = [
  {key: 'error', name: 'error', text: errorFigure, help: 'RMSE to the truth, mean over the items; 0: equal'},
  {key: 'ssim', name: 'SSIM', text: three, most: true, help: 'structural similarity to the truth; 1: equal'},
  {key: 'flip', name: 'FLIP', text: three, help: 'how visible the difference is when one flips between the two; 0: equal'},
  {key: 'ratio', name: 'time / HBAO+', text: times, help: 'time over that of HBAO+ medium, measured in turn on the same device'},
  {key: 'flicker', name: 'flicker', text: errorFigure, help: 'how the error changes from frame to frame, of sequences'},
  {key: 'eyes', name: 'eyes', text: errorFigure, help: 'difference of two eyes where both see a surface'},
];

const stability = (row) => {
  const {held, cases} = entryOf(row);
  return is(held) && cases > 0 ? held / cases : null;
};

/// The shown text of the best value of each metric, where not all are as good; rows of the same text are.
function bestTexts(rows) {
  const best = {};
  for (const {key, text, most} of metrics) {
    const values = rows.map((row) => figureOf(row, key)).filter(is);
    if (unique(values.map(text)).length > 1) best[key] = text(most ? Math.max(...values) : Math.min(...values));
  }
  const shares = rows.map(stability).filter(is);
  if (unique(shares).length > 1) best.stability = Math.max(...shares);
  return best;
}

const marked = (content, isBest) =>
    isBest ? element('span', {class: 'best'}, content, element('span', {class: 'unseen'}, ' (best)')) : content;

/// A submitted method has no ratio to HBAO+; what there is stands apart.
function timeCell(row, best) {
  if (is(row.ratio)) return marked(times(row.ratio), best.ratio === times(row.ratio));
  if (is(row.whole_ratio))
    return element(
        'span', {class: 'stated', title: 'its command, whole, over gloam run, whole, measured in turn'},
        times(row.whole_ratio) + ' whole');
  if (!is(row.stated_ms)) return '–';
  return element(
      'span', {class: 'stated', title: 'as its authors state it, on a device of their own'},
      figure(row.stated_ms) + ' ms stated');
}

function metricCell(metric, row, best, greatest) {
  const value = figureOf(row, metric.key), text = metric.text(value);
  if (!is(value)) return '–';
  let content = marked(text, best[metric.key] === text);
  if (metric.key === 'error' && greatest > 0)
    content = element('span', {class: 'measure', style: `--share:${(value / greatest).toFixed(4)}`}, content);
  return isAtFit(row, metric.key) ? [element('span', {class: 'stated'}, 'fit '), content] : content;
}

function nameCell(row) {
  const entry = entryOf(row);
  if (!isSubmitted(entry)) return nameOf(entry);
  const {link} = entry.submitted, name = nameOf(entry);
  return [
    link ? element('a', {href: link, rel: 'noreferrer', onclick: (event) => event.stopPropagation()}, name) : name,
    element('span', {class: 'badge'}, 'submitted')
  ];
}

function methodColumns(rows) {
  const best = bestTexts(rows), errors = rows.map((row) => figureOf(row, 'error')).filter(is);
  const greatest = errors.length ? Math.max(...errors) : 0, items = choiceNow().items.length;
  const has = (value) => rows.some((row) => is(value(row)));
  const columns = [
    {name: 'method', value: (row) => nameOf(entryOf(row)), cell: nameCell},
    {name: 'variant', value: (row) => entryOf(row).variant || null},
    {name: 'device', value: (row) => deviceOf(entryOf(row)) || null},
    ...metrics.map((metric) => ({
                     name: metric.name,
                     number: true,
                     most: metric.most,
                     help: metric.help,
                     value: (row) => figureOf(row, metric.key),
                     cell: (row) => metric.key === 'ratio' ? timeCell(row, best) : metricCell(metric, row, best, greatest)
                   })),
    {
      name: 'held',
      number: true,
      most: true,
      help: 'hard cases held: frames that are hard to get right (gloam stress), of those that concern the technique',
      value: stability,
      cell: (row) => is(stability(row)) ?
          marked(`${entryOf(row).held} of ${entryOf(row).cases}`, stability(row) === best.stability) :
          '–'
    },
    {name: 'reads', value: (row) => entryOf(row).reads, help: 'what the renderer has to give'},
    {
      name: 'items',
      number: true,
      most: true,
      help: 'items that it was measured on; means only where these are all',
      value: (row) => row.items,
      text: (value) => (value === items ? String(value) : `${value} of ${items}`)
    },
  ];
  const several = {device: devicesNow().length > 1, reads: unique(rows.map((row) => entryOf(row).reads).filter(Boolean)).length > 1};
  return columns.filter(
      (column) => ['method', 'error', 'items'].includes(column.name) ||
          (column.name in several ? several[column.name] : has(column.value) || (column.name === 'time / HBAO+' && has((row) => row.stated_ms ?? row.whole_ratio))));
}

function renderMethods() {
  const rows = rowsNow(), place = byId('methods-table');
  if (!place.sorting) place.sorting = {column: 'error', down: false};
  const columns = methodColumns(rows);
  if (!columns.some((column) => column.name === place.sorting.column)) place.sorting = {column: 'error', down: false};
  const hadFocus = place.contains(document.activeElement) && document.activeElement.tagName === 'TR';
  sortedTable(place, columns, rows, {
    isPicked: (row) => row.entry === state.picked,
    pick: (row) => {
      pick(row.entry);
      byId('method').scrollIntoView({block: 'nearest'});
    },
  });
  if (hadFocus && place.querySelector('tr.is-picked')) place.querySelector('tr.is-picked').focus({preventScroll: true});
  const partial = rows.filter((row) => !isWhole(row)).length, hidden = choiceNow().rows.length - rows.length;
  const remarks = ['A star marks the best of each column.'];
  if (partial)
    remarks.push(
        `${many(partial, 'row was', 'rows were')} not measured on all of these items, so ` +
        `${partial === 1 ? 'it has' : 'they have'} no means; a narrower choice of items may show them.`);
  if (hidden) remarks.push(`${many(hidden, 'row is', 'rows are')} hidden by the choices above.`);
  if (rows.some((row) => isSubmitted(entryOf(row))))
    remarks.push('Times in italics are not ratios to HBAO+ and are not sorted among them.');
  byId('methods-remark').textContent = remarks.join(' ');
}
