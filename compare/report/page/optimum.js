// The page of `rotorub optimise`, from the evaluated scenes: the convergence of the best value, maps of all evaluations, and
// a table of the best values.
import {answerOf, sheetsOf} from './answer.js';
import {shownUnit} from './linear_maps.js';
import {axes, css, growBy, layout, legendBelow, number} from './style.js';

const withUnit = (value, unit) => (value === null ? '' : `${number(value, 5)}${unit ? ` ${unit}` : ''}`);

// The evaluated scenes as columns, in units as people read them, from compare/optimise/output.cc.
export function searchOf({keys, evaluations, constraints, ...goal}) {
  const units = keys.map(({unit}) => shownUnit(unit)), of = (value) => evaluations.map(value);
  return {...goal, column: of(({figure}) => figure), feasible: of(({feasible}) => feasible), status: of(({status}) => status),
    keys: keys.map((key, k) => ({...key, unit: units[k].name, range: key.range.map((end) => units[k].perSi * end)})),
    values: keys.map((_, k) => of(({values}) => units[k].perSi * values[k])),
    constraints: constraints.map((one, k) => ({...one, values: of(({constraints: reached}) => reached[k] ?? null)}))};
}

// The data of a map with one mark for each evaluation, in the format of a sweep.
export function searchMap({figure, unit, maximise, best, keys, values, column, constraints, feasible, status}) {
  const statuses = ['ok', ...new Set(status.filter((word) => word !== 'ok'))], of = (name, more, meaning) => ({name, unit: more, meaning, word: false});
  return {kind: 'marks', keys, values, best, feasible, statuses, status: status.map((word) => statuses.indexOf(word)),
    figures: [of(figure, unit, `the figure to ${maximise ? 'maximise' : 'minimise'}`),
      ...constraints.map((one) => of(one.name, one.unit, `constraint: ${one.text}`)), of('evaluation', '', 'in the order of the search, from 0')],
    columns: [column, ...constraints.map((one) => one.values), column.map((_, k) => k)]};
}

// The best value so far after each evaluation; null before the first that meets the constraints.
export function bestSoFar({maximise, column, feasible}) {
  let best = null;
  return column.map((value, k) => {
    if (feasible[k] && (best === null || (maximise ? value > best : value < best))) best = value;
    return best;
  });
}

export function convergenceFigure(search, plot) {
  const {figure, unit, best, column, feasible} = search, evaluations = column.map((_, k) => k);
  const marks = (name, isSo, marker) => {
    const shown = evaluations.filter((k) => column[k] !== null && isSo(k));
    return shown.length ? [{type: 'scatter', mode: 'markers', name, x: shown, y: shown.map((k) => column[k]), marker,
      hovertemplate: `evaluation %{x}: %{y:.5g} ${unit}<extra>${name}</extra>`}] : [];
  };
  const soFar = {type: 'scatter', mode: 'lines', name: 'best so far', x: evaluations, y: bestSoFar(search), line: {color: css('--native'), width: 2, shape: 'hv'},
    hovertemplate: `evaluation %{x}: %{y:.5g} ${unit}<extra>best so far</extra>`};
  const given = column.filter((value) => value !== null), low = Math.min(...given), high = Math.max(...given);
  const data = [soFar, ...marks('meets the constraints', (k) => feasible[k] && k !== best, {size: 7, color: css('--coulomb')}),
    ...marks('violates a constraint', (k) => !feasible[k], {size: 8, symbol: 'x-thin', line: {width: 2, color: css('--bad')}}),
    ...marks('best', (k) => k === best, {size: 15, symbol: 'star', color: css('--good')})];
  const {legend, height} = legendBelow(data.map(({name}) => name), plot.clientWidth);
  growBy(plot, height);
  return {data, layout: layout({hovermode: 'closest', showlegend: true, legend, margin: {l: 72, r: 24, t: 10, b: 44 + height},
    xaxis: axes({title: {text: 'evaluation', standoff: 6}, zeroline: false}),
    yaxis: axes({title: {text: figure + (unit ? ` / ${unit}` : ''), standoff: 8}, type: low > 0 && high > 100 * low ? 'log' : undefined, zeroline: false})})};
}

function bestTable({figure, unit, maximise, best, keys, values, column, constraints}) {
  const rows = [...keys.map(({name, unit: of, range: [from, to]}, k) => [name, withUnit(values[k][best], of), `from ${number(from, 5)} to ${withUnit(to, of)}`]),
    [figure, withUnit(column[best], unit), maximise ? 'maximised' : 'minimised'],
    ...constraints.map((one) => [one.name, withUnit(one.values[best], one.unit), one.text])];
  return {caption: 'The best values', class: 'cards-when-small', columns: ['', 'best', 'range or limit'].map((text, k) => ({text, number: k === 1})), rows: rows.map((cells) => ({cells}))};
}

export function optimiseParts({page: {parts}, search, texts: [scene]}) {
  // If there is a best value, the first part (how the search ended) comes last.
  const answer = search.best === null ? parts : [...parts.slice(1), parts[0]];
  return [answerOf(answer), ...(search.best === null ? [] : [sheetsOf([bestTable(search)])]),
    ...(search.column.some((value) => value !== null) ? [{class: 'plots', parts: [{plots: 'convergence'}]}] : []),
    {lead: 'Each mark is a scene that was tried.'}, {maps: 0},
    sheetsOf([{figures: 0}, ...(scene ? [{summary: 'The best scene\'s text', pre: scene}] : [])])];
}
