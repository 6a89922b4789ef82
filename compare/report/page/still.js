// Starts a page without runs (bench, modes, optimise, maps), and lays it out.
import {layOut} from './layout.js';
import {feedbackMap, rubMap, withRubs} from './linear_maps.js';
import {searchMap, searchOf} from './optimum.js';
import {data, start, withPlotly} from './page.js';
import {withPlots} from './plot_words.js';
import {loopsOf, rotorOf} from './rotor_data.js';
import {stillParts} from './still_parts.js';
import {stills} from './stills.js';

const {found} = data.page;
if (found.scenes) Object.assign(data, {benches: found.scenes, machine: found.machine});
data.branches = found.rub_branches;
if (data.search) {
  data.search = searchOf(data.search);
  data.maps = [searchMap(data.search)];
}
if (data.rub_map) data.maps = [rubMap(data.rub_map)];
if (found.feedback_map) data.maps = [feedbackMap(found.feedback_map)];
data.maps = data.maps?.map(withRubs);
if (data.rotor) Object.assign(data, {rotor: rotorOf({...data.rotor, found}), loops: loopsOf(found, data.loops)});
layOut(document.querySelector('main'), withPlots(stillParts(data), data));
window.page = {data};
const draw = stills();
start(draw);
withPlotly(draw);
