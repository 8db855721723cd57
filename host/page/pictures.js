// The picked image beside the truth: a wipe, and the signed difference, computed here from the two.

const loaded = new Map();

async function decoded(id) {
  const image = new Image();
  image.src = 'data:image/png;base64,' + byId(id).textContent;
  await image.decode();
  return image;
}

/// A picture of the page by its number, composed of grey and mask: {width, height, grey(i) 0 .. 255, isThere(i), url}. The last
/// few are cached.
function loadPicture(index) {
  if (!loaded.has(index)) {
    const mask = byId('picture-' + index).dataset.mask;
    loaded.set(
        index,
        Promise.all([decoded('picture-' + index), decoded('mask-' + mask)]).then(([grey,
                                                                                   alpha]) => pictureOf(grey, alpha)));
    if (loaded.size > 12) loaded.delete(loaded.keys().next().value);
  }
  return loaded.get(index);
}

function pictureOf(grey, alpha) {
  const canvas = element('canvas', {width: grey.naturalWidth, height: grey.naturalHeight});
  const context = canvas.getContext('2d', {willReadFrequently: true}), area = [0, 0, canvas.width, canvas.height];
  context.drawImage(alpha, 0, 0);
  const mask = context.getImageData(...area).data;
  context.drawImage(grey, 0, 0);
  const pixels = context.getImageData(...area), values = new Uint8Array(mask.length / 4),
        there = new Uint8Array(mask.length / 4);
  for (let i = 0; i < values.length; ++i) {
    values[i] = pixels.data[4 * i];
    there[i] = mask[4 * i + 3] > 127;
    pixels.data[4 * i + 3] = mask[4 * i + 3];
  }
  context.putImageData(pixels, 0, 0);
  return {
    width: canvas.width,
    height: canvas.height,
    grey: (i) => values[i],
    isThere: (i) => there[i] === 1,
    url: canvas.toDataURL()
  };
}

/// Paints image - truth; `range`: the difference (0 to 1) that has the full colour.
function paintDifference(canvas, image, truth, range) {
  canvas.width = image.width;
  canvas.height = image.height;
  const context = canvas.getContext('2d', {willReadFrequently: true}),
        out = context.createImageData(image.width, image.height);
  const colours = differenceColours(), ramp = [];
  for (let d = -255; d <= 255; ++d) ramp.push(mixed(colours, d / 255 / range));
  for (let i = 0; i < image.width * image.height; ++i) {
    if (!image.isThere(i) || !truth.isThere(i)) continue;
    out.data.set(ramp[image.grey(i) - truth.grey(i) + 255], 4 * i);
    out.data[4 * i + 3] = 255;
  }
  context.putImageData(out, 0, 0);
}

/// Shows a picture and the truth if there are both, else the one that exists. `white`: the value of white pixels. `state`: {wipe (0 to 1), range, fullSize}. Returns
/// at once; the pictures follow. A later call cancels an earlier one.
async function showPictures(place, {name, picture, truth, white}, state) {
  const turn = (place.turn = (place.turn || 0) + 1);
  const images = await Promise.all([picture, truth].map((index) => (is(index) ? loadPicture(index) : null)));
  if (turn !== place.turn) return;
  const [image, reference] = images;
  place.classList.toggle('full-size', state.fullSize);
  if (!image) {
    place.replaceChildren(
        element('p', {class: 'remark'}, 'There is no picture of ' + name + ' here.'),
        ...(reference ? [element('div', {class: 'panes'}, singlePane(reference, 'truth'))] : []));
  } else if (!reference) {
    place.replaceChildren(
        element('p', {class: 'remark'}, 'There is no picture of the truth on this scene.'),
        element('div', {class: 'panes'}, singlePane(image, name)));
  } else {
    place.replaceChildren(element('div', {class: 'panes'}, ...comparison(image, reference, name, white, state)));
  }
  place.dataset.shown = name;
}

function singlePane(image, name) {
  return element(
      'figure', {},
      element('div', {class: 'box'}, element('div', {class: 'stage'}, element('img', {src: image.url, alt: name}))),
      element('figcaption', {}, name));
}

function comparison(a, b, name, white, state) {
  const valueHere = [element('span', {class: 'at'}), element('span', {class: 'at'})];
  const wipe = wipePane(a, b, name, state);
  const panes = [element(
      'figure', {}, element('div', {class: 'box'}, wipe.stage), wipe.slider,
      element(
          'figcaption', {}, element('span', {}, 'Image on the left, truth on the right; drag to wipe'), valueHere[0]))];
  if (a.width !== b.width || a.height !== b.height) {
    panes.push(element(
        'p', {class: 'remark'},
        `The image has ${a.width} × ${a.height} pixels and the truth ${b.width} × ${
            b.height}: there is no difference to show.`));
    return panes;
  }
  const difference = differencePane(a, b, name, white, state, valueHere[1]);
  panes.push(difference.figure);
  for (const stage of [wipe.stage, difference.stage]) {
    stage.addEventListener(
        'pointermove', (event) => valueHere.forEach((place) => (place.textContent = valuesAt(stage, event, a, b, white))));
    stage.addEventListener('pointerleave', () => valueHere.forEach((place) => (place.textContent = '')));
  }
  return panes;
}

function wipePane(image, reference, name, state) {
  const stage = element(
      'div', {class: 'stage wipe'}, element('img', {class: 'image', src: image.url, alt: name}),
      element('img', {class: 'truth', src: reference.url, alt: 'truth'}), element('div', {class: 'divider'}),
      element('span', {class: 'name-tag left'}, name), element('span', {class: 'name-tag right'}, 'truth'));
  const slider = element('input', {
    type: 'range',
    class: 'slider',
    min: 0,
    max: 100,
    step: 0.5,
    'aria-label': 'How much of the picture is the image, the rest is the truth'
  });
  const wipeTo = (share) => {
    state.wipe = Math.min(1, Math.max(0, share));
    stage.style.setProperty('--at', 100 * state.wipe + '%');
    slider.value = 100 * state.wipe;
  };
  const follow = (event) => {
    const box = stage.getBoundingClientRect();
    wipeTo((event.clientX - box.left) / box.width);
  };
  stage.addEventListener('pointerdown', (event) => {
    stage.setPointerCapture(event.pointerId);
    follow(event);
  });
  stage.addEventListener('pointermove', (event) => event.buttons && follow(event));
  slider.addEventListener('input', () => wipeTo(slider.value / 100));
  wipeTo(state.wipe);
  return {stage, slider};
}

function differencePane(a, b, name, white, state, valueHere) {
  const canvas = element('canvas', {role: 'img', 'aria-label': 'signed difference of ' + name + ' and the truth'});
  const stage = element('div', {class: 'stage'}, canvas);
  const shown = (range) => String(Number((range * white).toPrecision(2)));
  const ramp = element('div', {class: 'ramp'}), low = element('span'), high = element('span');
  const choice = element('select', {'aria-label': 'Difference that has the full colour'}, [
    0.05, 0.1, 0.25, 0.5, 1
  ].map((range) => element('option', {value: range, selected: range === state.range}, '± ' + shown(range))));
  const paint = () => {
    const colours = differenceColours(), css = (rgb) => `rgb(${rgb.join(',')})`;
    paintDifference(canvas, a, b, state.range);
    ramp.style.background =
        `linear-gradient(90deg, ${css(colours.below)}, ${css(colours.zero)}, ${css(colours.above)})`;
    low.textContent = '\u2212' + shown(state.range) + ' darker than the truth';
    high.textContent = 'brighter +' + shown(state.range);
  };
  choice.addEventListener('change', () => {
    state.range = Number(choice.value);
    paint();
  });
  paint();
  return {
    stage,
    figure: element(
        'figure', {}, element('div', {class: 'box'}, stage), element('div', {class: 'scale'}, low, ramp, high),
        element('figcaption', {}, element('label', {}, 'Image minus truth, full colour at ', choice), valueHere))
  };
}

/// "image 0.53, truth 0.61, difference -0.08" at the pointer
function valuesAt(stage, event, a, b, white) {
  const box = stage.getBoundingClientRect();
  const x = Math.floor(((event.clientX - box.left) / box.width) * a.width),
        y = Math.floor(((event.clientY - box.top) / box.height) * a.height);
  if (x < 0 || y < 0 || x >= a.width || y >= a.height) return '';
  const i = y * a.width + x;
  if (!a.isThere(i) || !b.isThere(i)) return `${x}, ${y}: background`;
  const [image, truth] = [(a.grey(i) / 255) * white, (b.grey(i) / 255) * white];
  return minus(
      `${x}, ${y}: image ${image.toFixed(2)}, truth ${truth.toFixed(2)}, difference ${(image - truth).toFixed(2)}`);
}
