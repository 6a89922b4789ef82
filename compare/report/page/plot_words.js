// The plots of a page that no clock moves, by the data that they show: titles, and words on how to read them. A plot
// stands on the page if its data does.

const errorsOf = ({series}) => series.flatMap(({family, points}) => points.filter(({limit}) => family === 'mujoco' && limit > 0));

const bench = ({benches}, index) => [
  {plot: 'precision', shape: 'wide tall', title: 'Error against time',
    text: 'to the left is faster, lower is more exact; hollow: it has settled to something else than the reference; dotted: the clearance'},
  {plot: 'step', shape: 'tall', title: 'Error against step', text: 'in brackets the order, fitted'},
  errorsOf(benches[index]).length && {plot: 'limit', shape: 'tall', title: 'MuJoCo against its own limit',
    text: 'solid: distance to its own finest step; dotted: to the reference. What stays between them no step takes away'},
];

const kinds = {bench};

// Parts of a page (layout.js) with their plots: of {plots: kind, index} those for which `data` has the data.
export const withPlots = (parts, data) => parts.map((part) => {
  if (part.parts) return {...part, parts: withPlots(part.parts, data)};
  if (!part.plots) return part;
  return {plots: kinds[part.plots](data, part.index).filter((one) => one).map(({plot, ...words}) =>
    ({...words, data: {of: part.plots, plot, ...(part.index === undefined ? {} : {index: part.index})}}))};
});
