// SPDX-License-Identifier: Apache-2.0
import type {Samples} from '../samples';
import type {Signal} from './quantities';

/**
 * Columns for uPlot of the rows first..end: time, then each signal. More rows than `points` are
 * grouped, and each group shows its lowest and highest value, so that no peak gets lost. Groups
 * begin at multiples of their size: a moving window then does not make the line shimmer.
 */
export function plotColumns(
  samples: Samples,
  signals: Signal[],
  first: number,
  end: number,
  points: number,
): number[][] {
  const size = Math.max(1, 2 ** Math.ceil(Math.log2(Math.max(1, (end - first) / points))));
  const columns: number[][] = [[], ...signals.map(() => [])];
  const readers = signals.map(({quantity, joint}) => quantity.reader(samples, joint));
  if (size === 1) {
    for (let row = first; row < end; ++row) {
      columns[0].push(samples.time(row));
      readers.forEach((value, k) => columns[k + 1].push(value(row)));
    }
    return columns;
  }
  for (let from = Math.ceil(first / size) * size; from < end; from += size) {
    const to = Math.min(from + size, end);
    columns[0].push(samples.time(from), samples.time((from + to) >> 1));
    readers.forEach((value, k) => {
      let lowest = from;
      let highest = from;
      for (let row = from; row < to; ++row) {
        if (value(row) < value(lowest)) lowest = row;
        if (value(row) > value(highest)) highest = row;
      }
      columns[k + 1].push(value(Math.min(lowest, highest)), value(Math.max(lowest, highest)));
    });
  }
  return columns;
}
