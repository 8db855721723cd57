// Error against time: the chart. Its legend and filters: choice.js.

function hoverOf(row) {
  const lines = [['error, RMSE', errorFigure(row.rmse)]];
  if (is(row.ratio)) lines.push(['over HBAO+', times(row.ratio)]);
  if (isSubmitted(row)) lines.push(...submittedLines(row));
  if (row.ms && is(row.ms.median))
    lines.push(
        ['time', figure(row.ms.median) + ' ms'],
        ['fastest, slowest', figure(row.ms.min) + ' to ' + figure(row.ms.max)]);
  if (is(row.bias)) lines.push(['bias', errorFigure(row.bias)]);
  if (is(row.ssim)) lines.push(['SSIM', row.ssim.toFixed(3)]);
  if (is(row.flip)) lines.push(['FLIP', row.flip.toFixed(3)]);
  if (is(row.flicker)) lines.push(['flicker', errorFigure(row.flicker)]);
  if (is(row.inconsistency)) lines.push(['between the eyes', errorFigure(row.inconsistency)]);
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
        shown = points.filter(isShown), levels = submittedLevels();
  byId('scatter-remark').textContent = remarkOn(points, shown, front);
  renderLegend([...shown, ...levels]);
  renderTimeSwitch();
  place.hidden = shown.length + levels.length === 0;
  if (place.hidden) return clearChart(place);
  const width = place.clientWidth || place.parentElement.clientWidth;
  const view = draw(
      place, scatterSpec({
        points: shown.map((row) => pointOf(row, front)),
        front: front.map((row) => ({x: timeOf(row), y: row.rmse})),
        levels: levels.map((row) => ({
                             key: keyOf(row),
                             y: row.rmse,
                             colour: colourOf(techniqueOf(row)),
                             label: row.technique,
                             hover: hoverOf(row)
                           })),
        base: state.mean === null ? sceneNow().base.rmse : null,
        picked: state.picked,
        width,
        isRatio: timeShown() === 'ratio',
        timeTitle: !shown.length    ? 'no time was measured here' :
            timeShown() === 'ratio' ? 'time over that of HBAO+ medium, in the same round' :
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
    if (is(scene.base.rmse))
      about.push(`Without a technique (${scene.base.name}, dotted) the error is ${errorFigure(scene.base.rmse)}.`);
    const levels = submittedLevels();
    if (levels.length)
      about.push(`Dashed lines are submitted methods, by their errors alone: ${
          timeShown() === 'ratio' ? 'their times are not ratios to HBAO+.' : 'no time is stated.'}`);
    if (timeShown() === 'ms' && points.some(isSubmitted))
      about.push('Times of submitted methods are as their authors state them, on devices of their own.');
    if (!points.length && !levels.length)
      about.push('There is no truth for this scene, so no error to draw; its times are below.');
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
