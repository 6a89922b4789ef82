// Parts of a run to which the page can zoom: the whole run; the first touch, from a tenth of a turn before to one turn after the
// first touch of any run, if there is one; the last two turns.
export function windowsOf({end, speed, sides}) {
  const turn = speed === 0 ? 0.05 * end : Math.min(2 * Math.PI / Math.abs(speed), end);
  const touch = Math.min(end, ...sides.map((side) => side.first_touch ?? end));
  const first = touch < end ? [{name: 'first touch', from: Math.max(0, touch - 0.1 * turn), to: Math.min(end, touch + turn)}] : [];
  return [{name: 'whole run', from: 0, to: end}, ...first, {name: 'last turns', from: Math.max(0, end - 2 * turn), to: end}];
}
