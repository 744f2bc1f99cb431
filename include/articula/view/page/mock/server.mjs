// SPDX-License-Identifier: Apache-2.0
// A stand-in for the server of the view, to develop the page: node mock/server.mjs [port] [folder].
// It checks nothing that protects a robot. The server of the view does.
import {createServer} from 'node:http';
import {readFile} from 'node:fs/promises';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {WebSocketServer} from 'ws';
import {Arm, sheet} from './arm.mjs';
import {parameters, services} from './services.mjs';

const port = Number(process.argv[2] ?? 8765);
const folder = process.argv[3] ?? fileURLToPath(new URL('../dist', import.meta.url));
const types = {'.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css'};

const http = createServer(async (request, response) => {
  const name = new URL(request.url, 'http://x').pathname.slice(1) || 'index.html';
  try {
    const body = await readFile(path.join(folder, path.basename(name)));
    response
      .writeHead(200, {'content-type': types[path.extname(name)] ?? 'application/octet-stream'})
      .end(body);
  } catch {
    response.writeHead(404).end();
  }
});
http.listen(port, '127.0.0.1', () => console.log(`http://127.0.0.1:${http.address().port}`));

const arm = new Arm();
const inputs = ['read', 'write', 'request', 'change', 'posted', 'overruns', 'missed'];
const topics = ['/situation', '/cycles', '/statistics', '/log'];
const readOnly = {
  robot: () => sheet,
  describe_parameters: () => ({parameters: parameters(arm)}),
};
const ownership = ['take_controls', 'release_controls'];
const serviceNames = [...Object.keys(services), ...Object.keys(readOnly), ...ownership];
const clients = new Set();
let operator = null;
let number = 0;

function situation(client) {
  const {mode, fault, advice, motion, controllers, paused, speed} = arm;
  return {
    mode,
    fault,
    advice,
    motion,
    controllers,
    paused,
    speed,
    operates: true,
    operator: operator?.name ?? '',
    you_operate: operator === client,
  };
}

function send(client, topic, message) {
  const id = client.subscriptions.get(topic);
  if (id === undefined) return;
  const payload = Buffer.from(JSON.stringify(message));
  const frame = Buffer.alloc(13 + payload.length);
  frame[0] = 1;
  frame.writeUInt32LE(id, 1);
  payload.copy(frame, 13);
  client.socket.send(frame);
}

function log(text, level = 2) {
  for (const client of clients)
    send(client, '/log', {timestamp: {sec: Math.floor(arm.time), nsec: 0}, level, message: text});
}

async function call(client, name, request) {
  if (readOnly[name]) return readOnly[name]();
  if (name === 'release_controls') {
    if (operator === client) operator = null;
    return {success: true, message: 'done'};
  }
  if (operator && operator !== client)
    return {success: false, message: `somebody else has the controls: ${operator.name}`};
  if (!operator) log(`${client.name} has the controls`);
  operator = client;
  if (name === 'take_controls') return {success: true, message: 'done'};
  const answer = await services[name](arm, request);
  if (name !== 'pull') log(`${name}: ${answer.message}`, answer.success ? 2 : 3);
  return answer;
}

new WebSocketServer({server: http}).on('connection', (socket) => {
  const client = {socket, name: `browser ${++number}`, subscriptions: new Map(), last: ''};
  clients.add(client);
  const text = (message) => socket.send(JSON.stringify(message));
  text({
    op: 'serverInfo',
    name: 'articula: q2d',
    capabilities: ['clientPublish', 'parameters', 'services'],
    supportedEncodings: ['json'],
    metadata: {robot: 'q2d'},
    sessionId: String(process.pid),
  });
  text({
    op: 'advertise',
    channels: topics.map((topic, id) => ({
      id,
      topic,
      encoding: 'json',
      schemaName: topic,
      schema: '{}',
    })),
  });
  text({
    op: 'advertiseServices',
    services: serviceNames.map((name, id) => ({id, name: `/${name}`, type: name})),
  });
  socket.on('close', () => {
    clients.delete(client);
    if (operator === client) {
      operator = null;
      arm.pull = null;
    }
  });
  socket.on('message', async (data, isBinary) => {
    if (!isBinary) {
      const message = JSON.parse(data);
      if (message.op === 'subscribe') {
        for (const {id, channelId} of message.subscriptions)
          client.subscriptions.set(topics[channelId], id);
      }
    } else if (data[0] === 1) {
      const reference = JSON.parse(data.subarray(5));
      await call(client, 'set_reference', {
        positions: Object.fromEntries(reference.name.map((n, j) => [n, reference.position[j]])),
      });
    } else if (data[0] === 2) {
      const length = data.readUInt32LE(9);
      const answer = await call(
        client,
        serviceNames[data.readUInt32LE(1)],
        JSON.parse(data.subarray(13 + length)),
      );
      const payload = Buffer.from(JSON.stringify(answer));
      const head = Buffer.from(data.subarray(0, 13 + length));
      head[0] = 3;
      socket.send(Buffer.concat([head, payload]));
    }
  });
});

let last = performance.now();
let simulated = 0; // s that are still to be simulated
setInterval(() => {
  const now = performance.now();
  simulated += arm.paused ? 0 : (now - last) * 1e-3 * arm.speed;
  last = now;
  const columns = () => sheet.joints.map(() => []);
  const cycles = {
    number: [],
    time: [],
    status: [],
    latency: [],
    period: [],
    update: [],
    position: columns(),
    velocity: columns(),
    effort: columns(),
    reference_position: columns(),
    reference_velocity: columns(),
    reference_acceleration: columns(),
    reference_effort: columns(),
    command: {effort: columns()},
    input: Object.fromEntries(inputs.map((name) => [name, []])),
    changes: [],
    dropped: 0,
  };
  let count = Math.min(1000, Math.floor(simulated / sheet.period));
  simulated -= count * sheet.period;
  count += arm.pendingSteps ?? 0;
  arm.pendingSteps = 0;
  for (; count > 0; --count) {
    arm.step();
    cycles.number.push(arm.number);
    cycles.time.push(arm.time);
    cycles.status.push(arm.mode === 'active' ? 0 : 9);
    cycles.latency.push(2e-6 * Math.exp(1.2 * (Math.random() + Math.random() + Math.random())));
    cycles.period.push(sheet.period);
    for (const name of inputs) cycles.input[name].push(name === 'posted' ? 1 : 0);
    cycles.update.push(4e-7 * (1 + Math.random()));
    sheet.joints.forEach((_, j) => {
      cycles.position[j].push(arm.position[j]);
      cycles.velocity[j].push(arm.velocity[j]);
      cycles.effort[j].push(arm.effort[j]);
      cycles.reference_position[j].push(arm.reference[j]);
      cycles.reference_velocity[j].push(arm.referenceVelocity[j]);
      cycles.reference_acceleration[j].push(0);
      cycles.reference_effort[j].push(0);
      cycles.command.effort[j].push(arm.effort[j]);
    });
  }
  for (const client of clients) {
    send(client, '/cycles', cycles);
    const present = JSON.stringify(situation(client));
    if (present !== client.last && client.subscriptions.has('/situation')) {
      client.last = present;
      send(client, '/situation', situation(client));
    }
  }
}, 16);
setInterval(() => {
  for (const client of clients)
    send(client, '/statistics', {
      cycles: arm.number,
      overruns: 0,
      dropped: 0,
      latency_median: 1.2e-5,
      latency_99: 4e-5,
      latency_max: 6e-5,
      execution_median: 6e-7,
      execution_99: 8e-7,
      execution_max: 1e-6,
    });
}, 500);
