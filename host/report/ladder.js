// The ladder: from the truth to what is shipped, step by step.

/// Specification: bars beside one another, a line for each total. `bars`: {step, index, value, colour, opacity, hover}; `totals`:
/// {value, colour, opacity, dash, label, picked}.
function ladderSpec({steps, count, bars, totals, width}) {
  const colours = theme(), height = 280, wide = width >= 620;
  const highest = Math.max(1e-9, ...bars.map((b) => b.value || 0), ...totals.map((t) => t.value)) * 1.06;
  // Leaves out labels that would overlap, except that of the picked setting: the table has them all.
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
      {scale: 'y', orient: 'left', grid: true, tickCount: 5, ...titleAbove('RMSE', 10)},
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
      mark('rect', 'bars', {name: 'bar_marks'}, {
        x: {scale: 'step', field: 'step', offset: {signal: `datum.index * bandwidth('step') / ${count}`}},
        width: {signal: `max(1, bandwidth('step') / ${count} - 1.5)`},
        y: {scale: 'y', field: 'value'},
        y2: {scale: 'y', value: 0},
        fill: {field: 'colour'},
        fillOpacity: {field: 'opacity'},
        stroke: {field: 'colour'},
        strokeWidth: {value: 0.8},
        tooltip: {field: 'hover'}
      }),
      mark('text', 'missing', {name: 'missing_marks'}, {
        x: {scale: 'step', field: 'step', offset: {signal: `(datum.index + 0.5) * bandwidth('step') / ${count}`}},
        y: {scale: 'y', value: 0, offset: -4},
        align: {value: 'center'},
        text: {value: '?'},
        fill: {field: 'colour'},
        tooltip: {field: 'hover'}
      }),
      mark('rule', 'totals', {name: 'total_rules'}, {
        x: {value: 0},
        x2: {signal: 'width'},
        y: {scale: 'y', field: 'value'},
        stroke: {field: 'colour'},
        strokeOpacity: {field: 'opacity'},
        strokeWidth: {value: 1.8},
        strokeDash: {field: 'dash'},
        tooltip: {field: 'hover'}
      }),
      mark('text', 'labelled', {interactive: false}, {
        x: {signal: 'width'},
        y: {scale: 'y', field: 'value', offset: -4},
        align: {value: 'right'},
        text: {field: 'label'},
        fill: {field: 'colour'}
      }),
    ],
  };
}

/// The picked setting and the chosen ones, in the order of choosing, with the style of each.
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
  const rows = compared(), scene = state.scene, steps = stepsNow();
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
  const place = byId('ladder-chart'), any = rows.some(({row}) => steps.some((step) => is(row.ladder[step.key])));
  place.hidden = !any;
  if (!any) {
    clearChart(place);
    return byId('ladder-table')
        .replaceChildren(element(
            'p', {class: 'remark'},
            `On ${
                scene} no step of the ladder is at hand for what is picked; gloam bench --ladder presets measures it.`));
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
  const base = baseRow(sceneNow());
  if (base)
    totals.push({
      value: base.rmse,
      colour: theme().faint,
      opacity: 0.9,
      dash: [1, 3],
      label: `${base.technique}, no technique ${errorFigure(base.rmse)}`,
      hover: {title: base.technique + ', no technique', lines: [['to the truth', errorFigure(base.rmse)]]}
    });
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
      base ? [...rows, {row: base}] : rows);
}

const atHand = (value) => (is(value) ? errorFigure(value) : 'not at hand');
