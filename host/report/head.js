// The head of the page, and the buttons of the scenes.

/// What the technique of a row, or of a mean, reads of a frame; null where nothing is known of it.
const readsOf = (row) => isSubmitted(row) ? null : data.rows.find((each) => each.technique === row.technique).reads;

/// Of plain settings and submitted methods; of all where there are no others.
function renderVerdict() {
  const all = state.mean !== null ? classNow().points : rowsOf(state.scene), plain = all.filter((row) => !row.variant);
  const points = (plain.length ? plain : all).map((row) => ({
    name: isSubmitted(row) ? `${nameOf(row)} (submitted)` : nameOf(row), error: row.rmse, ratio: row.ratio,
    ms: isSubmitted(row) || !row.ms ? null : row.ms.median, reads: readsOf(row)
  }));
  byId('verdict').textContent =
      verdict(points, state.mean !== null ? `in the mean of ${enumerate(classNow().scenes)}` : `on ${state.scene}`);
}

function renderHead() {
  const settings = unique(data.rows.map(keyOf)).length,
        used = unique(data.scenes.filter((scene) => rowsOf(scene.name).length).map((scene) => scene.title)).length;
  const on = data.rows.length ?
      `${many(settings, 'setting')} of ${many(techniques.length, 'technique')} on ${many(used, 'scene')}` :
      `${many(sequenceRows.length, 'setting')} of ${many(techniquesWithSequence.length, 'technique')} on a shot`;
  byId('lead').textContent = on + ': ' +
      'how far each image is from a ray-traced truth, and what it took to compute.';
  const facts = [
    ['CPU', data.cpu], ['Cores', data.cores], ['Device', data.device], ['Driver', data.driver], ['Measured', data.date],
    ['Commit', data.commit], ['Rounds', data.rounds], ['Rays per pixel of the truth', data.rays]
  ];
  byId('facts').replaceChildren(
      ...facts.filter(([, value]) => is(value) && value !== '')
          .map(([name, value]) => element('div', {}, element('dt', {}, name), element('dd', {}, String(value)))));
}

/// To another effect on the same scene, or on its first one.
function effectButton(effect, shown) {
  const there = scenesOf(effect).filter((scene) => rowsOf(scene.name).length);
  const same = there.find((scene) => scene.title === sceneNow().title) || there[0];
  return pressButton(
      effectTitle(effect), effect === shown, () => same && goTo(same.name, null), {class: 'effect', disabled: !same});
}

function renderScenes() {
  const parts = [], effect = effectNow();
  if (effects.length > 1) parts.push(...effects.map((each) => effectButton(each, effect)));
  for (const name of unique(scenesOf(effect).map((scene) => scene.class))) {
    const scenes = scenesOf(effect).filter((scene) => scene.class === name && rowsOf(scene.name).length);
    const means = data.classes.find((each) => each.name === name);
    if (name && scenes.length) parts.push(element('span', {class: 'class-name'}, name));
    for (const scene of scenes)
      parts.push(
          pressButton(scene.title, state.mean === null && scene.name === state.scene, () => goTo(scene.name, null)));
    if (means && means.scenes.length > 1)
      parts.push(pressButton('mean of ' + means.scenes.length, state.mean === name, () => goTo(state.scene, name)));
  }
  for (const place of document.querySelectorAll('h2 .scene-name:not([id])')) place.textContent = 'on ' + state.scene;
  const bar = byId('scenes'), at = bar.scrollLeft;
  bar.replaceChildren(...parts);
  bar.scrollLeft = at;
}
