// Methods that others submitted (gloam score): errors like all others, times of their own.

const isSubmitted = (row) => is(row.submitted);
const submittedNames = unique(data.rows.filter(isSubmitted).map((row) => row.technique));

const isStarred = (index) => submittedNames.includes(techniques[index]);

/// "1 − 0.83 (1 − AO^1.2)", "times 0.31"
function fitWords({fit_exponent: exponent, fit_strength: strength, fit_scale: scale}) {
  if (is(scale)) return 'times ' + figure(scale);
  return is(exponent) && is(strength) ? `1 \u2212 ${figure(strength)} (1 \u2212 AO^${figure(exponent)})` : '';
}

/// Figures for the box beside the pointer and beside the chart.
function submittedLines(row) {
  const {stated_ms: stated, fit_rmse: fit, whole_ms: whole, whole_ratio: ratio} = row.submitted;
  const lines = [];
  if (is(fit)) lines.push(['at its best fit', errorFigure(fit)]);
  if (is(whole)) lines.push(['its command, whole', figure(whole) + ' ms']);
  if (is(ratio)) lines.push(['over gloam run, whole', times(ratio)]);
  if (is(stated)) lines.push(['time as stated', figure(stated) + ' ms']);
  return lines;
}

/// What its authors say of it, for the box beside the chart.
function submittedFacts(row) {
  const {version, authors, device, convention, link} = row.submitted;
  const facts = [
    ['version', version], ['by', authors], ['device of the stated time', device], ['images', convention],
    ['best fit', fitWords(row.submitted)]
  ].filter(([, text]) => text);
  return [
    element(
        'p', {}, element('span', {class: 'badge'}, 'submitted'),
        ' Its images were scored; its time is not one of gloam\u2019s.'),
    element('dl', {class: 'figures'}, facts.map(([name, text]) => [element('dt', {}, name), element('dd', {}, text)])),
    link ? element('p', {}, element('a', {href: link, rel: 'noreferrer'}, link)) : null
  ];
}

/// The shown rows of the scene that have an error and no time on the present axis.
const submittedLevels = () => state.mean !== null ?
    [] :
    rowsOf(state.scene).filter((row) => isSubmitted(row) && isShown(row) && is(row.rmse) && !(timeOf(row) > 0));
