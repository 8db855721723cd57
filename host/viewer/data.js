// The values of the files: images of floats, unpacked when they are looked at. The last ones are kept.

/// Bytes of images that are kept.
const mostKept = (navigator.deviceMemory || 4) * 100e6;

async function inflated(element) {
  const binary = atob(byId('data-' + element).textContent), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

let floatsOfHalves = null;
/// The value of each of the 65536 halves.
function halfTable() {
  if (floatsOfHalves) return floatsOfHalves;
  floatsOfHalves = new Float32Array(65536);
  for (let bits = 0; bits < 65536; ++bits) {
    const exponent = (bits >> 10) & 31, fraction = bits & 1023, sign = bits >> 15 ? -1 : 1;
    floatsOfHalves[bits] = sign *
        (exponent === 0      ? fraction * 2 ** -24 :
             exponent === 31 ? (fraction ? NaN : Infinity) :
                               (1024 + fraction) * 2 ** (exponent - 25));
  }
  return floatsOfHalves;
}

/// The floats of `packed` (host/viewer/packed.h), bit for bit.
function unpacked(bytes, width, height, isHalf) {
  const count = width * height, planes = [0, 1, 2, 3].map((k) => bytes.subarray(k * count, (k + 1) * count));
  const [b0, b1, b2, b3] = planes, bits = new Int32Array(count);
  for (let y = 0, i = 0, above = 0; y < height; ++y) {
    let before = above;
    for (let x = 0; x < width; ++x, ++i) {
      const folded = isHalf ? b0[i] | (b1[i] << 8) : b0[i] | (b1[i] << 8) | (b2[i] << 16) | (b3[i] << 24);
      before = (before + ((folded >>> 1) ^ -(folded & 1))) | 0;
      bits[i] = before;
      if (x === 0) above = before;
    }
  }
  if (!isHalf) return new Float32Array(bits.buffer);
  const table = halfTable(), floats = new Float32Array(count);
  for (let i = 0; i < count; ++i) floats[i] = table[bits[i] & 65535];
  return floats;
}

// --- Images: a plane of a view of a frame

const kept = new Map();  // key -> {promise, bytes}, the last used at the end

function dropOldest() {
  let bytes = 0;
  for (const entry of kept.values()) bytes += entry.bytes;
  for (const [key, entry] of kept) {
    if (bytes <= mostKept || kept.size <= 4) return;
    bytes -= entry.bytes;
    kept.delete(key);
  }
}

/// Values by a key: made once, and kept while there is room.
function keptOr(key, bytes, make) {
  const entry = kept.get(key) || {bytes, promise: make()};
  kept.delete(key);
  kept.set(key, entry);
  dropOldest();
  return entry.promise;
}

/// The image of a side as the state has it: {width, height, left, top, plane, channels, background, frame, key}; null where the
/// frame, the view or the plane is missing. `left`, `top`: the first pixel in the display window, in pixels of the file.
function imageOf(side) {
  const file = files[side.file], frame = frameOf(file);
  const view = frame && frame.views.find((each) => each.name === side.view);
  const plane = view && view.planes.find((each) => each.name === side.plane);
  if (!plane) return Promise.resolve(null);
  const [width, height] = plane.size;
  const key = [side.file, frame.number, side.view, side.plane].join('|');
  const bytes = width * height * 4 * (plane.channels.length + 1);
  return keptOr(key, bytes, async () => {
    const channels = await Promise.all(
        plane.channels.map(async (channel) => unpacked(await inflated(channel.data), width, height, channel.half)));
    const whole = plane.has_background && is(view.background) ? await inflated(view.background) : null;
    const background = whole && cutOut(whole, frame.size[0], plane);
    const [left, top] = [0, 1].map((i) => frame.window[i] - frame.display[i] + plane.corner[i]);
    const rangeKey = side.file + '|' + side.plane;
    return {width, height, left, top, plane, channels, background, frame, key, rangeKey};
  });
}

/// The part of the frame's background that a plane covers: data windows may be smaller than the frame.
function cutOut(whole, wholeWidth, plane) {
  const [width, height] = plane.size, [left, top] = plane.corner.map((at) => Math.floor(at / data.step));
  if (width === wholeWidth && width * height === whole.length) return whole;
  const part = new Uint8Array(width * height);
  for (let y = 0; y < height; ++y)
    part.set(whole.subarray((top + y) * wholeWidth + left, (top + y) * wholeWidth + left + width), y * width);
  return part;
}

/// Where images lie: `pitch` is the distance of pixels, `left` and `top` the corner, in pixels of A's file. B's display window
/// covers that of A.
function placeOf(image, reference) {
  const width = (frame) => frame.display[2] - frame.display[0];
  const factor = reference ? width(reference.frame) / width(image.frame) : 1;
  return {left: image.left * factor, top: image.top * factor, pitch: data.step * factor};
}

// --- Differences

/// The components that two planes share, as pairs of indices: those of one name, else all of planes of one kind.
function sharedComponents(a, b) {
  const names = b.components;
  const pairs = a.components.map((name, i) => [i, name ? names.indexOf(name) : -1]).filter(([, j]) => j >= 0);
  if (pairs.length) return pairs;
  const areFigures = [a, b].every((plane) => plane.style === 'share' || plane.style === 'scalar');
  const isAlike = a.components.length === names.length && (areFigures || a.style === b.style);
  return isAlike ? names.map((name, i) => [i, i]) : [];
}

/// Why there is no difference of two images; empty if there is one.
function whyNoDifference(a, b) {
  if (!a || !b) return 'one of the two is missing in this frame';
  const size = (image) => image.frame.display.slice(2).map((end, i) => end - image.frame.display[i]).join(' × ');
  if (size(a) !== size(b)) return `A has ${size(a)} pixels and B ${size(b)}: there is no difference of pixels`;
  if (!sharedComponents(a.plane, b.plane).length)
    return `${a.plane.name} and ${b.plane.name} have no component in common: there is no difference`;
  if ((a.left - b.left) % data.step || (a.top - b.top) % data.step)
    return 'the pixels that --scale kept of A and B lie at other places: there is no difference';
  return '';
}

/// A - B where both have values, as an image in the place of A; `isAbsolute`: its size. Elsewhere it is background.
function differenceOf(a, b, isAbsolute) {
  const count = a.width * a.height;
  const pairs = sharedComponents(a.plane, b.plane);
  return keptOr('difference|' + isAbsolute + a.key + '|' + b.key, count * 4 * (pairs.length + 1), async () => {
    const dx = (a.left - b.left) / data.step, dy = (a.top - b.top) / data.step;
    const background = new Uint8Array(count), channels = pairs.map(() => new Float32Array(count));
    for (let y = 0, i = 0; y < a.height; ++y) {
      for (let x = 0; x < a.width; ++x, ++i) {
        const u = x + dx, v = y + dy, j = v * b.width + u;
        const isOutside = u < 0 || v < 0 || u >= b.width || v >= b.height;
        if (isOutside || (a.background && a.background[i]) || (b.background && b.background[j])) {
          background[i] = 1;
          continue;
        }
        pairs.forEach(([p, q], k) => {
          const difference = a.channels[p][i] - b.channels[q][j];
          channels[k][i] = isAbsolute ? Math.abs(difference) : difference;
        });
      }
    }
    const plane = {
      name: isAbsolute ? '|A − B|' : 'A − B',
      style: isAbsolute ? 'absolute' : 'difference',
      components: pairs.map(([p]) => a.plane.components[p]),
      has_background: true,
      never_negative: false,
    };
    const {width, height, left, top, frame} = a;
    return {
      width,
      height,
      left,
      top,
      plane,
      channels,
      background,
      frame,
      rangeKey: plane.name + a.rangeKey + b.rangeKey,
      figures: null
    };
  });
}

/// Mean, RMSE and the largest size of a difference over its finite values: {mean, rmse, largest, at: [x, y], pixels}.
function figuresOf(image) {
  if (image.figures) return image.figures;
  let sum = 0, squares = 0, count = 0, largest = 0, at = 0;
  for (const values of image.channels)
    for (let i = 0; i < values.length; ++i) {
      const value = values[i];
      if (image.background[i] || !Number.isFinite(value)) continue;
      sum += value;
      squares += value * value;
      ++count;
      if (Math.abs(value) > largest) {
        largest = Math.abs(value);
        at = i;
      }
    }
  image.figures = count ? {
    mean: sum / count,
    rmse: Math.sqrt(squares / count),
    largest,
    at: [at % image.width, Math.floor(at / image.width)],
    pixels: count / image.channels.length
  } :
                          null;
  return image.figures;
}
