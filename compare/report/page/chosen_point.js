// Shows the point of a sweep that was clicked or entered by its number: its values, and a link to the page of its run if the
// run was saved, otherwise the command that reruns and saves it. `runs`: {command, kept: {point: link}, points}.
const element = (name, text, attributes = {}) => Object.assign(document.createElement(name), {textContent: text, ...attributes});

// The shell command for a point: the study's command with the point's number.
export const commandOf = (runs, point) => `${runs.command} --point ${point}`;

// Draws into `place`. `lines`: for a point, the [name, value] pairs of the map; none for a point that the map does not draw.
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
