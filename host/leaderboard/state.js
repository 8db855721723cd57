// The state of the page: the tables, and what is chosen and picked of them.

const data = JSON.parse(byId('data').textContent);

const state = {
  board: 0,
  effect: 0,
  choice: 0,
  device: '',       // '': all
  variants: false,  // rows with a variant are shown
  layers: true,     // rows that read more than one layer of one view are shown
  fit: false,       // submitted methods at their best fit
  picked: null,     // an entry, by number
  item: null,
  pictures: {wipe: 0.5, range: 0.25, fullSize: false},
};

const boardNow = () => data.boards[state.board];
const tableNow = () => boardNow().effects[state.effect];
const choiceNow = () => tableNow().choices[state.choice];
const entryOf = (row) => tableNow().entries[row.entry];
const isSubmitted = (entry) => is(entry.submitted);
const nameOf = (entry) =>
    [entry.technique, isSubmitted(entry) ? entry.submitted.version : entry.preset].filter(Boolean).join(' ');
const titleOf = (entry) => nameOf(entry) + (entry.variant ? ', ' + entry.variant : '');
const effectTitle = (effect) => (effect === 'ao' ? 'ambient occlusion' : effect.replace(/_/g, ' '));

const kinds = {
  frame: 'single frames',
  sequence: 'sequences',
  eyes: 'pairs of eyes',
  display: 'light-field displays',
  hard: 'hard cases',
};
const choiceTitle = ({what, name}) => (what === 'all' ? 'all items' : what === 'kind' ? kinds[name] || name : name);

/// Two drivers of one device are told apart by the driver.
const deviceOf = (entry) => {
  if (isSubmitted(entry) || !entry.device) return '';
  const drivers = unique(tableNow().entries.filter((each) => each.device === entry.device).map((each) => each.driver));
  return drivers.length > 1 ? `${entry.device} (${entry.driver})` : entry.device;
};
const devicesNow = () => unique(tableNow().entries.map(deviceOf).filter(Boolean));

/// A figure of a row of a table, or of one item; at the best fit where that is shown and there is one.
const fitted = {error: 'fit_error', ssim: 'fit_ssim', flip: 'fit_flip'};
function figureOf(row, key) {
  return state.fit && fitted[key] && is(row[fitted[key]]) ? row[fitted[key]] : row[key];
}
const isAtFit = (row, key) => state.fit && fitted[key] && is(row[fitted[key]]);

/// Measured on all items of the choice that any method was measured on.
const isWhole = (row, choice = choiceNow()) => row.items === choice.items.length;

/// The number of the choice that says most: on which most methods have means, of most items. Some methods compute only pairs of eyes or
/// displays and others never do, so all items together would show hardly any.
function tellingChoice() {
  const isCounted = (row, choice) => isWhole(row, choice) && (state.variants || !entryOf(row).variant);
  const said = tableNow().choices.map(
      (choice) => choice.items.length * choice.rows.filter((row) => isCounted(row, choice)).length);
  return said.indexOf(Math.max(...said));
}

function isShown(row) {
  const entry = entryOf(row);
  if (isSubmitted(entry)) return true;
  return (state.variants || !entry.variant) && (state.layers || entry.reads === 'one layer') &&
      (!state.device || deviceOf(entry) === state.device);
}
const rowsNow = () => choiceNow().rows.filter(isShown);

/// The rows of a method, one for each item, of the choice.
const itemRowsOf = (entry) =>
    tableNow().rows.filter((row) => row.entry === entry && choiceNow().items.includes(row.item));
