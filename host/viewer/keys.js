// Keys, and the list of them on the page.

const keyList = [
  ['A', 'A alone', () => (state.mode === 'flicker' ? flickTo('a') : changeMode('a'))],
  ['B', 'B alone; in a flicker, B now', () => (state.mode === 'flicker' ? flickTo('b') : changeMode('b'))],
  ['W', 'wipe', () => changeMode('wipe')],
  ['F', 'flicker; again: the other one', () => (state.mode === 'flicker' ? flickTo() : changeMode('flicker'))],
  ['S', 'side by side', () => changeMode('beside')],
  ['D', 'difference', () => changeMode('difference')],
  ['Shift+D', 'its size', () => changeMode('absolute')],
  ['X', 'swap A and B', () => swapSides()],
  ['P', 'next plane of A', () => stepSide('plane', 1)],
  ['Shift+P', 'plane before', () => stepSide('plane', -1)],
  ['V', 'next view of A', () => stepSide('view', 1)],
  ['Shift+V', 'view before', () => stepSide('view', -1)],
  ['.', 'next frame', () => stepFrame(1)],
  [',', 'frame before', () => stepFrame(-1)],
  [
    'Space', 'play; in a flicker, by itself',
    () => (state.mode === 'flicker' ? letFlicker(!state.flickers) : play(!plays))
  ],
  ['E', 'half a stop brighter', () => stepExposure(0.5)],
  ['Shift+E', 'half a stop darker', () => stepExposure(-0.5)],
  ['R', 'range from the values', () => byId('tones').querySelector('.buttons .plain')?.click()],
  ['M', 'mark NaN, infinite and impossible values', () => changeMarks(!state.marks)],
  ['+', 'zoom in', () => zoomBy(1.5)],
  ['-', 'zoom out', () => zoomBy(1 / 1.5)],
  ['0', 'the whole picture', () => fit()],
  ['1', 'one pixel for one of the screen', () => oneToOne()],
  ['?', 'this list', () => (byId('keys').open = !byId('keys').open, byId('keys').scrollIntoView())],
];
const arrows = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1]
};

function stepExposure(stops) {
  for (const image of imagesWithTones())
    changeTone(image, {exposure: Math.min(10, Math.max(-10, toneNow(image).exposure + stops))});
}

/// "Shift+D" for a key with Shift; signs have theirs already.
function keyName(event) {
  if (event.key === ' ') return 'Space';
  if (event.key === '=') return '+';
  if (event.key.length > 1) return event.key;
  const letter = event.key.toUpperCase();
  return (event.shiftKey && letter !== event.key.toLowerCase() ? 'Shift+' : '') + letter;
}

/// A control that is typed into or chosen from keeps its keys.
const takesKeys = (target) => target.matches('input:not([type="checkbox"]), select, textarea');

function pressKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || takesKeys(event.target)) return;
  if (event.key === ' ' && event.target.matches('button, summary, input')) return;
  if (event.key in arrows && (event.target === stage || event.target === document.body)) {
    event.preventDefault();
    return movePicked(...arrows[event.key].map((step) => step * (event.shiftKey ? 10 : 1)));
  }
  const found = keyList.find(([name]) => name === keyName(event));
  if (!found) return;
  event.preventDefault();
  found[2]();
}

function prepareKeys() {
  byId('keys').append(element('dl', {class: 'facts'}, [
    ...keyList, ['Arrows', 'move the kept pixel; with Shift by ten'], ['Wheel, drag', 'zoom, move'],
    ['Click', 'keep the values of a pixel shown'], ['Double click', 'one to one, and back']
  ].map(([name, what]) => [element('dt', {}, element('kbd', {}, name)), element('dd', {}, what)])));
  document.addEventListener('keydown', pressKey);
}
