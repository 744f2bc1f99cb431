// SPDX-License-Identifier: Apache-2.0
import {McapWriter} from '@mcap/core';
import {columnName, type Samples} from '../samples';
import {inputs, type RobotSheet, statuses} from '../wire';

type Json = {[name: string]: Json} | number | string | null;

// ms of work at a time. A page that takes no messages for seconds loses the controls.
const slice = 10;

/** The part of a file that is in memory. */
class Parts {
  readonly parts: Uint8Array<ArrayBuffer>[] = [];
  private size = 0n;

  position(): bigint {
    return this.size;
  }

  write(bytes: Uint8Array): Promise<void> {
    this.parts.push(new Uint8Array(bytes)); // the writer goes on to use its own
    this.size += BigInt(bytes.length);
    return Promise.resolve();
  }
}

/**
 * The rows first..end as an MCAP file with JSON messages as McapRecordWriter of C++ writes them, so that
 * read_mcap_recording() gives the bits of the loop.
 */
export async function mcapFile(
  samples: Samples,
  sheet: RobotSheet,
  first: number,
  end: number,
): Promise<Uint8Array<ArrayBuffer>[]> {
  const encoder = new TextEncoder();
  const file = new Parts();
  const writer = new McapWriter({writable: file, chunkSize: 1 << 20});
  const record = recordReader(samples, sheet);
  await writer.start({library: 'articula', profile: ''});
  const schemaId = await writer.registerSchema({
    name: 'articula.Cycle',
    encoding: 'jsonschema',
    data: encoder.encode(first < end ? JSON.stringify(schemaOf(JSON.parse(record(first)))) : '{}'),
  });
  const channelId = await writer.registerChannel({
    schemaId,
    topic: 'cycle',
    messageEncoding: 'json',
    metadata: new Map(),
  });
  let next = performance.now() + slice;
  for (let row = first; row < end; ++row) {
    if (performance.now() > next) {
      await new Promise((resolve) => setTimeout(resolve));
      next = performance.now() + slice;
    }
    const logTime = BigInt(Math.round(samples.time(row) * 1e9));
    const data = encoder.encode(record(row));
    await writer.addMessage({channelId, sequence: row - first, logTime, publishTime: logTime, data});
  }
  await writer.end();
  return file.parts;
}

/** A number with all its bits. JSON has neither NaN nor infinity, and readers lose the sign of -0. */
function numberText(value: number): string {
  if (!Number.isFinite(value)) return 'null';
  return Object.is(value, -0) ? '-0.0' : String(value);
}

/** A function that gives the message of a row. */
function recordReader(samples: Samples, sheet: RobotSheet): (row: number) => string {
  type Part = (row: number) => string;
  const column = (name: string): Part => {
    const read = samples.reader(name);
    return (row) => numberText(read(row));
  };
  const object = (members: [string, Part][]): Part => {
    const names = members.map(([name]) => JSON.stringify(name));
    return (row) => `{${members.map(([, part], k) => `${names[k]}:${part(row)}`).join(',')}}`;
  };
  const joint = (index: number): Part => {
    const own = (quantity: string) => column(columnName(quantity, index));
    const commands = sheet.commands.map((name): [string, Part] => [name, own(`command.${name}`)]);
    return object([
      ['position', own('position')],
      ['velocity', own('velocity')],
      ['effort', own('effort')],
      [
        'reference',
        object(
          ['position', 'velocity', 'acceleration', 'effort'].map((name) => [
            name,
            own(`reference_${name}`),
          ]),
        ),
      ],
      ['command', commands.length === 1 ? commands[0][1] : object(commands)],
    ]);
  };
  const status = samples.reader('status');
  const whole = object([
    ['timestamp', (row) => numberText(samples.time(row))],
    [sheet.name, object(sheet.joints.map(({name}, index) => [name, joint(index)]))],
    ['cycle', column('number')],
    ['status', (row) => JSON.stringify(statuses[status(row)] ?? 'unknown status')],
    ['status_number', column('status')],
    ['timing', object(['latency', 'period', 'update'].map((name) => [name, column(name)]))],
    ['input', object(inputs.map((name) => [name, column(`input.${name}`)]))],
  ]);
  return (row) => {
    const text = whole(row);
    const changes = samples.changesAt(row);
    return changes.length === 0
      ? text
      : `${text.slice(0, -1)},"changes":${JSON.stringify(changes)}}`;
  };
}

/** The JSON Schema of objects with the members and types of an example. */
function schemaOf(example: Json): object {
  if (typeof example === 'string') return {type: 'string'};
  if (example === null || typeof example !== 'object') return {type: 'number'};
  const properties = Object.entries(example).map(([name, member]) => [name, schemaOf(member)]);
  return {type: 'object', properties: Object.fromEntries(properties)};
}
