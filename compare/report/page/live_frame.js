// The places of a scene's live part, which live.js fills: player, sliders, plots, and the bar of the clock.
import {html} from './html.js';
import {runPlots} from './run_plots.js';

const where = ({name}) => name && `contact ${name}`;

const footOf = (contact, index) => html`
  <div class="run-foot" data-contact="${index}">
    ${where(contact) && html`<p class="contact-head">${where(contact)} <output class="mode" aria-live="off"></output></p>`}
    <canvas class="section" role="img" aria-label="cross-section at the contact ${contact.name}"></canvas>
    <dl class="readings" aria-label="readings"></dl>
  </div>`;

const runOf = (which, contacts) => html`
  <div class="player-run">
    <div class="run-head"><label><span class="swatch"></span> <select aria-label="${which} run"></select></label>
      ${contacts.length < 2 && html`<output class="mode" aria-live="off"></output>`}</div>
    <canvas class="rig" role="img" aria-label="the rig with the bent shaft; drag or arrow keys turn it"></canvas>
    ${contacts.map(footOf)}
  </div>`;

const unrolledOf = (contact) => html`
  <figure class="unrolled-figure">
    <figcaption><b>Gap, unrolled${contact.name && `, ${where(contact)}`}</b> <span class="unit">over the angle</span> — gap
      around the ring, logarithmic. Disc and square: smallest gap now; fading line: last turn; triangles: impacts</figcaption>
    <canvas class="unrolled" role="img" aria-label="gap around the ring ${where(contact)}, logarithmic"></canvas>
  </figure>`;

const playerOf = ({contacts}) => html`
  <section class="player${contacts.length > 1 && ' several'}" tabindex="0" aria-label="live player: space plays and pauses, arrow keys step, page keys go to impacts, home and end to the ends">
    <div class="player-head"><h3>The rub, live</h3><p class="note player-note"></p></div>
    <div class="player-runs">${['first', 'second'].map((which) => runOf(which, contacts))}</div>
    ${contacts.map(unrolledOf)}
  </section>`;

const sliderOf = ({key, also, unit, value, low, high, meaning}) => html`
  <label title="${meaning}"><code>${key}</code>${also.map((other) => html` <span class="unit">and ${other}</span>`)}
    <input type="range" min="${low}" max="${high}" step="any" value="${value}"> <output>${value} ${unit}</output></label>`;

const whatIfOf = ({what_if: asked}) => asked && html`
  <details class="what-if later" open>
    <summary><h3>What if</h3></summary>
    <p class="note">Move a slider: the native model computes the whole run again, in this page. Player and plots show it as <i class="swatch side-recomputed"></i> <b>native, recomputed here</b>.</p>
    <div class="sliders">${asked.sliders.map(sliderOf)}</div>
    <p class="recomputed"><button type="button" class="put-back" disabled>as the scene has it</button> <output class="told" aria-live="polite"></output></p>
  </details>`;

const plotOf = ({key, title, unit, text, shape, over, contact, place}) => html`
  <figure class="${shape}"><figcaption><b>${title}${place && `, ${where(place)}`}</b> <span class="unit">${unit}</span> — ${text}</figcaption>
    <div class="plot" data-plot="${key}" data-over="${over}" data-contact="${contact}"></div></figure>`;

const plotsOf = (scene, id) => html`
  <section class="plots" id="${id}-plots" data-contents="Plots" aria-label="plots over the run">
    <div class="plot-bar">
      <div class="legend" role="group" aria-label="runs shown">${scene.sides.map(({label}) => html`
        <button type="button" class="legend-item" data-side="${label}" aria-pressed="true"><i class="swatch side-${label}"></i>${label}</button>`)}</div>
      <div class="ranges" role="group" aria-label="time shown">${scene.windows.map(({name}, index) => html`
        <button type="button" data-window="${index}" aria-pressed="false">${name}</button>`)}</div>
    </div>
    <div class="plot-grid">${runPlots(scene).map(plotOf)}</div>
  </section>`;

const transport = html`
  <div class="transport" role="group" aria-label="time of player and plots">
    <button type="button" class="to-start" aria-label="to the start" title="to the start (home)">|◂</button>
    <button type="button" class="to-before" aria-label="previous hard impact" title="previous hard impact (page up)">⚡◂</button>
    <button type="button" class="play" aria-label="play" aria-pressed="false" title="play, pause (space)">▶</button>
    <button type="button" class="to-next" aria-label="next hard impact" title="next hard impact (page down)">▸⚡</button>
    <input type="range" class="seek" min="0" max="1" step="any" value="0" aria-label="time of the run">
    <output class="time" aria-live="off"></output>
    <label>slowed <select class="pace" aria-label="slow motion"></select></label>
    <label title="ten times slower within a twentieth of a second of film of an impact"><input type="checkbox" class="slowing" checked> slower at impacts</label>
    <label class="outline-choice"><input type="checkbox" class="outline" checked> other run as outline</label>
  </div>`;

export const liveOf = (scene, id) => html`
  <div class="live" id="${id}-live" data-contents="Live">${playerOf(scene)}${whatIfOf(scene)}${plotsOf(scene, id)}${transport}</div>`;
