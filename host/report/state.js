// The state of the page: the measurements, and what is picked, chosen and shown of them.

const data = JSON.parse(byId('data').textContent);

const steps = [
  {key: 't0w', short: 'model', help: 'what the method chooses to compute instead of the truth'},
  {key: 't1', short: 'screen', help: 'estimating on the screen, over all surfaces'},
  {key: 't2', short: 'hidden', help: 'geometry that the picture hides'},
  {key: 't12', short: 'screen and hidden', help: 'both at once, where there is no form over all layers'},
  {key: 't3', short: 'samples', help: 'noise of sampling'},
  {key: 't4_bias', short: 'filter bias', help: 'what the filter blurs away'},
  {key: 't4_noise', short: 'noise left', help: 'noise that the filter leaves'},
  {key: 't5', short: 'rounding', help: 'float and fast maths'},
];

const keyOf = (row) => JSON.stringify([row.technique, row.preset, row.variant]);
const nameOf = (row) => [row.technique, row.preset, row.variant && '(' + row.variant + ')'].filter(Boolean).join(' ');

const techniques = unique(data.rows.map((row) => row.technique));
const presetsOf = new Map(techniques.map(
    (name) => [name, unique(data.rows.filter((row) => row.technique === name).map((row) => row.preset))]));
const techniqueOf = (row) => techniques.indexOf(row.technique);
const mostChosen = 6;

const state = {
  scene: data.scenes.length ? data.scenes[0].name : null,
  mean: null,  // a class if its means are shown
  time: 'ratio',
  picked: null,
  chosen: [],
  hidden:
      {technique: new Set(), preset: new Set(), variant: new Set(data.rows.map((row) => row.variant).filter(Boolean))},
  pictures: {wipe: 0.5, range: 0.25, fullSize: false},
};

// --- What is shown now

const effects = unique(data.scenes.map((scene) => scene.effect));
const effectTitle = (plane) => (plane === 'ao' ? 'ambient occlusion' : plane.replace(/_/g, ' '));
const effectNow = () => sceneNow().effect;
const scenesOf = (effect) => data.scenes.filter((scene) => scene.effect === effect);
const classesOf = (effect) => {
  const names = scenesOf(effect).map((scene) => scene.class);
  return data.classes.filter((each) => names.includes(each.name));
};
const rowsOfEffect = (effect) => {
  const names = scenesOf(effect).map((scene) => scene.name);
  return data.rows.filter((row) => names.includes(row.scene));
};

/// The steps of the ladder; the one for techniques without a form over layers only where there is such a technique.
const stepsNow = () =>
    steps.filter(({key}) => key !== 't12' || rowsOfEffect(effectNow()).some((row) => is(row.ladder[key])));

/// What there is without a technique, as a row; null where nothing is known of it. It takes no time.
function baseRow(scene) {
  if (!is(scene.base.rmse)) return null;
  const none = {median: null, min: null, max: null};
  return {
    isBase: true, scene: scene.name, technique: scene.base.name, preset: '', variant: '', ms: none, rmse: scene.base.rmse,
        bias: scene.base.bias, ladder: {}
  };
}

const sceneNow = () => data.scenes.find((scene) => scene.name === state.scene);
const rowsOf = (scene) => data.rows.filter((row) => row.scene === scene);
const rowNow = (key) => data.rows.find((row) => row.scene === state.scene && keyOf(row) === key);
const isShown = (row) => Object.entries(state.hidden).every(([what, hidden]) => !hidden.has(row[what]));
const showsVariants = () => data.rows.some((row) => row.variant && !state.hidden.variant.has(row.variant));
const classNow = () => data.classes.find((each) => each.name === state.mean);
const classTitle = (name) => name || (data.classes.length > 1 ? 'without a class' : 'all scenes');

/// The points on the front of the shown scene or class. While no variants are shown, the front among plain settings.
function frontNow() {
  if (state.mean !== null)
    return classNow().points.filter((point) => (showsVariants() ? point.on_front : point.on_plain_front));
  const scene = sceneNow();
  return (showsVariants() ? scene.front : scene.plain_front).map((index) => data.rows[index]);
}

/// The points with an error, and a time on the present axis.
function pointsNow() {
  const rows = state.mean !== null ? classNow().points : rowsOf(state.scene);
  return rows.filter((row) => is(row.rmse) && timeOf(row) > 0);
}

const hasRatios = () => state.mean !== null || rowsOf(state.scene).some((row) => is(row.ratio));
const timeShown = () => (state.mean !== null ? 'ratio' : hasRatios() ? state.time : 'ms');
/// A submitted row has only the time that its authors state, in ms.
const timeOf = (row) => {
  if (timeShown() === 'ratio') return row.ratio;
  return isSubmitted(row) ? row.submitted.stated_ms : row.ms.median;
};

// --- Picking and choosing

function pick(key) {
  state.picked = key;
  renderPicked();
}

function keep(key) {
  if (state.chosen.includes(key)) return;
  state.chosen = [...state.chosen.slice(-(mostChosen - 1)), key];
  renderPicked();
}

function drop(key) {
  state.chosen = state.chosen.filter((other) => other !== key);
  renderPicked();
}

function goTo(scene, mean) {
  const effect = effectNow();
  state.scene = scene;
  state.mean = mean;
  if (effectNow() !== effect) {
    state.picked = bestKey();
    state.chosen = firstChosen();
    renderFilters();
    renderFronts();
  }
  if (state.mean === null && !rowNow(state.picked)) state.picked = bestKey();
  render();
}

/// The most accurate plain setting on the front, else the first row.
function bestKey() {
  const front = sceneNow().plain_front, rows = rowsOf(state.scene);
  const row = front.length ? data.rows[front[front.length - 1]] : rows.find((each) => !each.variant) || rows[0];
  return row ? keyOf(row) : null;
}

/// The initial choice: the reference setting of the ratios, and the fastest of the front.
function firstChosen() {
  const base = rowsOf(state.scene).find((row) => row.technique === 'hbao+' && row.preset === 'medium' && !row.variant);
  const fastest = data.rows[sceneNow().plain_front[0]];
  return unique([base, fastest].filter(Boolean).map(keyOf)).filter((key) => key !== state.picked);
}
