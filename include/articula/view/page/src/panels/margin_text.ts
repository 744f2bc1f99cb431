// SPDX-License-Identifier: Apache-2.0
import {format} from '../dom';
import type {Futures} from '../wire';

/** The margins of a joint in a line. */
export function marginText(margins: Futures['margins'][number]): string {
  if (!margins.stable) return 'Unstable with these gains';
  const {gain_margin: gain, phase_margin: phase, delay_margin: delay} = margins;
  const degrees = phase === null ? '∞' : `${Math.round((phase * 180) / Math.PI)}°`;
  const factor = gain === null ? '∞' : `× ${format(gain, 2)}`;
  const time = delay === null ? '∞' : `${format(1e3 * delay, 2)} ms`;
  return `Margins: gain ${factor}, phase ${degrees}, delay ${time}`;
}
