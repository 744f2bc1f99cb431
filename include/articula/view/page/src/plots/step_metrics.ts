// SPDX-License-Identifier: Apache-2.0
import {columnName, type Samples} from '../samples';

/** What a joint made of the last change of its reference from one constant value to another. */
export interface StepMetrics {
  from: number;
  to: number;
  start: number; // time at which the reference left its old value [s]
  duration: number; // of the change of the reference [s]; 0 for a step, more along a profile
  rise: number; // from 10 % to 90 % of the way [s]; NaN if it was not reached
  overshoot: number; // beyond the new value, share of the way
  settling: number; // from the start until within 2 % of the way for good [s]; NaN likewise
  error: number; // reference minus position at the end
}

const shortestRest = 0.02; // s that the reference must have rested before and after a change

/** The last step within the rows first..end; null if the reference never rested twice. */
export function lastStep(
  samples: Samples,
  joint: number,
  first: number,
  end: number,
): StepMetrics | null {
  const at = samples.reader(columnName('reference_position', joint));
  const position = samples.reader(columnName('position', joint));
  if (end - first < 3) return null;
  // Back over the rest after the change, then over the change, to the rest before it.
  const to = at(end - 1);
  const least = 1e-5 * Math.max(1, Math.abs(to)); // a change below it is rounding of the samples
  let row = end - 1;
  while (row > first && Math.abs(at(row - 1) - to) <= least) --row;
  if (row === first || samples.time(end - 1) - samples.time(row) < shortestRest) return null;
  const arrival = row;
  while (row > first && Math.abs(at(row) - at(row - 1)) > least / 10) --row;
  if (row === first) return null;
  const from = at(row);
  const height = to - from;
  if (Math.abs(height) <= 10 * least) return null;
  let rest = row; // unless the turning point of a wave
  while (rest > first && Math.abs(at(rest - 1) - from) <= least) --rest;
  if (rest > first && samples.time(row) - samples.time(rest) < shortestRest) return null;

  const start = samples.time(row);
  const duration = arrival - row > 1 ? samples.time(arrival) - start : 0;
  let tenth = NaN;
  let ninety = NaN;
  let furthest = -Infinity;
  let outside = start;
  for (; row < end; ++row) {
    const share = (position(row) - from) / height;
    const time = samples.time(row);
    if (Number.isNaN(tenth) && share >= 0.1) tenth = time;
    if (Number.isNaN(ninety) && share >= 0.9) ninety = time;
    if (Math.abs(share - 1) > 0.02) outside = time;
    furthest = Math.max(furthest, share);
  }
  const settled = outside < samples.time(end - 1);
  return {
    from,
    to,
    start,
    duration,
    rise: ninety - tenth,
    overshoot: Math.max(0, furthest - 1),
    settling: settled ? outside - start : NaN,
    error: to - position(end - 1),
  };
}
