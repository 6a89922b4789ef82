// The parts of the page of one command, for layout.js, from the parts of its result and the data of its plots.
import {benchParts} from './bench_parts.js';
import {branchesParts, feedbackMapParts, rubMapParts, sweepParts} from './map_parts.js';
import {modesParts} from './modes_parts.js';
import {optimiseParts} from './optimum.js';

const kinds = {bench: benchParts, branches: branchesParts, feedback_map: feedbackMapParts, modes: modesParts, optimise: optimiseParts,
  rub_map: rubMapParts, sweep: sweepParts};
export const stillParts = (data) => kinds[data.page.kind](data);
