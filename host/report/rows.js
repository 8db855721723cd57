// All measurements as tables.

function rowColumns(allScenes) {
  const number = (name, value, text, help) => ({name, value, text, help, number: true});
  const columns = [
    ...(allScenes ? [{name: 'scene', value: (row) => row.scene}] : []),
    {
      name: 'technique',
      value: (row) => row.technique,
      cell: (row) => [
        row.isBase ? null : swatch(techniqueOf(row), row.variant !== ''), row.technique,
        isSubmitted(row) ? element('span', {class: 'badge'}, 'submitted') : null
      ]
    },
    {name: 'preset', value: (row) => row.preset || null},
    {name: 'variant', value: (row) => row.variant || null},
    number('ms', (row) => row.ms.median, figure, 'median over the rounds'),
    number(
        'range', (row) => row.ms.max,
        (value, row) => (is(value) ? figure(row.ms.min) + ' to ' + figure(row.ms.max) : '–'),
        'fastest and slowest round'),
    number('/ HBAO+', (row) => row.ratio, figure, 'time over that of HBAO+ medium'),
    number('/ own floor', (row) => row.to_own_floor, figure, 'time over that of its own gathers alone'),
    number('rmse', (row) => row.rmse, errorFigure, 'to the truth'),
    number('bias', (row) => row.bias, errorFigure, 'mean of image minus truth'),
    number('SSIM', (row) => row.ssim, (value) => (is(value) ? value.toFixed(3) : '–'), 'structural similarity to the truth; 1: equal'),
    number('FLIP', (row) => row.flip, (value) => (is(value) ? value.toFixed(3) : '–'), 'how visible the difference is; 0: equal'),
    number('flicker', (row) => row.flicker, errorFigure, 'how the error changes from frame to frame'),
    number('eyes', (row) => row.inconsistency, errorFigure, 'mean difference of the two views where both see a surface'),
    number(
        'rmse at fit', (row) => (isSubmitted(row) ? row.submitted.fit_rmse : null), errorFigure,
        'of a submitted method, at its best exponent and strength'),
    number(
        'stated ms', (row) => (isSubmitted(row) ? row.submitted.stated_ms : null), figure,
        'of a submitted method, as its authors state it'),
    number(
        'whole / gloam run', (row) => (isSubmitted(row) ? row.submitted.whole_ratio : null), figure,
        'of a submitted command: its whole time over that of gloam run, in turn'),
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
  const scenes = allScenes ? scenesOf(effectNow()) : [sceneNow()];
  const rows = scenes.flatMap((scene) => [...rowsOf(scene.name).filter(isShown), baseRow(scene)]).filter(Boolean);
  sortedTable(byId('rows-table'), rowColumns(allScenes), rows, {
    isPicked: (row) => row.scene === state.scene && keyOf(row) === state.picked,
    pick: (row) => {
      if (row.isBase) return;
      state.picked = keyOf(row);
      if (row.scene === state.scene && state.mean === null)
        renderPicked();
      else
        goTo(row.scene, null);
    },
  });
}

/// One row per technique and scene, one column per varied quantity.
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
