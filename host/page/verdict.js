// The answer in some sentences: what is nearest to the truth, and at what cost.

const reference = 'HBAO+ medium';

function costWords({ratio, ms}) {
  if (is(ratio)) return `, at ${times(ratio)} the time of ${reference}`;
  return is(ms) ? `, in ${figure(ms)} ms` : '';
}

/// `points`: {name, error, ratio, ms, reads}, of which all but the name may be missing; `where`: "on gallery".
function verdict(points, where) {
  const nearest = points.filter((point) => is(point.error))
                      .sort((a, b) => a.error - b.error || (a.ratio ?? Infinity) - (b.ratio ?? Infinity));
  if (!nearest.length) return `There is no truth ${where}, so nothing is known of errors there.`;
  const best = nearest[0], quick = nearest.find((point) => is(point.ratio) && point.ratio <= 1);
  const sentences = [`Nearest to the truth ${where} is ${best.name}: error ${errorFigure(best.error)}${costWords(best)}.`];
  const plain = nearest.find((point) => point.reads === 'one layer');
  if (best.reads && best !== plain)
    sentences.push(
        `It reads ${best.reads}` +
        (plain ? `; of what reads one layer, ${plain.name} is nearest: error ${errorFigure(plain.error)}${costWords(plain)}.` : '.'));
  if (quick && quick !== best && quick !== plain)
    sentences.push(
        `Of what takes no longer than ${reference}, ${quick.name} is nearest: error ${errorFigure(quick.error)}` +
        (quick.ratio < 1 ? `, at ${times(quick.ratio)}.` : '.'));
  return sentences.join(' ');
}
