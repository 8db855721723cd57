// The colours of differences.

/// Blue below zero, orange above, the colour of the page at zero.
const differenceColours = () =>
    (matchMedia('(prefers-color-scheme: dark)').matches ?
         {below: [96, 165, 250], zero: [24, 26, 29], above: [251, 146, 60]} :
         {below: [24, 90, 189], zero: [250, 249, 246], above: [200, 80, 10]});

function mixed(colours, t) {
  const end = t < 0 ? colours.below : colours.above, share = Math.min(1, Math.abs(t));
  return colours.zero.map((zero, i) => Math.round(zero + (end[i] - zero) * share));
}
