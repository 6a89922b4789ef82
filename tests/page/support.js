// Pages of the program in Debian's Chromium, driven as a reader would.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';

const top = path.resolve(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname), '../..');
const {chromium} = await import(path.join(top, 'build/npm/node_modules/playwright-core/index.mjs'));
const program = process.env.ROTORUB_BINARY || path.join(top, 'build/bin/rotorub');
// Tests that only a nightly run does: test(name, nightly, ...).
const nightly = {skip: process.env.ROTORUB_NIGHTLY !== '1'};
const scene = (name) => path.join(top, 'mjcf', `${name}.toml`);

// Runs the program in a folder of its own, which goes when the tests end; `codes`: what it may end with. Gives what it
// printed, where it ended with 0.
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'rotorub-page-'));
process.on('exit', () => fs.rmSync(folder, {recursive: true, force: true}));
function rotorub(args, codes = [0]) {
  try {
    return execFileSync(program, args, {cwd: folder, stdio: ['ignore', 'pipe', 'pipe']});
  } catch (error) {
    assert.ok(codes.includes(error.status), `rotorub ${args.join(' ')}: ${error.status} ${error.stderr}`);
  }
}

// WebGL by software, so that it is the same everywhere; without it where asked.
function launch({webgl = true} = {}) {
  const args = webgl ? ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'] : ['--disable-3d-apis'];
  if (process.getuid() === 0) args.push('--no-sandbox');
  return chromium.launch({executablePath: process.env.CHROMIUM || '/usr/bin/chromium', args});
}

// A page with its folded parts open, unless `folded`; with all that it says on the console and asks of a network in `said`. Reduced motion: a smooth scroll that
// is still under way would move the page between a look and a click.
async function open(browser, file, {width = 1200, height = 1000, colorScheme = 'light', folded = false} = {}) {
  const page = await browser.newPage({viewport: {width, height}, colorScheme, reducedMotion: 'reduce'});
  page.setDefaultTimeout(120000);  // a busy machine takes half a minute to draw a large page
  page.said = [];
  page.on('console', (message) => page.said.push(`${message.type()}: ${message.text()}`));
  page.on('pageerror', (error) => page.said.push(`error: ${error.stack}`));
  page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) page.said.push(`request: ${request.url()}`); });
  await page.goto(`file://${path.join(folder, file)}`);
  await page.waitForFunction(() => window.Plotly && document.querySelector('.plot .main-svg, .player'));
  await page.waitForFunction(`(page.players || []).every((p, k) => k > 0 || !p || p.firstDrawn)`);
  if (!folded) await page.evaluate(unfold);
  return page;
}

function unfold() {
  for (const button of document.querySelectorAll('.more-plots')) button.click();
  for (const part of document.querySelectorAll('details.later')) part.open = true;
}

const state = (page, k = 0) => page.evaluate(`page.players[${k}].state()`);
// Brings a part of the k-th scene on the screen, in the middle of what the sticky bars leave.
async function bring(page, selector, k = 0) {
  await page.evaluate(([s, i]) => document.querySelectorAll('.scene')[i].querySelector(s)
    .scrollIntoView({block: 'center', behavior: 'instant'}), [selector, k]);
  await page.waitForTimeout(150);
}
// And waits until the frames after it are drawn: on a busy machine they are not at once.
const seek = (page, t, k = 0) => page.evaluate(async ([i, at]) => {
  window.page.players[i].clock.seek(at);
  for (let frame = 0; frame < 3; ++frame) await new Promise((drawn) => { requestAnimationFrame(drawn); });
}, [k, t]);
// Plots are drawn one in each frame, so a check may have to wait: on a busy machine for some ten seconds.
async function eventually(check) {
  for (const end = Date.now() + 60000; ;) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() > end) throw error;
      await new Promise((go) => { setTimeout(go, 50); });
    }
  }
}

// Rows of a run's series.csv as objects.
function series(file) {
  const [header, ...lines] = fs.readFileSync(path.join(folder, file), 'utf8').trim().split('\n');
  const names = header.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((field, k) => [names[k], field])));
}

export {assert, bring, eventually, folder, launch, nightly, open, rotorub, scene, seek, series, state, top};
