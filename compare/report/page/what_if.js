// "What if": sliders for a scene's values. The native model, in a worker, recomputes the run with these values.
import {micro, milli} from './factors.js';
import {unpacked} from './packed.js';
import {short} from './style.js';

const kRest = 150;    // ms without a movement before the run is computed
const kDigits = 3;    // significant digits of a slider's value, where it is moved to
const kExact = 7;     // and where the scene has it

// The module from the page, compiled once for all scenes.
let compiled;
function nativeModule() {
  compiled ||= unpacked('native-module').arrayBuffer().then((bytes) => WebAssembly.compile(bytes));
  return compiled;
}

// The unit for people of a value in SI, and its number of such units in one of SI.
function unitFor(si, value) {
  if (si === 'm') return Math.abs(value) < 1e-4 ? {unit: 'um', factor: micro} : {unit: 'mm', factor: milli};
  return {'rad/s': {unit: 'rpm', factor: 30 / Math.PI}, s: {unit: 'ms', factor: milli}, 1: {unit: '', factor: 1}}[si] ?? {unit: si, factor: 1};
}

// The sliders for what_if.h's values: the range is the schema's if it has two ends, otherwise from 0, or from a quarter of the
// value, to twice the value.
export const slidersOf = (values) => values.map(({unit: si, value, low, low_open: isOpen, high, ...words}) => {
  const {unit, factor} = unitFor(si, value), isBounded = low !== null && high !== null;
  const ends = [isBounded || (low === 0 && !isOpen) ? low : 0.25 * value, isBounded ? high : 2 * value].sort((a, b) => a - b);
  const [shown, from, to] = [value, ...ends].map((v) => Number((factor * v).toPrecision(kExact)));
  return {...words, unit, value: shown, low: from, high: to};
});

// The changes in the form of --set: ["contact.clearance=0.4 mm"].
export function changesOf(sliders, values) {
  return sliders.flatMap(({key, also, unit}, k) => values[k] === undefined ? [] :
    [key, ...also].map((name) => `${name}=${values[k]}${unit && ` ${unit}`}`));
}
// The options for a shell command.
export const commandOf = (changes) => changes.map((change) => ` --set "${change}"`).join('');

export class WhatIf {
  // element: its place in live_frame.js. asked: {text, name, sliders: of slidersOf()}. join(answer): shows the result of live.cc.
  constructor(element, asked, join) {
    Object.assign(this, {element, asked, join, values: [], job: 0});
    this.told = element.querySelector('.told');
    this.back = element.querySelector('.put-back');
    this.inputs = [...element.querySelectorAll('input')];
    this.inputs.forEach((input, k) => {
      input.addEventListener('input', () => this.move(k, Number(short(Number(input.value), kDigits))));
    });
    this.back.addEventListener('click', () => this.putBack());
  }

  move(k, value) {
    this.values[k] = value;
    this.say(k);
    this.back.disabled = false;
    this.told.textContent = 'computing …';
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.compute(), kRest);
  }
  say(k) {
    const {value, unit} = this.asked.sliders[k];
    this.inputs[k].parentElement.querySelector('output').textContent = `${this.values[k] ?? value} ${unit}`;
  }
  putBack() {
    this.values = [];
    this.inputs.forEach((input, k) => {
      input.value = this.asked.sliders[k].value;
      this.say(k);
    });
    this.back.disabled = true;
    this.compute();
  }

  // Cancels a run that is still in progress.
  async compute() {
    const job = ++this.job, changes = changesOf(this.asked.sliders, this.values);
    this.worker?.terminate();
    this.told.textContent = 'computing …';
    try {
      const module = await nativeModule();
      if (job !== this.job) return;
      this.worker = new Worker(URL.createObjectURL(new Blob([document.getElementById('native-worker').textContent], {type: 'text/javascript'})));
      this.worker.onmessage = ({data}) => this.take(data, changes);
      this.worker.onerror = ({message}) => this.take({refused: message}, changes);
      this.worker.postMessage({module, text: this.asked.text, name: this.asked.name, changes});
    } catch (error) {
      this.take({refused: `this browser cannot run the native model: ${error.message}`}, changes);
    }
  }
  take(answer, changes) {
    this.worker?.terminate();
    this.element.dataset.computed = this.job;  // for tests
    if (answer.refused) {
      this.told.textContent = `Not computed: ${answer.refused}`;
      return;
    }
    const {message} = answer.side, ended = message ? ` It ended early: ${message}.` : '';
    this.told.textContent = `Computed in ${short(1e-3 * answer.took)} s.${ended} By the program: rotorub run ${this.asked.name}${commandOf(changes)}`;
    this.join(answer);
  }
}
