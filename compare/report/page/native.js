// The native model as a WebAssembly module (report/live/live.cc), in a worker of the page or under node.

// The C library gets a clock; all other system calls, such as file access, return this error.
const kNotThere = 52;  // ENOSYS

// module: a WebAssembly.Module. Returns {run(text, name, changes): the result of live.cc, figures()}.
export async function nativeModel(module) {
  const imports = {};
  for (const {module: room, name} of WebAssembly.Module.imports(module)) {
    imports[room] = imports[room] || {};
    imports[room][name] = () => kNotThere;
  }
  let memory;
  const env = imports.env || {}, wasi = imports.wasi_snapshot_preview1 || {};
  env.emscripten_notify_memory_growth = () => {};
  wasi.clock_time_get = (_clock, _precision, at) => {
    new DataView(memory.buffer).setBigUint64(at, BigInt(Math.round(1e6 * performance.now())), true);
    return 0;
  };
  wasi.proc_exit = (code) => { throw new Error(`the module has ended itself, ${code}`); };
  const {exports} = await WebAssembly.instantiate(module, imports);
  memory = exports.memory;
  exports._initialize?.();

  function put(text) {
    const bytes = new TextEncoder().encode(`${text}\0`), at = exports.malloc(bytes.length);
    new Uint8Array(memory.buffer).set(bytes, at);
    return at;
  }
  function got(at) {
    const bytes = new Uint8Array(memory.buffer, at);
    return JSON.parse(new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0))));
  }
  return {
    run(text, name, changes) {
      const places = [text, name, changes.join('\n')].map(put);
      const answer = got(exports.rotorub_run(...places));
      places.forEach(exports.free);
      return answer;
    },
    figures: () => got(exports.rotorub_figures()),
  };
}
