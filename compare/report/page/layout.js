// Lays the parts of a result out as HTML: those of page_json() (compare/result/result.h), and what only a page has:
//   {cards: [{title, tone, headline, text, link}]}   the page's short answers
//   {lead: text}                                     what the page is about
//   {plots: [{title, unit, text, shape, data}]}      places of plots; data: their data attributes
//   {maps: index}                                    the place of a set of maps
//   {summary, pre}                                   a text that is folded away
// No text is read as HTML: a name such as "<b>" is shown as it is written.

// An element with attributes and children; those without a value are left out.
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) if (value) made.setAttribute(key, value);
  made.append(...children.filter((child) => child));
  return made;
}

const toned = ({text, tone, toned: words}) => {
  const at = tone && words ? text.indexOf(words) : -1;
  return at < 0 ? [text] : [text.slice(0, at), element('b', {class: tone}, words), text.slice(at + words.length)];
};

const cellOf = (cell) => (typeof cell === 'string' ? cell :
  element('span', {class: `chip ${cell.tone || ''}`.trim(), title: cell.note}, element('span', {class: 'word'}, cell.text)));

// The first cell of a row is its heading, unless it is a number.
function rowOf({cells, note}, columns) {
  const row = element('tr', {}, ...cells.map((cell, k) => {
    const isHeading = k === 0 && !columns[k].number;
    return element(isHeading ? 'th' : 'td', {scope: isHeading && 'row', class: columns[k].number && 'number'}, cellOf(cell));
  }));
  return note ? [row, element('tr', {class: 'row-note'}, element('td', {colspan: String(columns.length)}, note))] : [row];
}

function tableOf({caption, columns, rows}, label) {
  const table = element('table', {'aria-label': !caption && label});
  if (caption) table.append(element('caption', {}, caption));
  if (columns.some(({text}) => text))
    table.append(element('thead', {}, element('tr', {}, ...columns.map(({text, number}) =>
      element(text ? 'th' : 'td', {scope: text && 'col', class: number && 'number'}, text)))));
  table.append(element('tbody', {}, ...rows.flatMap((row) => rowOf(row, columns))));
  return element('div', {class: 'scroll'}, table);
}

const cardOf = ({title, tone, headline, text, link}) => element('div', {class: `card ${tone || ''}`.trim()},
  element('p', {class: 'card-scene'}, link ? element('a', {href: link}, title) : title),
  element('p', {class: 'card-verdict'}, headline), element('p', {class: 'card-other'}, text));

function plotOf({title, unit, text, shape, data}) {
  const place = element('div', {class: 'plot'});
  Object.assign(place.dataset, data);
  return element('figure', {class: shape}, element('figcaption', {}, element('b', {}, title),
    unit && element('span', {class: 'unit'}, ` ${unit}`), text && ` — ${text}`), place);
}

// Each kind of part has a key of its own. heading: above the part.
const kinds = {
  rows: (table, heading) => tableOf(table, heading),
  lines: ({lines}) => element('pre', {tabindex: '0'}, lines),  // wide lines are scrolled by keys
  lead: ({lead}) => element('p', {class: 'lead'}, lead),
  cards: ({cards}) => element('section', {class: 'cards', 'aria-label': 'in short'}, ...cards.map(cardOf)),
  plots: ({plots}) => element('div', {class: 'plot-grid'}, ...plots.map(plotOf)),
  maps: ({maps}) => element('section', {class: 'map-set', 'data-index': String(maps)}),
  summary: ({summary, pre}) => element('details', {}, element('summary', {}, summary), element('pre', {}, pre)),
  text: (sentence) => element('p', {class: 'note'}, ...toned(sentence)),
};

function sectionOf({id, title, conditions, parts, class: kind}, level) {
  const section = element('section', {id, class: title ? 'scene' : kind});
  if (title) section.append(element('div', {class: 'scene-head'}, element(`h${level}`, {}, title),
    conditions && element('p', {class: 'conditions'}, conditions)));
  layOut(section, parts, title ? level + 1 : level);
  return section;
}

// level: of the headings. A heading begins a section, which ends at the next one.
export function layOut(into, parts, level = 2) {
  let place = into, heading;
  for (const part of parts) {
    if (part.heading) {
      ({heading} = part);
      place = element('section', {}, element(`h${level}`, {}, heading));
      into.append(place);
      continue;
    }
    if (part.parts || part.summary) place = into;
    const kind = Object.keys(kinds).find((key) => key in part);
    place.append(part.parts ? sectionOf(part, level) : kinds[kind](part, heading));
  }
}
