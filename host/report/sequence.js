// Error and flicker over time, on the frames of a shot.

const sequenceRows = data.sequence ? data.sequence.rows : [];
/// Techniques of single frames first, so that each has one colour on the page.
const techniquesWithSequence = unique([...techniques, ...sequenceRows.map((row) => row.technique)]);
const sequenceTechniqueOf = (row) => techniquesWithSequence.indexOf(row.technique);
const sequenceNameOf = (row) => [row.technique, row.preset, row.temporal && '(temporal)'].filter(Boolean).join(' ');
const sequenceTimeOf = (row) => (sequenceRows.every((each) => is(each.ratio)) ? row.ratio : row.ms.median);

/// Specification of a chart. `points`: {x, y, colour, shape, hollow, hover}; `pairs`: {x, y, x2, y2, colour}; `level`: of a dashed line,
/// or null.
function sequenceSpec({points, pairs, level, titles, width}) {
  const x = logDomain(points.map((point) => point.x));
  const y = linearDomain([...points.map((point) => point.y), ...(is(level) ? [level] : [])]);
  const at = {x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}};
  return {
    height: 300,
    data: [{name: 'points', values: points}, {name: 'pairs', values: pairs}],
    scales: [
      {name: 'x', type: 'log', domain: x, range: 'width', nice: false},
      {name: 'y', type: 'linear', domain: y, range: 'height', zero: false, nice: false},
    ],
    axes: [
      {scale: 'x', orient: 'bottom', grid: true, values: logTicks(x, width / 80), format: '~g', title: titles[0]},
      {scale: 'y', orient: 'left', grid: true, tickCount: 5, title: titles[1]},
    ],
    marks: [
      ...(is(level) ? [{
        type: 'rule',
        interactive: false,
        encode: {
          enter: {
            x: {value: 0},
            x2: {signal: 'width'},
            y: {scale: 'y', value: level},
            stroke: {value: theme().faint},
            strokeDash: {value: [2, 4]}
          }
        }
      }] :
                      []),
      mark('rule', 'pairs', {interactive: false}, {
        ...at,
        x2: {scale: 'x', field: 'x2'},
        y2: {scale: 'y', field: 'y2'},
        stroke: {field: 'colour'},
        strokeOpacity: {value: 0.45}
      }),
      {
        type: 'symbol',
        name: 'point_marks',
        from: {data: 'points'},
        encode: {
          enter: {
            ...at,
            size: {value: 70},
            shape: {field: 'shape'},
            stroke: {field: 'colour'},
            strokeWidth: {value: 1.5},
            fill: {field: 'colour'},
            tooltip: {field: 'hover'}
          },
          update: {fillOpacity: {signal: 'datum.hollow ? 0.08 : 0.9'}},
          hover: {fillOpacity: {value: 1}}
        }
      },
    ],
  };
}

function sequenceHover(row) {
  return {
    title: sequenceNameOf(row),
    lines: [
      ['error, RMSE', errorFigure(row.rmse)], ['flicker', errorFigure(row.flicker)],
      ['time of a frame', figure(row.ms.median) + ' ms'], ['over HBAO+', times(row.ratio)]
    ]
  };
}

function drawSequence(place, valueOf, title, level) {
  const shown = sequenceRows.filter((row) => is(valueOf(row)) && sequenceTimeOf(row) > 0);
  place.hidden = !shown.length;
  if (place.hidden) return clearChart(place);
  const points = shown.map((row) => ({
                             x: sequenceTimeOf(row),
                             y: valueOf(row),
                             colour: colourOf(sequenceTechniqueOf(row)),
                             shape: shapeOf(sequenceTechniqueOf(row)),
                             hollow: !row.temporal,
                             hover: sequenceHover(row)
                           }));
  const pairs = shown.flatMap((row, index) => {
    const other =
        shown.findIndex((each) => each.temporal && each.technique === row.technique && each.preset === row.preset);
    if (row.temporal || other < 0) return [];
    const {x, y, colour} = points[index];
    return [{x, y, colour, x2: points[other].x, y2: points[other].y}];
  });
  const width = place.clientWidth || place.parentElement.clientWidth;
  const time = sequenceRows.every((row) => is(row.ratio)) ? 'time of a frame, over HBAO+ medium' : 'ms of a frame';
  draw(place, sequenceSpec({points, pairs, level, titles: [time, title], width}), width);
}

function renderSequence() {
  byId('sequence').hidden = !data.sequence;
  if (!data.sequence) return;
  const {shot, frames, width, height, truth_change: change} = data.sequence;
  byId('sequence-shot').textContent =
      `${shot}, ${many(frames, 'frame')}` + (is(width) && is(height) ? ` of ${width}\u00d7${height}` : '');
  drawSequence(byId('sequence-error'), (row) => row.rmse, 'error, mean RMSE', null);
  drawSequence(byId('sequence-flicker'), (row) => row.flicker, 'flicker', change);
  const number = (name, value, text, help) => ({name, value, text, help, number: true});
  sortedTable(
      byId('sequence-table'),
      [
        {
          name: 'technique',
          value: (row) => row.technique,
          cell: (row) => [swatch(sequenceTechniqueOf(row), !row.temporal), row.technique]
        },
        {name: 'preset', value: (row) => row.preset || null},
        {name: 'over time', value: (row) => (row.temporal ? 'temporal' : null)},
        number('ms', (row) => row.ms.median, figure, 'kernels of one frame, median over the frames'),
        number('/ HBAO+', (row) => row.ratio, figure, 'time over that of HBAO+ medium on the same frame'),
        number('rmse', (row) => row.rmse, errorFigure, 'to the truth, mean over the frames'),
        number('worst', (row) => row.worst_rmse, errorFigure, 'of the frame with the largest RMSE'),
        number('worst frame', (row) => row.worst_frame, (value) => (is(value) ? String(value) : '–')),
        number('SSIM', (row) => row.ssim, figure, 'mean over the frames'),
        number(
            'flicker', (row) => row.flicker, errorFigure,
            'RMSE of the change from frame to frame, to that of the truth'),
      ],
      sequenceRows);
}
