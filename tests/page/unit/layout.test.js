// The parts of a result as HTML, in a document of our own.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {layOut} from '../../../compare/report/page/layout.js';

// An element as it would be written; text is escaped as a browser does.
const escaped = (text) => String(text).replaceAll('&', '&amp;').replaceAll('<', '&lt;');
class Element {
  constructor(name) { Object.assign(this, {name, attributes: {}, children: [], dataset: {}}); }
  setAttribute(key, value) { this.attributes[key] = value; }
  append(...children) { this.children.push(...children); }
  get html() {
    const data = Object.entries(this.dataset).map(([key, value]) => [`data-${key}`, value]);
    const attributes = [...Object.entries(this.attributes), ...data].map(([key, value]) => ` ${key}="${escaped(value)}"`).join('');
    return `<${this.name}${attributes}>${this.children.map((child) => child.html ?? escaped(child)).join('')}</${this.name}>`;
  }
}
globalThis.document = {createElement: (name) => new Element(name)};

function laid(...parts) {
  const main = new Element('main');
  layOut(main, parts);
  return main.html.slice('<main>'.length, -'</main>'.length);
}

test('a table has a caption, the headings of its columns, and one of each row', () => {
  const table = {caption: 'figures', columns: [{text: 'name'}, {text: 'force / N', number: true}, {text: ''}],
    rows: [{cells: ['a', '1.5', '']}, {cells: ['b', '2', {text: 'no', tone: 'bad', note: 'why'}], note: 'more'}]};
  assert.equal(laid(table), '<div class="scroll"><table><caption>figures</caption>' +
    '<thead><tr><th scope="col">name</th><th scope="col" class="number">force / N</th><td></td></tr></thead><tbody>' +
    '<tr><th scope="row">a</th><td class="number">1.5</td><td></td></tr>' +
    '<tr><th scope="row">b</th><td class="number">2</td><td><span class="chip bad" title="why"><span class="word">no</span></span></td></tr>' +
    '<tr class="row-note"><td colspan="3">more</td></tr></tbody></table></div>');
});

test('a table without headings has the name of the part that it stands in', () => {
  assert.equal(laid({heading: 'poles'}, {columns: [{text: '', number: true}], rows: [{cells: ['1']}]}),
    '<section><h2>poles</h2><div class="scroll"><table aria-label="poles"><tbody><tr><td class="number">1</td></tr></tbody></table></div></section>');
});

test('a heading begins a part, and a section has parts of the next level', () => {
  assert.equal(laid({text: 'before'}, {heading: 'one'}, {text: 'of it'}, {heading: 'two'},
    {id: 'scenes-1', title: 'ring', conditions: '1 s', parts: [{heading: 'three'}, {lines: 'a\nb'}]}, {summary: 'text', pre: 'x = 1'}),
  '<p class="note">before</p><section><h2>one</h2><p class="note">of it</p></section><section><h2>two</h2></section>' +
    '<section id="scenes-1" class="scene"><div class="scene-head"><h2>ring</h2><p class="conditions">1 s</p></div>' +
    '<section><h3>three</h3><pre tabindex="0">a\nb</pre></section></section><details><summary>text</summary><pre>x = 1</pre></details>');
});

test('words of a sentence have its tone', () => {
  assert.equal(laid({text: 'run: ok', tone: 'good', toned: 'ok'}), '<p class="note">run: <b class="good">ok</b></p>');
  assert.equal(laid({text: 'run', tone: 'good', toned: 'ok'}), '<p class="note">run</p>');
});

test('cards and plots', () => {
  assert.equal(laid({cards: [{title: 'ring', tone: 'good', headline: 'yes', text: 'why', link: '#scenes-1'}]}),
    '<section class="cards" aria-label="in short"><div class="card good"><p class="card-scene"><a href="#scenes-1">ring</a></p>' +
    '<p class="card-verdict">yes</p><p class="card-other">why</p></div></section>');
  assert.equal(laid({plots: [{title: 'Polar', unit: 'µm', text: 'how', shape: 'square', data: {of: 'rotor', index: 0}}]}),
    '<div class="plot-grid"><figure class="square"><figcaption><b>Polar</b><span class="unit"> µm</span> — how</figcaption>' +
    '<div class="plot" data-of="rotor" data-index="0"></div></figure></div>');
});

test('the place of a set of maps', () => {
  assert.equal(laid({maps: 0}), '<section class="map-set" data-index="0"></section>');
});

test('a text is never HTML', () => {
  assert.equal(laid({title: '<b>nowhere', parts: []}, {text: '<i>'}, {heading: '</h2>'}),
    '<section class="scene"><div class="scene-head"><h2>&lt;b>nowhere</h2></div></section><p class="note">&lt;i></p><section><h2>&lt;/h2></h2></section>');
});

test('sentences with dashes become a list, and a part can be folded', () => {
  assert.equal(laid({text: 'a', mark: '-'}, {text: 'b', mark: '-'}, {text: 'c'}), '<ul class="note"><li>a</li><li>b</li></ul><p class="note">c</p>');
  assert.equal(laid({details: 'more', id: 'm', contents: 'More', open: true, parts: [{facts: [['step', '1 s']]}]}),
    '<details id="m" class="later" open="open" data-contents="More"><summary><h2>more</h2></summary>' +
    '<dl class="facts"><div><dt>step</dt><dd>1 s</dd></div></dl></details>');
});

test('a value has its difference below it, and a run its colour', () => {
  const table = {class: 'cards-when-small', columns: [{text: 'figure'}, {text: 'cone', number: true}],
    rows: [{cells: [{text: 'force', note: 'mean'}, {text: '2', beside: '+3 %', tone: 'bad', note: 'outside'}]}]};
  assert.equal(laid(table), '<div class="scroll"><table class="cards-when-small"><thead><tr><th scope="col">figure</th><th scope="col" class="number side-cone">cone</th></tr></thead>' +
    '<tbody><tr><th scope="row"><span title="mean">force</span></th><td class="number" data-label="cone">2<br></br>' +
    '<span class="chip bad" title="outside"><span class="word">+3 %</span></span></td></tr></tbody></table></div>');
});
