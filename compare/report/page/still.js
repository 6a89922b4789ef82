// Of a page without runs: bench, modes, maps. Without it the page still shows its tables.
import {data, start, withPlotly} from './page.js';
import {stills} from './stills.js';

window.page = {data};
const draw = stills();
start(draw);
withPlotly(draw);
