// The point of a sweep that was clicked, or asked for by its number: its values, and the run behind it: a link to its page
// where it was kept, else the command that runs the point again and keeps it. `runs`: {command, kept: {point: link}, points}.
const element = (name, text, attributes = {}) => Object.assign(document.createElement(name), {textContent: text, ...attributes});

// One line for the shell: the point's number behind the study's command.
export const commandOf = (runs, point) => `${runs.command} --point ${point}`;

// Draws into `place`; `lines`: [name, value] of what the map knows of a point, of one that it does not draw nothing.
export function chosenPoint(place, runs, lines) {
  const number = element('input', '', {type: 'number', min: 0, max: runs.points - 1, step: 1});
  const label = element('label', 'run of point '), answer = element('div', '');
  label.append(number);
  answer.setAttribute('aria-live', 'polite');
  place.replaceChildren(label, answer);

  function choose(point) {
    number.value = String(point);
    const kept = runs.kept[point], list = element('p', '');
    lines(point).forEach(([name, value]) => { list.append(element('b', `${name} `), `${value}  `); });
    const way = kept ? element('p', '') : element('p', 'This run was not kept. It is run again, and its page made, by');
    if (kept) way.append(element('a', `Open the run of point ${point}`, {href: kept}));
    answer.replaceChildren(list, way, ...(kept ? [] : [element('pre', commandOf(runs, point), {tabIndex: 0, className: 'command'})]));
  }
  number.addEventListener('change', () => {
    const point = Number(number.value);
    if (number.value !== '' && Number.isInteger(point) && point >= 0 && point < runs.points) choose(point);
    else answer.replaceChildren(element('p', `Points are 0 to ${runs.points - 1}.`));
  });
  return choose;
}
