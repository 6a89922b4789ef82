// The section of a synchronous rub is one place.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {ranges} from '../../../compare/report/page/whirl.js';

const width = ([low, high]) => high - low;

test('places that differ by next to nothing are not scaled up to a cloud', () => {
  const [x, y] = ranges([[300, 400], [300.01, 400], [300, 399.99]]);
  assert.ok(Math.abs(width(x) - 50) < 0.01 && Math.abs(width(y) - 50) < 0.01, `${width(x)} um of 500`);
});

test('a cloud fills the picture, and nothing has no range', () => {
  const [x, y] = ranges([[-100, 0], [100, 50]]);
  assert.ok(Math.abs(width(x) - 220) < 1e-9 && Math.abs(width(y) - 220) < 1e-9);
  assert.equal(ranges([]), null);
});
