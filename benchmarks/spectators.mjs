// SPDX-License-Identifier: Apache-2.0
// What browsers cost a loop: the latency of its cycles without and with ten clients, in turn, and the age
// of what a page shows beside nine others. The loop's thread has real-time priority if the user may give
// it one.
//
//   cmake --preset test && ninja -C build/test view_page_simulated_q2d pr2_view articula_page
//   node benchmarks/spectators.mjs [build folder] [rounds] [seconds of a round] [program]
//
// The program is below the build folder, as examples/pr2_view. The default is a Q2D at 1 kHz.
import {spawnSync} from 'node:child_process';
import {createRequire} from 'node:module';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

const root = fileURLToPath(new URL('..', import.meta.url));
const build = path.resolve(process.argv[2] ?? path.join(root, 'build/test'));
const rounds = Number(process.argv[3] ?? 5);
const seconds = Number(process.argv[4] ?? 10);
Object.assign(process.env, {
  SERVER: path.join(build, process.argv[5] ?? 'tests/view/page/view_page_simulated_q2d'),
  PAGE: path.join(build, 'page'),
  MODULES: path.join(build, 'page-source/node_modules'),
  CHROMIUM: process.env.CHROMIUM ?? '/usr/bin/chromium',
  SCREENSHOTS: path.join(build, 'tests/view/page/screenshots'),
});
const {startServer, startBrowser, openPage, pause} = await import(
  path.join(root, 'tests/view/page/browser.mjs')
);
const {WebSocket} = createRequire(path.join(process.env.MODULES, 'any.js'))('ws');

/** A client that takes all that a page takes; `statistics` is the last of their messages. */
function connect(url) {
  const client = {bytes: 0, pictures: 0, statistics: null};
  const socket = new WebSocket(url.replace('http', 'ws'), ['foxglove.websocket.v1']);
  const topics = new Map();
  socket.binaryType = 'nodebuffer';
  socket.on('message', (data, isBinary) => {
    client.bytes += data.length;
    if (isBinary) {
      const topic = topics.get(data.readUInt32LE(1));
      if (topic === '/statistics') client.statistics = JSON.parse(data.subarray(13));
      if (topic === '/cycles') ++client.pictures;
      return;
    }
    const message = JSON.parse(data);
    if (message.op !== 'advertise') return;
    const subscriptions = message.channels.map(({id}) => ({id: id + 1, channelId: id}));
    message.channels.forEach(({id, topic}) => topics.set(id + 1, topic));
    socket.send(JSON.stringify({op: 'subscribe', subscriptions}));
  });
  client.close = () => socket.terminate();
  return client;
}

function withPriority(pid) {
  return spawnSync('chrt', ['--fifo', '--pid', '80', String(pid)]).status === 0;
}

/** The statistics of a new loop after some seconds with so many clients, and one that asks for them. */
async function round(count) {
  const server = await startServer();
  const isRealtime = withPriority(server.pid);
  const clients = Array.from({length: count}, () => connect(server.url));
  await pause(1e3 * (seconds - 1));
  const last = connect(server.url);
  await pause(1000);
  const {statistics} = last;
  const bytes = clients.reduce((sum, client) => sum + client.bytes, 0);
  const pictures = Math.min(...clients.map((client) => client.pictures)) / seconds;
  for (const client of [...clients, last]) client.close();
  await server.stop();
  return {...statistics, bytes, pictures, isRealtime};
}

const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
const us = (x) => (1e6 * x).toFixed(1);
const all = {0: [], 10: []};
for (let k = 0; k < rounds; ++k) for (const count of [0, 10]) all[count].push(await round(count));
console.log(
  `latency of the cycles [us], real-time priority: ${all[0][0].isRealtime}, ` +
    `${rounds} rounds of ${seconds} s, medians and lowest of the rounds`,
);
for (const [count, list] of Object.entries(all)) {
  const figures = ['latency_median', 'latency_99', 'latency_max', 'execution_median', 'execution_99']
    .map((name) => {
      const values = list.map((statistics) => statistics[name]);
      return `${name} ${us(median(values))} (${us(Math.min(...values))})`;
    })
    .join(', ');
  const rate = median(list.map(({bytes}) => bytes)) / seconds / 1e6;
  const overruns = list.map((own) => own.overruns).join(' ');
  const pictures = Math.min(...list.map((own) => own.pictures));
  const gets = list[0].pictures === Infinity ? '' : `, ${pictures.toFixed(1)} pictures/s and client`;
  console.log(`${count} clients: ${figures}; overruns ${overruns}; ${rate.toFixed(1)} MB/s${gets}`);
}

// The age of what the page shows: from a cycle to the picture after the one that draws it.
const server = await startServer();
withPriority(server.pid); // a loop that misses cycles counts less time than passes
const browser = await startBrowser();
const others = Array.from({length: 9}, () => connect(server.url));
const {page} = await openPage(browser, server.url);
const {ages, drawing} = await page.evaluate(async (duration) => {
  // How long the page's own code takes for a picture.
  const drawing = [];
  const original = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) =>
    original((now) => {
      const begin = performance.now();
      callback(now);
      drawing.push(performance.now() - begin);
    });

  const socket = new WebSocket(location.origin.replace('http', 'ws'), ['foxglove.websocket.v1']);
  socket.binaryType = 'arraybuffer';
  // The time of day of the loop's time 0: every message has that of its newest cycle.
  const start = await new Promise((resolve) => {
    socket.onmessage = ({data}) => {
      if (typeof data === 'string') {
        const {op, channels} = JSON.parse(data);
        if (op !== 'advertise') return;
        const {id} = channels.find(({topic}) => topic === '/cycles');
        socket.send(JSON.stringify({op: 'subscribe', subscriptions: [{id: 1, channelId: id}]}));
        return;
      }
      const {time} = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 13)));
      const stamp = Number(new DataView(data).getBigUint64(5, true)) * 1e-6;
      resolve(stamp - 1e3 * time.at(-1));
    };
  });
  socket.close();
  const ages = [];
  const end = performance.now() + 1e3 * duration;
  let drawn = null;
  await new Promise((resolve) => {
    const frame = (now) => {
      if (drawn !== null) ages.push(performance.timeOrigin + now - start - 1e3 * drawn);
      const {samples, row} = articula.playback.shown;
      drawn = samples.time(row); // drawn by the page in this frame
      if (now < end) original(frame);
      else resolve();
    };
    original(frame);
  });
  window.requestAnimationFrame = original;
  return {ages, drawing};
}, seconds);
const shares = (values) => {
  values.sort((a, b) => a - b);
  const share = (x) => values[Math.floor(x * (values.length - 1))].toFixed(1);
  return `lowest ${share(0)}, median ${share(0.5)}, 99 % ${share(0.99)}`;
};
console.log(
  `update to pixel [ms]: ${shares(ages)}; ` +
    `${(ages.length / seconds).toFixed(1)} frames/s, drawn by software`,
);
console.log(`the page's own code for a picture [ms]: ${shares(drawing)}`);
for (const client of others) client.close();
await browser.close();
await server.stop();
