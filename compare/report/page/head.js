// The head and the foot of every page by its kind: a topic, the question that the page answers, and a note.
const andList = (keys) => keys.map(({name}) => name).join(' and ');
const inSi = (command) => `rotorub ${command} --json prints the figures in SI units.`;

const heads = {
  report: ({mode, versions: {MuJoCo: version}}) => ({topic: `${mode} comparison`, heading: 'Can MuJoCo\'s contact forces be trusted?',
    note: `MuJoCo ${version}. Assumptions: small deflections, no tilt, wear or heat in the contact.`}),
  run: ({page: {names}}) => ({topic: 'one run', heading: names, note: 'Between rows of the series the page draws a cubic through positions and velocities; the ' +
    'gap also passes through every impact in between.'}),
  bench: () => ({topic: 'speed against error', heading: 'Which solver is the fastest for a given error?', note: 'Peers get the contact of a disc in a ring ' +
    '(its normal from the present positions) from us; the solver is theirs. Native times include the bookkeeping of energy and contact; those of MuJoCo ' +
    'and of the peers do not.'}),
  modes: ({hash, theory}) => ({topic: 'whirl of the free rotor', heading: 'Where does it whirl, and where does it stay stable?',
    note: `Scene ${hash}. Limits: ${theory} shaft with rotary inertia, small deflections, no contact.`}),
  rub_map: () => ({topic: 'lasting rubs', heading: 'Which rubs last, and where?', note: inSi('modes --rub-map')}),
  feedback_map: () => ({topic: 'cross-coupled feedback', heading: 'Which feedback calms the rub?', note: inSi('modes --feedback-map')}),
  branches: () => ({topic: 'periodic rubs', heading: 'Which rubs repeat, and which of them last?', note: inSi('modes --periodic --across')}),
  sweep: ({page: {names}, maps: [{keys}]}) => ({topic: 'sweep', heading: `What does ${names} do over ${andList(keys)}?`,
    note: 'The results are in results.csv, in SI units.'}),
  optimise: ({search: {keys, maximise, figure}}) => ({topic: 'optimise',
    heading: `Which values of ${andList(keys)} ${maximise ? 'maximise' : 'minimise'} ${figure}?`, note: inSi('optimise')}),
};
export const headOf = (data) => heads[data.page.kind](data);

export function writeHead(data) {
  const {topic, heading, note} = headOf(data), {names} = data.page, at = (selector) => document.querySelector(selector);
  document.title = `${names}: ${topic} · rotorub`;
  at('.eyebrow').textContent = `rotorub · ${topic} · ${names}`;
  at('h1').textContent = heading;
  at('footer p').append(` ${note}`);
}
