// The controls above and below the stage: what A and B are, how they are shown, zoom, frames.

function chooser(label, className, choices, chosen, action) {
  const select = element(
      'select', {'aria-label': label, class: className, title: label},
      choices.map(([value, text]) => element('option', {value, selected: String(value) === String(chosen)}, text)));
  select.addEventListener('change', () => action(select.value));
  return select;
}

const viewName = (name) => name || 'the view';

// --- A and B

/// Changes what a side shows. B follows A to the same plane and view while they were the same.
function changeSide(name, change) {
  const before = {...state[name]}, side = state[name], other = state[name === 'a' ? 'b' : 'a'];
  Object.assign(side, change);
  settle(side);
  const isPlane = is(change.plane) && change.file === undefined;
  if (name === 'a' && other.file !== side.file) {
    const wants = {
      plane: other.plane === before.plane ? side.plane : other.plane,
      view: other.view === before.view ? side.view : other.view
    };
    const there = viewNamed(files[other.file], wants.view);
    if (there.name === wants.view) other.view = wants.view;
    if (isPlane && there.planes.some((plane) => plane.name === wants.plane)) other.plane = wants.plane;
    settle(other);
  }
  update();
}

function sideControls(name) {
  const side = state[name], file = files[side.file], views = viewsOf(file), place = byId('side-' + name);
  const parts = [element('b', {'aria-hidden': 'true'}, name.toUpperCase())];
  if (files.length > 1)
    parts.push(chooser(
        'File of ' + name.toUpperCase(), 'of-file', files.map((each, i) => [i, each.name]), side.file,
        (value) => changeSide(name, {file: Number(value)})));
  else
    parts.push(element('span', {class: 'name', title: file.name}, file.name));
  parts.push(chooser(
      'Plane of ' + name.toUpperCase(), 'of-plane', planesOf(side).map((plane) => [plane.name, plane.name]), side.plane,
      (value) => changeSide(name, {plane: value})));
  if (views.length > 1)
    parts.push(chooser(
        'View of ' + name.toUpperCase(), 'of-view', views.map((view) => [view.name, viewName(view.name)]), side.view,
        (value) => changeSide(name, {view: value})));
  replaceKeepingFocus(place, parts);
}

/// Replaces children; the control of the same label keeps the focus.
function replaceKeepingFocus(place, parts) {
  const label = place.contains(document.activeElement) && document.activeElement.getAttribute('aria-label');
  place.replaceChildren(...parts.filter(is));
  if (label)
    [...place.querySelectorAll('[aria-label]')].find((each) => each.getAttribute('aria-label') === label)?.focus();
}

function swapSides() {
  [state.a, state.b] = [state.b, state.a];
  update();
}

/// The next or previous plane or view of A.
function stepSide(what, step) {
  const names = (what === 'plane' ? planesOf(state.a) : viewsOf(files[state.a.file])).map((each) => each.name);
  const next = (names.indexOf(state.a[what]) + step + names.length) % names.length;
  changeSide('a', {[what]: names[next]});
}

// --- Modes and zoom

const modeNames = {
  a: ['A', 'A alone', 'A'],
  b: ['B', 'B alone', 'B'],
  wipe: ['Wipe', 'A left and B right of a line', 'W'],
  flicker: ['Flicker', 'A and B in turns', 'F'],
  beside: ['Side by side', 'A beside B, with one zoom', 'S'],
  difference: ['A \u2212 B', 'the difference with its sign', 'D'],
  absolute: ['|A \u2212 B|', 'the size of the difference', 'Shift+D'],
};

function changeMode(mode) {
  state.mode = mode;
  if (mode !== 'flicker' && state.flickers) letFlicker(false);
  update();
}

function renderModes() {
  const canCompare = files.length > 1 || sideText(state.a) !== sideText(state.b);
  replaceKeepingFocus(byId('modes'), modes.map((mode) => {
    const [text, help, key] = modeNames[mode];
    return pressButton(
        text, state.mode === mode, () => changeMode(mode),
        {'aria-label': `${text}: ${help}`, title: `${help} (${key})`, disabled: needsBoth(mode) && !canCompare});
  }));
}

function prepareZoom() {
  const button = (text, label, action) =>
      element('button', {type: 'button', 'aria-label': label, title: label, onclick: action}, text);
  byId('zooms').replaceChildren(
      button('\u2212', 'Zoom out', () => zoomBy(1 / 1.5)), element('output', {id: 'zoom'}),
      button('+', 'Zoom in', () => zoomBy(1.5)), button('Fit', 'The whole picture (0)', fit),
      button('1:1', 'One pixel of the picture for one of the screen (1)', oneToOne));
}

/// In pixels of the screen per pixel that the page has.
function renderZoom() {
  const percent = 100 * looking().zoom * data.step * deviceScale();
  byId('zoom').textContent = (percent < 10 ? percent.toPrecision(2) : Math.round(percent)) + '\u202f%';
}

function renderNames() {
  const show = (id, text) => {
    byId(id).hidden = !text;
    byId(id).textContent = text || '';
  };
  const name = (key) => {
    const side = state[key], file = files[side.file];
    return [key.toUpperCase(), file.name, side.plane, viewsOf(file).length > 1 ? viewName(side.view) : '']
        .filter(Boolean)
        .join(' \u00b7 ');
  };
  const single = {a: 'a', b: 'b', flicker: state.phase}[state.mode];
  const isDifference = state.mode === 'difference' || state.mode === 'absolute';
  show(
      'name-a',
      single           ? name(single) :
          isDifference ? (state.mode === 'absolute' ? '|A \u2212 B|' : 'A \u2212 B') :
                         name('a'));
  byId('name-a').style.maxWidth =
      state.mode === 'wipe' || (state.mode === 'beside' && panes()[1].left > 0) ? '' : '94%';
  const stacked = state.mode === 'beside' && panes()[1].top > 0;
  byId('name-b').style.top = stacked ? panes()[1].top + 8 + 'px' : '';
  byId('name-b').className = stacked ? 'name-tag left' : 'name-tag right';
  show('name-b', state.mode === 'wipe' || state.mode === 'beside' ? name('b') : '');
}

// --- Frames

let playWaits = 0, plays = false;

function toFrame(number) {
  state.frame = number;
  settle(state.a);
  settle(state.b);
  return update();
}

function stepFrame(step) {
  if (!frameNumbers.length) return Promise.resolve();
  const next = (frameNumbers.indexOf(state.frame) + step + frameNumbers.length) % frameNumbers.length;
  return toFrame(frameNumbers[next]);
}

/// Shows frame after frame, as fast as they can be unpacked and at most 12 a second.
function play(runs) {
  plays = runs;
  clearTimeout(playWaits);
  const next = async () => {
    const start = performance.now();
    await stepFrame(1);
    if (plays) playWaits = setTimeout(next, Math.max(0, 1000 / 12 - (performance.now() - start)));
  };
  if (runs) next();
  renderFrames();
}

function renderFrames() {
  const strip = byId('frames');
  strip.hidden = frameNumbers.length < 2;
  if (strip.hidden) return;
  if (!strip.children.length) {
    strip.append(
        element('button', {type: 'button', class: 'plain', id: 'play', onclick: () => play(!plays)}), element('input', {
          type: 'range',
          id: 'frame',
          min: 0,
          max: frameNumbers.length - 1,
          'aria-label': 'Frame',
          oninput: (event) => toFrame(frameNumbers[event.target.value])
        }),
        element('output', {id: 'frame-number'}));
  }
  byId('play').textContent = plays ? 'Stop' : 'Play';
  byId('play').setAttribute('aria-pressed', String(plays));
  byId('frame').value = frameNumbers.indexOf(state.frame);
  byId('frame').setAttribute('aria-valuetext', 'frame ' + state.frame);
  byId('frame-number').textContent = 'frame ' + state.frame;
}
