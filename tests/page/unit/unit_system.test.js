// The units of a page: texts, headings and figures in the chosen system.
import assert from 'node:assert/strict';
import {afterEach, test} from 'node:test';
import {choose, conversion, figureInUnits, headingInUnits, inUnits, unitOf} from '../../../compare/report/page/unit_system.js';

afterEach(() => choose('si'));

test('SI leaves all as it is', () => {
  const figure = {data: [{y: [1]}], layout: {yaxis: {}}};
  assert.equal(inUnits('gap 12.3 µm, 4 N'), 'gap 12.3 µm, 4 N');
  assert.equal(figureInUnits(figure, 'µm').data, figure.data);
  assert.equal(conversion('µm'), null);
});

test('numbers are converted with their units, and so are those that share a unit', () => {
  choose('mil');
  const texts = {'gap 12.3 µm': 'gap 0.484 mil', '1,234 N': '277.4 lbf', '−53.1 N, 2e3 N': '−11.9 lbf, 450 lbf', '55.15 mm/s instead of 0.09345, x 3': '2.171 in/s instead of 0.003679, x 3',
    '0.1 to 5 µm': '0.00394 to 0.197 mil', '0.1967 N s': '0.04422 lbf s'};
  for (const [si, mil] of Object.entries(texts)) assert.equal(inUnits(si), mil);
  for (const other of ['9.81 m/s²', '3000 rpm', '50 Hz', '5 ms', 'v2 N', '3 points']) assert.equal(inUnits(other), other);
  assert.equal(inUnits('254', 'µm'), '10');
  assert.equal(inUnits('254', 'rpm'), '254');
  choose('mm');
  assert.deepEqual(['12.3 µm', '5 N', '2 mN s'].map((text) => inUnits(text)), ['0.0123 mm', '5 N', '0.002 N s']);
});

test('headings name their units at the end', () => {
  choose('mil');
  assert.deepEqual(['before / (m/s)', 'amplitude / µm', 'mean normal force, N', 'k / (N/m)', ' µm', 'phase / °', 'within'].map(headingInUnits),
    ['before / (in/s)', 'amplitude / mil', 'mean normal force, lbf', 'k / (lbf/in)', ' mil', 'phase / °', 'within']);
  assert.deepEqual(['x / µm', 't / s', undefined].map(unitOf), ['µm', undefined, undefined]);
});

test('a figure has its points, marks, letters and hover boxes in the same units', () => {
  choose('mil');
  const {data, layout, factors} = figureInUnits({
    data: [{x: [1, 2], y: [25.4, null], customdata: [[3, 254]], hovertemplate: '%{x} s: %{y:.3g} µm, %{customdata[1]:.3g} µm'}, {x: [0], y: [254], yaxis: 'y2'}],
    layout: {xaxis: {title: {text: 't / s'}, range: [0, 2]}, yaxis: {type: 'log', range: [1, 2]}, yaxis2: {title: {text: 'y / µm'}, range: [0, 254], dtick: 50},
      shapes: [{x0: 1, x1: 1, yref: 'paper', y0: 0, y1: 1}, {xref: 'paper', x0: 0, x1: 1, y0: 25.4, y1: 25.4}, {type: 'path', yref: 'y2', path: 'M1,254L2,0Z'}],
      annotations: [{x: 1, y: Math.log10(25.4), text: '25.4 µm'}]}}, 'µm');
  assert.ok(Math.abs(data[0].y[0] - 1) < 1e-12);
  assert.deepEqual([data[0].x, data[0].y[1], data[1].y.map(Math.round)], [[1, 2], null, [10]]);
  assert.equal(data[0].hovertemplate, '%{x} s: %{y:.3g} mil, %{customdata[1]:.3g} mil');
  assert.deepEqual(data[0].customdata.map((row) => row.map(Math.round)), [[3, 10]]);
  assert.deepEqual(layout.yaxis.range.map((end) => end.toFixed(6)), [1, 2].map((end) => (end - Math.log10(25.4)).toFixed(6)));
  assert.deepEqual([layout.yaxis2.title.text, Math.round(layout.yaxis2.range[1]), layout.yaxis2.dtick], ['y / mil', 10, undefined]);
  assert.deepEqual([layout.shapes[0].y1, layout.shapes[1].x1, layout.shapes[1].y0.toFixed(6)], [1, 1, '1.000000']);
  assert.match(layout.shapes[2].path, /^M1,(10|9\.99\d+)L2,0Z$/);
  assert.ok(Math.abs(layout.annotations[0].y) < 1e-12);
  assert.equal(layout.annotations[0].text, '1 mil');
  assert.deepEqual([factors.x, factors.y.toFixed(6)], [1, (1 / 25.4).toFixed(6)]);
});
