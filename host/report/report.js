// The page: draws all parts, and redraws them when something changes.

function renderPicked() {
  const view = byId('scatter').view;
  if (view) view.signal('picked', state.picked).runAsync();
  renderAside();
  renderPictures();
  renderLadder();
  renderRoofline();
  renderRows();
}

/// Redraws the parts that depend on the filters.
function renderShown() {
  renderScatter();
  renderAside();
  renderFloors();
  renderRows();
}

function render() {
  renderVerdict();
  renderScenes();
  renderScatter();
  renderFloors();
  renderPicked();
}

/// Charts follow the width and the colours of the page.
function redraw() {
  renderFronts();
  renderOthers();
  renderSequence();
  render();
}

/// A page of a shot alone: the parts about single frames have nothing to show.
function startWithSequenceAlone() {
  for (const section of document.querySelectorAll('main > section'))
    section.hidden = !['sequence', 'skipped', 'measured'].includes(section.id);
  byId('scenes').hidden = true;
  renderHead();
  const show = () => (renderOthers(), renderSequence());
  show();
  addEventListener('resize', show);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', show);
}

function start() {
  if (!data.rows.length) return startWithSequenceAlone();
  state.scene =
      (data.scenes.find((scene) => scene.plain_front.length) || data.scenes.find((scene) => rowsOf(scene.name).length))
          .name;
  // Without plain rows, variants are shown from the start: otherwise the page would be empty.
  if (!data.rows.some((row) => !row.variant)) state.hidden.variant.clear();
  state.picked = bestKey();
  state.chosen = firstChosen();
  byId('all-scenes').addEventListener('change', renderRows);
  renderHead();
  renderFilters();
  redraw();
  let waiting = 0, width = innerWidth;
  addEventListener('resize', () => {
    if (innerWidth === width) return;
    width = innerWidth;
    clearTimeout(waiting);
    waiting = setTimeout(render, 150);
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
  addEventListener('scroll', () => (byId('hover').hidden = true), {passive: true});
}

start();
