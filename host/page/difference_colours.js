// The colours of differences.

/// Too dark is blue, too bright is red, as in the pictures of gloam compare (picture/differences.cpp), from the colour of the page at zero.
const differenceColours = () =>
    (matchMedia('(prefers-color-scheme: dark)').matches ?
         {below: [134, 175, 232], zero: [24, 26, 29], above: [226, 150, 137]} :
         {below: [17, 70, 137], zero: [247, 247, 247], above: [125, 36, 26]});

function mixed(colours, t) {
  const end = t < 0 ? colours.below : colours.above, share = Math.min(1, Math.abs(t));
  return colours.zero.map((zero, i) => Math.round(zero + (end[i] - zero) * share));
}
