// The charts, as Vega specifications.

const shapes = [
  'M-1,0a1,1,0,1,0,2,0a1,1,0,1,0,-2,0Z',                           // circle
  'M-0.9,-0.9H0.9V0.9H-0.9Z',                                      // square
  'M0,-1.15L1.1,0.8H-1.1Z',                                        // triangle
  'M0,-1.25L1.05,0L0,1.25L-1.05,0Z',                               // diamond
  'M-1.1,-0.4H-0.4V-1.1H0.4V-0.4H1.1V0.4H0.4V1.1H-0.4V0.4H-1.1Z',  // plus
  'M0,1.15L1.1,-0.8H-1.1Z',                                        // triangle, point down
  'M-0.55,-0.95H0.55L1.1,0L0.55,0.95H-0.55L-1.1,0Z',               // hexagon
];

function theme() {
  const style = getComputedStyle(document.documentElement);
  const value = (name) => style.getPropertyValue('--' + name).trim();
  return {
    ink: value('ink'),
    faint: value('faint'),
    rule: value('rule'),
    grid: value('grid'),
    panel: value('panel'),
    paper: value('paper'),
    accent: value('accent'),
    front: value('front'),
    colours: value('colours').split(/\s+/),
    font: getComputedStyle(document.body).fontFamily,
  };
}

/// Eight colours and seven shapes in step: 56 techniques until one looks like another.
const colourOf = (index) => theme().colours[index % theme().colours.length];
const shapeOf = (index) => shapes[index % shapes.length];

/// The mark of a technique, in running text.
function swatch(index, hollow) {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg'), path = document.createElementNS(space, 'path');
  svg.setAttribute('viewBox', '-1.4 -1.4 2.8 2.8');
  svg.setAttribute('class', 'swatch');
  svg.setAttribute('aria-hidden', 'true');
  path.setAttribute('d', shapeOf(index));
  path.setAttribute('fill', hollow ? 'none' : colourOf(index));
  path.setAttribute('stroke', colourOf(index));
  path.setAttribute('stroke-width', '0.3');
  svg.append(path);
  return svg;
}

function configuration(colours) {
  const text = {font: colours.font, fontSize: 11};
  return {
    background: 'transparent',
    axis: {
      labelFont: text.font,
      labelFontSize: 11,
      labelColor: colours.faint,
      titleFont: text.font,
      titleFontSize: 12,
      titleFontWeight: 'normal',
      titleColor: colours.faint,
      domainColor: colours.rule,
      tickColor: colours.rule,
      gridColor: colours.grid,
      labelPadding: 4,
    },
    text: {...text, fill: colours.ink},
  };
}

/// Draws a specification where another may be already.
function draw(place, spec, width) {
  if (place.view) place.view.finalize();
  const view = new vega.View(
      vega.parse({padding: 4, autosize: {type: 'fit', contains: 'padding'}, width, ...spec}, configuration(theme())), {
        renderer: 'svg',
        container: place,
        hover: true,
      });
  view.logLevel(1);
  place.view = view;
  view.tooltip((handler, event, item, value) => showHover(event, value));
  view.runAsync();
  return view;
}

function clearChart(place) {
  if (place.view) place.view.finalize();
  place.view = null;
  place.replaceChildren();
}

/// 0.5, 1, 2, 5, ... within a domain; fewer where there would be no room.
function logTicks([low, high], most) {
  for (const steps of [[1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 3, 5], [1, 2, 5], [1, 3], [1]]) {
    const ticks = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) {
      for (const step of steps) {
        const tick = Number((step * 10 ** power).toPrecision(3));
        if (tick >= low && tick <= high) ticks.push(tick);
      }
    }
    if (ticks.length <= most || steps.length === 1) return ticks;
  }
}

/// Some room around what is shown, on a logarithmic axis.
function logDomain(values) {
  const low = Math.min(...values), high = Math.max(...values), room = Math.max(1.12, (high / low) ** 0.07);
  return [low / room, high * room];
}

function linearDomain(values) {
  const low = Math.min(...values), high = Math.max(...values), room = 0.08 * (high - low) || 0.1 * high || 0.01;
  return [Math.max(0, low - room), high + room];
}

/// Error against time. `points`: {key, x, y, technique (number), label, size, hollow, onFront, hover}; `front`: the points
/// of the front, which may be hidden among `points`.
function scatterSpec({points, front, picked, timeTitle, isRatio, width}) {
  const colours = theme();
  const all = [...points, ...front];
  const x = logDomain(all.map((p) => p.x)), y = linearDomain(all.map((p) => p.y));
  const ordered = [...front].sort((a, b) => a.x - b.x || b.y - a.y);
  const line =
      ordered.length ? [{x: ordered[0].x, y: y[1]}, ...ordered, {x: x[1], y: ordered[ordered.length - 1].y}] : [];
  const at = {x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}};
  return {
    height: Math.round(Math.max(300, Math.min(470, width * 0.62))),
    signals: [{name: 'picked', value: picked}],
    data: [
      {name: 'points', values: points.map((p) => ({...p, colour: colourOf(p.technique), shape: shapeOf(p.technique)}))},
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
      {
        scale: 'y',
        orient: 'left',
        grid: true,
        tickCount: 6,
        title: 'error: RMSE to the truth',
        titleAngle: 0,
        titleAlign: 'left',
        titleAnchor: 'end',
        titleX: 0,
        titleY: -12,
        titleBaseline: 'bottom'
      },
    ],
    marks: [
      {
        type: 'area',
        from: {data: 'line'},
        interactive: false,
        clip: true,
        encode: {
          enter: {
            x: at.x,
            y: at.y,
            y2: {value: 0},
            interpolate: {value: 'step-after'},
            fill: {value: colours.front},
            fillOpacity: {value: 0.035}
          }
        }
      },
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
      {
        type: 'line',
        name: 'front_line',
        from: {data: 'line'},
        interactive: false,
        clip: true,
        encode: {
          enter: {
            ...at,
            interpolate: {value: 'step-after'},
            stroke: {value: colours.front},
            strokeWidth: {value: 1.4},
            strokeOpacity: {value: 0.6}
          }
        }
      },
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

/// Bars beside one another, a line for each total. `bars`: {step, index, value, colour, opacity, hover}; `totals`: {value,
/// colour, opacity, dash, label, picked}.
function ladderSpec({steps, count, bars, totals, width}) {
  const colours = theme(), height = 280, wide = width >= 620;
  const highest = Math.max(1e-9, ...bars.map((b) => b.value || 0), ...totals.map((t) => t.value)) * 1.06;
  // A label that would lie on another is left out, but never what is picked: the table has them all.
  const labelled = [];
  for (const total of [...totals].sort((a, b) => (b.picked || 0) - (a.picked || 0) || b.value - a.value)) {
    const at = height * (1 - total.value / highest);
    if (labelled.every((other) => Math.abs(other.at - at) > 13)) labelled.push({...total, at});
  }
  return {
    height: height + 60,
    data: [
      {name: 'bars', values: bars.filter((b) => is(b.value))},
      {name: 'missing', values: bars.filter((b) => !is(b.value))},
      {name: 'totals', values: totals},
      {name: 'labelled', values: labelled},
    ],
    scales: [
      {
        name: 'step',
        type: 'band',
        domain: steps.map((s) => s.key),
        range: 'width',
        paddingInner: 0.28,
        paddingOuter: 0.14
      },
      {
        name: 'words',
        type: 'ordinal',
        domain: steps.map((s) => s.key),
        range: steps.map((s) => (wide ? s.key + '|' + s.short : s.key))
      },
      {name: 'y', domain: [0, highest], range: 'height', nice: false},
    ],
    axes: [
      {
        scale: 'y',
        orient: 'left',
        grid: true,
        tickCount: 5,
        title: 'RMSE',
        titleAngle: 0,
        titleAlign: 'left',
        titleAnchor: 'end',
        titleX: 0,
        titleY: -10,
        titleBaseline: 'bottom'
      },
      {
        scale: 'step',
        orient: 'bottom',
        ticks: false,
        labelPadding: 8,
        encode:
            {labels: {update: {text: {signal: 'split(scale(\'words\', datum.value), \'|\')'}, lineHeight: {value: 14}}}}
      },
    ],
    marks: [
      {
        type: 'rect',
        name: 'bar_marks',
        from: {data: 'bars'},
        encode: {
          enter: {
            x: {scale: 'step', field: 'step', offset: {signal: `datum.index * bandwidth('step') / ${count}`}},
            width: {signal: `max(1, bandwidth('step') / ${count} - 1.5)`},
            y: {scale: 'y', field: 'value'},
            y2: {scale: 'y', value: 0},
            fill: {field: 'colour'},
            fillOpacity: {field: 'opacity'},
            stroke: {field: 'colour'},
            strokeWidth: {value: 0.8},
            tooltip: {field: 'hover'}
          }
        }
      },
      {
        type: 'text',
        name: 'missing_marks',
        from: {data: 'missing'},
        encode: {
          enter: {
            x: {scale: 'step', field: 'step', offset: {signal: `(datum.index + 0.5) * bandwidth('step') / ${count}`}},
            y: {scale: 'y', value: 0, offset: -4},
            align: {value: 'center'},
            text: {value: '?'},
            fill: {field: 'colour'},
            tooltip: {field: 'hover'}
          }
        }
      },
      {
        type: 'rule',
        name: 'total_rules',
        from: {data: 'totals'},
        encode: {
          enter: {
            x: {value: 0},
            x2: {signal: 'width'},
            y: {scale: 'y', field: 'value'},
            stroke: {field: 'colour'},
            strokeOpacity: {field: 'opacity'},
            strokeWidth: {value: 1.8},
            strokeDash: {field: 'dash'},
            tooltip: {field: 'hover'}
          }
        }
      },
      {
        type: 'text',
        from: {data: 'labelled'},
        interactive: false,
        encode: {
          enter: {
            x: {signal: 'width'},
            y: {scale: 'y', field: 'value', offset: -4},
            align: {value: 'right'},
            text: {field: 'label'},
            fill: {field: 'colour'}
          }
        }
      },
    ],
  };
}

/// Each plan's time beside its floor. `rows`: {name, floor, ms, ratio, colour, shape, hover}
function floorSpec({rows, width}) {
  const colours = theme();
  const domain = logDomain(rows.flatMap((r) => [r.floor, r.ms]));
  domain[1] *= (domain[1] / domain[0]) ** Math.min(0.5, 60 / width);  // for the text behind the last mark
  const y = {scale: 'y', field: 'id', band: 0.5};
  return {
    height: rows.length * 24 + 50,
    data: [{name: 'rows', values: rows.map((row, id) => ({...row, id}))}],
    scales: [
      {name: 'x', type: 'log', domain, range: 'width', nice: false},
      {name: 'y', type: 'band', domain: rows.map((row, id) => id), range: 'height'},
      {name: 'names', type: 'ordinal', domain: rows.map((row, id) => id), range: rows.map((row) => row.name)},
    ],
    axes: [
      {
        scale: 'x',
        orient: 'top',
        grid: true,
        values: logTicks(domain, width / 90),
        format: '~g',
        title: 'ms',
        titleAnchor: 'end'
      },
      {
        scale: 'y',
        orient: 'left',
        ticks: false,
        domain: false,
        labelLimit: width * 0.4,
        labelColor: colours.ink,
        encode: {labels: {update: {text: {signal: 'scale(\'names\', datum.value)'}}}}
      },
    ],
    marks: [
      {
        type: 'rule',
        from: {data: 'rows'},
        encode: {
          enter: {
            x: {scale: 'x', field: 'floor'},
            x2: {scale: 'x', field: 'ms'},
            y,
            stroke: {field: 'colour'},
            strokeWidth: {value: 2},
            strokeOpacity: {value: 0.45},
            tooltip: {field: 'hover'}
          }
        }
      },
      {
        type: 'rect',
        name: 'floors',
        from: {data: 'rows'},
        encode: {
          enter: {
            xc: {scale: 'x', field: 'floor'},
            width: {value: 3},
            yc: y,
            height: {value: 13},
            fill: {value: colours.faint},
            tooltip: {field: 'hover'}
          }
        }
      },
      {
        type: 'symbol',
        name: 'times',
        from: {data: 'rows'},
        encode: {
          enter: {
            x: {scale: 'x', field: 'ms'},
            y,
            size: {value: 85},
            shape: {field: 'shape'},
            fill: {field: 'colour'},
            tooltip: {field: 'hover'}
          }
        }
      },
      {
        type: 'text',
        from: {data: 'rows'},
        interactive: false,
        encode: {
          enter: {
            x: {scale: 'x', field: 'ms', offset: 10},
            y,
            baseline: {value: 'middle'},
            fill: {value: colours.faint},
            text: {field: 'words'}
          }
        }
      },
    ],
  };
}

/// The box beside the pointer. `value`: {title, lines: [[name, text], ...]}; null hides it.
function showHover(event, value) {
  const box = byId('hover');
  box.hidden = !value || !value.title;
  if (box.hidden) return;
  box.replaceChildren(
      element('b', {}, value.title),
      element(
          'table', {},
          value.lines.map(
              ([name, text]) => element('tr', {}, element('td', {}, name), element('td', {class: 'number'}, text)))));
  const {width, height} = box.getBoundingClientRect();
  const left = event.clientX + 16 + width > innerWidth ? event.clientX - 16 - width : event.clientX + 16;
  box.style.left = Math.max(4, Math.min(left, innerWidth - width - 4)) + 'px';
  box.style.top = Math.max(4, Math.min(event.clientY + 14, innerHeight - height - 4)) + 'px';
}
