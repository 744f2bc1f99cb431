// SPDX-License-Identifier: Apache-2.0
// The part of the Foxglove WebSocket protocol that the page needs. Everything is JSON.
import {Emitter} from './emitter';
import type {Socket} from './socket';

interface Events {
  open: {name: string; sessionId: string};
  close: string; // what the user should know
  status: {level: number; message: string};
  parameters: {name: string; value: unknown}[];
}

interface PendingCall {
  resolve: (answer: unknown) => void;
  reject: (reason: Error) => void;
}

const firstDelay = 300; // ms until the first new attempt; it doubles up to the last delay
const lastDelay = 2000;

/** A connection that comes back by itself. Subscriptions and advertised topics outlive it. */
export class FoxgloveClient extends Emitter<Events> {
  private socket: Socket | null = null;
  private delay = firstDelay;
  private nextId = 1;
  private readonly handlers = new Map<string, (message: unknown) => void>(); // by topic
  private readonly topics = new Map<number, string>(); // by the subscription's id
  private readonly services = new Map<string, number>();
  private readonly calls = new Map<number, PendingCall>();
  private readonly published = new Map<string, number>(); // ids of the client's channels by topic
  private parameterNames: string[] = [];

  /** @param open makes a connection; called again when one has ended */
  constructor(private readonly open: () => Socket) {
    super();
  }

  connect(): void {
    const socket = this.open();
    socket.onmessage = ({data}) => (typeof data === 'string' ? this.text(data) : this.binary(data));
    socket.onclose = ({code, reason}) => this.closed(code, reason);
    this.socket = socket;
  }

  /** Receives the messages of a topic, now or as soon as the server has it. */
  subscribe(topic: string, handler: (message: unknown) => void): void {
    this.handlers.set(topic, handler);
  }

  /** Calls a service. Fails if the connection ends before the answer. */
  call(service: string, request: unknown): Promise<unknown> {
    const id = this.services.get(service);
    if (id === undefined || this.socket?.readyState !== WebSocket.OPEN) {
      const reason =
        this.services.size === 0 ? 'the page is not connected' : 'the server does not offer it';
      return Promise.reject(new Error(`${service}: ${reason}`));
    }
    const call = this.nextId++;
    const payload = new TextEncoder().encode(JSON.stringify(request));
    const message = new Uint8Array(13 + 4 + payload.length);
    const view = new DataView(message.buffer);
    view.setUint8(0, 2);
    view.setUint32(1, id, true);
    view.setUint32(5, call, true);
    view.setUint32(9, 4, true);
    message.set(new TextEncoder().encode('json'), 13);
    message.set(payload, 17);
    this.socket.send(message);
    return new Promise((resolve, reject) => this.calls.set(call, {resolve, reject}));
  }

  /** Publishes on a topic of the client. */
  publish(topic: string, value: unknown): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    let id = this.published.get(topic);
    if (id === undefined) {
      id = this.nextId++;
      this.published.set(topic, id);
      this.send({op: 'advertise', channels: [{id, topic, encoding: 'json', schemaName: ''}]});
    }
    const payload = new TextEncoder().encode(JSON.stringify(value));
    const message = new Uint8Array(5 + payload.length);
    const view = new DataView(message.buffer);
    view.setUint8(0, 1);
    view.setUint32(1, id, true);
    message.set(payload, 5);
    this.socket.send(message);
  }

  /** Asks to hear of changes of parameters, also those by other clients. */
  watchParameters(names: string[]): void {
    this.parameterNames = names;
    const most = 200; // names in a message, which servers limit
    for (let first = 0; first < names.length; first += most) {
      this.send({
        op: 'subscribeParameterUpdates',
        parameterNames: names.slice(first, first + most),
      });
    }
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private text(data: string): void {
    const message = JSON.parse(data);
    switch (message.op) {
      case 'serverInfo':
        this.delay = firstDelay;
        this.watchParameters(this.parameterNames);
        this.emit('open', message);
        break;
      case 'advertise':
        this.advertised(message.channels);
        break;
      case 'advertiseServices':
        for (const service of message.services) this.services.set(service.name, service.id);
        break;
      case 'parameterValues':
        this.emit('parameters', message.parameters);
        break;
      case 'status':
        this.emit('status', message);
        break;
      case 'serviceCallFailure':
        this.calls.get(message.callId)?.reject(new Error(message.message));
        this.calls.delete(message.callId);
        break;
    }
  }

  private advertised(channels: {id: number; topic: string}[]): void {
    const subscriptions = channels
      .filter(({topic}) => this.handlers.has(topic))
      .map(({id, topic}) => ({id: this.nextId++, channelId: id, topic}));
    for (const {id, topic} of subscriptions) this.topics.set(id, topic);
    if (subscriptions.length > 0) {
      this.send({
        op: 'subscribe',
        subscriptions: subscriptions.map(({id, channelId}) => ({id, channelId})),
      });
    }
  }

  private binary(data: ArrayBuffer): void {
    const view = new DataView(data);
    const decode = (from: number) =>
      JSON.parse(new TextDecoder().decode(new Uint8Array(data, from)));
    if (view.getUint8(0) === 1) {
      const topic = this.topics.get(view.getUint32(1, true));
      if (topic !== undefined) this.handlers.get(topic)?.(decode(13));
    } else if (view.getUint8(0) === 3) {
      const call = view.getUint32(5, true);
      this.calls.get(call)?.resolve(decode(13 + view.getUint32(9, true)));
      this.calls.delete(call);
    }
  }

  private closed(code: number, reason: string): void {
    this.socket = null;
    for (const call of this.calls.values())
      call.reject(new Error('the connection was closed before the answer'));
    this.calls.clear();
    this.topics.clear();
    this.services.clear();
    this.published.clear();
    this.emit('close', `The connection is closed${reason ? `: ${reason}` : ''} (code ${code}). It is tried again.`);
    setTimeout(() => this.connect(), this.delay);
    this.delay = Math.min(2 * this.delay, lastDelay);
  }
}
