// SPDX-License-Identifier: Apache-2.0
import type uPlot from 'uplot';
import {jointColour} from '../theme';
import type {Futures} from '../wire';

/** The joints of a plot whose position is drawn, and the scale of each. */
export type FanJoints = {joint: number; unit: string}[];

/** Widens the range of a scale so that the fan fits. */
export function withFan(
  futures: Futures | null,
  joints: FanJoints,
  unit: string,
  low: number | null,
  high: number | null,
): [number, number] {
  let [least, most] = [low ?? Infinity, high ?? -Infinity];
  for (const own of joints) {
    if (own.unit !== unit) continue;
    const fan = futures?.joints[own.joint];
    for (const x of [...(fan?.quantiles.flat() ?? []), futures?.goals[fan?.name ?? '']]) {
      if (x === null || x === undefined || !Number.isFinite(x)) continue;
      least = Math.min(least, x);
      most = Math.max(most, x);
    }
  }
  return [least, most];
}

/** Draws futures: a light band of all, a darker one of most, some curves, and the goals. */
export function drawFan(plot: uPlot, futures: Futures, joints: FanJoints): void {
  const {ctx, bbox} = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.setLineDash([]); // that of the line before is still set
  const step = futures.horizon / futures.samples;
  const x = (k: number) => plot.valToPos(futures.time + k * step, 'x', true);
  for (const {joint, unit} of joints) {
    const fan = futures.joints[joint];
    if (!fan) continue;
    const path = (values: (number | null)[]) =>
      values.flatMap((q, k) => (q === null ? [] : [[x(k), plot.valToPos(q, unit, true)]]));
    const draw = (points: number[][]) => {
      ctx.beginPath();
      for (const [left, top] of points) ctx.lineTo(left, top);
    };
    ctx.fillStyle = ctx.strokeStyle = jointColour(joint);
    for (let low = 0, high = fan.quantiles.length - 1; low < high; ++low, --high) {
      ctx.globalAlpha = 0.15 + 0.12 * low;
      draw([...path(fan.quantiles[low]), ...path(fan.quantiles[high]).reverse()]);
      ctx.fill();
    }
    ctx.globalAlpha = 0.5;
    ctx.lineWidth = devicePixelRatio;
    for (const curve of fan.curves) {
      draw(path(curve));
      ctx.stroke();
    }
  }
  ctx.globalAlpha = 1;
  ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
  for (const {joint, unit} of joints) {
    const goal = futures.goals[futures.joints[joint]?.name];
    if (!Number.isFinite(goal)) continue;
    const y = plot.valToPos(goal, unit, true);
    ctx.strokeStyle = jointColour(joint);
    ctx.beginPath();
    ctx.moveTo(x(0), y);
    ctx.lineTo(x(futures.samples), y);
    ctx.stroke();
  }
  ctx.restore();
}
