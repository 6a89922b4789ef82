// What a plot's buttons write.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {csvOf, fileName} from '../../../compare/report/page/save.js';

test('the points of lines, a row each', () => {
  const text = csvOf([{name: 'native', x: [0, 1e-3], y: [5, null]}, {name: 'a, "b"', y: [7]}]);
  assert.equal(text, 'trace,x,y\r\nnative,0,5\r\nnative,0.001,\r\n"a, ""b""",0,7\r\n');
});

test('the cells of a map', () => {
  const text = csvOf([{name: 'map', x: [1, 2], y: [10], z: [Float64Array.of(0.5, 0.25)]}]);
  assert.equal(text, 'trace,x,y,z\r\nmap,1,10,0.5\r\nmap,2,10,0.25\r\n');
});

test('a file is named by its plot', () => {
  assert.equal(fileName('Normal force, contact "a"'), 'normal-force-contact-a');
  assert.equal(fileName('µ'), 'plot');
});
