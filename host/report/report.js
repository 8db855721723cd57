// The page: draws all parts, and draws them anew when something changes.

function renderPicked() {
  const view = byId('scatter').view;
  if (view) view.signal('picked', state.picked).runAsync();
  renderAside();
  renderPictures();
  renderLadder();
  renderRows();
}

/// What the filters change.
function renderShown() {
  renderScatter();
  renderAside();
  renderFloors();
  renderRows();
}

function render() {
  renderScenes();
  renderScatter();
  renderFloors();
  renderPicked();
}

/// Charts are as wide as the page and in its colours.
function redraw() {
  renderFronts();
  renderOthers();
  render();
}

function start() {
  state.scene =
      (data.scenes.find((scene) => scene.plain_front.length) || data.scenes.find((scene) => rowsOf(scene.name).length))
          .name;
  // Where nothing plain was measured there is nothing to show by default.
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
