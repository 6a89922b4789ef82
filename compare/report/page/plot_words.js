// The plots of a page's results, by the data that they show: titles, and sentences on how to read them. A plot appears only
// if the page has its data.
import {beyondText, dampingScale, rpmText} from './campbell.js';
import {benchOf} from './precision.js';

const mujocoErrors = ({series}) => series.flatMap(({family, points}) => points.filter(({limit}) => family === 'mujoco' && limit > 0));

const bench = ({benches}, index) => [
  {plot: 'precision', shape: 'wide tall', title: 'Error against time',
    text: 'to the left is faster, lower is more exact; hollow: settled to another motion than the reference; dotted: the clearance'},
  {plot: 'step', shape: 'tall', title: 'Error against step', text: 'colours and dashes as above; the table below has the fitted orders'},
  mujocoErrors(benchOf(benches[index])).length && {plot: 'limit', shape: 'tall', title: 'MuJoCo against its own limit',
    text: 'colours as above; solid: distance to its own finest step; dotted: to the reference. No step removes the distance between them'},
];

const decrement = {plot: 'decrement', title: 'Logarithmic decrement',
  text: 'ln of the ratio of two successive swings, 2πζ/√(1−ζ²), of each whirl without contact; below 0 it grows'};

const bode = ({bode: shown}) => shown ? [
  {plot: 'bode', shape: 'wide tall', title: 'Bode plot', unit: 'unbalance response', text: 'amplitude and phase of the response to ' +
    'unbalance at each constant speed, without contact, with the modes kept. At a resonance the amplitude peaks and the phase falls by 180 ' +
    'degrees. Rings: the peaks with the amplification factor of API 684, about 1/(2ζ); long dashes: undamped critical ' +
    `speeds; dotted: the scene's speed.${shown.forces ? ' Forces that turn with the spin there count as the unbalance that they stand for.' : ''}` +
    `${shown.limit ? ' Dashes and dots: half of what API 617 allows from peak to peak; no line where the closed loop is unstable; sampled ' +
    'controls answer with their samples, hold and delay.' : ''}`},
  {plot: 'polar', shape: 'square', title: 'Polar plot', unit: 'µm', text: 'the same response as a vector that turns with the rotor; the ' +
    'keyphasor mark is to the right. Each loop is a critical speed, where the response lags the unbalance by 90 degrees.'},
] : [];

const whirlShapes = ({shapes, campbell}) => shapes && {plot: 'whirl_shapes', shape: 'wide tall', title: `Whirl shapes at ${rpmText(campbell.running)}`,
  text: 'the bent rotor seen obliquely, without contact, each drawn equally large; arrows: the direction of the whirl, with the spin ' +
    'counter-clockwise; thin: the paths of points along the shaft'};

// Nearly equal damping has no colours.
const damped = ({pieces = []}) => (dampingScale(pieces) ? ', coloured by damping' : '');

// The page of `rotorub modes`.
const rotor = ({rotor: shown}) => [
  {plot: 'campbell', shape: 'wide tall', title: 'Campbell diagram', text: `whirl frequencies for spin speeds up to ${rpmText(shown.campbell.top)}, forward solid, ` +
    `backward dashed${damped(shown.campbell)}, the scene's speed dotted; where forward whirl meets 1×, unbalance resonates. ${beyondText(shown.campbell)}`},
  {plot: 'damping', shape: 'low', title: 'Damping ratio', unit: '%', text: 'below 0 a whirl grows'},
  {...decrement, shape: 'low'},
  ...bode(shown),
  ...shown.stiffness.map(({title, words}, index) => ({plot: 'stiffness', index, shape: 'wide tall', title, text: words})),
  whirlShapes(shown),
  shown.shapes && {plot: 'shapes', shape: 'wide tall', title: 'Mode shapes at rest',
    text: 'undamped planar modes along the shaft, each drawn 1 high; below them the rotor, thickness enlarged'},
];

// The free rotor of a run, whose plots the clock's script draws.
const whirl = ({rotor: shown}) => [
  {plot: 'campbell', shape: 'wide tall', title: 'Campbell diagram', text: 'whirl frequencies without contact, forward solid, backward ' +
    `dashed${damped(shown.campbell)}; dotted: the scene's speed, ${rpmText(shown.campbell.running)}, with marks where it whirls; rings: critical speeds, where unbalance resonates. ${beyondText(shown.campbell)}`},
  {...decrement, shape: 'wide low'},
  ...bode(shown),
  whirlShapes(shown),
].filter((one) => one).map((one) => ({...one, over: 'rotor'}));

const loop = ({loops}, index) => [
  loops[index].sensitivity.length && {plot: 'sensitivity', shape: 'wide tall', title: 'Sensitivity', unit: '|S| = |1/(1 + L)|',
    text: `${loops[index].title}; each loop with all others closed. Zones of ISO 14839-3: A for new machines, B acceptable for long-term ` +
      'operation, C not acceptable for long-term operation, D severe enough to cause damage'},
  loops[index].step.length && {plot: 'step', shape: 'wide', title: 'Step of force', text: `${loops[index].title}; deflection of the ` +
    'rotor at the bearing after a force of 1 N is applied there at t = 0. Ring: peak; diamond: settled within 2 %; dotted: steady value'},
];

const bifurcation = ({bifurcation: shown}) => [{plot: 'bifurcation', shape: 'wide tall', title: 'Bifurcation diagram', unit: 'µm',
  text: 'the rotor\'s position along x each time its mark passes +x, once each value has settled: one point means that the motion repeats every ' +
    'turn, k points every k turns, a cloud chaos or several frequencies. Dots: upwards; rings: downwards; where they differ, two motions coexist. ' +
    `Below: the largest Lyapunov exponent on the way up; above 0 neighbouring runs diverge, which is chaos. ${shown.note}`}];

const convergence = () => [{plot: 'convergence', shape: 'wide', title: 'Convergence',
  text: 'the value of each evaluation, and the best so far of those that meet the constraints'}];

const branches = () => [
  {plot: 'mean_force', shape: 'wide tall', title: 'Branches of periodic rubs', unit: 'N', text: 'mean normal force of one period; solid: stable, ' +
    'dashed: unstable. Marks: named points of the branches'},
  {plot: 'amplitude', shape: 'wide tall', title: 'Largest deflection', unit: 'µm', text: 'distance of the rotor from its place at rest in one period'},
  {plot: 'multiplier', shape: 'wide', title: 'Largest multiplier', text: 'by which a small disturbance grows in one period; stable up to 1'},
];

const kinds = {bench, rotor, whirl, loop, bifurcation, convergence, branches};

// Makes the table of the meanings of the figures in a set of maps.
const figuresOf = ({figures}) => [{heading: 'Figures'}, {class: 'cards-when-small', columns: ['name', 'unit here', 'meaning'].map((text) => ({text})),
  rows: figures.map(({name, unit, meaning}) => ({cells: [name, unit, meaning]}))}];

// Expands the parts of a page (layout.js): {plots: kind, index} becomes the plots for which `data` has the data, and {figures:
// index} becomes the table of the figures in that set of maps.
export const withPlots = (parts, data) => parts.flatMap((part) => {
  if ('figures' in part) return figuresOf(data.maps[part.figures]);
  if (part.parts) return {...part, parts: withPlots(part.parts, data)};
  if (!part.plots) return part;
  const placed = ({plot, over, index = part.index, ...words}) =>
    ({...words, data: {...(over ? {over} : {of: part.plots}), plot, ...(index === undefined ? {} : {index})}});
  return {plots: kinds[part.plots](data, part.index).filter((one) => one).map(placed)};
});

// The parts on the free rotor of a run's scene.
export function whirlParts(scene) {
  const {refusal, shapes} = scene.rotor;
  if (refusal) return [{text: `No Campbell diagram: ${refusal}`}];
  const without = {text: 'No whirl shapes: the scene gives its modes as masses and stiffnesses, without a shaft to draw them along.'};
  return [...withPlots([{plots: 'whirl'}], scene), ...(shapes ? [] : [without])];
}
