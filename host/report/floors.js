// The time of each plan beside its floor.

/// Specification of the chart. `rows`: {name, floor, ms, ratio, colour, shape, hover}
function floorSpec({rows, width}) {
  const colours = theme();
  const domain = logDomain(rows.flatMap((r) => [r.floor, r.ms]));
  domain[1] *= (domain[1] / domain[0]) ** Math.min(0.5, 60 / width);  // room for the text behind the last mark
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
      mark('rule', 'rows', {}, {
        x: {scale: 'x', field: 'floor'},
        x2: {scale: 'x', field: 'ms'},
        y,
        stroke: {field: 'colour'},
        strokeWidth: {value: 2},
        strokeOpacity: {value: 0.45},
        tooltip: {field: 'hover'}
      }),
      mark('rect', 'rows', {name: 'floors'}, {
        xc: {scale: 'x', field: 'floor'},
        width: {value: 3},
        yc: y,
        height: {value: 13},
        fill: {value: colours.faint},
        tooltip: {field: 'hover'}
      }),
      mark('symbol', 'rows', {name: 'times'}, {
        x: {scale: 'x', field: 'ms'},
        y,
        size: {value: 85},
        shape: {field: 'shape'},
        fill: {field: 'colour'},
        tooltip: {field: 'hover'}
      }),
      mark('text', 'rows', {interactive: false}, {
        x: {scale: 'x', field: 'ms', offset: 10},
        y,
        baseline: {value: 'middle'},
        fill: {value: colours.faint},
        text: {field: 'words'}
      }),
    ],
  };
}

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
