// SPDX-License-Identifier: Apache-2.0
import type uPlot from 'uplot';
import {colour} from '../theme';

const font = '11px system-ui, sans-serif';

/** The range of an axis. A resting signal would otherwise fill the plot with its noise. */
export function niceRange(_: uPlot, low: number, high: number): uPlot.Range.MinMax {
  if (!Number.isFinite(low) || !Number.isFinite(high)) return [-1, 1];
  const least = 2e-3 * Math.max(Math.abs(low), Math.abs(high), 0.1);
  const margin = Math.max(0.06 * (high - low), least);
  return [low - margin, high + margin];
}

/** The axis of the time, below the plot. */
export function timeAxis(): uPlot.Axis {
  return {
    ...common(),
    size: 24,
    gap: 2,
    space: 70,
    values: (_, ticks) => ticks.map((tick) => `${+tick.toFixed(4)} s`),
  };
}

/** The axis of a unit: the first on the left with a grid, the second on the right. */
export function valueAxis(unit: string, isFirst: boolean): uPlot.Axis {
  return {
    ...common(),
    scale: unit,
    side: isFirst ? 3 : 1,
    size: 64,
    space: 22,
    label: `[${unit}]`,
    labelSize: 16,
    labelFont: font,
    labelGap: 0,
    values: (_, ticks, __, ___, step) => tickTexts(ticks, step),
    grid: {show: isFirst, stroke: colour('--plot-grid'), width: 1},
  };
}

function common(): uPlot.Axis {
  const grid = {stroke: colour('--plot-grid'), width: 1};
  return {stroke: colour('--muted'), font, ticks: {show: false}, grid};
}

// As many digits as the distance between two numbers needs.
function tickTexts(ticks: number[], step: number): string[] {
  let digits = 0;
  while (digits < 8 && Math.abs(step * 10 ** digits - Math.round(step * 10 ** digits)) > 1e-6) ++digits;
  return ticks.map((tick) => tick.toFixed(digits).replace('-', '−'));
}
