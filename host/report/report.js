// The page: what is picked, chosen and shown, and the parts that follow from it.

const data = JSON.parse(byId('data').textContent);

const steps = [
  {key: 't0w', short: 'model', help: 'what the method chooses to compute instead of the truth'},
  {key: 't1', short: 'screen', help: 'estimating on the screen, over all surfaces'},
  {key: 't2', short: 'hidden', help: 'geometry that the picture hides'},
  {key: 't3', short: 'samples', help: 'noise of sampling'},
  {key: 't4_bias', short: 'filter bias', help: 'what the filter blurs away'},
  {key: 't4_noise', short: 'noise left', help: 'noise that the filter leaves'},
  {key: 't5', short: 'rounding', help: 'float and fast maths'},
];

const keyOf = (row) => JSON.stringify([row.technique, row.preset, row.variant]);
const nameOf = (row) => [row.technique, row.preset, row.variant && '(' + row.variant + ')'].filter(Boolean).join(' ');
const unique = (items) => [...new Set(items)];

const techniques = unique(data.rows.map((row) => row.technique));
const presetsOf = new Map(techniques.map(
    (name) => [name, unique(data.rows.filter((row) => row.technique === name).map((row) => row.preset))]));
const techniqueOf = (row) => techniques.indexOf(row.technique);
const mostChosen = 6;

const state = {
  scene: data.scenes[0].name,
  mean: null,  // a class, where its means are shown
  time: 'ratio',
  picked: null,
  chosen: [],
  hidden:
      {technique: new Set(), preset: new Set(), variant: new Set(data.rows.map((row) => row.variant).filter(Boolean))},
  pictures: {wipe: 0.5, range: 0.25, fullSize: false},
};

// --- What is at hand

const sceneNow = () => data.scenes.find((scene) => scene.name === state.scene);
const rowsOf = (scene) => data.rows.filter((row) => row.scene === scene);
const rowNow = (key) => data.rows.find((row) => row.scene === state.scene && keyOf(row) === key);
const isShown = (row) => Object.entries(state.hidden).every(([what, hidden]) => !hidden.has(row[what]));
const showsVariants = () => data.rows.some((row) => row.variant && !state.hidden.variant.has(row.variant));
const classNow = () => data.classes.find((each) => each.name === state.mean);
const classTitle = (name) => name || (data.classes.length > 1 ? 'without a class' : 'all scenes');

/// Who is on the front of the scene or class at hand. While no variants are shown, the front among plain settings.
function frontNow() {
  if (state.mean !== null)
    return classNow().points.filter((point) => (showsVariants() ? point.on_front : point.on_plain_front));
  const scene = sceneNow();
  return (showsVariants() ? scene.front : scene.plain_front).map((index) => data.rows[index]);
}

/// What has an error, and a time on the axis at hand.
function pointsNow() {
  const rows = state.mean !== null ? classNow().points : rowsOf(state.scene);
  return rows.filter((row) => is(row.rmse) && timeOf(row) > 0);
}

const hasRatios = () => state.mean !== null || rowsOf(state.scene).some((row) => is(row.ratio));
const timeShown = () => (state.mean !== null ? 'ratio' : hasRatios() ? state.time : 'ms');
const timeOf = (row) => (timeShown() === 'ratio' ? row.ratio : row.ms.median);

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
  state.scene = scene;
  state.mean = mean;
  if (state.mean === null && !rowNow(state.picked)) state.picked = bestKey();
  render();
}

/// The most accurate plain setting on the front, else the first row.
function bestKey() {
  const front = sceneNow().plain_front, rows = rowsOf(state.scene);
  const row = front.length ? data.rows[front[front.length - 1]] : rows.find((each) => !each.variant) || rows[0];
  return row ? keyOf(row) : null;
}

/// To begin with, the setting that the ratios are to, and the fastest of the front.
function firstChosen() {
  const base = rowsOf(state.scene).find((row) => row.technique === 'hbao+' && row.preset === 'medium' && !row.variant);
  const fastest = data.rows[sceneNow().plain_front[0]];
  return unique([base, fastest].filter(Boolean).map(keyOf)).filter((key) => key !== state.picked);
}

// --- The head of the page

function renderHead() {
  const settings = unique(data.rows.map(keyOf)).length,
        used = data.scenes.filter((scene) => rowsOf(scene.name).length).length;
  byId('lead').textContent =
      `${many(settings, 'setting')} of ${many(techniques.length, 'technique')} on ${many(used, 'scene')}: ` +
      'how far each image is from a ray-traced truth, and what it took to compute.';
  const facts = [
    ['CPU', data.cpu], ['Cores', data.cores], ['Device', data.device], ['Driver', data.driver], ['Measured', data.date],
    ['Commit', data.commit], ['Rounds', data.rounds], ['Rays per pixel of the truth', data.rays]
  ];
  byId('facts').replaceChildren(
      ...facts.filter(([, value]) => is(value) && value !== '')
          .map(([name, value]) => element('div', {}, element('dt', {}, name), element('dd', {}, String(value)))));
}

function pressButton(text, pressed, action) {
  return element('button', {type: 'button', 'aria-pressed': String(pressed), onclick: action}, text);
}

function renderScenes() {
  const parts = [];
  for (const name of unique(data.scenes.map((scene) => scene.class))) {
    const scenes = data.scenes.filter((scene) => scene.class === name && rowsOf(scene.name).length);
    const means = data.classes.find((each) => each.name === name);
    if (name && scenes.length) parts.push(element('span', {class: 'class-name'}, name));
    for (const scene of scenes)
      parts.push(
          pressButton(scene.name, state.mean === null && scene.name === state.scene, () => goTo(scene.name, null)));
    if (means && means.scenes.length > 1)
      parts.push(pressButton('mean of ' + means.scenes.length, state.mean === name, () => goTo(state.scene, name)));
  }
  for (const place of document.querySelectorAll('h2 .scene-name')) place.textContent = 'on ' + state.scene;
  const bar = byId('scenes'), at = bar.scrollLeft;
  bar.replaceChildren(...parts);
  bar.scrollLeft = at;
}

// --- Error against time

function hoverOf(row) {
  const lines = [['error, RMSE', errorFigure(row.rmse)]];
  if (is(row.ratio)) lines.push(['over HBAO+', times(row.ratio)]);
  if (row.ms)
    lines.push(
        ['time', figure(row.ms.median) + ' ms'],
        ['fastest, slowest', figure(row.ms.min) + ' to ' + figure(row.ms.max)]);
  if (is(row.bias)) lines.push(['bias', errorFigure(row.bias)]);
  if (is(row.to_own_floor)) lines.push(['over its floor', times(row.to_own_floor)]);
  if (is(row.samples)) lines.push(['samples per pixel', setting(row.samples)]);
  if (row.fronts) lines.push(['on fronts of', row.fronts.length + ' of ' + classNow().scenes.length]);
  return {title: nameOf(row), lines};
}

function pointOf(row, front) {
  const size = Math.min(5, presetsOf.get(row.technique).indexOf(row.preset));
  return {
    key: keyOf(row),
    x: timeOf(row),
    y: row.rmse,
    technique: techniqueOf(row),
    label: nameOf(row),
    size: 50 + 42 * size,
    hollow: row.variant !== '',
    onFront: front.includes(row),
    hover: hoverOf(row)
  };
}

function renderScatter() {
  const place = byId('scatter'), front = frontNow().filter((row) => timeOf(row) > 0), points = pointsNow(),
        shown = points.filter(isShown);
  byId('scatter-remark').textContent = remarkOn(points, shown, front);
  renderLegend(shown);
  renderTimeSwitch();
  place.hidden = shown.length === 0;
  if (!shown.length) return clearChart(place);
  const width = place.clientWidth || place.parentElement.clientWidth;
  const view = draw(
      place, scatterSpec({
        points: shown.map((row) => pointOf(row, front)),
        front: front.map((row) => ({x: timeOf(row), y: row.rmse})),
        picked: state.picked,
        width,
        isRatio: timeShown() === 'ratio',
        timeTitle: timeShown() === 'ratio' ? 'time over that of HBAO+ medium, in the same round' :
                                             'time of the whole plan, ms',
      }),
      width);
  view.addEventListener('click', (event, item) => {
    const key = item && item.datum && item.datum.key ? item.datum.key : nearestPoint(view, event, place);
    if (!key) return;
    if (event.shiftKey)
      keep(key);
    else
      pick(key);
  });
}

/// Fingers are wider than points: the nearest within 24 pixels.
function nearestPoint(view, event, place) {
  const box = place.querySelector('svg').getBoundingClientRect(), [left, top] = view.origin();
  const padding = view.padding(), x = view.scale('x'), y = view.scale('y');
  const distance = (p) => Math.hypot(
      x(p.x) + left + (padding.left || 0) - (event.clientX - box.left),
      y(p.y) + top + (padding.top || 0) - (event.clientY - box.top));
  const nearest = view.data('points').reduce((best, p) => (!best || distance(p) < distance(best) ? p : best), null);
  return nearest && distance(nearest) < 24 ? nearest.key : null;
}

function remarkOn(points, shown, front) {
  const about = [];
  const scene = sceneNow();
  if (state.mean !== null) {
    const {scenes, left_out: leftOut} = classNow();
    about.push(`Means over ${enumerate(scenes)}.`);
    if (leftOut)
      about.push(`${many(leftOut, 'setting is', 'settings are')} not here: measured on some of these scenes only.`);
  } else {
    const facts = [];
    if (is(scene.width) && is(scene.height)) facts.push(`${scene.width} × ${scene.height} pixels`);
    if (is(scene.radius))
      facts.push(
          `radius ${setting(scene.radius)}` +
          (is(scene.radius_pixels) ? ` (${figure(scene.radius_pixels)} pixels at the median depth)` : ''));
    if (is(scene.truth_noise)) facts.push(`noise of the truth itself ${errorFigure(scene.truth_noise)}`);
    if (facts.length) about.push(scene.name + ': ' + facts.join(', ') + '.');
    if (!points.length) about.push('There is no truth for this scene, so no error to draw; its times are below.');
    if (!hasRatios() && state.time === 'ratio') about.push('HBAO+ medium was not measured here, so the axis is in ms.');
  }
  if (points.length && !shown.length) about.push('Nothing is left of the choice below.');
  const unseen = front.filter((row) => !isShown(row)).length;
  if (unseen)
    about.push(`${many(unseen, 'point')} of the front ${
        unseen === 1 ? 'is' : 'are'} not shown by the choice below; the line passes there all the same.`);
  if (shown.length) about.push('Hover for figures, click to pick, shift-click to keep for comparison.');
  return about.join(' ');
}

function renderLegend(shown) {
  const used = techniques.filter((name) => shown.some((row) => row.technique === name));
  const notes = [];
  if (used.some((name) => presetsOf.get(name).length > 1)) notes.push('larger: a later preset');
  if (shown.some((row) => row.variant)) notes.push('hollow: a variant');
  if (shown.length)
    notes.push(
        'line: Pareto front' + (showsVariants() || !data.rows.some((row) => row.variant) ? '' : ' of plain settings'));
  byId('legend').replaceChildren(
      ...used.map((name) => element('span', {}, swatch(techniques.indexOf(name)), name)),
      element('span', {class: 'of-front'}, notes.join(' · ')));
}

function renderTimeSwitch() {
  const choices = [['ratio', 'over HBAO+', hasRatios()], ['ms', 'in ms', state.mean === null]];
  byId('time-switch')
      .replaceChildren(...choices.filter(([, , possible]) => possible)
                           .map(([time, text]) => pressButton(text, timeShown() === time, () => {
                                  state.time = time;
                                  renderScatter();
                                })));
}

function renderFilters() {
  const boxes = [];
  for (const [what, title] of [['technique', 'Techniques'], ['preset', 'Presets'], ['variant', 'Variants']]) {
    const values = unique(data.rows.map((row) => row[what]));
    if (values.length < 2) continue;
    const hidden = state.hidden[what];
    const checks = values.map((value) => {
      const input = element('input', {
        type: 'checkbox',
        checked: !hidden.has(value),
        'data-filter': what,
        'data-value': value,
        onchange: () => {
          if (input.checked)
            hidden.delete(value);
          else
            hidden.add(value);
          renderShown();
        }
      });
      return element('label', {class: 'check'}, input, value || (what === 'variant' ? 'plain' : 'none'));
    });
    const all = element(
        'button', {
          type: 'button',
          onclick: () => {
            const everything = values.every((value) => !hidden.has(value));
            values.forEach((value) => (everything ? hidden.add(value) : hidden.delete(value)));
            renderFilters();
            renderShown();
          }
        },
        'all or none');
    boxes.push(element('fieldset', {}, element('legend', {}, title), element('div', {class: 'checks'}, checks, all)));
  }
  byId('filters').hidden = boxes.length === 0;
  byId('filter-boxes').replaceChildren(...boxes);
}

// --- The picked point

function settingsText(row) {
  return Object.entries(row.settings)
      .map(([name, value]) => `${name}=${typeof value === 'object' ? JSON.stringify(value) : value}`)
      .join(' ');
}

function spentSentence(row) {
  const shares = [...row.spent_on].sort((a, b) => b.share - a.share).map((s) => percent(s.share) + ' ' + s.what);
  return shares.length ? enumerate(shares) : '';
}

/// How a point stands to the front.
function standingOf(point) {
  if (!is(point.rmse)) return 'no truth to tell its error';
  if (!frontNow().includes(point)) return 'not on the front: another setting is as fast and as near to the truth, and better in one of the two';
  const onAll = state.mean !== null ? point.on_front : sceneNow().front.includes(data.rows.indexOf(point));
  return element('span', {class: 'badge'}, 'on the Pareto front' + (onAll ? '' : ' of plain settings'));
}

function renderAside() {
  const place = byId('picked');
  const point =
      state.mean !== null ? classNow().points.find((each) => keyOf(each) === state.picked) : rowNow(state.picked);
  if (!point) {
    const name = state.picked ? nameOfKey(state.picked) : null;
    return place.replaceChildren(
        element('p', {}, name ? `${name} was not measured here. Pick a point.` : 'Pick a point.'));
  }
  const figures = hoverOf(point).lines.map(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]);
  const parts = [
    element('h3', {}, swatch(techniqueOf(point), point.variant !== ''), nameOf(point)),
    element('p', {}, standingOf(point))
  ];
  parts.push(element('dl', {class: 'figures'}, figures));
  if (point.spent_on && point.spent_on.length) parts.push(element('p', {}, 'Its time: ' + spentSentence(point) + '.'));
  if (point.passes && point.passes.length) {
    parts.push(element(
        'details', {}, element('summary', {}, many(point.passes.length, 'pass', 'passes')),
        element(
            'dl', {class: 'figures'},
            point.passes.map((p) => [element('dt', {}, p.name), element('dd', {}, figure(p.ms.median) + ' ms')]))));
  }
  if (point.settings && Object.keys(point.settings).length)
    parts.push(element('details', {}, element('summary', {}, 'Settings'), element('code', {}, settingsText(point))));
  const kept = state.chosen.includes(state.picked);
  parts.push(element(
      'button',
      {type: 'button', class: 'plain', id: 'keep', onclick: () => (kept ? drop(state.picked) : keep(state.picked))},
      kept ? 'Take out of the comparison' : 'Keep for comparison'));
  place.replaceChildren(...parts);
}

const nameOfKey = (key) => {
  const [technique, preset, variant] = JSON.parse(key);
  return nameOf({technique, preset, variant});
};

function renderPictures() {
  const place = byId('viewer'), row = rowNow(state.picked);
  byId('pictures').hidden =
      !data.rows.some((each) => is(each.picture)) && !data.scenes.some((scene) => is(scene.truth_picture));
  byId('size-switch')
      .replaceChildren(...[[false, 'fit'], [true, 'pixel by pixel']].map(
          ([fullSize, text]) => pressButton(text, state.pictures.fullSize === fullSize, () => {
            state.pictures.fullSize = fullSize;
            renderPictures();
          })));
  if (!row) return;
  showPictures(place, {name: nameOf(row), picture: row.picture, truth: sceneNow().truth_picture}, state.pictures);
}

// --- The ladder

/// The picked one and the chosen, in the order of choosing, with how each is drawn.
function compared() {
  const keys = unique([...(state.picked ? [state.picked] : []), ...state.chosen]).filter(rowNow);
  const met = new Map();
  return keys.map((key, index) => {
    const row = rowNow(key), earlier = met.get(row.technique) || 0;
    met.set(row.technique, earlier + 1);
    return {
      key,
      index,
      row,
      colour: colourOf(techniqueOf(row)),
      opacity: [0.92, 0.55, 0.3, 0.12, 0.75, 0.42][earlier % 6],
      dash: [[1, 0], [6, 3], [2, 2], [8, 2, 2, 2]][earlier % 4]
    };
  });
}

function renderLadder() {
  const rows = compared(), scene = state.scene;
  byId('chosen').replaceChildren(...rows.map(({key, row, colour, opacity}) => {
    const square = element('span', {class: 'square'});
    square.style.background = `color-mix(in srgb, ${colour} ${100 * opacity}%, transparent)`;
    square.style.outline = `1px solid ${colour}`;
    const remove = state.chosen.includes(key) ?
        element('button', {type: 'button', 'aria-label': 'take out ' + nameOf(row), onclick: () => drop(key)}, '×') :
        null;
    return element(
        'span', {class: 'chip' + (key === state.picked ? ' is-picked' : '')}, square,
        nameOf(row) + (key === state.picked ? ' · picked' : ''), remove);
  }));
  const place = byId('ladder-chart'),
        any = rows.some(({row}) => is(row.rmse) || steps.some((step) => is(row.ladder[step.key])));
  place.hidden = !any;
  if (!any) {
    clearChart(place);
    return byId('ladder-table')
        .replaceChildren(
            element('p', {class: 'remark'}, `On ${scene} no step of the ladder is at hand for what is picked.`));
  }
  const bars = rows.flatMap(
      ({row, index, colour, opacity}) => steps.map(
          (step) => ({
            step: step.key,
            index,
            value: row.ladder[step.key],
            colour,
            opacity,
            hover: {
              title: nameOf(row),
              lines: [[
                step.key + ', ' + step.short, is(row.ladder[step.key]) ? errorFigure(row.ladder[step.key]) : 'not at hand'
              ]]
            }
          })));
  const totals = rows.filter(({row}) => is(row.rmse))
                     .map(({row, key, colour, dash}) => ({
                            value: row.rmse,
                            picked: key === state.picked,
                            colour,
                            opacity: 0.9,
                            dash,
                            label: nameOf(row) + ' ' + errorFigure(row.rmse),
                            hover: {title: nameOf(row), lines: [['total to the truth', errorFigure(row.rmse)]]}
                          }));
  const width = place.clientWidth || place.parentElement.clientWidth;
  draw(place, ladderSpec({steps, count: rows.length, bars, totals, width}), width);
  sortedTable(
      byId('ladder-table'),
      [
        {name: 'on ' + scene, value: ({row}) => nameOf(row)},
        {
          name: 'total',
          number: true,
          help: 'RMSE of what is shipped to the truth',
          value: ({row}) => row.rmse,
          text: atHand
        },
        ...steps.map((step) => ({
                       name: step.key + ' ' + step.short,
                       number: true,
                       help: step.help,
                       value: ({row}) => row.ladder[step.key],
                       text: atHand
                     })),
      ],
      rows);
}

const atHand = (value) => (is(value) ? errorFigure(value) : 'not at hand');

// --- Fronts in words

function settingButton(row, scene) {
  return element(
      'button', {
        type: 'button',
        onclick: () => {
          state.picked = keyOf(row);
          if (row.variant) state.hidden.variant.delete(row.variant);
          renderFilters();
          goTo(scene, null);
        }
      },
      swatch(techniqueOf(row), row.variant !== ''), nameOf(row));
}

/// Per technique, on how many of the class's scenes one of its settings is on the front.
function techniqueSentence(each) {
  const parts = techniques
                    .map((name) => {
                      const scenes = unique(
                          each.points.filter((point) => point.technique === name).flatMap((point) => point.fronts));
                      return {name, scenes};
                    })
                    .filter(({scenes}) => scenes.length)
                    .sort((a, b) => b.scenes.length - a.scenes.length);
  const total = each.scenes.length;
  if (total === 1) return `They are of ${enumerate(parts.map(({name}) => name))}.`;
  const words = parts.map(
      ({name, scenes}) =>
          `${name} in ${scenes.length} of ${total}` + (scenes.length === 1 ? ` (${scenes[0]} only)` : ''));
  return `On the scenes' own fronts: ${words.join(', ')}.`;
}

function renderFronts() {
  byId('class-fronts').replaceChildren(...data.classes.map((each) => {
    const front = each.points.filter((point) => point.on_front), table = element('div'), total = each.scenes.length;
    sortedTable(
        table,
        [
          {name: 'setting', value: nameOf, cell: (p) => [swatch(techniqueOf(p), p.variant !== ''), nameOf(p)]},
          {
            name: 'over HBAO+',
            number: true,
            value: (p) => p.ratio,
            text: times,
            help: 'mean over the scenes of the time over that of HBAO+ medium'
          },
          {
            name: 'error',
            number: true,
            value: (p) => p.rmse,
            text: errorFigure,
            help: 'mean over the scenes of the RMSE to the truth'
          },
          {name: 'on the front of', value: (p) => p.fronts.length, cell: (p) => frontsCell(p, each)},
        ],
        front);
    const left = each.left_out ?
        ` ${many(each.left_out, 'setting was', 'settings were')} measured on some of these scenes only and left out.` :
        '';
    return element(
        'div', {class: 'class-front'}, element('h3', {}, classTitle(each.name)),
        element(
            'p', {},
            `${many(total, 'scene')} (${enumerate(each.scenes)}). ${front.length} of ${
                many(each.points.length, 'setting')} on the front${total > 1 ? ' of the means' : ''}. ` +
                techniqueSentence(each) + left),
        table);
  }));
  byId('scene-fronts')
      .replaceChildren(
          element('h3', {}, 'Scene by scene, fastest first'),
          ...data.scenes.filter((scene) => rowsOf(scene.name).length).map((scene) => {
            const chain = scene.front.flatMap(
                (index, i) =>
                    [i ? element('span', {class: 'arrow'}, '→') : null, settingButton(data.rows[index], scene.name)]);
            const what = scene.front_time === 'ms' && scene.front.length ? ' (by ms)' : '';
            return element(
                'div', {class: 'scene-front'}, element('span', {}, scene.name + what),
                element('div', {}, chain.length ? chain : element('span', {class: 'lone'}, 'no truth, so no front')));
          }));
}

function frontsCell(point, each) {
  const total = each.scenes.length, count = point.fronts.length;
  const dots = each.scenes.map((scene) => (point.fronts.includes(scene) ? '●' : '○')).join('');
  const only = total > 1 && count === 1 ? `, ${point.fronts[0]} only` : count === 0 ? ', by its mean alone' : '';
  return [
    total > 1 && total <= 12 ? element('span', {class: 'dots', title: point.fronts.join(', ')}, dots) : null,
    element(
        'span', {class: total > 1 && count * 2 < total ? 'lone' : null}, `${count} of ${many(total, 'scene')}${only}`)
  ];
}

// --- Floors

function renderFloors() {
  const rows = rowsOf(state.scene).filter(isShown).filter((row) => row.own_floor_ms > 0 && row.ms.median > 0);
  const place = byId('floor-chart'), words = byId('floor-words');
  byId('floors').hidden = !data.rows.some((row) => row.own_floor_ms > 0);
  place.hidden = rows.length === 0;
  if (!rows.length) {
    clearChart(place);
    return words.replaceChildren(
        element('p', {class: 'remark'}, `No floor of its own was measured for what is shown on ${state.scene}.`));
  }
  const ratioOf = (row) => (is(row.to_own_floor) ? row.to_own_floor : row.ms.median / row.own_floor_ms);
  const width = place.clientWidth || place.parentElement.clientWidth;
  draw(
      place, floorSpec({
        width,
        rows: rows.map((row) => ({
                         name: nameOf(row),
                         floor: row.own_floor_ms,
                         ms: row.ms.median,
                         words: times(ratioOf(row)),
                         colour: colourOf(techniqueOf(row)),
                         shape: shapeOf(techniqueOf(row)),
                         hover: {
                           title: nameOf(row),
                           lines: [
                             ['time', figure(row.ms.median) + ' ms'], ['floor', figure(row.own_floor_ms) + ' ms'],
                             ['over the floor', times(ratioOf(row))]
                           ]
                         }
                       }))
      }),
      width);
  const far = rows.filter((row) => ratioOf(row) > 1.5).sort((a, b) => ratioOf(b) - ratioOf(a));
  const sentences = far.map(
      (row) => element(
          'li', {}, element('strong', {}, nameOf(row)), ` takes ${figure(ratioOf(row))} times its floor: `,
          spentSentence(row) ? spentSentence(row) + '.' : 'what the rest goes to was not measured.'));
  const first = sentences.slice(0, 12), rest = sentences.slice(12);
  words.replaceChildren(
      element(
          'p', {},
          far.length ? 'More than half above the floor, and what the time is spent on:' :
                       'Everything shown is within 1.5 times its floor.'),
      element('ul', {}, first),
      ...(rest.length ?
              [element('details', {}, element('summary', {}, `and ${rest.length} more`), element('ul', {}, rest))] :
              []));
}

// --- Tables

function rowColumns(allScenes) {
  const number = (name, value, text, help) => ({name, value, text, help, number: true});
  const columns = [
    ...(allScenes ? [{name: 'scene', value: (row) => row.scene}] : []),
    {
      name: 'technique',
      value: (row) => row.technique,
      cell: (row) => [swatch(techniqueOf(row), row.variant !== ''), row.technique]
    },
    {name: 'preset', value: (row) => row.preset || null},
    {name: 'variant', value: (row) => row.variant || null},
    number('ms', (row) => row.ms.median, figure, 'median over the rounds'),
    number(
        'range', (row) => row.ms.max, (value, row) => figure(row.ms.min) + ' to ' + figure(row.ms.max),
        'fastest and slowest round'),
    number('/ HBAO+', (row) => row.ratio, figure, 'time over that of HBAO+ medium'),
    number('/ own floor', (row) => row.to_own_floor, figure, 'time over that of its own gathers alone'),
    number('rmse', (row) => row.rmse, errorFigure, 'to the truth'),
    number('bias', (row) => row.bias, errorFigure, 'mean of image minus truth'),
    number('samples', (row) => row.samples, (value) => (is(value) ? setting(value) : '–'), 'per pixel'),
    number('/ gather floor', (row) => row.to_gather_floor, figure, 'time over that of the gathers of HBAO+ medium'),
    number('/ copy floor', (row) => row.to_copy_floor, figure, 'time over reading and writing one plane'),
    number('/ naive', (row) => row.to_naive, figure, 'the estimate alone over a plain port of HBAO+'),
    number('/ native', (row) => row.to_native, figure, 'the estimate alone over C++ with vectors by hand'),
  ];
  const rows = data.rows;
  return columns.filter(
      (column) => ['technique', 'ms', 'rmse'].includes(column.name) || rows.some((row) => is(column.value(row))));
}

function renderRows() {
  const allScenes = byId('all-scenes').checked;
  const rows = data.rows.filter((row) => (allScenes || row.scene === state.scene) && isShown(row));
  sortedTable(byId('rows-table'), rowColumns(allScenes), rows, {
    isPicked: (row) => row.scene === state.scene && keyOf(row) === state.picked,
    pick: (row) => {
      state.picked = keyOf(row);
      if (row.scene === state.scene && state.mean === null)
        renderPicked();
      else
        goTo(row.scene, null);
    },
  });
}

/// One row per technique and scene, a column for each thing that was varied.
function renderGrowth() {
  const named = (g) => JSON.stringify([g.technique, g.scene]);
  const rows = unique(data.growth.map(named)).map((name) => data.growth.filter((g) => named(g) === name));
  const range = (from, to, unit) => (is(from) && is(to) ? `${figure(from)} to ${figure(to)}${unit}` : '');
  const exponentOf = (row, over) => row.find((g) => g.over === over);
  sortedTable(
      byId('growth-table'),
      [
        {
          name: 'technique',
          value: (row) => row[0].technique,
          cell: (row) => [techniques.includes(row[0].technique) ? swatch(techniqueOf(row[0])) : null, row[0].technique]
        },
        {name: 'scene', value: (row) => row[0].scene || null},
        ...unique(data.growth.map((g) => g.over))
            .map((over) => ({
                   name: over,
                   number: true,
                   value: (row) => (exponentOf(row, over) ? exponentOf(row, over).exponent : null),
                   cell: (row) => {
                     const g = exponentOf(row, over);
                     return g ? element(
                                    'span', {
                                      title: [range(g.x_from, g.x_to, ' ' + over), range(g.ms_from, g.ms_to, ' ms')]
                                                 .filter(Boolean)
                                                 .join(': ')
                                    },
                                    minus(g.exponent.toFixed(2))) :
                                '–';
                   }
                 })),
      ],
      rows);
}

function renderOthers() {
  byId('growth').hidden = !data.growth.length;
  byId('paper').hidden = !data.paper.length;
  byId('skipped').hidden = !data.skipped.length;
  renderGrowth();
  sortedTable(
      byId('paper-table'),
      [
        ...['table', 'row', 'column'].map((name) => ({name, value: (f) => f[name] || null})),
        {name: 'ms', number: true, value: (f) => f.ms, text: figure},
        {name: 'ratio here', number: true, value: (f) => f.ratio, text: figure},
        {name: 'ratio in the paper', number: true, value: (f) => f.paper_ratio, text: figure},
        {name: 'over', value: (f) => f.base || null},
      ],
      data.paper);
  sortedTable(
      byId('skipped-table'),
      [
        {name: 'technique', value: (s) => s.technique || null},
        {name: 'preset', value: (s) => s.preset || null},
        {name: 'scene', value: (s) => s.scene || null},
        {name: 'why', words: true, value: (s) => s.why || null},
      ],
      data.skipped);
}

// --- All together

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
