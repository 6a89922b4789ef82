// The native model as the pages' module, under node, beside the program: the same impacts, events and last row.
import fs from 'node:fs';
import path from 'node:path';
import {after, before, test} from 'node:test';
import zlib from 'node:zlib';
import {nativeModel} from '../../compare/report/page/native.js';
import {assert, folder, rotorub, scene, series, top} from './support.js';

const kApart = 1e-9;  // of the largest of its kind

let module;
before(async () => {
  module = await WebAssembly.compile(zlib.gunzipSync(fs.readFileSync(path.join(top, 'build/lib/rotorub_native.wasm.gz'))));
});

// What the two sides share, as columns: the greatest difference, over the largest value of the column.
function apart(ours, theirs) {
  assert.equal(ours.length, theirs.length);
  const most = Math.max(...theirs.map(Math.abs));
  return most > 0 ? Math.max(...theirs.map((value, k) => Math.abs(value - ours[k]))) / most : Math.max(0, ...ours.map(Math.abs));
}

// name: of the scene; changes, as --set takes them.
async function compared(name, changes) {
  const file = scene(name), out = name.replaceAll('/', '-');
  rotorub(['run', file, '--quiet', '-o', out, ...changes.flatMap((change) => ['--set', change])]);
  const native = await nativeModel(module);
  const answer = native.run(fs.readFileSync(file, 'utf8'), path.basename(file), changes);
  assert.equal(answer.refused, undefined);
  const figures = native.figures(), impacts = series(`${out}/impacts.csv`), events = series(`${out}/events.csv`);
  const column = (rows, of) => rows.map((row) => Number(row[of]));
  assert.deepEqual(figures.events.map(([, event]) => event), events.map(({event}) => event));
  const found = {
    'times of events': apart(figures.events.map(([t]) => t), column(events, 't')),
    'times of impacts': apart(figures.impacts.map(([t]) => t), column(impacts, 't')),
    'normal impulses': apart(figures.impacts.map((i) => i[1]), column(impacts, 'normal_impulse')),
    'friction impulses': apart(figures.impacts.map((i) => i[2]), column(impacts, 'friction_impulse')),
  };
  // Of the last row each value beside the largest that its column has.
  const rows = series(`${out}/series.csv`), last = rows[rows.length - 1];
  for (const [of, value] of Object.entries(figures.end)) {
    if (of.endsWith('mode')) assert.equal(['free', 'slide', 'stick'][value], last[of]);
    else found[`${of} at the end`] = apart([...column(rows.slice(0, -1), of), value], column(rows, of));
  }
  return {impacts: impacts.length, found};
}

after(() => fs.rmSync(folder, {recursive: true, force: true}));

// Impact after impact in a run that bounces; stick and slip, a controller, two contacts, a shaft that runs up, a compliant
// contact, each of the fixed steps. The two C libraries differ in the last bit of exp, pow, ..., which a long chaotic run shows.
for (const [name, least, ...changes] of [
  ['paper_sliding', 6],
  ['paper_sliding', 6, 'contact.friction=0.45', 'contact.clearance=0.4 mm', 'controller.preload=20 N'],
  ['paper_passive', 500],
  ['paper_passive', 100, 'run.integrator=verlet', 'run.end=0.2'],
  ['paper_passive', 20, 'run.integrator=paper', 'run.end=0.12'],
  ['bench_ring', 20],
  ['two_catchers', 10],
  ['blade_loss', 1],
  ['run_up_rub', 1],
  ['compliant_ring', 1],
  ['falling_friction', 0, 'run.end=0.1'],  // then each stick ends on its last bits
]) {
  test(`${name} ${changes.join(', ')}`, async () => {
    const {impacts, found} = await compared(name, changes);
    assert.ok(impacts >= least, `${impacts} impacts`);
    for (const [of, share] of Object.entries(found)) assert.ok(share <= kApart, `${of}: ${share} apart`);
  });
}

test('what is no scene, and what asks for a file, is refused with a reason', async () => {
  const native = await nativeModel(module), text = fs.readFileSync(scene('bench_ring'), 'utf8');
  assert.match(native.run(text, 'ring.toml', ['contact.friction=-1']).refused, /contact\.friction.*>= 0/s);
  assert.match(native.run('[run', 'none.toml', []).refused, /none\.toml:1/);
  assert.match(native.run(text, 'ring.toml', ['controller={kind="library",library="own.so",sample_time=1e-4}']).refused, /controller\.library: is not loaded/);
});
