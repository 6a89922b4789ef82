// The worker of "what if". It makes one run, so that the page stays responsive and can stop the run.
import {nativeModel} from './native.js';

addEventListener('message', async ({data: {module, text, name, changes}}) => {
  try {
    const native = await nativeModel(module), before = performance.now();
    postMessage({...native.run(text, name, changes), took: performance.now() - before});
  } catch (error) {
    postMessage({refused: String(error.message || error)});
  }
});
