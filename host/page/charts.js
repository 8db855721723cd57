// What the charts (Vega specifications) share: marks, colours, scales, the box beside the pointer.

const shapes = [
  'M-1,0a1,1,0,1,0,2,0a1,1,0,1,0,-2,0Z',                           // circle
  'M-0.9,-0.9H0.9V0.9H-0.9Z',                                      // square
  'M0,-1.15L1.1,0.8H-1.1Z',                                        // triangle
  'M0,-1.25L1.05,0L0,1.25L-1.05,0Z',                               // diamond
  'M-1.1,-0.4H-0.4V-1.1H0.4V-0.4H1.1V0.4H0.4V1.1H-0.4V0.4H-1.1Z',  // plus
  'M0,1.15L1.1,-0.8H-1.1Z',                                        // triangle, point down
  'M-0.55,-0.95H0.55L1.1,0L0.55,0.95H-0.55L-1.1,0Z',               // hexagon
];

/// Submitted methods have this shape alone, in the colour of their turn.
const star = 'M0,-1.3L0.33,-0.45L1.24,-0.4L0.53,0.17L0.76,1.05L0,0.56L-0.76,1.05L-0.53,0.17L-1.24,-0.4L-0.33,-0.45Z';

// The title of a vertical axis, above it.
function titleAbove(title, offset) {
  return {title, titleAngle: 0, titleAlign: 'left', titleAnchor: 'end', titleX: 0, titleY: -offset, titleBaseline: 'bottom'};
}

/// A mark for each row of `data`. `more`: further properties of the mark; `enter`: how a row is shown.
const mark = (type, data, more, enter) => ({type, from: {data}, ...more, encode: {enter}});

function theme() {
  const style = getComputedStyle(document.documentElement);
  const value = (name) => style.getPropertyValue('--' + name).trim();
  return {
    ink: value('ink'),
    faint: value('faint'),
    rule: value('rule'),
    grid: value('grid'),
    panel: value('panel'),
    paper: value('paper'),
    accent: value('accent'),
    front: value('front'),
    colours: value('colours').split(/\s+/),
    font: getComputedStyle(document.body).fontFamily,
  };
}

/// Eight colours and seven shapes advance together: 56 techniques before a pair repeats. Each page says which are submitted: isStarred.
const colourOf = (index) => theme().colours[index % theme().colours.length];
const shapeOf = (index) => (isStarred(index) ? star : shapes[index % shapes.length]);

/// The mark of a technique, in running text.
function swatch(index, hollow) {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg'), path = document.createElementNS(space, 'path');
  svg.setAttribute('viewBox', '-1.4 -1.4 2.8 2.8');
  svg.setAttribute('class', 'swatch');
  svg.setAttribute('aria-hidden', 'true');
  path.setAttribute('d', shapeOf(index));
  path.setAttribute('fill', hollow ? 'none' : colourOf(index));
  path.setAttribute('stroke', colourOf(index));
  path.setAttribute('stroke-width', '0.3');
  svg.append(path);
  return svg;
}

function configuration(colours) {
  const text = {font: colours.font, fontSize: 11};
  return {
    background: 'transparent',
    axis: {
      labelFont: text.font,
      labelFontSize: 11,
      labelColor: colours.faint,
      titleFont: text.font,
      titleFontSize: 12,
      titleFontWeight: 'normal',
      titleColor: colours.faint,
      domainColor: colours.rule,
      tickColor: colours.rule,
      gridColor: colours.grid,
      labelPadding: 4,
    },
    text: {...text, fill: colours.ink},
  };
}

/// Draws a specification in place of an earlier one.
function draw(place, spec, width) {
  if (place.view) place.view.finalize();
  const view = new vega.View(
      vega.parse({padding: 4, autosize: {type: 'fit', contains: 'padding'}, width, ...spec}, configuration(theme())), {
        renderer: 'svg',
        container: place,
        hover: true,
      });
  view.logLevel(1);
  place.view = view;
  view.tooltip((handler, event, item, value) => showHover(event, value));
  view.runAsync();
  return view;
}

function clearChart(place) {
  if (place.view) place.view.finalize();
  place.view = null;
  place.replaceChildren();
}

/// 0.5, 1, 2, 5, ... within a domain; fewer if there is no room.
function logTicks([low, high], most) {
  for (const steps of [[1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 3, 5], [1, 2, 5], [1, 3], [1]]) {
    const ticks = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) {
      for (const step of steps) {
        const tick = Number((step * 10 ** power).toPrecision(3));
        if (tick >= low && tick <= high) ticks.push(tick);
      }
    }
    if (ticks.length <= most || steps.length === 1) return ticks;
  }
}

/// A domain with some room around the values, for a logarithmic axis.
function logDomain(values) {
  const low = Math.min(...values), high = Math.max(...values), room = Math.max(1.12, (high / low) ** 0.07);
  return [low / room, high * room];
}

function linearDomain(values) {
  const low = Math.min(...values), high = Math.max(...values), room = 0.08 * (high - low) || 0.1 * high || 0.01;
  return [Math.max(0, low - room), high + room];
}

/// The box beside the pointer. `value`: {title, lines: [[name, text], ...]}; null hides it.
function showHover(event, value) {
  const box = byId('hover');
  box.hidden = !value || !value.title;
  if (box.hidden) return;
  box.replaceChildren(
      element('b', {}, value.title),
      element(
          'table', {},
          value.lines.map(
              ([name, text]) => element('tr', {}, element('td', {}, name), element('td', {class: 'number'}, text)))));
  const {width, height} = box.getBoundingClientRect();
  const left = event.clientX + 16 + width > innerWidth ? event.clientX - 16 - width : event.clientX + 16;
  box.style.left = Math.max(4, Math.min(left, innerWidth - width - 4)) + 'px';
  box.style.top = Math.max(4, Math.min(event.clientY + 14, innerHeight - height - 4)) + 'px';
}
