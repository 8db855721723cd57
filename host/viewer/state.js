// The state of the page: what is shown of the files, and how. The address keeps it, so that a link shows the same.

const data = JSON.parse(byId('data').textContent);
const files = data.files;

const modes = ['a', 'b', 'wipe', 'flicker', 'beside', 'difference', 'absolute'];
const needsBoth = (mode) => mode !== 'a' && mode !== 'b';

const state = {
  a: {file: 0, view: '', plane: ''},
  b: {file: 0, view: '', plane: ''},
  frame: null,      // number of a shot's frame
  mode: 'a',        // one of `modes`
  wipe: 0.5,        // share of the stage that shows A
  zoom: null,       // pixels of the screen per pixel of A's image; null: the whole image
  centre: [0, 0],   // point of A's image in the middle of the stage
  picked: null,     // [x, y], pixel of A's image whose values stay shown
  rate: 1,          // changes a second of a flicker that runs by itself
  flickers: false,  // whether it does
  phase: 'a',       // what a flicker shows now
  marks: true,      // NaN, infinite and impossible values in colours of their own
  tones: {},  // how values become colours, by what is shown (tone.js); what is not said is as for the plane's kind
};

// --- Files, frames, views, planes

const frameNumbers =
    unique(files.flatMap((file) => (file.shot ? file.frames.map((frame) => frame.number) : []))).sort((a, b) => a - b);

/// The frame of a file that is shown now; undefined for a shot without it.
const frameOf = (file) => (file.shot ? file.frames.find((frame) => frame.number === state.frame) : file.frames[0]);

/// A frame of the file, to know its views and planes by.
const anyFrameOf = (file) => frameOf(file) || file.frames[0];
const viewsOf = (file) => anyFrameOf(file).views;
const viewNamed = (file, name) => viewsOf(file).find((view) => view.name === name) || viewsOf(file)[0];
const planesOf = (side) => viewNamed(files[side.file], side.view).planes;
const planeNamed = (side) => planesOf(side).find((plane) => plane.name === side.plane);

/// Lets a side show something that is there: the wanted plane and view where its file has them.
function settle(side, plane = side.plane, view = side.view) {
  side.view = viewNamed(files[side.file], view).name;
  const planes = planesOf(side);
  side.plane = (planes.find((each) => each.name === plane) || planes[0] || {name: ''}).name;
  return side;
}

/// The first two files that begin with the same plane: of a frame, a result and its truth the latter two. Null where no two do.
function alikeFiles() {
  const leading = files.map((file) => (viewsOf(file)[0].planes[0] || {}).name);
  const first = leading.findIndex((name, i) => name && leading.indexOf(name, i + 1) > i);
  return first < 0 ? null : [first, leading.indexOf(leading[first], first + 1)];
}

/// The first planes to show: a result before the colour, as the command has sorted them, and beside it the same of another file.
function firstSides() {
  settle(state.a);
  const alike = alikeFiles();
  if (alike) {
    state.a = settle({file: alike[0]});
    state.b = settle({file: alike[1], view: state.a.view, plane: state.a.plane});
    state.mode = 'wipe';
    return;
  }
  if (files.length > 1) {
    state.b = settle({file: 1, view: state.a.view});
    return;
  }
  const views = viewsOf(files[0]), planes = planesOf(state.a);
  if (views.length > 1)
    state.b = settle({file: 0, view: views[1].name, plane: state.a.plane});
  else
    state.b = settle({file: 0, view: state.a.view, plane: (planes[1] || planes[0]).name});
}

// --- The address

const sideText = (side) => [side.file, side.plane, side.view].join('|');

function sideOf(text) {
  const [file, plane, view] = text.split('|');
  const index = Math.min(files.length - 1, Math.max(0, Math.trunc(Number(file)) || 0));
  return settle({file: index, plane: plane || '', view: view || ''});
}

const short = (value) => Number(value.toPrecision(6));
const numbersOf = (text, count) => {
  const numbers = text.split(',').map(Number);
  return numbers.length === count && numbers.every(Number.isFinite) ? numbers : null;
};

/// What the address says after its #.
function addressOfState() {
  const words = new URLSearchParams({a: sideText(state.a), b: sideText(state.b), mode: state.mode});
  if (state.frame !== null) words.set('frame', state.frame);
  if (state.wipe !== 0.5) words.set('wipe', short(state.wipe));
  if (state.zoom !== null) {
    words.set('zoom', short(state.zoom));
    words.set('centre', state.centre.map(short).join(','));
  }
  if (state.picked) words.set('pixel', state.picked.join(','));
  if (!state.marks) words.set('marks', 'off');
  if (state.rate !== 1) words.set('rate', state.rate);
  for (const [key, tone] of Object.entries(state.tones))
    if (Object.keys(tone).length) words.set('tone.' + key, JSON.stringify(tone));
  return words.toString();
}

/// A tone from an address holds what tones hold, and nothing else.
function toneOf(text) {
  const tone = {};
  try {
    const read = JSON.parse(text);
    for (const name of ['exposure', 'low', 'high'])
      if (Number.isFinite(read[name])) tone[name] = read[name];
    for (const [name, words] of Object.entries({map: mapNames, transfer: transferNames}))
      if (words.includes(read[name])) tone[name] = read[name];
    if (typeof read.channel === 'string' || Number.isInteger(read.channel)) tone.channel = read.channel;
  } catch (error) {
    return {};
  }
  return tone;
}

/// Takes over what an address says; anything else in it is ignored.
function takeAddress(text) {
  const words = new URLSearchParams(text);
  const frame = Number(words.get('frame'));
  if (words.has('frame') && frameNumbers.includes(frame)) state.frame = frame;
  for (const side of ['a', 'b'])
    if (words.has(side)) state[side] = sideOf(words.get(side));
  if (modes.includes(words.get('mode'))) state.mode = words.get('mode');
  const wipe = Number(words.get('wipe') ?? 0.5), zoom = Number(words.get('zoom')), rate = Number(words.get('rate'));
  if (wipe >= 0 && wipe <= 1) state.wipe = wipe;
  if (zoom > 0 && zoom <= 1000) {
    state.zoom = zoom;
    state.centre = numbersOf(words.get('centre') || '', 2) || state.centre;
  }
  if (rate >= 0.2 && rate <= 3) state.rate = rate;
  const picked = numbersOf(words.get('pixel') || '', 2);
  if (picked && picked.every(Number.isInteger)) state.picked = picked;
  if (words.get('marks') === 'off') state.marks = false;
  for (const [name, text] of words)
    if (name.startsWith('tone.')) state.tones[name.slice(5)] = toneOf(text);
}

let addressWaits = 0;
/// A moment after the last change: browsers refuse many changes at once.
function keepAddress() {
  clearTimeout(addressWaits);
  addressWaits = setTimeout(() => {
    try {
      history.replaceState(null, '', '#' + addressOfState());
    } catch (error) {  // a page inside another one may not
    }
  }, 150);
}
