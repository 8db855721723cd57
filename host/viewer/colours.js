// Colour maps. A colour is [red, green, blue] of 0 .. 255.

const nanColour = [255, 0, 255], infiniteColour = [0, 208, 255], negativeColour = [64, 96, 255];

/// From the least value to the greatest. `differences` is for values of both signs.
const mapNames = ['grey', 'viridis', 'cividis', 'inferno', 'turbo', 'differences', 'identity', 'wheel'];
/// Those that a person chooses from; the others belong to kinds of planes.
const mapsToChoose = ['grey', 'viridis', 'cividis', 'inferno', 'turbo', 'differences'];

const packedColour = ([red, green, blue]) => ((255 << 24) | (blue << 16) | (green << 8) | red) >>> 0;

/// The colour of a position, 0 to 1, on a map. `ends`: those of differences.
function mapColour(map, t, ends = null) {
  if (map === 'differences') return mixed(ends || differenceColours(), 2 * t - 1);
  const index = Math.round(255 * Math.min(1, Math.max(0, t)));
  if (!data.colours[map]) return [index, index, index];
  return [0, 2, 4].map((k) => parseInt(data.colours[map].substr(6 * index + k, 2), 16));
}

const tableSize = 16384;

/// The colours of a map from position 0 to 1, for an image's Uint32Array.
function mapTable(map, curve) {
  const table = new Uint32Array(tableSize + 1), ends = differenceColours();
  for (let i = 0; i <= tableSize; ++i) table[i] = packedColour(mapColour(map, curve(i / tableSize), ends));
  return table;
}

/// `hue` in turns, red at 0; the others 0 to 1.
function hueColour(hue, saturation, brightness) {
  return [0, 2 / 3, 1 / 3].map((offset) => {
    const turn = hue + offset, ramp = Math.abs(6 * (turn - Math.floor(turn)) - 3) - 1;
    return Math.round(255 * brightness * (1 - saturation * (1 - Math.min(1, Math.max(0, ramp)))));
  });
}

const identityBits = new Uint32Array(1), identityValue = new Float32Array(identityBits.buffer);

/// A colour for an identity, the one that it has in gloam's pictures.
function identityColour(id) {
  identityValue[0] = id;
  let h = identityBits[0];
  h = Math.imul(h ^ (h >>> 16), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  h = (h ^ (h >>> 16)) >>> 0;
  return hueColour((h & 0xffff) / 65536, 0.35 + (0.35 * ((h >>> 16) & 0xff)) / 255, 0.6 + (0.35 * (h >>> 24)) / 255);
}
