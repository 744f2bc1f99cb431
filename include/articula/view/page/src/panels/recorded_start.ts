// SPDX-License-Identifier: Apache-2.0
import type {Shown} from '../playback';
import type {Samples} from '../samples';
import type {RobotSheet} from '../wire';

const horizon = 1; // s, as of a question that does not name another one
const most = 20000; // numbers of the references, and of the history: a message has a limit

const measured = ['position', 'velocity', 'effort'];
const references = ['position', 'velocity', 'acceleration', 'effort'];

/** The members of a question for futures that begin at a recorded cycle and follow what came then. */
export function recordedStart({samples, row: shown}: Shown, sheet: RobotSheet): object {
  const row = Math.max(shown, samples.first + 1); // there is a cycle before it
  const commands = sheet.commands.map((name) => `command.${name}`);
  const members = (names: string[], prefix: string, at: number) =>
    Object.fromEntries(names.map((name) => [name, samples.at(`${prefix}${name}`, at)]));

  const history = [];
  for (let k = historyStart(samples, row, sheet); k < row; ++k) {
    history.push({
      ...members(measured, '', k),
      ...Object.fromEntries(
        references.map((name) => [`reference_${name}`, samples.at(`reference_${name}`, k)]),
      ),
      command: commands.map((name) => samples.at(name, k)),
    });
  }
  const cycles = Math.round(horizon / sheet.period);
  const every = Math.max(1, Math.ceil((4 * sheet.joints.length * cycles) / most));
  const ahead = [];
  for (let k = row; k < Math.min(samples.end, row + cycles + 1); k += every)
    ahead.push(members(references, 'reference_', k));
  return {
    start: {time: samples.time(row), ...members(measured, '', row)},
    history,
    references: ahead,
    reference_step: every * sheet.period,
  };
}

/**
 * The first row from which on the controller has to be followed. There the commands tell what it
 * remembers: no drive is at its limit, or the controller has just started.
 */
function historyStart(samples: Samples, row: number, sheet: RobotSheet): number {
  const perRow = (7 + sheet.commands.length) * sheet.joints.length;
  const oldest = Math.max(samples.first, row - Math.floor(most / perRow));
  const isActive = (k: number) => samples.value('status', k) === 0;
  const isFree = (k: number) =>
    !sheet.commands.includes('effort') ||
    samples
      .at('command.effort', k)
      .every((effort, j) => Math.abs(effort) < (sheet.joints[j].limits.effort ?? Infinity));
  let first = row - 1;
  while (first > oldest && !isFree(first) && isActive(first - 1)) --first;
  return first;
}
