// The panel beside the stage: colours, counts, and what is known of the files.

// --- Colours

/// The images whose colours are chosen now, each tone once.
function imagesWithTones() {
  if (state.mode === 'difference' || state.mode === 'absolute') return [shown.difference].filter(Boolean);
  const images = (needsBoth(state.mode) ? [shown.a, shown.b] : [shown[state.mode]]).filter(Boolean);
  return images.filter((image, i) => images.findIndex((other) => toneKey(other) === toneKey(image)) === i);
}

/// Changes the tone of an image; `null` for a value takes the one of the plane's kind. All is drawn again, the panel with `anew`.
function changeTone(image, change, anew = true) {
  const tone = {...(state.tones[toneKey(image)] || {}), ...change};
  for (const name of Object.keys(tone))
    if (tone[name] === null) delete tone[name];
  state.tones[toneKey(image)] = tone;
  keepAddress();
  redraw();
  if (anew) renderTones();
}

function exposureControl(image, tone) {
  const words = element('output', {}, exposureText(tone.exposure));
  const slider = element('input', {
    type: 'range',
    min: -10,
    max: 10,
    step: 0.25,
    value: tone.exposure,
    'aria-label': 'Exposure in stops',
    oninput: (event) => {
      words.textContent = exposureText(Number(event.target.value));
      changeTone(image, {exposure: Number(event.target.value)}, false);
    }
  });
  return element('div', {class: 'exposure'}, slider, words);
}

const exposureText = (stops) => (stops > 0 ? '+' : '') + minus(String(stops)) + ' EV';

function rangeControl(image, tone) {
  const isList = Array.isArray(tone.low);
  const box = (name, label) => element('input', {
    type: 'text',
    inputmode: 'decimal',
    'aria-label': label,
    value: isList ? '' : String(short(tone[name])),
    placeholder: isList ? 'each its own' : null,
    onchange: (event) => {
      const value = Number(event.target.value.replace('\u2212', '-').replace(',', '.'));
      const other = name === 'low' ? 'high' : 'low',
            kept = isList ? (name === 'low' ? value + 1 : value - 1) : tone[other];
      if (event.target.value.trim() === '' || !Number.isFinite(value) || value === kept) return renderTones();
      changeTone(image, {[name]: value, [other]: kept});
    }
  });
  return element('div', {class: 'range'}, box('low', 'Value at the dark end'), box('high', 'Value at the bright end'));
}

/// Buttons that set the range.
function rangeButtons(image, tone) {
  const values = () =>
      (tone.channel === 'all' ? image.channels.flatMap((channel) => fullRangeOf(image, channel)) :
                                fullRangeOf(image, scalarsOf(image, tone.channel)));
  const set = (low, high) => changeTone(image, {low, high: low === high ? high + 1 : high});
  const button = (text, label, action) =>
      element('button', {type: 'button', class: 'plain', title: label, 'aria-label': label, onclick: action}, text);
  const auto = () => {
    const found = {...toneNow(image), low: null, high: null};
    const list = found.channel === 'all' ? image.channels.slice(0, 3) : [scalarsOf(image, found.channel)];
    const ranges = list.map((each) => rangeOf(image, each, found.channel === 'all' ? {...found, map: 'grey'} : found));
    const isReversed = ranges[0][0] > ranges[0][1], lows = ranges.flat();
    set(isReversed ? Math.max(...lows) : Math.min(...lows), isReversed ? Math.min(...lows) : Math.max(...lows));
  };
  return element(
      'div', {class: 'wide buttons'},
      button('99 %', 'From the values: all but the lowest and highest half percent (R)', auto),
      button('All', 'From the least to the greatest value', () => set(Math.min(...values()), Math.max(...values()))),
      button('0 to 1', 'From 0 to 1', () => set(0, 1)),
      button(
          'Turn', 'Exchange the dark and the bright end',
          () => is(tone.low) && !Array.isArray(tone.low) && set(tone.high, tone.low)),
      button('Reset', 'Colours as they were', () => {
        delete state.tones[toneKey(image)];
        changeTone(image, {});
      }));
}

/// One component of vectors has no direction to make a hue of.
function mapFor(channel, map) {
  if (channel === 'all') return {map: null};
  return map === 'wheel' ? {map: 'viridis'} : {};
}

function toneControls(image) {
  const tone = toneNow(image), plane = image.plane, row = (label, control) => [element('label', {}, label), control];
  const isMapped = tone.channel !== 'all' && tone.map !== 'identity', hasRange = tone.map !== 'identity';
  const parts = [element('h2', {class: 'wide'}, 'Colours of ' + plane.name)];
  const choices = channelChoices(plane);
  if (choices.length > 1)
    parts.push(row('Shows', chooser('Component', '', choices, tone.channel, (value) => {
                     const channel = choices.map(([each]) => each).find((each) => String(each) === value);
                     changeTone(image, {channel, low: null, high: null, ...mapFor(channel, tone.map)});
                   })));
  if (hasRange) {
    parts.push(row('Exposure', exposureControl(image, tone)));
    parts.push(row('Range', rangeControl(image, tone)));
    parts.push(rangeButtons(image, tone));
  }
  if (isMapped)
    parts.push(row(
        'Colours',
        chooser(
            'Colour map', '', mapsToChoose.map((name) => [name, name]), tone.map, (map) => changeTone(image, {map}))));
  if (hasRange && tone.map !== 'wheel')
    parts.push(
        row('Curve',
            chooser(
                'Curve', '', transferNames.filter((name) => isMapped || name !== 'log').map((name) => [name, name]),
                tone.transfer, (transfer) => changeTone(image, {transfer}))));
  if (isMapped) parts.push(rampOf(tone));
  return element('div', {class: 'tone', role: 'group', 'aria-label': 'Colours of ' + plane.name}, parts);
}

/// The map from its dark to its bright end, with the values there.
function rampOf(tone) {
  const gain = 2 ** tone.exposure, curve = curves[tone.transfer];
  const stops = Array.from({length: 33}, (unused, i) => `rgb(${mapColour(tone.map, curve(i / 32)).join(',')})`);
  return element(
      'div', {class: 'wide scale'}, element('span', {}, figure(tone.low / gain)),
      element('div', {class: 'ramp', style: `background:linear-gradient(90deg,${stops.join(',')})`}),
      element('span', {}, figure(tone.high / gain)));
}

function renderTones() { replaceKeepingFocus(byId('tones'), imagesWithTones().map(toneControls)); }

// --- Counts

const countNames = [
  ['nan', 'NaN', nanColour], ['infinite', 'infinite', infiniteColour],
  ['minus_infinite', '\u2212infinite', infiniteColour], ['negative', 'negative', negativeColour]
];

/// Values of a plane that are on no scale, over its components. Infinite depths are background.
function countsOf(image) {
  const {plane, background} = image, counts = [];
  const inBackground = background ? background.reduce((sum, one) => sum + one, 0) : 0;
  if (inBackground) counts.push([null, 'background', inBackground]);
  for (const [key, name, colour] of countNames) {
    let count = plane.channels.reduce((sum, channel) => sum + channel[key], 0);
    if (key === 'infinite' && plane.style === 'depth') count -= inBackground;
    if (count > 0) counts.push([key !== 'negative' || plane.never_negative ? colour : undefined, name, count]);
  }
  return counts;
}

function countRow([colour, name, count]) {
  const style = colour ? `background:rgb(${colour.join(',')})` : null;
  const chip = colour === undefined ? null : element('span', {class: colour ? 'chip' : 'chip hatched', style});
  return [element('dt', {}, chip, name), element('dd', {}, many(count, name === 'background' ? 'pixel' : 'value'))];
}

function countList(image, name) {
  const counts = countsOf(image), none = image.plane.never_negative ? ', none is negative.' : '.';
  return [
    element('h2', {}, 'Marked in ' + name),
    counts.length ? element('dl', {class: 'facts'}, counts.map(countRow)) :
                    element('p', {class: 'remark'}, 'All values are finite' + none)
  ];
}

function renderCounts() {
  const both = needsBoth(state.mode), sides = (both ? ['a', 'b'] : [state.mode]).filter((side) => shown[side]);
  const parts =
      sides.map((side) => countList(shown[side], (both ? side.toUpperCase() + ', ' : '') + shown[side].plane.name));
  const box = element(
      'label', {class: 'check'}, element('input', {
        type: 'checkbox',
        id: 'marks',
        checked: state.marks,
        onchange: (event) => changeMarks(event.target.checked)
      }),
      'mark them in the picture');
  replaceKeepingFocus(byId('counts'), [...parts.flat(), box]);
}

function changeMarks(marks) {
  state.marks = marks;
  keepAddress();
  redraw();
  renderCounts();
}

// --- The difference in figures

function renderFigures() {
  const place = byId('figures'), isDifference = state.mode === 'difference' || state.mode === 'absolute';
  place.hidden = !isDifference;
  if (!isDifference) return;
  const why = whyNoDifference(shown.a, shown.b);
  if (why) return place.replaceChildren(element('p', {}, why + '.'));
  const found = figuresOf(shown.difference);
  if (!found) return place.replaceChildren(element('p', {}, 'No pixel has a value in both.'));
  const at = [shown.difference.left + found.at[0] * data.step, shown.difference.top + found.at[1] * data.step];
  const fact = (name, value) => [element('dt', {}, name), element('dd', {}, value)];
  place.replaceChildren(
      element('h2', {}, state.mode === 'absolute' ? 'Size of the difference' : 'Difference'),
      element(
          'dl', {class: 'facts'}, fact('mean', errorFigure(found.mean)), fact('RMSE', errorFigure(found.rmse)),
          fact('largest', errorFigure(found.largest) + ' at ' + at.join(', ')),
          fact('pixels', String(Math.round(found.pixels)))));
}

// --- The files

function aboutSide(name) {
  const side = state[name], file = files[side.file], frame = frameOf(file);
  if (!frame) return [element('h2', {}, file.name), element('p', {}, `has no frame ${state.frame}.`)];
  const view = frame.views.find((each) => each.name === side.view), plane = planeNamed(side);
  const [x0, y0, x1, y1] = frame.display, window = frame.window;
  const isSame = window.join() === frame.display.join();
  const facts = [
    [
      'size',
      `${x1 - x0} × ${y1 - y0}` +
          (isSame ?
               '' :
               `, data ${window[2] - window[0]} × ${window[3] - window[1]} at ${window[0] - x0}, ${window[1] - y0}`)
    ],
    frame.pixel_aspect !== 1 ? ['pixels', `${setting(frame.pixel_aspect)} times as wide as high, drawn square`] : null,
    ['plane', plane ? plane.name + (plane.help ? ': ' + plane.help : '') : 'missing'], ...frame.facts,
    view && view.camera ? ['camera', view.camera] : null
  ];
  const list = (pairs, mono) => element(
      'dl', {class: 'facts' + (mono ? ' mono' : '')},
      pairs.filter(is).map(([term, text]) => [element('dt', {}, term), element('dd', {}, text)]));
  return [
    element('h2', {}, name.toUpperCase() + ': ' + frame.name), list(facts),
    frame.notes.length ? element(
                             'details', {open: true}, element('summary', {}, many(frame.notes.length, 'assumption')),
                             element('ul', {class: 'notes'}, frame.notes.map((note) => element('li', {}, note)))) :
                         null,
    frame.attributes.length ?
        element(
            'details', {}, element('summary', {}, many(frame.attributes.length, 'attribute') + ' of the header'),
            list(frame.attributes, true)) :
        null
  ];
}

function renderAbout() {
  const sides = state.mode === 'a' || state.mode === 'b' ? [state.mode] : ['a', 'b'];
  const isSameFrame = sides.length > 1 && state.a.file === state.b.file;
  const words = [
    data.values, data.half ? 'Values are rounded to half.' : '',
    data.step > 1 ? `Of ${data.step} × ${data.step} pixels one is here.` : '', sizesInWords(sides)
  ].filter(Boolean);
  byId('about').replaceChildren(
      ...(isSameFrame ? ['a'] : sides).flatMap(aboutSide).filter(is), element('p', {class: 'remark'}, words.join(' ')));
}

/// What is done about files of different sizes; empty where they are of one.
function sizesInWords(sides) {
  if (sides.length < 2 || !shown.a || !shown.b) return '';
  const size =
      (image) => [image.frame.display[2] - image.frame.display[0], image.frame.display[3] - image.frame.display[1]];
  const [a, b] = [size(shown.a), size(shown.b)];
  return a.join() === b.join() ? '' : `B (${b.join(' × ')}) is drawn as wide as A (${a.join(' × ')}).`;
}
