// The answer: what is nearest to the truth and at what cost, in words and as a chart of the methods that are shown.

const techniqueNames = () => unique(tableNow().entries.map((entry) => entry.technique));
const isStarred = (index) =>
    tableNow().entries.some((entry) => isSubmitted(entry) && entry.technique === techniqueNames()[index]);

function choiceWords() {
  const choice = choiceNow(), count = choice.items.length;
  if (count === 1) return 'on ' + tableNow().items[choice.items[0]].name;
  return 'on ' + (choice.what === 'all' ? `all ${count} items` : `${choiceTitle(choice)}, ${count} items`);
}

/// "on 24 single frames", "on 3 items of class thin"
function verdictPlace() {
  const {what, name, items} = choiceNow();
  if (what === 'all' || items.length === 1) return choiceWords();
  return what === 'kind' ? `on ${items.length} ${kinds[name] || name}` : `on ${items.length} items of class ${name}`;
}

/// Beside which no other is as fast and as near to the truth, and better in one of the two.
function frontOf(points) {
  let least = Infinity;
  return [...points].sort((a, b) => a.x - b.x || a.y - b.y).filter(({y}) => y < least && ((least = y), true));
}

function pointOf(row) {
  const entry = entryOf(row), error = figureOf(row, 'error'), ratio = is(row.ratio) ? [['over HBAO+', times(row.ratio)]] : [];
  return {
    key: String(row.entry),
    x: row.ratio,
    y: error,
    technique: techniqueNames().indexOf(entry.technique),
    label: titleOf(entry),
    size: 110,
    hollow: Boolean(entry.variant),
    hover: {title: titleOf(entry), lines: [['error, RMSE', errorFigure(error)], ...ratio]}
  };
}

function renderVerdict() {
  const name = (entry) => titleOf(entry) + (isSubmitted(entry) ? ' (submitted)' : '');
  const points = rowsNow().map((row) => ({
    name: name(entryOf(row)), error: figureOf(row, 'error'), ratio: row.ratio, reads: entryOf(row).reads
  }));
  byId('verdict').textContent = verdict(points, verdictPlace());
  for (const place of document.querySelectorAll('.choice-name')) place.textContent = choiceWords();
}

function renderCosts() {
  const place = byId('scatter'), rows = rowsNow().filter((row) => is(figureOf(row, 'error')));
  const all = rows.map(pointOf), points = all.filter(({x}) => x > 0), front = frontOf(points);
  const levels = all.filter(({x}) => !(x > 0)).map((point) => ({...point, colour: colourOf(point.technique)}));
  renderVerdict();
  byId('costs-remark').textContent = 'Points on the line are the Pareto front: no other is as fast and as near to the truth, and ' +
      'better in one of the two. Hover for figures, click to see the pictures.' +
      (levels.length ? ' Dashed lines are methods without a time that compares, by their errors alone.' : '');
  place.hidden = byId('costs-remark').hidden = !all.length;
  if (place.hidden) return clearChart(place);
  const width = place.clientWidth || place.parentElement.clientWidth;
  const spec = scatterSpec({
    points: points.map((point) => ({...point, onFront: front.includes(point)})),
    front,
    levels,
    base: null,
    picked: String(state.picked),
    width,
    isRatio: true,
    timeTitle: points.length ? 'time over that of HBAO+ medium' : 'no time was measured here',
  });
  const view = draw(place, spec, width);
  view.addEventListener('click', (event, item) => {
    const key = item && item.datum && item.datum.key ? item.datum.key : nearestPoint(view, event, place);
    if (key) pick(Number(key));
  });
}
