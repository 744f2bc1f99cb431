// SPDX-License-Identifier: Apache-2.0
// Runs a WebAssembly program that prints: node run.mjs program.wasm
//
// The same lines run it in a web page, with fetch() instead of readFile() and an element of the page
// instead of standard output.
import {readFile} from 'node:fs/promises';

class Exit extends Error {}

/// The functions of WASI (snapshot preview 1) that such a program calls.
/// @param memory  returns the program's memory
/// @param print   called with the number of the stream, 1 or 2, and bytes
function system(memory, print) {
  const functions = {
    fd_write(stream, buffers, count, written) {
      const view = new DataView(memory().buffer);
      let size = 0;
      for (let i = 0; i < count; ++i) {
        const [start, length] =
            [0, 4].map((offset) => view.getUint32(buffers + 8 * i + offset, true));
        print(stream, new Uint8Array(memory().buffer, start, length));
        size += length;
      }
      view.setUint32(written, size, true);
      return 0;
    },
    proc_exit(status) {
      throw new Exit(String(status));
    },
  };
  const missing = () => 52;  // ENOSYS
  return new Proxy(functions, {get: (known, name) => known[name] ?? missing});
}

const streams = {1: process.stdout, 2: process.stderr};
const {instance} = await WebAssembly.instantiate(await readFile(process.argv[2]), {
  wasi_snapshot_preview1: system(
      () => instance.exports.memory, (stream, bytes) => streams[stream].write(bytes.slice())),
});
try {
  instance.exports._start();
} catch (exit) {
  if (!(exit instanceof Exit)) throw exit;
  process.exitCode = Number(exit.message);
}
