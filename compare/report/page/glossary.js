// The glossary of a report and of a run's page (compare/docs/glossary.md has more words).
const words = [
  ['native', 'The program\'s own model of the scene, without MuJoCo. The other runs are judged against it.'],
  ['MuJoCo alone (cone)', 'MuJoCo\'s own soft contact with its own friction cone, as a model in MuJoCo has it.'],
  ['with the corrected cone (cone-coulomb)', 'The same contact; a plugin corrects its normal reference for sliding, so that friction follows Coulomb\'s law.'],
  ['MuJoCo\'s normal force, Coulomb friction (coulomb)', 'MuJoCo\'s soft normal force; a plugin adds the friction of Coulomb\'s law.'],
  ['with the rigid law (rigid)', 'A plugin solves impacts and lasting contact inside MuJoCo\'s step, by the laws of the native model.'],
  ['trusted', 'Yes: every judged figure that can be decided is within the tolerance. Averages only: forces, work and speeds are; figures of ' +
    'single moments, such as the largest impact, are not. No: an average is off. Undecidable: the motion does not repeat itself well enough to tell.'],
  ['hard impact', 'An impact faster than a hundredth of the fastest one.'],
  ['lasting contact', 'The share of the time after the first touch in which rotor and ring stay together.'],
  ['points', 'Percentage points: the difference of two shares. From 99 % to 90 % it is -9 points.'],
  ['repeated runs', 'The same run from starts that are a few units in the last place apart. A difference smaller than theirs cannot be decided.'],
  ['±', 'Half of the interval in which the true difference lies with 95 % certainty, from the repeated runs.'],
  ['shadow', 'The native model at MuJoCo\'s step: its error is due to the step.'],
  ['bouncing', 'Contact comes and goes in the last fifth of the run, regularly or not.'],
  ['synchronous rub', 'Lasting contact that goes round with the spin. Backward whip: against the spin, slipping. Rolling: against it without slip.'],
  ['whirl', 'How fast the rotor\'s centre goes round the ring\'s; backward is negative.'],
  ['gap', 'The distance between the surfaces: 0 in contact, below 0 the penetration of a soft contact.'],
  ['modes kept', 'How many of the shaft\'s bending shapes the model has. Both sides have the same, so their agreement says nothing about those left out.'],
  ['time of a step', 'Computing time, the median of repeated runs. It is not a result.'],
];

export const glossary = {details: 'What the words mean', id: 'glossary', class: 'glossary', contents: 'Words', parts: [{facts: words}]};
