// Fronts in words: by class of scenes, and scene by scene.

function settingButton(row, scene) {
  return element(
      'button', {
        type: 'button',
        onclick: () => {
          state.picked = keyOf(row);
          if (row.variant) state.hidden.variant.delete(row.variant);
          renderFilters();
          goTo(scene, null);
        }
      },
      swatch(techniqueOf(row), row.variant !== ''), nameOf(row));
}

/// Per technique, the number of the class's scenes that have one of its settings on the front.
function techniqueSentence(each) {
  const parts = techniques
                    .map((name) => {
                      const scenes = unique(
                          each.points.filter((point) => point.technique === name).flatMap((point) => point.fronts));
                      return {name, scenes};
                    })
                    .filter(({scenes}) => scenes.length)
                    .sort((a, b) => b.scenes.length - a.scenes.length);
  const total = each.scenes.length;
  if (total === 1) return `They are of ${enumerate(parts.map(({name}) => name))}.`;
  const words = parts.map(
      ({name, scenes}) =>
          `${name} in ${scenes.length} of ${total}` + (scenes.length === 1 ? ` (${scenes[0]} only)` : ''));
  return `On the scenes' own fronts: ${words.join(', ')}.`;
}

function renderFronts() {
  byId('class-fronts').replaceChildren(...classesOf(effectNow()).map((each) => {
    const front = each.points.filter((point) => point.on_front), table = element('div'), total = each.scenes.length;
    sortedTable(
        table,
        [
          {name: 'setting', value: nameOf, cell: (p) => [swatch(techniqueOf(p), p.variant !== ''), nameOf(p)]},
          {
            name: 'over HBAO+',
            number: true,
            value: (p) => p.ratio,
            text: times,
            help: 'mean over the scenes of the time over that of HBAO+ medium'
          },
          {
            name: 'error',
            number: true,
            value: (p) => p.rmse,
            text: errorFigure,
            help: 'mean over the scenes of the RMSE to the truth'
          },
          {name: 'on the front of', value: (p) => p.fronts.length, cell: (p) => frontsCell(p, each)},
        ],
        front);
    const left = each.left_out ?
        ` ${many(each.left_out, 'setting was', 'settings were')} measured on some of these scenes only and left out.` :
        '';
    return element(
        'div', {class: 'class-front'}, element('h3', {}, classTitle(each.name)),
        element(
            'p', {},
            `${many(total, 'scene')} (${enumerate(each.scenes)}). ${front.length} of ${
                many(each.points.length, 'setting')} on the front${total > 1 ? ' of the means' : ''}. ` +
                techniqueSentence(each) + left),
        table);
  }));
  byId('scene-fronts')
      .replaceChildren(
          element('h3', {}, 'Scene by scene, fastest first'),
          ...scenesOf(effectNow()).filter((scene) => rowsOf(scene.name).length).map((scene) => {
            const chain = scene.front.flatMap(
                (index, i) =>
                    [i ? element('span', {class: 'arrow'}, '→') : null, settingButton(data.rows[index], scene.name)]);
            const what = scene.front_time === 'ms' && scene.front.length ? ' (by ms)' : '';
            return element(
                'div', {class: 'scene-front'}, element('span', {}, scene.name + what),
                element('div', {}, chain.length ? chain : element('span', {class: 'lone'}, 'no truth, so no front')));
          }));
}

function frontsCell(point, each) {
  const total = each.scenes.length, count = point.fronts.length;
  const dots = each.scenes.map((scene) => (point.fronts.includes(scene) ? '●' : '○')).join('');
  const only = total > 1 && count === 1 ? `, ${point.fronts[0]} only` : count === 0 ? ', by its mean alone' : '';
  return [
    total > 1 && total <= 12 ? element('span', {class: 'dots', title: point.fronts.join(', ')}, dots) : null,
    element(
        'span', {class: total > 1 && count * 2 < total ? 'lone' : null}, `${count} of ${many(total, 'scene')}${only}`)
  ];
}
