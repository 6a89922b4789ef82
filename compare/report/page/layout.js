// Lays the parts of a result out as HTML: those of page_json() (compare/result/result.h), and what only a page has:
//   {cards: [{title, tone, headline, text, link}]}   the page's short answers
//   {lead: text}                                     what the page is about
//   {plots: [{title, unit, text, shape, data}]}      places of plots; data: their data attributes
//   {maps: index}                                    the place of a set of maps
//   {summary, pre}                                   a text that is folded away
//   {details, id, open, parts}                       a part that a reader can fold; details: its heading
//   {facts: [[name, text]]}                          words and what they mean
//   {markup}                                         of html.js
// A part with `contents` is in the page's list of contents, under that name.
// No text is read as HTML: a name such as "<b>" is shown as it is written.
import {withCode} from './html.js';
import {isRun} from './style.js';

// An element with attributes and children; those without a value are left out.
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) if (value) made.setAttribute(key, value);
  made.append(...children.filter((child) => child));
  return made;
}

const coded = (text) => withCode(text, (piece) => element('code', {}, piece));

const toned = ({text, tone, toned: words}) => {
  const at = tone && words ? text.indexOf(words) : -1;
  return at < 0 ? coded(text) : [text.slice(0, at), element('b', {class: tone}, words), text.slice(at + words.length)];
};

const chipOf = (text, {tone, note}) => element('span', {class: `chip ${tone || ''}`.trim(), title: note}, element('span', {class: 'word'}, text));
function cellOf(cell) {
  if (typeof cell === 'string') return [cell];
  if (cell.beside) return [cell.text, element('br'), cell.note ? chipOf(cell.beside, cell) : element('span', {class: 'unit'}, cell.beside)];
  return [cell.tone ? chipOf(cell.text, cell) : element('span', {title: cell.note}, cell.text)];
}

// The first cell of a row is its heading, unless it is a number.
function rowOf({cells, note}, columns, labelled) {
  const row = element('tr', {}, ...cells.map((cell, k) => {
    const {number} = columns[k], isHeading = k === 0 && !number, isWord = !/\d/.test(cell.text ?? cell);
    return element(isHeading ? 'th' : 'td', {scope: isHeading && 'row', class: number && (isWord ? 'number words' : 'number'),
      'data-label': labelled && !isHeading && columns[k].text}, ...cellOf(cell));
  }));
  return note ? [row, element('tr', {class: 'row-note'}, element('td', {colspan: String(columns.length)}, note))] : [row];
}

// A column of a run has the run's colour in its heading. class: "cards-when-small" names each cell by its column.
function tableOf({caption, columns, rows, class: kind}, label) {
  const table = element('table', {class: kind, 'aria-label': !caption && label});
  if (caption) table.append(element('caption', {}, caption));
  if (columns.some(({text}) => text))
    table.append(element('thead', {}, element('tr', {}, ...columns.map(({text, number}) =>
      element(text ? 'th' : 'td', {scope: text && 'col', class: [number && 'number', isRun(text) && `side-${text}`].filter(Boolean).join(' ')}, text)))));
  table.append(element('tbody', {}, ...rows.flatMap((row) => rowOf(row, columns, kind === 'cards-when-small'))));
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

// Each kind of part is recognised by its key. heading: the heading above the part.
const kinds = {
  rows: (table, heading) => tableOf(table, heading),
  lines: ({lines}) => element('pre', {tabindex: '0'}, lines),  // wide lines are scrolled by keys
  lead: ({lead}) => element('p', {class: 'lead'}, lead),
  cards: ({cards}) => element('section', {class: 'cards', 'aria-label': 'in short'}, ...cards.map(cardOf)),
  plots: ({plots}) => element('div', {class: 'plot-grid'}, ...plots.map(plotOf)),
  maps: ({maps}) => element('section', {class: 'map-set', 'data-index': String(maps)}),
  facts: ({facts}) => element('dl', {class: 'facts'}, ...facts.map(([name, text]) =>
    element('div', {}, element('dt', {}, name), element('dd', {}, text)))),
  markup: ({markup}) => document.createRange().createContextualFragment(markup.text),
  list: ({list}) => element('ul', {class: 'note'}, ...list.map((text) => element('li', {}, ...coded(text)))),
  summary: ({summary, pre}) => element('details', {}, element('summary', {}, summary), element('pre', {}, pre)),
  text: (sentence) => element('p', {class: 'note'}, ...toned(sentence)),
};

function detailsOf({details, id, open, contents, parts, class: kind}, level) {
  const folded = element('details', {id, class: kind || 'later', open: open && 'open', 'data-contents': contents},
    element('summary', {}, element(`h${level}`, {}, details)));
  layOut(folded, parts, level + 1);
  return folded;
}

// scene: the number of the scene whose runs it shows.
function sectionOf({id, title, conditions, tone, contents, scene, parts, class: kind}, level) {
  const section = element('section', {id, class: kind || (title && 'scene'), 'data-contents': contents, 'data-scene': scene});
  if (title) section.append(element('div', {class: 'scene-head'}, element(`h${level}`, {}, title),
    conditions && element('p', {class: `conditions ${tone || ''}`.trim()}, conditions)));
  layOut(section, parts, title ? level + 1 : level);
  return section;
}

// Texts with dashes that follow each other become a list.
function listed(parts) {
  const all = [];
  for (const part of parts) {
    const last = all[all.length - 1];
    if (part.mark !== '-') all.push(part);
    else if (last?.list) last.list.push(part.text);
    else all.push({list: [part.text]});
  }
  return all;
}

// level: of the headings. A heading begins a section, which ends at the next one.
export function layOut(into, parts, level = 2) {
  let place = into, heading;
  for (const part of listed(parts)) {
    if (part.heading) {
      ({heading} = part);
      place = element('section', {}, element(`h${level}`, {}, heading));
      into.append(place);
      continue;
    }
    if (part.parts || part.summary) place = into;
    const kind = Object.keys(kinds).find((key) => key in part);
    if (part.details) place.append(detailsOf(part, level));
    else place.append(part.parts ? sectionOf(part, level) : kinds[kind](part, heading));
  }
}
