// The page: shows what the state says, and again when it changes.

let turns = 0, showing = Promise.resolve();

/// Shows the state; the promise holds once the picture is drawn. A later call cancels an earlier one.
function update() {
  showing = show();
  return showing;
}

const say = (text) => (byId('message').textContent = text);

/// The images of the state: those of a side that is not shown are not unpacked.
async function imagesNow() {
  const both = needsBoth(state.mode);
  const [a, b] = await Promise.all(
      [both || state.mode === 'a' ? imageOf(state.a) : null, both || state.mode === 'b' ? imageOf(state.b) : null]);
  const isDifference = state.mode === 'difference' || state.mode === 'absolute';
  const difference =
      isDifference && !whyNoDifference(a, b) ? await differenceOf(a, b, state.mode === 'absolute') : null;
  return {a, b, difference, reference: a || b};
}

async function show() {
  const turn = ++turns, waits = setTimeout(() => say('Unpacking \u2026'), 200);
  renderControls();
  try {
    const images = await imagesNow();
    if (turn !== turns) return;
    shown = images;
    say(wordsInstead());
    drawStage();
    renderPanel();
  } catch (error) {
    say('This page cannot be shown: ' + error.message + '. It takes a browser of 2023 or newer.');
    throw error;
  } finally {
    clearTimeout(waits);
  }
}

/// What is said where there is no picture.
function wordsInstead() {
  if (state.mode === 'difference' || state.mode === 'absolute')
    return shown.difference ? '' : 'No difference: ' + whyNoDifference(shown.a, shown.b) + '.';
  const missing = (needsBoth(state.mode) ? ['a', 'b'] : [state.mode]).filter((side) => !shown[side]);
  return missing
      .map((side) => `${files[state[side].file].name} has no ${state[side].plane || 'plane'} in frame ${state.frame}.`)
      .join(' ');
}

function renderControls() {
  sideControls('a');
  sideControls('b');
  renderModes();
  renderNames();
  renderFrames();
  renderFlicker();
  keepAddress();
}

function renderPanel() {
  renderValues();
  renderFigures();
  renderTones();
  renderCounts();
  renderAbout();
}

function start() {
  if (frameNumbers.length) state.frame = frameNumbers[0];
  firstSides();
  takeAddress(location.hash.slice(1));
  prepareZoom();
  prepareKeys();
  followPointers();
  followDivider();
  byId('swap').addEventListener('click', swapSides);
  new ResizeObserver(() => {
    renderNames();
    redraw();
  }).observe(stage);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => (redraw(), renderTones()));
  addEventListener('hashchange', () => {
    takeAddress(location.hash.slice(1));
    update();
  });
  update();
}

start();
