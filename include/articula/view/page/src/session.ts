// SPDX-License-Identifier: Apache-2.0
import {Emitter} from './emitter';
import {FoxgloveClient} from './foxglove_client';
import {Samples} from './samples';
import type {Socket} from './socket';
import type {
  Cycles,
  Futures,
  LogEntry,
  Parameter,
  RobotSheet,
  ServiceAnswer,
  Situation,
  Statistics,
} from './wire';

interface Events {
  opened: null; // a new connection, of which nothing has arrived yet
  connection: boolean;
  robot: RobotSheet; // another robot, or the same one of a server that was started again
  situation: Situation;
  cycles: Cycles;
  statistics: Statistics;
  log: LogEntry;
  parameters: Parameter[];
  values: Map<string, number | null>; // parameters that have changed
  futures: Futures | null; // of gains that are typed and not applied
  notice: {text: string; isError: boolean};
}

/** What the page knows about the loop, and how it asks for something. */
export class Session extends Emitter<Events> {
  sheet: RobotSheet | null = null;
  samples: Samples | null = null;
  situation: Situation | null = null;
  statistics: Statistics | null = null;
  futures: Futures | null = null;
  connected = false;
  private awaited: {number: number; resolve: () => void}[] = [];
  private readonly client: FoxgloveClient;

  constructor(open: () => Socket) {
    super();
    this.client = new FoxgloveClient(open);
    this.client.on('open', () => this.emit('opened', null));
    this.client.on('close', (reason) => {
      if (this.connected) this.notify(reason, true);
      this.setConnected(false);
    });
    this.client.on('status', ({level, message}) =>
      this.emit('notice', {text: message, isError: level > 0}),
    );
    this.client.on('parameters', (list) => {
      const gains = list.filter(({value}) => typeof value === 'number' || value === null);
      this.emit('values', new Map(gains.map(({name, value}) => [name, value as number | null])));
    });
    this.client.subscribe('/situation', (message) => {
      this.situation = message as Situation;
      this.emit('situation', this.situation);
      if (!this.connected) void this.begin();
    });
    this.client.subscribe('/cycles', (message) => {
      if (!this.samples) return;
      this.samples.append(message as Cycles);
      this.note(this.samples);
      this.emit('cycles', message as Cycles);
    });
    this.client.subscribe('/statistics', (message) => {
      this.statistics = message as Statistics;
      this.emit('statistics', this.statistics);
    });
    this.client.subscribe('/log', (message) => this.emit('log', message as LogEntry));
    this.client.connect();
  }

  /** True if a request of this page can succeed: nobody else has the controls. */
  get mayOperate(): boolean {
    const s = this.situation;
    return this.connected && s !== null && s.operates && (s.you_operate || s.operator === '');
  }

  /** True if this page can stop the robot, also while somebody else has the controls. */
  get mayStop(): boolean {
    return this.connected && this.situation !== null && this.situation.operates;
  }

  /** Asks for something. A refusal is shown to the user and returned. */
  async ask(service: string, request: object = {}): Promise<ServiceAnswer> {
    const answer = await this.askQuietly(service, request);
    if (!answer.success) this.notify(answer.message || `${service} was refused`, true);
    return answer;
  }

  /** Asks for something whose refusal the caller shows. */
  async askQuietly(service: string, request: object = {}): Promise<ServiceAnswer> {
    try {
      return (await this.client.call(service, request)) as ServiceAnswer;
    } catch (error) {
      return {success: false, message: (error as Error).message};
    }
  }

  /** Waits for the cycle of a number, or a later one. It may arrive after an answer of the loop. */
  arrival(number: number): Promise<void> {
    return new Promise((resolve) => {
      this.awaited.push({number, resolve});
      if (this.samples) this.note(this.samples);
    });
  }

  publish(topic: string, message: object): void {
    this.client.publish(topic, message);
  }

  notify(text: string, isError = false): void {
    this.emit('notice', {text, isError});
  }

  /** Shows simulated futures, or no more. */
  showFutures(futures: Futures | null): void {
    if (futures === this.futures) return;
    this.futures = futures;
    this.emit('futures', futures);
  }

  private note(samples: Samples): void {
    const newest = samples.value('number', samples.end - 1);
    for (const {resolve} of this.awaited.filter(({number}) => number <= newest)) resolve();
    this.awaited = this.awaited.filter(({number}) => !(number <= newest));
  }

  private setConnected(connected: boolean): void {
    if (connected === this.connected) return;
    this.connected = connected;
    this.emit('connection', connected);
  }

  // After a new connection everything may be different: the program behind the port can be another.
  private async begin(): Promise<void> {
    this.setConnected(true);
    try {
      const sheet = (await this.client.call('/robot', {})) as RobotSheet;
      this.sheet = sheet;
      this.samples = new Samples(sheet);
      this.awaited = []; // of the program before
      this.emit('robot', sheet);
      const {parameters} = (await this.client.call('/describe_parameters', {})) as {
        parameters: Parameter[];
      };
      this.emit('parameters', parameters);
      this.client.watchParameters(parameters.map(({name}) => name));
    } catch (error) {
      this.notify((error as Error).message, true);
    }
    if (this.situation) this.emit('situation', this.situation);
  }
}
