// The picked point, in figures.

function settingsText(row) {
  return Object.entries(row.settings)
      .map(([name, value]) => `${name}=${typeof value === 'object' ? JSON.stringify(value) : value}`)
      .join(' ');
}

function spentSentence(row) {
  const shares = [...row.spent_on].sort((a, b) => b.share - a.share).map((s) => percent(s.share) + ' ' + s.what);
  return shares.length ? enumerate(shares) : '';
}

/// The relation of a point to the front.
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
    ...(isSubmitted(point) ? submittedFacts(point) : [element('p', {}, standingOf(point))])
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
  showPictures(place, {name: nameOf(row), picture: row.picture, truth: sceneNow().truth_picture, white: sceneNow().white}, state.pictures);
}
