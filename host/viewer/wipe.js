// The line between A and B, and a flicker that runs by itself.

function renderDivider() {
  const divider = byId('divider');
  divider.hidden = state.mode !== 'wipe';
  divider.style.left = 100 * state.wipe + '%';
  divider.setAttribute('aria-valuenow', Math.round(100 * state.wipe));
}

function wipeTo(share) {
  state.wipe = Math.min(1, Math.max(0, share));
  keepAddress();
  redraw();
}

function followDivider() {
  const divider = byId('divider');
  divider.addEventListener('pointerdown', (event) => divider.setPointerCapture(event.pointerId));
  divider.addEventListener('pointermove', (event) => {
    if (event.buttons) wipeTo(onStage(event)[0] / stage.clientWidth);
  });
  divider.addEventListener('keydown', (event) => {
    const steps = {ArrowLeft: -0.01, ArrowRight: 0.01, PageUp: 0.1, PageDown: -0.1, Home: -1, End: 1};
    if (!(event.key in steps)) return;
    event.preventDefault();
    event.stopPropagation();
    wipeTo(state.wipe + steps[event.key] * (event.shiftKey ? 10 : 1));
  });
}

// --- Flicker

let flickerWaits = 0;

/// Shows one of the two; without a side the one that is not shown.
function flickTo(side = state.phase === 'a' ? 'b' : 'a') {
  state.phase = side;
  renderNames();
  redraw();
}

function letFlicker(runs) {
  state.flickers = runs;
  clearInterval(flickerWaits);
  if (runs) flickerWaits = setInterval(() => flickTo(), 1000 / state.rate);
  renderFlicker();
}

/// At most three changes a second: more can hurt people who react to flashes.
function renderFlicker() {
  const strip = byId('flicker');
  strip.hidden = state.mode !== 'flicker';
  const words = element('output', {}, setting(state.rate) + ' a second');
  strip.replaceChildren(
      element('button', {type: 'button', class: 'plain', onclick: () => flickTo()}, 'Other one'),
      pressButton(state.flickers ? 'Stop' : 'By itself', state.flickers, () => letFlicker(!state.flickers)),
      element('input', {
        type: 'range',
        min: 0.2,
        max: 3,
        step: 0.2,
        value: state.rate,
        'aria-label': 'Changes a second',
        oninput: (event) => {
          state.rate = Number(event.target.value);
          words.textContent = setting(state.rate) + ' a second';
          keepAddress();
          if (state.flickers) letFlickerAtNewRate();
        }
      }),
      words);
}

function letFlickerAtNewRate() {
  clearInterval(flickerWaits);
  flickerWaits = setInterval(() => flickTo(), 1000 / state.rate);
}
