// The figures beside the pictures, of one instant, with their units.
import {units} from './units.js';

const pair = (values, unit) => values.map(unit).join(', ');
// Name and text of each reading; null if the run does not have it. Signs are as in the series (see the page's plots). Readings
// that do not belong to a contact appear only beside the first one.
const kinds = [
  ['gap', (p, run) => p.gap === null ? null : units.gap(p.gap, run.finest)],
  ['gap rate', (p) => p.gapRate === null ? null : units.speed(Math.abs(p.gapRate) < 1e-6 ? 0 : p.gapRate)],
  ['force, a sample', (p) => p.force === null ? null : units.force(p.force)],
  ['normal force', (p) => p.normal === null ? null : units.force(p.normal)],
  ['friction force', (p) => p.friction === null ? null : units.force(p.friction)],
  ['last impact', (p, run) => {
    const k = run.impactsUntil(p.t);
    return run.has('impacts') ? k > 0 ? units.impulse(run.impacts[k - 1].normal) : 'none yet' : null;
  }],
  ['control x, y', (p) => p.control && pair(p.control, units.force)],
  ['current 1, 2', (p) => p.current && pair(p.current, units.current)],
  ['spin', (p, run) => p.speed === null || run.number > 0 ? null : units.rpm(p.speed)],
  ['ring’s spin', (p, run) => run.has('ring_speed') ? units.rpm(run.value('ring_speed', p.t)) : null],
  ['rotor x, y', (p) => pair(p.rotor, units.length)],
];

// Shows the readings of a run at one of its contacts. list, mode: the elements.
export function showReadings({list, mode}, run, pose) {
  const inside = run.within(pose.t);
  const rows = !inside ? [] : kinds.map(([name, text]) => [name, text(pose, run)]).filter(([, text]) => text !== null);
  if (list.children.length !== rows.length) list.innerHTML = rows.map(([name]) => `<div><dt>${name}</dt><dd></dd></div>`).join('');
  rows.forEach(([name, text], r) => {
    list.children[r].firstChild.textContent = name;
    list.children[r].lastChild.textContent = text;
  });
  mode.textContent = !inside ? 'no samples here' : pose.t > run.end + 1e-12 ? `ended at ${units.time(run.end)}` : pose.mode || '';
  mode.className = `mode ${pose.mode || ''}`;
}
