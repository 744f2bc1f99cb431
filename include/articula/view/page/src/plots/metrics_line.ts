// SPDX-License-Identifier: Apache-2.0
import {element, format, formatTime} from '../dom';
import type {Samples} from '../samples';
import {jointColour} from '../theme';
import {positionUnit, type RobotSheet} from '../wire';
import type {Signal} from './quantities';
import {lastStep} from './step_metrics';

/** What the last step of each joint within a range of time was like. */
export function stepLines(
  samples: Samples,
  sheet: RobotSheet,
  joints: number[],
  from: number,
  to: number,
): HTMLElement[] {
  // A loop that is activated sets the reference to the position, which is no step of it.
  const end = samples.rowAt(to);
  let first = samples.rowAt(from);
  for (let row = end - 1; row >= first; --row)
    if (samples.value('status', row) !== 0) first = row + 1;
  return joints.flatMap((joint) => {
    const step = lastStep(samples, joint, first, end);
    if (!step) return [];
    const unit = positionUnit(sheet.joints[joint]);
    const name = element('b', {}, sheet.joints[joint].name);
    name.style.setProperty('--line', jointColour(joint));
    // The rise along a profile is that of the profile.
    const kind = step.duration === 0 ? 'step' : 'motion';
    const rise = step.duration === 0 ? `rise ${formatTime(step.rise)}` : `takes ${formatTime(step.duration)}`;
    const text =
      ` ${kind} ${format(step.from)} → ${format(step.to)} ${unit}: ` +
      `${rise}, overshoot ${format(100 * step.overshoot, 3)} %, ` +
      `settles in ${formatTime(step.settling)}, error ${format(step.error, 5)} ${unit}`;
    return [element('span', {}, name, text.replaceAll('-', '−'))];
  });
}

/** Where the cursors A and B are, and how the signals differ between them. */
export function cursorLine(
  samples: Samples,
  signals: Signal[],
  [a, b]: [number | null, number | null],
): HTMLElement[] {
  if (a === null) return [];
  if (b === null) {
    return [element('span', {}, `A at ${format(a, 6)} s. Shift and click sets B.`)];
  }
  const [before, after] = [a, b].map((time) => Math.min(samples.rowAt(time), samples.end - 1));
  const differences = signals.map(({quantity, joint, label, unit}) => {
    const value = quantity.reader(samples, joint);
    return `${label} ${format(value(after) - value(before), 4)} ${unit}`;
  });
  return [element('span', {}, `B − A = ${formatTime(b - a)}, ${differences.join(', ')}`)];
}
