// "What if": sliders of a scene's values. With what they say the native model, in a worker, computes the run again.
import {unpacked} from './packed.js';
import {short} from './style.js';

const kRest = 150;    // ms without a move: then it is computed
const kDigits = 3;    // of what a slider says

// The module out of the page, once for all scenes.
let compiled;
function nativeModule() {
  compiled ||= unpacked('native-module').arrayBuffer().then((bytes) => WebAssembly.compile(bytes));
  return compiled;
}

// As --set takes it: [contact.clearance=0.4 mm].
export function changesOf(sliders, values) {
  return sliders.flatMap(({key, also, unit}, k) => values[k] === undefined ? [] :
    [key, ...also].map((name) => `${name}=${values[k]}${unit && ` ${unit}`}`));
}
// For a shell.
export const commandOf = (changes) => changes.map((change) => ` --set "${change}"`).join('');

export class WhatIf {
  // element: its place in live_frame.js. asked: {text, name, sliders} (what_if.h). join(answer): what live.cc gives, shown.
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

  // A run that is still under way is of no use any more.
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
