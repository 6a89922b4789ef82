// "What if": sliders for a scene's values. The native model, in a worker, recomputes the run with these values.
import {unpacked} from './packed.js';
import {short} from './style.js';

const kRest = 150;    // ms without a movement before the run is computed
const kDigits = 3;    // significant digits of a slider's value

// The module from the page, compiled once for all scenes.
let compiled;
function nativeModule() {
  compiled ||= unpacked('native-module').arrayBuffer().then((bytes) => WebAssembly.compile(bytes));
  return compiled;
}

// The changes in the form of --set: ["contact.clearance=0.4 mm"].
export function changesOf(sliders, values) {
  return sliders.flatMap(({key, also, unit}, k) => values[k] === undefined ? [] :
    [key, ...also].map((name) => `${name}=${values[k]}${unit && ` ${unit}`}`));
}
// The options for a shell command.
export const commandOf = (changes) => changes.map((change) => ` --set "${change}"`).join('');

export class WhatIf {
  // element: its place in live_frame.js. asked: {text, name, sliders} (what_if.h). join(answer): shows the result of live.cc.
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
    const ended = answer.message ? ` It ended early: ${answer.message}.` : '';
    this.told.textContent = `Computed in ${short(1e-3 * answer.took)} s.${ended} By the program: rotorub run ${this.asked.name}${commandOf(changes)}`;
    this.join(answer);
  }
}
