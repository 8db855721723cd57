// How values become colours: which component, exposure, the range, the curve, the map.

/// Between the ends of the range: `log` by the logarithm of values, the others by the value; `sRGB` and `gamma 2.2` for linear light.
const transferNames = ['linear', 'sRGB', 'gamma 2.2', 'log'];
const curves = {
  'linear': (t) => t,
  'log': (t) => t,
  'gamma 2.2': (t) => t ** (1 / 2.2),
  'sRGB': (t) => (t <= 0.0031308 ? 12.92 * t : 1.055 * t ** (1 / 2.4) - 0.055),
};

/// Where the tone of an image is kept in the state.
const toneKey = (image) => image.plane.name;

/// What a kind of plane looks like where nothing is chosen. Without `low` and `high` the range is that of the values.
function toneOfKind(plane) {
  switch (plane.style) {
    case 'colour':
      return {channel: 'all', low: 0, high: 1, map: 'grey', transfer: 'sRGB'};
    case 'direction':
      return {channel: 'all', low: -1, high: 1, map: 'grey', transfer: 'linear'};
    case 'position':
      return {channel: 'all', map: 'grey', transfer: 'linear'};
    case 'motion':
      return {channel: 'all', map: 'wheel', transfer: 'linear'};
    case 'share':
      return {channel: 0, low: 0, high: 1, map: 'grey', transfer: 'linear'};
    case 'identity':
      return {channel: 0, map: 'identity', transfer: 'linear'};
    case 'count':
      return {channel: 0, map: 'inferno', transfer: 'linear'};
    case 'depth':
      return {channel: 0, map: 'viridis', transfer: 'log'};
    case 'difference':
      return {channel: plane.components.length > 1 ? 'all' : 0, map: 'differences', transfer: 'linear'};
    case 'absolute':
      return {channel: plane.components.length > 1 ? 'all' : 0, map: 'inferno', transfer: 'linear'};
    default: {
      const least = Math.min(...plane.channels.map((channel) => channel.least ?? 0));
      const channel = plane.components.length === 3 ? 'all' : 0;
      return {channel, map: least < 0 && channel === 0 ? 'differences' : 'grey', transfer: 'linear'};
    }
  }
}

/// Choices of components beside each by itself: names by value.
function channelChoices(plane) {
  const names = plane.components, choices = [];
  if (names.length > 1) choices.push(['all', names.length === 2 ? 'direction and length' : 'all as red, green, blue']);
  names.forEach((name, i) => choices.push([i, name || 'value']));
  if (names.length > 1) choices.push(['length', 'length of the vector']);
  if (plane.style === 'colour') choices.push(['luminance', 'luminance']);
  return choices;
}

// --- One number per pixel

/// The values of the chosen component, or of what is made of several.
function scalarsOf(image, channel) {
  if (Number.isInteger(channel)) return image.channels[Math.min(channel, image.channels.length - 1)];
  image.made = image.made || {};
  if (image.made[channel]) return image.made[channel];
  const weights = channel === 'luminance' ? [0.2126, 0.7152, 0.0722] : null;
  const parts = weights ? image.channels.slice(0, 3) : image.channels, values = new Float32Array(parts[0].length);
  for (let i = 0; i < values.length; ++i) {
    let sum = 0;
    parts.forEach((part, k) => (sum += weights ? weights[k] * part[i] : part[i] * part[i]));
    values[i] = weights ? sum : Math.sqrt(sum);
  }
  return (image.made[channel] = values);
}

// --- Ranges

/// Values below which shares of the finite foreground lie, of at most some ten thousand pixels at even distances.
function percentilesOf(image, values, shares) {
  const step = Math.max(1, Math.floor(values.length / 40000)), sample = [];
  for (let i = 0; i < values.length; i += step)
    if (Number.isFinite(values[i]) && !(image.background && image.background[i])) sample.push(values[i]);
  if (!sample.length) return shares.map(() => null);
  const sorted = Float32Array.from(sample).sort();
  return shares.map((share) => sorted[Math.round(share * (sorted.length - 1))]);
}

/// All finite values of the foreground.
function fullRangeOf(image, values) {
  let least = Infinity, most = -Infinity;
  for (let i = 0; i < values.length; ++i) {
    const value = values[i];
    if (!Number.isFinite(value) || (image.background && image.background[i])) continue;
    if (value < least) least = value;
    if (value > most) most = value;
  }
  return least <= most ? [least, most] : [0, 1];
}

/// 1, 2 or 5 times a power of ten, not below a number.
function roundedUp(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value)), factor = value / power;
  return short((factor <= 1 ? 1 : factor <= 2 ? 2 : factor <= 5 ? 5 : 10) * power);
}

/// The range of values: nearly all of them. Of depths the nearest is the end, which is bright; of both signs 0 is in the middle.
function rangeOf(image, values, tone) {
  let [low, high] = percentilesOf(image, values, [0.005, 0.995]);
  if (low === null) [low, high] = [0, 1];
  if (tone.map === 'differences' || (image.plane.style === 'difference' && tone.channel === 'all')) {
    high = roundedUp(Math.max(Math.abs(low), Math.abs(high)));
    low = -high;
  } else if (image.plane.style === 'absolute') {
    [low, high] = [0, roundedUp(high)];
  } else if (image.plane.style === 'depth') {
    [low, high] = [high, low];
  }
  if (low === high) [low, high] = [low - 0.5, high + 0.5];
  return [low, high];
}

const keptRanges = new Map();

/// The range by itself. It stays as it was found first, so that colours mean the same in all frames and views of a file, and in B
/// what they mean in A. `part`: of several components.
function autoRange(image, tone, part) {
  const isLikeA = shown.a && toneKey(shown.a) === toneKey(image) && shown.a.channels.length === image.channels.length;
  const source = isLikeA ? shown.a : image;
  const ofA = toneKey(image) === state.a.plane ? state.a.file + '|' + state.a.plane : image.rangeKey;
  const key = [ofA, tone.channel, tone.map, tone.transfer, part].join('|');
  const values = () =>
      (is(part) ? source.channels[part] : scalarsOf(source, tone.channel === 'all' ? 'length' : tone.channel));
  if (!keptRanges.has(key)) keptRanges.set(key, rangeOf(source, values(), tone));
  return keptRanges.get(key);
}

/// The tone of an image: {channel, exposure, low, high, isAuto, map, transfer}. Of `all` components low and high are lists where the
/// range is that of the values and each axis has its own.
function toneNow(image) {
  const tone = {exposure: 0, ...toneOfKind(image.plane), ...(state.tones[toneKey(image)] || {})};
  if (!channelChoices(image.plane).some(([value]) => value === tone.channel))
    tone.channel = toneOfKind(image.plane).channel;
  tone.isAuto = !is(tone.low) || !is(tone.high);
  if (tone.channel === 'all' && tone.map !== 'wheel') {
    if (!tone.isAuto) return tone;
    const ranges = image.channels.slice(0, 3).map((unused, part) => autoRange(image, {...tone, map: 'grey'}, part));
    if (image.plane.style === 'difference') {
      const widest = Math.max(...ranges.map(([, high]) => high));
      return {...tone, low: -widest, high: widest};
    }
    if (image.plane.style === 'absolute') return {...tone, low: 0, high: Math.max(...ranges.map(([, high]) => high))};
    return {...tone, low: ranges.map(([low]) => low), high: ranges.map(([, high]) => high)};
  }
  if (tone.isAuto) [tone.low, tone.high] = autoRange(image, tone);
  return tone;
}

/// From a value to its position in the range, 0 to 1 inside it: `value * scale + shift`, of the logarithm with `log`.
function lineOf(low, high, exposure, isLog) {
  const gain = 2 ** exposure, at = (value) => (isLog ? Math.log(Math.max(value, 1e-30)) : value);
  const scale = 1 / (at(high) - at(low));
  return {scale: isLog ? scale : gain * scale, shift: -at(low) * scale + (isLog ? Math.log(gain) * scale : 0)};
}
