// SPDX-License-Identifier: Apache-2.0
import {type Cycles, inputs, type LoopChange, type RobotSheet} from './wire';

const longest = 60; // s of history
const largest = 128e6; // bytes of all columns: a robot with many joints gets a shorter history

const jointQuantities = [
  'position',
  'velocity',
  'effort',
  'reference_position',
  'reference_velocity',
  'reference_acceleration',
  'reference_effort',
] as const;

const loopQuantities = ['number', 'latency', 'period', 'update', 'status'] as const;

/** The name of a column: "position/0", "command.effort/1", "latency". */
export function columnName(quantity: string, joint?: number): string {
  return joint === undefined ? quantity : `${quantity}/${joint}`;
}

/**
 * The last cycles in columns, each a ring, with the bits of the loop. A row is named by its index since
 * the start.
 */
export class Samples {
  readonly capacity: number;
  private readonly times: Float64Array;
  private readonly columns = new Map<string, Float64Array>();
  private changes: LoopChange[] = [];
  first = 0; // the oldest row that is still there
  end = 0; // one after the newest

  constructor(private readonly sheet: RobotSheet) {
    const quantities = [...jointQuantities, ...sheet.commands.map((name) => `command.${name}`)];
    const names = quantities.flatMap((name) =>
      sheet.joints.map((_, joint) => columnName(name, joint)),
    );
    names.push(...loopQuantities, ...inputs.map((name) => `input.${name}`));
    this.capacity = Math.ceil(Math.min(longest / sheet.period, largest / (8 * names.length)));
    this.times = new Float64Array(this.capacity);
    for (const name of names) this.columns.set(name, new Float64Array(this.capacity));
  }

  /** The rows as they are now. */
  copy(): Samples {
    const copy = new Samples(this.sheet);
    copy.times.set(this.times);
    for (const [name, values] of this.columns) copy.columns.get(name)?.set(values);
    copy.changes = [...this.changes];
    copy.first = this.first;
    copy.end = this.end;
    return copy;
  }

  append(cycles: Cycles): void {
    const count = cycles.time.length;
    if (count === 0) return;
    for (let row = 0; row < count; ++row) {
      this.times[(this.end + row) % this.capacity] = cycles.time[row];
    }
    for (const quantity of jointQuantities) {
      cycles[quantity].forEach((values, joint) => this.put(columnName(quantity, joint), values));
    }
    for (const [name, joints] of Object.entries(cycles.command)) {
      joints.forEach((values, joint) => this.put(columnName(`command.${name}`, joint), values));
    }
    for (const name of loopQuantities) this.put(name, cycles[name]);
    for (const name of inputs) this.put(`input.${name}`, cycles.input[name]);
    this.end += count;
    this.first = Math.max(this.first, this.end - this.capacity);
    const oldest = this.value('number', this.first);
    this.changes = [...this.changes.filter(({cycle}) => cycle >= oldest), ...cycles.changes];
  }

  get lastTime(): number {
    return this.end > this.first ? this.time(this.end - 1) : 0;
  }

  time(row: number): number {
    return this.times[row % this.capacity];
  }

  /** A value; NaN where the column does not exist. */
  value(column: string, row: number): number {
    return this.columns.get(column)?.[row % this.capacity] ?? NaN;
  }

  /** A function that gives the values of a column, for those who read many of them. */
  reader(column: string): (row: number) => number {
    const values = this.columns.get(column);
    const {capacity} = this;
    return values ? (row) => values[row % capacity] : () => NaN;
  }

  /** A value of each joint. */
  at(quantity: string, row: number): number[] {
    return this.sheet.joints.map((_, joint) => this.value(columnName(quantity, joint), row));
  }

  /** The newest value of each joint. */
  latest(quantity: string): number[] {
    return this.at(quantity, this.end - 1);
  }

  /** The changes before a row that the row before it did not have. */
  changesAt(row: number): object[] {
    const cycle = this.value('number', row);
    return this.changes.filter((own) => own.cycle === cycle).map(({change}) => change);
  }

  /** The first row at or after a time. */
  rowAt(time: number): number {
    return this.firstRow((row) => this.time(row) >= time);
  }

  /** The first row of a cycle's number or a later one. */
  rowOf(number: number): number {
    return this.firstRow((row) => this.value('number', row) >= number);
  }

  /** The first row from which on a condition holds. */
  private firstRow(holds: (row: number) => boolean): number {
    let low = this.first;
    let high = this.end;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (holds(middle)) high = middle;
      else low = middle + 1;
    }
    return low;
  }

  private put(name: string, values: number[]): void {
    const column = this.columns.get(name);
    if (!column) return;
    for (let row = 0; row < values.length; ++row) {
      column[(this.end + row) % this.capacity] = values[row] ?? NaN; // JSON has no NaN but null
    }
  }
}
