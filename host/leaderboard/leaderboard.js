// The page: draws all parts, and redraws them when something changes.

/// The method nearest to the truth, so that a newcomer sees pictures at once.
function bestEntry() {
  const rows = rowsNow().filter((row) => is(figureOf(row, 'error')));
  const best = rows.sort((a, b) => figureOf(a, 'error') - figureOf(b, 'error'))[0] || rowsNow()[0];
  return best ? best.entry : null;
}

function choose(changes) {
  const isOtherTable = 'board' in changes || 'effect' in changes;
  Object.assign(state, changes);
  if (isOtherTable) state.choice = tellingChoice();
  if (isOtherTable || !choiceNow().rows.some((row) => row.entry === state.picked)) state.picked = bestEntry();
  if (isOtherTable) state.item = null;
  render();
}

function render() {
  renderHead();
  renderChoices();
  renderFilters();
  renderCosts();
  renderMethods();
  renderMethod();
}

function start() {
  // Without plain rows, variants are shown from the start: otherwise the page would be empty.
  if (!tableNow().entries.some((entry) => !entry.variant)) state.variants = true;
  state.choice = tellingChoice();
  state.picked = bestEntry();
  renderFiles();
  render();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => (renderCosts(), renderMethod()));
  addEventListener('resize', renderCosts);
  addEventListener('scroll', () => (byId('hover').hidden = true), {passive: true});
}

start();
