// SPDX-License-Identifier: Apache-2.0
// node live_requests.mjs loop.wasm requests.txt: sends the requests to the loop of a page and prints
// all cycles and answers, as live_requests.cpp does of the same loop natively.
import {readFile} from 'node:fs/promises';

const [, , program, requests] = process.argv;
const functions = {
  clock_time_get(_clock, _precision, result) {
    new DataView(loop.memory.buffer).setBigUint64(result, process.hrtime.bigint(), true);
    return 0;
  },
  proc_exit(status) {
    throw new Error(`the program has ended with status ${status}`);
  },
};
const missing = () => 52; // ENOSYS
const system = new Proxy(functions, {get: (known, name) => known[name] ?? missing});
const {instance} = await WebAssembly.instantiate(await readFile(program), {wasi_snapshot_preview1: system});
const loop = instance.exports;
const services = new Map();
let printed = '';

function send(isText, bytes) {
  const start = loop.articula_incoming(bytes.length);
  new Uint8Array(loop.memory.buffer, start, bytes.length).set(bytes);
  loop.articula_receive(isText ? 1 : 0);
}

/** Reads what the loop sends: learns its services, subscribes to its cycles, keeps them and answers. */
function receive() {
  for (let kind = 0; (kind = loop.articula_take()) !== 0; ) {
    const frame = Buffer.from(loop.memory.buffer, loop.articula_outgoing(), loop.articula_outgoing_size());
    if (kind === 1) {
      printed += `${frame.toString('utf8', frame[0] === 1 ? 13 : 17)}\n`; // of a message, of an answer
      continue;
    }
    const message = JSON.parse(frame.toString());
    for (const {name, id} of message.services ?? []) services.set(name, id);
    const cycles = message.op === 'advertise' && message.channels.find(({topic}) => topic === '/cycles');
    if (!cycles) continue;
    const subscriptions = [{id: 1, channelId: cycles.id}];
    send(true, Buffer.from(JSON.stringify({op: 'subscribe', subscriptions})));
  }
}

loop._initialize();
if (loop.articula_open() !== 0) throw new Error('the loop does not start');
receive();
let call = 0;
for (const line of (await readFile(requests, 'utf8')).trim().split('\n')) {
  const [what, first, ...rest] = line.split(' ');
  if (what === 'call') {
    const head = Buffer.alloc(13);
    head.writeUInt8(2, 0);
    head.writeUInt32LE(services.get(first), 1);
    head.writeUInt32LE(++call, 5);
    head.writeUInt32LE(4, 9);
    send(false, Buffer.concat([head, Buffer.from('json' + rest.join(' '))]));
    continue;
  }
  for (let k = 0; k < Number(rest[0]); ++k) {
    loop.articula_advance(Number(first), 0);
    receive();
  }
}
process.stdout.write(printed);
