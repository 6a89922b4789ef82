// What axe finds in the pages, everything drawn, light and dark: nothing.
import fs from 'node:fs';
import path from 'node:path';
import {after, before, test} from 'node:test';
import {assert, folder, launch, nightly, open, rotorub, scene, top} from './support.js';

const axe = fs.readFileSync(path.join(top, 'build/npm/node_modules/axe-core/axe.min.js'), 'utf8');
let browser;
before(async () => {
  rotorub(['compare', scene('bench_ring'), '--end', '0.02', '--twins', '0', '--no-video', '--quiet', '-o', '.'], [0, 1]);
  rotorub(['modes', scene('bench_whip'), '--quiet', '-o', 'whip']);
  fs.writeFileSync(path.join(folder, 'study.toml'), `scene = "${scene('bench_drop')}"\n[sample]\nkind = "grid"\n[[vary]]\nkey = "contact.friction"\n` +
    'from = 0.1\nto = 0.4\ncount = 3\n[[vary]]\nkey = "contact.restitution"\nvalues = [0.2, 0.6]\n[run]\nend = "20 ms"\n');
  rotorub(['sweep', 'study.toml', '--quiet', '-o', 'sweep']);
  if (!nightly.skip) {
    rotorub(['run', scene('bench_ring'), '--end', '0.05', '--quiet', '-o', 'ring']);
    rotorub(['plot', 'ring', '--quiet']);
    rotorub(['modes', scene('touchdown'), '--quiet', '-o', 'touchdown']);
    rotorub(['bench', scene('bench_drop'), '--engines', 'native-verlet', '--steps', '20us', '--repeats', '1', '--end', '12ms', '--quiet', '-o', 'bench']);
  }
  browser = await launch();
});
after(() => browser?.close());

// Each day three pages, in one theme each; nightly every kind of page in both.
const daily = ['report.html light', 'whip/modes.html dark', 'sweep/sweep.html light'];
for (const file of ['report.html', 'ring/plot.html', 'touchdown/modes.html', 'whip/modes.html', 'sweep/sweep.html', 'bench/bench.html']) {
  for (const colorScheme of ['light', 'dark']) {
    test(`${file}, ${colorScheme}`, daily.includes(`${file} ${colorScheme}`) ? {} : nightly, async () => {
      const page = await open(browser, file, {colorScheme});
      await page.evaluate(async () => {
        for (const fold of document.querySelectorAll('details')) fold.open = true;
        for (let y = 0; y < document.body.scrollHeight; y += 700) {
          scrollTo(0, y);
          await new Promise((done) => { setTimeout(done, 100); });
        }
      });
      await page.evaluate(axe);
      const found = await page.evaluate(async () => (await window.axe.run(document, {resultTypes: ['violations']})).violations
        .map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((node) => node.target.join(' ')).join(', ')}`));
      assert.deepEqual(found, []);
      await page.close();
    });
  }
}
