// What is shown, in an address and back.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {addressOf, stateIn} from '../../../compare/report/page/address.js';

test('what is shown comes back from its address', () => {
  const hash = addressOf('scene-1', {t: 0.1071, range: [0.1, 0.12], hidden: new Set(['cone', 'a,b&c'])});
  assert.equal(hash, '#scene-1?t=0.1071&from=0.1&to=0.12&hide=cone&hide=a%2Cb%26c');
  assert.deepEqual(stateIn(hash, 'scene-1'), {t: 0.1071, from: 0.1, to: 0.12, hidden: new Set(['cone', 'a,b&c'])});
  assert.equal(stateIn(hash, 'scene-2'), null);
  assert.equal(stateIn('#scene-1-figures', 'scene-1'), null);
});

test('of an address that is no number nothing is taken', () => {
  assert.deepEqual(stateIn('#scene-1?t=soon&from=', 'scene-1'), {t: undefined, from: undefined, to: undefined, hidden: new Set()});
});
