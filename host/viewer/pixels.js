// From values to pixels: paints an image into a canvas of its size. Background is left transparent, so that the hatching behind shows.

const [markedNan, markedInfinite, markedNegative] = [nanColour, infiniteColour, negativeColour].map(packedColour);

/// The colour of a value that is on no scale, or 0. Infinite depths are background, which is not painted.
function markOf(value, plane) {
  if (value !== value) return markedNan;
  if (value === Infinity || value === -Infinity) return markedInfinite;
  return value < 0 && plane.never_negative ? markedNegative : 0;
}

function paintScalars(out, image, tone, marks) {
  const values = scalarsOf(image, tone.channel), isLog = tone.transfer === 'log';
  const {scale, shift} = lineOf(tone.low, tone.high, tone.exposure, isLog);
  const table = mapTable(tone.map, curves[tone.transfer]), {background, plane} = image;
  for (let i = 0; i < values.length; ++i) {
    if (background && background[i]) continue;
    const value = values[i], mark = marks ? markOf(value, plane) : 0;
    if (mark) {
      out[i] = mark;
      continue;
    }
    const t = (isLog ? Math.log(value) : value) * scale + shift;
    out[i] = table[t >= 1 ? tableSize : t > 0 ? (t * tableSize + 0.5) | 0 : 0];
  }
}

function paintComponents(out, image, tone, marks) {
  const parts = image.channels.slice(0, 3), ends = (end, k) => (Array.isArray(end) ? end[k] : end);
  const lines = parts.map((part, k) => lineOf(ends(tone.low, k), ends(tone.high, k), tone.exposure, false));
  const curve = curves[tone.transfer], table = new Uint8Array(tableSize + 1);
  for (let i = 0; i <= tableSize; ++i) table[i] = Math.round(255 * curve(i / tableSize));
  const byte = (value, line) => {
    const t = value * line.scale + line.shift;
    return table[t >= 1 ? tableSize : t > 0 ? (t * tableSize + 0.5) | 0 : 0];
  };
  const [red, green, blue] = parts, [forRed, forGreen, forBlue] = lines, {background, plane} = image;
  for (let i = 0; i < out.length; ++i) {
    if (background && background[i]) continue;
    const r = red[i], g = green[i], b = blue ? blue[i] : 0;
    const mark = marks ? markOf(r, plane) || markOf(g, plane) || markOf(b, plane) : 0;
    out[i] = mark ||
        ((255 << 24) | ((blue ? byte(b, forBlue) : 0) << 16) | (byte(g, forGreen) << 8) | byte(r, forRed)) >>> 0;
  }
}

/// Each identity in a colour of its own.
function paintIdentities(out, image) {
  const values = image.channels[0], colours = new Map();
  for (let i = 0; i < values.length; ++i) {
    if (image.background && image.background[i]) continue;
    if (!colours.has(values[i])) colours.set(values[i], packedColour(identityColour(values[i])));
    out[i] = colours.get(values[i]);
  }
}

/// Vectors in the image: the hue is the direction, the brightness the length.
function paintVectors(out, image, tone, marks) {
  const [across, down] = image.channels, gain = 2 ** tone.exposure, longest = tone.high > 0 ? tone.high : 1;
  for (let i = 0; i < out.length; ++i) {
    if (image.background && image.background[i]) continue;
    const x = across[i], y = down[i], mark = marks ? markOf(x, image.plane) || markOf(y, image.plane) : 0;
    out[i] = mark ||
        packedColour(hueColour(
            Math.atan2(y, x) / (2 * Math.PI), 0.85, Math.min(1, (gain * Math.hypot(x, y)) / longest) || 0));
  }
}

/// The image as a canvas of its size, in its present tone.
function paintedOf(image) {
  const tone = toneNow(image), isDark = matchMedia('(prefers-color-scheme: dark)').matches;
  const key = JSON.stringify([tone, state.marks, isDark]);
  if (image.painted && image.painted.key === key) return image.painted.canvas;
  const canvas = image.painted ? image.painted.canvas : element('canvas', {width: image.width, height: image.height});
  const context = canvas.getContext('2d', {willReadFrequently: true});
  const pixels = context.createImageData(image.width, image.height), out = new Uint32Array(pixels.data.buffer);
  if (tone.map === 'identity')
    paintIdentities(out, image);
  else if (tone.map === 'wheel' && tone.channel === 'all')
    paintVectors(out, image, tone, state.marks);
  else if (tone.channel === 'all')
    paintComponents(out, image, tone, state.marks);
  else
    paintScalars(out, image, tone, state.marks);
  context.putImageData(pixels, 0, 0);
  image.painted = {key, canvas};
  return canvas;
}
