// SPDX-License-Identifier: Apache-2.0
// Foxglove's own client (npm @foxglove/ws-protocol) against the view:
//   node client_test.mjs <program that serves a fake arm and prints its address>
import {parse} from '@foxglove/rosmsg';
import {MessageReader} from '@foxglove/rosmsg2-serialization';
import foxglove from '@foxglove/ws-protocol';
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {once} from 'node:events';
import process from 'node:process';
import WebSocket from 'ws';

const {FoxgloveClient} = foxglove;
const decode = (data) => JSON.parse(new TextDecoder().decode(data));
const encode = (value) => new TextEncoder().encode(JSON.stringify(value));

/** A client with all that the server has sent to it. */
class Recorded {
  constructor(url, subprotocol) {
    this.socket = new WebSocket(url, [subprotocol]);
    this.client = new FoxgloveClient({ws: this.socket});
    this.seen = [];
    this.waiting = [];
    const kinds = ['open', 'error', 'serverInfo', 'status', 'message', 'advertise',
      'advertiseServices', 'parameterValues', 'serviceCallResponse', 'serviceCallFailure',
      'fetchAssetResponse'];
    for (const kind of kinds) {
      this.client.on(kind, (event) => {
        this.seen.push({kind, event});
        this.waiting = this.waiting.filter((look) => !look());
      });
    }
  }

  /** The first event of a kind, past or to come, for which `test` holds. */
  wait(kind, test = () => true) {
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`no ${kind} came`)), 30_000);
      const look = () => {
        const found = this.seen.find((entry) => entry.kind === kind && test(entry.event));
        if (found === undefined) return false;
        clearTimeout(timer);
        resolve(found.event);
        return true;
      };
      if (!look()) this.waiting.push(look);
    });
  }

  async subscribe(topic) {
    const channels = await this.wait('advertise');
    const channel = channels.find((entry) => entry.topic === topic);
    assert.equal(channel.encoding, 'json');
    assert.equal(channel.schemaEncoding, 'jsonschema');
    assert.equal(JSON.parse(channel.schema).type, 'object');
    return this.client.subscribe(channel.id);
  }

  async message(topic) {
    const subscriptionId = await this.subscribe(topic);
    const event = await this.wait('message', (e) => e.subscriptionId === subscriptionId);
    assert.ok(event.timestamp > 1_600_000_000_000_000_000n, 'time of the day in ns');
    return decode(event.data);
  }

  /** The first message of each channel that PlotJuggler's plug-in takes, by topic. */
  async rosMessages() {
    const messages = {};
    for (const channel of await this.wait('advertise')) {
      if (channel.encoding !== 'cdr' || channel.schemaEncoding !== 'ros2msg') continue;
      const reader = new MessageReader(parse(channel.schema, {ros2: true}));
      const subscriptionId = this.client.subscribe(channel.id);
      const event = await this.wait('message', (e) => e.subscriptionId === subscriptionId);
      messages[channel.topic] = reader.readMessage(event.data);
      this.client.unsubscribe(subscriptionId);
    }
    return messages;
  }

  async call(name, request) {
    const services = await this.wait('advertiseServices');
    const service = services.find((entry) => entry.name === name);
    const callId = (this.calls = (this.calls ?? 0) + 1);
    const data = new DataView(encode(request).buffer);
    this.client.sendServiceCallRequest({serviceId: service.id, callId, encoding: 'json', data});
    const response = await this.wait('serviceCallResponse', (e) => e.callId === callId);
    assert.equal(response.serviceId, service.id);
    assert.equal(response.encoding, 'json');
    return decode(response.data);
  }
}

async function check(url, subprotocol, gain) {
  const recorded = new Recorded(url, subprotocol);
  const {client} = recorded;
  await recorded.wait('open');
  assert.equal(recorded.socket.protocol, subprotocol);

  const info = await recorded.wait('serverInfo');
  assert.equal(info.name, 'articula: fake arm');
  for (const capability of ['clientPublish', 'parameters', 'parametersSubscribe', 'services']) {
    assert.ok(info.capabilities.includes(capability), capability);
  }

  const state = await recorded.message('/joint_states');
  assert.deepEqual(state.name, ['shoulder', 'elbow', 'finger']);
  assert.equal(state.position.length, 3);
  const ros = await recorded.rosMessages();
  assert.deepEqual(Object.keys(ros), ['/ros/joint_states', '/ros/reference', '/ros/command']);
  assert.deepEqual(ros['/ros/joint_states'].name, ['shoulder', 'elbow', 'finger']);
  assert.equal(ros['/ros/joint_states'].position.length, 3);
  assert.deepEqual(ros['/ros/command'].name, ['shoulder', 'elbow']);
  assert.equal(ros['/ros/command'].position.length, 0);
  assert.equal(ros['/ros/command'].effort.length, 2);
  const {transforms} = await recorded.message('/tf');
  assert.deepEqual(transforms.map((t) => t.child_frame_id), ['upper_arm', 'forearm']);
  assert.match((await recorded.message('/robot_description')).data, /^<robot/);
  assert.equal((await recorded.message('/situation')).operates, true);
  const cycles = await recorded.message('/cycles');
  assert.equal(cycles.number.length, cycles.position[1].length);
  assert.equal((await recorded.message('/statistics')).overruns, 0);

  client.getParameters(['pid.shoulder.p', '/robot_description'], 'get');
  const values = await recorded.wait('parameterValues', (e) => e.id === 'get');
  assert.deepEqual(values.parameters.map((p) => p.name), ['/robot_description', 'pid.shoulder.p']);
  client.subscribeParameterUpdates(['pid.shoulder.p']);
  client.setParameters([{name: 'pid.shoulder.p', value: gain}], 'set');
  const set = await recorded.wait('parameterValues', (e) => e.id === 'set');
  assert.equal(set.parameters[0].value, gain);
  await recorded.wait('parameterValues', (e) => e.id === undefined && e.parameters[0].value === gain);
  client.setParameters([{name: 'pid.shoulder.p', value: 1e6}], 'refused');
  const refused = await recorded.wait('parameterValues', (e) => e.id === 'refused');
  assert.equal(refused.parameters[0].value, gain);
  assert.match((await recorded.wait('status', (e) => e.level === 2)).message, /range/);

  assert.equal((await recorded.call('/go', {positions: {elbow: 0.25}})).success, true);
  const wrong = await recorded.call('/go', {positions: {knee: 0.25}});
  assert.deepEqual(wrong, {success: false, message: "there is no joint 'knee'"});
  assert.equal((await recorded.call('/robot', {})).joints[1].limits.upper, 1.5);

  const channel = client.advertise({topic: '/reference', encoding: 'json', schemaName: 'any'});
  client.sendMessage(channel, encode({name: ['elbow'], position: [-0.75]}));
  await recorded.wait('message', (event) => {
    if (event.data.getUint8(0) !== '{'.charCodeAt(0)) return false; // CDR
    const message = decode(event.data);
    return message.name?.[1] === 'elbow' && message.position[1] === -0.75;
  });
  client.unadvertise(channel);

  client.fetchAsset('package://nowhere/mesh.stl', 7);
  const asset = await recorded.wait('fetchAssetResponse', (e) => e.requestId === 7);
  assert.equal(asset.status, 1);

  client.close();
  await once(recorded.socket, 'close');
  console.log(`${subprotocol}: ${recorded.seen.length} events`);
}

const server = spawn(process.argv[2], {stdio: ['pipe', 'pipe', 'inherit']});
try {
  const [line] = await once(server.stdout, 'data');
  const url = String(line).trim().replace('http:', 'ws:');
  await check(url, 'foxglove.websocket.v1', 42.5);
  await check(url, 'foxglove.sdk.v1', 12.5);
  server.stdin.end();
  const [status] = await once(server, 'exit');
  assert.equal(status, 0);
} finally {
  server.kill();
}
