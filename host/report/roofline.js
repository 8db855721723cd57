// The roofline: what the passes of the compared settings compute, beside what the device can do at most.

/// The passes of the compared rows that were counted, with what they reached.
function rooflinePoints(peaks) {
  return compared().flatMap(({row, colour, opacity}) => {
    const pixels = row.width * row.height;
    return row.passes.filter((pass) => pass.per_pixel && pass.ms.median > 0 && pixels > 0).map((pass) => {
      const count = pass.per_pixel, bytes = count.bytes_loaded + count.bytes_stored;
      const perSecond = (perPixel) => perPixel * pixels / pass.ms.median * 1e-6;  // 10^9
      const point = {
        name: `${nameOf(row)}: ${pass.name}`,
        intensity: count.operations / bytes,
        gflops: perSecond(count.operations),
        gathers: perSecond(count.loads),
        gigabytes: perSecond(bytes),
        ms: pass.ms.median,
        count,
        bound: pass.bound,
        bytes,
        colour,
        opacity,
        shape: shapeOf(techniqueOf(row))
      };
      point.shares = sharesOf(point, peaks);
      return point;
    });
  });
}

/// Shares of the roofs, 0 to 1; null where a roof was not measured.
function sharesOf({gflops, gathers, gigabytes}, {fma_gflops: fma, gather_g_per_s: gather, copy_gb_per_s: copy}) {
  const share = (reached, peak) => (peak > 0 ? reached / peak : null);
  return {fma: share(gflops, fma), gather: share(gathers, gather), copy: share(gigabytes, copy)};
}

const shareText = (share) => (is(share) ? percent(share) : '–');

/// "reads, 71 %"
const boundText = ({bound}) => (bound ? `${bound.by}, ${percent(bound.share)}` : '–');

function rooflineHover(point) {
  const {count, shares} = point;
  return {
    title: point.name,
    lines: [
      ['operations per pixel', figure(count.operations)],
      ['bytes per pixel', `${figure(count.bytes_loaded)} in, ${figure(count.bytes_stored)} out`],
      ['operations per byte', figure(point.intensity)], ['time', figure(point.ms) + ' ms'],
      ['reached', figure(point.gflops) + ' Gflop/s'], ['of multiply-add', shareText(shares.fma)],
      ['of gather', shareText(shares.gather)], ['of copy', shareText(shares.copy)], ['bound by', boundText(point)]
    ]
  };
}

/// Lines of the roofs over a domain of intensities: {name, x, x2, y, y2}. A value read is four bytes.
function roofs({fma_gflops: fma, gather_g_per_s: gather, copy_gb_per_s: copy}, [low, high]) {
  const slanted = (name, bytesPerSecond) => {
    const end = fma > 0 ? Math.min(high, fma / bytesPerSecond) : high;
    return end > low ? {name, x: low, x2: end, y: low * bytesPerSecond, y2: end * bytesPerSecond} : null;
  };
  return [
    fma > 0 ? {name: `multiply-add: ${figure(fma)} Gflop/s`, x: low, x2: high, y: fma, y2: fma, flat: true} : null,
    gather > 0 ? slanted(`gather: ${figure(4 * gather)} GB/s`, 4 * gather) : null,
    copy > 0 ? slanted(`copy: ${figure(copy)} GB/s`, copy) : null
  ].filter(Boolean);
}

function rooflineSpec({points, peaks, width}) {
  const colours = theme();
  const x = logDomain([0.25, ...points.map((p) => p.intensity), 16]), lines = roofs(peaks, x);
  const y = logDomain([...points.map((p) => p.gflops), ...lines.flatMap((line) => [line.y2])]);
  const at = {x: {scale: 'x', field: 'intensity'}, y: {scale: 'y', field: 'gflops'}};
  return {
    height: Math.round(Math.max(280, Math.min(420, width * 0.5))),
    data: [
      {name: 'points', values: points.map((p) => ({...p, hover: rooflineHover(p)}))},
      {name: 'roofs', values: lines.map((line) => ({...line, y: Math.max(line.y, y[0]), x: line.flat ? line.x : Math.max(line.x, line.x * y[0] / line.y)}))},
    ],
    scales: [
      {name: 'x', type: 'log', domain: x, range: 'width', nice: false},
      {name: 'y', type: 'log', domain: y, range: 'height', nice: false},
    ],
    axes: [
      {scale: 'x', orient: 'bottom', grid: true, values: logTicks(x, width / 70), format: '~g', title: 'operations per byte', titlePadding: 8},
      {
        scale: 'y',
        orient: 'left',
        grid: true,
        values: logTicks(y, 8),
        format: '~g',
        ...titleAbove('Gflop/s', 12)
      },
    ],
    marks: [
      mark('rule', 'roofs', {name: 'roof_lines', interactive: false}, {
        x: {scale: 'x', field: 'x'},
        x2: {scale: 'x', field: 'x2'},
        y: {scale: 'y', field: 'y'},
        y2: {scale: 'y', field: 'y2'},
        stroke: {value: colours.front},
        strokeWidth: {value: 1.4},
        strokeOpacity: {value: 0.6}
      }),
      mark('text', 'roofs', {interactive: false}, {
        x: {scale: 'x', field: 'x2', offset: {signal: 'datum.flat ? -6 : -34'}},
        y: {scale: 'y', field: 'y2', offset: {signal: 'datum.flat ? -7 : 16'}},
        align: {value: 'right'},
        fill: {value: colours.faint},
        text: {field: 'name'}
      }),
      mark('symbol', 'points', {name: 'passes'}, {
        ...at,
        size: {value: 110},
        shape: {field: 'shape'},
        fill: {field: 'colour'},
        fillOpacity: {field: 'opacity'},
        stroke: {field: 'colour'},
        tooltip: {field: 'hover'}
      }),
    ],
  };
}

function renderRoofline() {
  const peaks = sceneNow().peaks, place = byId('roofline-chart'), table = byId('roofline-table');
  byId('roofline').hidden = !data.scenes.some((scene) => scene.peaks);
  if (byId('roofline').hidden) return;
  const points = peaks ? rooflinePoints(peaks) : [];
  const uncounted = compared().filter(({row}) => !row.passes.some((pass) => pass.per_pixel)).map(({row}) => nameOf(row));
  byId('roofline-remark').textContent = !peaks ? `No peaks were measured on ${state.scene}.` :
      uncounted.length                         ? `Not counted: ${enumerate(uncounted)}.` :
                                                 '';
  place.hidden = table.hidden = !points.length;
  if (!points.length) return clearChart(place);
  const width = place.clientWidth || place.parentElement.clientWidth;
  draw(place, rooflineSpec({points, peaks, width}), width);
  const number = (name, value, text, help) => ({name, value, text, help, number: true});
  sortedTable(
      table,
      [
        {name: 'pass', value: (p) => p.name}, number('ms', (p) => p.ms, figure),
        number('operations', (p) => p.count.operations, figure, 'on floats, per pixel'),
        number('bytes', (p) => p.bytes, figure, 'read and written, per pixel'),
        number('Gflop/s', (p) => p.gflops, figure), number('G values/s', (p) => p.gathers, figure, 'read from planes'),
        number('GB/s', (p) => p.gigabytes, figure, 'read and written'),
        number('of multiply-add', (p) => p.shares.fma, shareText), number('of gather', (p) => p.shares.gather, shareText),
        number('of copy', (p) => p.shares.copy, shareText, 'above 100 %: planes are read again from caches'),
        {name: 'bound by', value: boundText, help: 'instructions, reads around each pixel, or copies of planes: which of them takes the longest at the peaks, and how much of the time that is'}
      ],
      points);
}
