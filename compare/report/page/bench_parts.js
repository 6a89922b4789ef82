// The page of a bench.
import {scenesText} from './answer.js';

const headlineShare = 0.99e-5;  // relative to the clearance; finer levels appear only in the tables

// Green if a native integrator is the fastest at every level that any engine reaches.
function cardOf({scene, levels, verdict}, id) {
  const answers = levels.filter((level) => level.clearance_share >= headlineShare).map((level) => level.native_is_fastest).filter((is) => is !== null);
  const [tone, headline] = !answers.length ? ['part', 'No engine reaches a level'] :
    answers.every(Boolean) ? ['good', 'A native integrator at every level reached'] : ['bad', 'Not native at every level'];
  return {title: scene, tone, headline, text: verdict, link: `#${id}`};
}

export function benchParts({page: {parts}, benches, machine, texts}) {
  const scenes = parts.slice(0, benches.length);
  return [
    {cards: benches.map((bench, k) => cardOf(bench, scenes[k].id))},
    {lead: 'Each engine runs a series of steps (of tolerances, if it adapts its steps). An error is the largest distance of rotor or ring from ' +
      'the reference over the whole run; a time is the median of repeated whole integrations with the output off, all points in turns. Measured ' +
      `on ${machine.processor}, ${machine.instructions}, one thread each; ${machine.compiler}; MuJoCo ${machine.mujoco_version}.`},
    ...scenes.map((scene, index) => ({...scene, parts: [{plots: 'bench', index}, ...scene.parts, scenesText(texts[index])]})),
    ...parts.slice(benches.length).map((part) => ({...part, class: 'sheets'}))];
}
