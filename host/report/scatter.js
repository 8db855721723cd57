// Error against time: the chart. Its legend and filters: choice.js.

/// Specification of the chart. `points`: {key, x, y, technique (number), label, size, hollow, onFront, hover}; `front`: points of
/// the front, which may be hidden among `points`; `levels`: {y, colour, label, key, hover} of submitted rows without a time here.
function scatterSpec({points, front, levels, base, picked, timeTitle, isRatio, width}) {
  const colours = theme();
  const all = [...points, ...front];
  // What there is without a technique is drawn where it does not squeeze the points together.
  const errors = [...all, ...levels].map((p) => p.y), bases = is(base) && base <= 2 * Math.max(...errors) ? [base] : [];
  const x = all.length ? logDomain(all.map((p) => p.x)) : [0.1, 10], y = linearDomain([...errors, ...bases]);
  const ordered = [...front].sort((a, b) => a.x - b.x || b.y - a.y);
  const line =
      ordered.length ? [{x: ordered[0].x, y: y[1]}, ...ordered, {x: x[1], y: ordered[ordered.length - 1].y}] : [];
  const at = {x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}};
  return {
    height: Math.round(Math.max(300, Math.min(470, width * 0.62))),
    signals: [{name: 'picked', value: picked}],
    data: [
      {name: 'points', values: points.map((p) => ({...p, colour: colourOf(p.technique), shape: shapeOf(p.technique)}))},
      {name: 'base', values: bases.map((value) => ({y: value}))},
      {name: 'levels', values: levels},
      {name: 'line', values: line.map((p) => ({x: p.x, y: p.y}))},
      {name: 'on_front', source: 'points', transform: [{type: 'filter', expr: 'datum.onFront'}]},
      {name: 'picked_point', source: 'points', transform: [{type: 'filter', expr: 'datum.key === picked'}]},
    ],
    scales: [
      {name: 'x', type: 'log', domain: x, range: 'width', nice: false},
      {name: 'y', domain: y, range: 'height', nice: false, zero: false},
    ],
    axes: [
      {
        scale: 'x',
        orient: 'bottom',
        grid: true,
        values: logTicks(x, width / 55),
        format: '~g',
        title: timeTitle,
        titlePadding: 8
      },
      {scale: 'y', orient: 'left', grid: true, tickCount: 6, ...titleAbove('error: RMSE to the truth', 12)},
    ],
    marks: [
      mark('area', 'line', {interactive: false, clip: true}, {
        x: at.x,
        y: at.y,
        y2: {value: 0},
        interpolate: {value: 'step-after'},
        fill: {value: colours.front},
        fillOpacity: {value: 0.035}
      }),
      ...(isRatio ? [{
        type: 'rule',
        interactive: false,
        clip: true,
        encode: {
          enter: {
            x: {scale: 'x', value: 1},
            y: {value: 0},
            y2: {signal: 'height'},
            stroke: {value: colours.faint},
            strokeDash: {value: [2, 4]},
            opacity: {value: x[0] < 1 && x[1] > 1 ? 0.8 : 0}
          }
        }
      }] :
                    []),
      mark(
          'rule', 'base', {name: 'base_line', interactive: false},
          {x: {value: 0}, x2: {signal: 'width'}, y: at.y, stroke: {value: colours.faint}, strokeDash: {value: [1, 3]}}),
      mark('rule', 'levels', {name: 'level_rules'}, {
        x: {value: 0},
        x2: {signal: 'width'},
        y: at.y,
        stroke: {field: 'colour'},
        strokeWidth: {value: 1.4},
        strokeDash: {value: [7, 4]},
        tooltip: {field: 'hover'}
      }),
      mark('symbol', 'levels', {name: 'level_stars'}, {
        x: {signal: 'width - 8'},
        y: at.y,
        size: {value: 110},
        shape: {value: star},
        fill: {field: 'colour'},
        tooltip: {field: 'hover'}
      }),
      mark('text', 'levels', {interactive: false}, {
        x: {signal: 'width - 18'},
        y: {scale: 'y', field: 'y', offset: -5},
        align: {value: 'right'},
        text: {field: 'label'},
        fill: {field: 'colour'}
      }),
      mark('line', 'line', {name: 'front_line', interactive: false, clip: true}, {
        ...at,
        interpolate: {value: 'step-after'},
        stroke: {value: colours.front},
        strokeWidth: {value: 1.4},
        strokeOpacity: {value: 0.6}
      }),
      {
        type: 'symbol',
        name: 'halo',
        from: {data: 'picked_point'},
        interactive: false,
        encode: {
          update: {
            ...at,
            size: {signal: 'datum.size * 3.2 + 160'},
            fill: {value: colours.accent},
            fillOpacity: {value: 0.16},
            stroke: {value: colours.accent},
            strokeWidth: {value: 1.6}
          }
        }
      },
      {
        type: 'symbol',
        name: 'point_marks',
        from: {data: 'points'},
        encode: {
          enter: {
            ...at,
            size: {field: 'size'},
            shape: {field: 'shape'},
            stroke: {field: 'colour'},
            tooltip: {field: 'hover'}
          },
          update: {
            fill: {field: 'colour'},
            fillOpacity: {signal: 'datum.hollow ? 0.08 : datum.onFront ? 0.95 : 0.42'},
            strokeOpacity: {signal: 'datum.onFront ? 1 : 0.7'},
            strokeWidth: {signal: 'datum.onFront ? 2 : 1.3'}
          },
          hover: {fillOpacity: {value: 1}, strokeOpacity: {value: 1}}
        }
      },
      {
        type: 'symbol',
        name: 'front_points',
        from: {data: 'on_front'},
        interactive: false,
        encode: {enter: {...at, size: {field: 'size'}, fill: {value: 'transparent'}, tooltip: {value: null}}}
      },
      {
        type: 'text',
        from: {data: 'front_points'},
        interactive: false,
        encode: {
          enter: {text: {field: 'datum.label'}, fontSize: {value: width < 500 ? 10 : 11}, fill: {value: colours.ink}}
        },
        transform: [{
          type: 'label',
          anchor: ['top-right', 'right', 'top', 'bottom-left', 'left', 'bottom', 'top-left', 'bottom-right'],
          offset: [4],
          avoidMarks: ['point_marks'],
          size: {signal: '[width, height]'}
        }]
      },
    ],
  };
}

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

/// The nearest point within 24 pixels: fingers are wider than points.
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
