// Error against time: the chart, of whatever the page puts into it.

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
