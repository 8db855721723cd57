// The stage: draws what is shown at the present zoom, and moves it by pointer and wheel.

const canvas = byId('canvas'), stage = byId('stage');
const pen = canvas.getContext('2d', {willReadFrequently: true});

/// What `show` (view.js) has at hand: images of both sides, and what is drawn of them.
let shown = {a: null, b: null, difference: null, reference: null};

const deviceScale = () => Math.min(3, window.devicePixelRatio || 1);
const leastZoom = () => fittingZoom() / 4, mostZoom = 256;

/// The parts of the stage that images are drawn in: side by side there are two. {left, top, width, height} in CSS pixels.
function panes() {
  const width = stage.clientWidth, height = stage.clientHeight;
  if (state.mode !== 'beside') return [{left: 0, top: 0, width, height}];
  if (height > width)
    return [{left: 0, top: 0, width, height: height / 2}, {left: 0, top: height / 2, width, height: height / 2}];
  return [{left: 0, top: 0, width: width / 2, height}, {left: width / 2, top: 0, width: width / 2, height}];
}

/// The rectangle of A's frame, its display window and data outside it, in pixels of its file: {left, top, width, height}.
function extent() {
  if (!shown.reference) return {left: 0, top: 0, width: 1, height: 1};
  const {window: [x0, y0, x1, y1], display} = shown.reference.frame;
  return {left: x0 - display[0], top: y0 - display[1], width: x1 - x0, height: y1 - y0};
}

function fittingZoom() {
  const {width, height} = extent(), pane = panes()[0];
  return Math.max(1e-3, Math.min(pane.width / width, pane.height / height, 32));
}

/// Zoom and centre as they are now: the whole image until someone zooms.
function looking() {
  if (state.zoom !== null) return {zoom: state.zoom, centre: state.centre};
  const {left, top, width, height} = extent();
  return {zoom: fittingZoom(), centre: [left + width / 2, top + height / 2]};
}

/// From a point of the stage (CSS pixels) to one of A's image.
function pointAt(x, y) {
  const pane =
      panes().find(
          (each) => x >= each.left && x < each.left + each.width && y >= each.top && y < each.top + each.height) ||
      panes()[0];
  const {zoom, centre} = looking();
  return [centre[0] + (x - pane.left - pane.width / 2) / zoom, centre[1] + (y - pane.top - pane.height / 2) / zoom];
}

/// Where a point of A's image is in a pane, CSS pixels.
function placeIn(pane, u, v) {
  const {zoom, centre} = looking();
  return [pane.left + pane.width / 2 + (u - centre[0]) * zoom, pane.top + pane.height / 2 + (v - centre[1]) * zoom];
}

/// The pixel of an image at a point of A's image: {x, y, i}; null outside.
function pixelOf(image, u, v) {
  if (!image) return null;
  const place = placeOf(image, shown.reference);
  const x = Math.floor((u - place.left) / place.pitch), y = Math.floor((v - place.top) / place.pitch);
  return x >= 0 && y >= 0 && x < image.width && y < image.height ? {x, y, i: y * image.width + x} : null;
}

// --- Drawing

/// Slanting lines behind an image: background is left out of it.
function hatching() {
  const style = getComputedStyle(stage), colour = (name) => style.getPropertyValue(name);
  const tile = element('canvas', {width: 8, height: 8}), context = tile.getContext('2d');
  context.fillStyle = colour('--paper');
  context.fillRect(0, 0, 8, 8);
  context.strokeStyle = colour('--rule');
  for (const shift of [-8, 0, 8]) {
    context.moveTo(shift, 8);
    context.lineTo(shift + 8, 0);
  }
  context.stroke();
  return pen.createPattern(tile, 'repeat');
}

/// Draws an image into a part of a pane. `clip`: left and right end, CSS pixels.
function drawImage(image, pane, clip = [pane.left, pane.left + pane.width]) {
  if (!image || clip[1] <= clip[0]) return;
  const scale = deviceScale(), {zoom} = looking(), place = placeOf(image, shown.reference);
  const [left, top] = placeIn(pane, place.left, place.top), pitch = place.pitch * zoom;
  pen.save();
  pen.scale(scale, scale);
  pen.beginPath();
  pen.rect(clip[0], pane.top, clip[1] - clip[0], pane.height);
  pen.clip();
  pen.fillStyle = hatching();
  pen.fillRect(left, top, image.width * pitch, image.height * pitch);
  // Reduced images are averaged, others show their pixels; identities cannot be averaged.
  pen.imageSmoothingEnabled = pitch * scale < 1 && image.plane.style !== 'identity';
  pen.imageSmoothingQuality = 'high';
  pen.drawImage(paintedOf(image), left, top, image.width * pitch, image.height * pitch);
  if (pitch >= 12) drawGrid(image, {left, top, pitch}, clip, pane);
  if (pitch >= 44) drawValues(image, {left, top, pitch}, clip, pane);
  pen.restore();
}

/// The pixels of an image that are seen: [first x, end x, first y, end y].
function seenPixels(image, at, clip, pane) {
  const first = (end, corner) => Math.max(0, Math.floor((end - corner) / at.pitch));
  const last = (end, corner, count) => Math.min(count, Math.ceil((end - corner) / at.pitch));
  return [
    first(clip[0], at.left), last(clip[1], at.left, image.width), first(pane.top, at.top),
    last(pane.top + pane.height, at.top, image.height)
  ];
}

function drawGrid(image, at, clip, pane) {
  const [x0, x1, y0, y1] = seenPixels(image, at, clip, pane);
  pen.beginPath();
  for (let x = x0; x <= x1; ++x) {
    pen.moveTo(at.left + x * at.pitch, at.top + y0 * at.pitch);
    pen.lineTo(at.left + x * at.pitch, at.top + y1 * at.pitch);
  }
  for (let y = y0; y <= y1; ++y) {
    pen.moveTo(at.left + x0 * at.pitch, at.top + y * at.pitch);
    pen.lineTo(at.left + x1 * at.pitch, at.top + y * at.pitch);
  }
  pen.strokeStyle = 'rgba(128, 128, 128, 0.35)';
  pen.lineWidth = 0.5;
  pen.stroke();
}

/// The values of pixels that are large enough to hold them.
function drawValues(image, at, clip, pane) {
  const [x0, x1, y0, y1] = seenPixels(image, at, clip, pane), lines = image.channels.length;
  const size = Math.min(13, at.pitch / 5.5, (at.pitch - 6) / lines / 1.15);
  if (size < 7) return;
  const colours =
      paintedOf(image).getContext('2d', {willReadFrequently: true}).getImageData(x0, y0, x1 - x0, y1 - y0).data;
  pen.font = size + 'px ui-monospace, "DejaVu Sans Mono", monospace';
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  for (let y = y0; y < y1; ++y) {
    for (let x = x0; x < x1; ++x) {
      const k = 4 * ((y - y0) * (x1 - x0) + x - x0);
      const brightness = 0.3 * colours[k] + 0.59 * colours[k + 1] + 0.11 * colours[k + 2];
      pen.fillStyle = colours[k + 3] < 128 ? getComputedStyle(stage).color : brightness > 130 ? '#000' : '#fff';
      image.channels.forEach((values, c) => {
        const line = (c - (lines - 1) / 2) * size * 1.15;
        pen.fillText(
            shortValue(values[y * image.width + x]), at.left + (x + 0.5) * at.pitch,
            at.top + (y + 0.5) * at.pitch + line);
      });
    }
  }
}

/// A line around A's display window, where data lie elsewhere.
function drawDisplay(pane) {
  const image = shown.reference;
  if (!image) return;
  const [x0, y0, x1, y1] = image.frame.display, scale = deviceScale(), {zoom} = looking();
  const isFilled = !image.left && !image.top && Math.abs(image.width * data.step - (x1 - x0)) < data.step &&
      Math.abs(image.height * data.step - (y1 - y0)) < data.step;
  if (isFilled) return;
  const [left, top] = placeIn(pane, 0, 0);
  pen.save();
  pen.scale(scale, scale);
  pen.strokeStyle = getComputedStyle(stage).getPropertyValue('--faint');
  pen.setLineDash([4, 4]);
  pen.strokeRect(left, top, (x1 - x0) * zoom, (y1 - y0) * zoom);
  pen.restore();
}

/// A frame around the pixel whose values stay shown.
function drawPicked(pane) {
  if (!state.picked) return;
  const [x, y] = state.picked, {zoom} = looking(), scale = deviceScale();
  const [left, top] = placeIn(pane, x, y), size = Math.max(7, zoom * data.step);
  const shift = (size - zoom * data.step) / 2;
  pen.save();
  pen.scale(scale, scale);
  for (const [width, colour] of [[3, 'rgba(0, 0, 0, 0.7)'], [1.2, '#fff']]) {
    pen.lineWidth = width;
    pen.strokeStyle = colour;
    pen.strokeRect(left - shift, top - shift, size, size);
  }
  pen.restore();
}

/// The line between two panes.
function drawSeam(pane) {
  const scale = deviceScale();
  pen.fillStyle = getComputedStyle(stage).getPropertyValue('--faint');
  if (pane.top > 0)
    pen.fillRect(0, Math.round(pane.top * scale), pane.width * scale, Math.ceil(scale));
  else
    pen.fillRect(Math.round(pane.left * scale), 0, Math.ceil(scale), pane.height * scale);
}

function drawStage() {
  const scale = deviceScale(), width = Math.round(stage.clientWidth * scale),
        height = Math.round(stage.clientHeight * scale);
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  pen.clearRect(0, 0, width, height);
  const [pane, other] = panes(), {a, b, difference} = shown, middle = pane.left + pane.width * state.wipe;
  switch (state.mode) {
    case 'wipe':
      drawImage(a, pane, [pane.left, middle]);
      drawImage(b, pane, [middle, pane.left + pane.width]);
      break;
    case 'beside':
      drawImage(a, pane);
      drawImage(b, other);
      drawPicked(other);
      drawSeam(other);
      break;
    case 'difference':
    case 'absolute':
      drawImage(difference, pane);
      break;
    case 'flicker':
      drawImage(state.phase === 'a' ? a : b, pane);
      break;
    default:
      drawImage(state.mode === 'b' ? b : a, pane);
  }
  drawDisplay(pane);
  drawPicked(pane);
  renderDivider();
  renderZoom();
}

let drawWaits = false;
/// Draws before the next picture of the screen.
function redraw() {
  if (drawWaits) return;
  drawWaits = true;
  requestAnimationFrame(() => {
    drawWaits = false;
    drawStage();
  });
}

// --- Zoom and pan

/// Zooms so that a point of the stage stays where it is.
function zoomAt(x, y, factor) {
  const {zoom} = looking(), [u, v] = pointAt(x, y);
  const next = Math.min(mostZoom, Math.max(leastZoom(), zoom * factor));
  const {centre} = looking();
  state.zoom = next;
  state.centre = [u + ((centre[0] - u) * zoom) / next, v + ((centre[1] - v) * zoom) / next];
  changedView();
}

const zoomBy = (factor) => {
  const pane = panes()[0];
  const [u, v] = state.picked ? placeIn(pane, state.picked[0] + 0.5, state.picked[1] + 0.5) : [-1, -1];
  const isSeen = u >= pane.left && v >= pane.top && u < pane.left + pane.width && v < pane.top + pane.height;
  zoomAt(...(isSeen ? [u, v] : [pane.left + pane.width / 2, pane.top + pane.height / 2]), factor);
};

function fit() {
  state.zoom = null;
  changedView();
}

/// One pixel of A per pixel of the screen.
function oneToOne() {
  const {centre} = looking();
  state.zoom = 1 / deviceScale() / data.step;
  state.centre = state.picked ? state.picked.map((at) => at + 0.5) : centre;
  changedView();
}

function changedView() {
  keepAddress();
  redraw();
}

function moveBy(dx, dy) {
  const {zoom, centre} = looking();
  state.zoom = zoom;
  state.centre = [centre[0] - dx / zoom, centre[1] - dy / zoom];
  changedView();
}

const onStage = (event) => {
  const box = stage.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
};

/// One pointer drags, two zoom; a click picks the pixel under it.
function followPointers() {
  const pointers = new Map();
  let travelled = 0;
  stage.addEventListener('pointerdown', (event) => {
    if (event.target === byId('divider')) return;
    stage.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, onStage(event));
    travelled = 0;
  });
  stage.addEventListener('pointermove', (event) => {
    const at = onStage(event), before = pointers.get(event.pointerId);
    if (!before) return hover(...pointAt(...at));
    travelled += Math.hypot(at[0] - before[0], at[1] - before[1]);
    if (travelled > 3) stage.classList.add('is-dragged');
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const distance = (point) => Math.max(1, Math.hypot(point[0] - other[0], point[1] - other[1]));
      zoomAt((at[0] + other[0]) / 2, (at[1] + other[1]) / 2, distance(at) / distance(before));
    }
    if (travelled > 3) moveBy((at[0] - before[0]) / pointers.size, (at[1] - before[1]) / pointers.size);
    pointers.set(event.pointerId, at);
  });
  const release = (event) => {
    if (pointers.delete(event.pointerId) && travelled <= 3 && event.type === 'pointerup')
      pick(...pointAt(...onStage(event)));
    stage.classList.remove('is-dragged');
  };
  stage.addEventListener('pointerup', release);
  stage.addEventListener('pointercancel', release);
  stage.addEventListener('pointerleave', () => hover());
  stage.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoomAt(...onStage(event), Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0018)));
  }, {passive: false});
  stage.addEventListener('dblclick', () => (state.zoom === null ? oneToOne() : fit()));
}
