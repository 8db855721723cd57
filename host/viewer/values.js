// Values under the cursor: the floats of the files, in as many digits as tell them apart.

/// The shortest decimal that reads as the same float.
function exactValue(value) {
  if (Number.isNaN(value)) return 'NaN';
  if (!Number.isFinite(value)) return value > 0 ? '+inf' : '\u2212inf';
  for (let digits = 1; digits <= 9; ++digits) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) return minus(Object.is(value, -0) ? '-0' : plainNumber(Number(text)));
  }
  return minus(plainNumber(value));
}

/// Without an exponent where a person would write none.
function plainNumber(value) {
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-6 || size >= 1e15) ? value.toExponential() : String(value);
}

/// For a pixel of the picture: up to four digits.
function shortValue(value) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'NaN' : value > 0 ? '+inf' : '\u2212inf';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return minus(value.toExponential(1));
  return minus(String(Number(value.toPrecision(4))));
}

let hovered = null;  // [u, v], point of A's image under the pointer

/// Without a point, the values of the picked pixel are shown again.
function hover(u, v) {
  hovered = is(u) ? [u, v] : null;
  byId('values').setAttribute('aria-live', 'off');
  renderValues();
}

/// Keeps the values of the pixel of A at a point shown.
function pick(u, v) {
  const place = shown.reference ? placeOf(shown.reference, shown.reference) : {left: 0, top: 0, pitch: 1};
  const at = [(u - place.left) / place.pitch, (v - place.top) / place.pitch].map(Math.floor);
  const next = [place.left + at[0] * place.pitch, place.top + at[1] * place.pitch];
  state.picked = state.picked && state.picked.join() === next.join() ? null : next;
  keepAddress();
  renderValues();
  redraw();
}

/// Moves the picked pixel, and the picture where it would leave the stage.
function movePicked(dx, dy) {
  const {left, top, width, height} = extent(), {centre} = looking();
  const from = state.picked || centre.map((at) => Math.floor(at / data.step) * data.step);
  const clamp = (at, low, high) => Math.min(high, Math.max(low, at));
  state.picked = state.picked ?
      [
        clamp(from[0] + dx * data.step, left, left + width - data.step),
        clamp(from[1] + dy * data.step, top, top + height - data.step)
      ] :
      from;
  const pane = panes()[0], [x, y] = placeIn(pane, ...state.picked), margin = 24;
  const over = (at, start, size) => Math.min(0, start + size - margin - at) + Math.max(0, start + margin - at);
  if (state.zoom !== null) moveBy(over(x, pane.left, pane.width), over(y, pane.top, pane.height));
  hovered = null;
  byId('values').setAttribute('aria-live', 'polite');
  keepAddress();
  renderValues();
  redraw();
}

/// Values of an image at a point, by component; null outside.
function valuesAt(image, u, v) {
  const at = pixelOf(image, u, v);
  if (!at) return null;
  return {
    ...at,
    isBackground: Boolean(image.background && image.background[at.i]),
    values: image.channels.map((channel) => channel[at.i])
  };
}

const componentName = (plane, i) => plane.components[i] || plane.name;

/// The rows of the table: a component each, in columns of A, B and their difference.
function renderValues() {
  const table = byId('values'), point = hovered || (state.picked && state.picked.map((at) => at + 0.5));
  const both = needsBoth(state.mode), sides = both ? ['a', 'b'] : [state.mode];
  if (!point || !shown.reference) {
    table.replaceChildren(
        element('caption', {}, 'Values'),
        element(
            'tr', {},
            element(
                'td', {class: 'remark', style: 'text-align:left;font-family:inherit'},
                'Point at a pixel, or click to keep one.')));
    return;
  }
  const read = sides.map((side) => valuesAt(shown[side], ...point));
  const first = read.find(Boolean), plane = sides.map((side) => shown[side] && shown[side].plane);
  const inFile = first && pixelInFile(sides[read.indexOf(first)], first);
  const caption = !first ?
      'Outside the picture' :
      `Pixel ${inFile.join(', ')}` + (read.some((each) => each && each.isBackground) ? ' \u00b7 background' : '');
  const rows = [];
  const count = Math.max(0, ...plane.filter(Boolean).map((each) => each.components.length));
  const hasDifference = both && read[0] && read[1] && !whyNoDifference(shown.a, shown.b);
  const shared = hasDifference ? sharedComponents(plane[0], plane[1]) : [];
  rows.push(element(
      'tr', {class: 'head'}, element('th', {}, ''),
      sides.map(
          (side, k) =>
              element('td', {}, (both ? side.toUpperCase() + ' ' : '') + (plane[k] ? plane[k].name : 'missing'))),
      hasDifference ? element('td', {}, 'A \u2212 B') : null));
  for (let i = 0; i < count; ++i) {
    const pair = shared.find(([p]) => p === i), row = [plane[0] ? i : -1, plane[0] && pair ? pair[1] : i];
    rows.push(element(
        'tr', {},
        element('th', {scope: 'row'}, plane.filter(Boolean).map((each) => componentName(each, i)).find(Boolean)),
        read.map(
            (each, k) => element(
                'td', {}, each && row[k] >= 0 && row[k] < each.values.length ? exactValue(each.values[row[k]]) : '')),
        hasDifference ?
            element('td', {}, pair ? exactValue(Math.fround(read[0].values[pair[0]] - read[1].values[pair[1]])) : '') :
            null));
  }
  table.replaceChildren(element('caption', {}, caption), element('tbody', {}, rows));
}

/// Pixel coordinates in the file's display window.
function pixelInFile(side, at) {
  const image = shown[side];
  return [image.left + at.x * data.step, image.top + at.y * data.step];
}
