// SPDX-License-Identifier: Apache-2.0
import {columnName, type Samples} from '../samples';
import {lastStep, type StepMetrics} from './step_metrics';

/** What a joint made of a signal. */
export interface Response {
  step: StepMetrics | null;
  rootMeanSquare: number; // of reference minus position
  largest: number; // of the same, absolute
  effort: number; // largest measured effort, absolute
  gain: number | null; // amplitude of the position over that of the reference, for a sine
  phase: number | null; // of the position against the reference [degrees]
}

/** Evaluates the samples between two times. `frequency` [Hz] counts for sines alone. */
export function responseTo(
  samples: Samples,
  joint: number,
  from: number,
  to: number,
  kind: string,
  frequency: number,
): Response {
  const first = samples.rowAt(from);
  const end = samples.rowAt(to);
  const read = (quantity: string, row: number) => samples.value(columnName(quantity, joint), row);
  let squares = 0;
  let largest = 0;
  let effort = 0;
  for (let row = first; row < end; ++row) {
    const error = read('reference_position', row) - read('position', row);
    squares += error * error;
    largest = Math.max(largest, Math.abs(error));
    effort = Math.max(effort, Math.abs(read('effort', row)));
  }
  const result: Response = {
    step: kind === 'step' ? lastStep(samples, joint, first, end) : null,
    rootMeanSquare: Math.sqrt(squares / Math.max(1, end - first)),
    largest,
    effort,
    gain: null,
    phase: null,
  };
  if (kind === 'sine' && frequency > 0) {
    // The last whole periods: the transient at the start is over by then, if there are several.
    const periods = Math.max(1, Math.floor((to - from) * frequency) - 1);
    const range: [number, number] = [samples.rowAt(to - periods / frequency), end];
    const asked = component(samples, columnName('reference_position', joint), ...range, frequency);
    const made = component(samples, columnName('position', joint), ...range, frequency);
    const size = Math.hypot(...asked);
    if (size > 1e-9) {
      result.gain = Math.hypot(...made) / size;
      const angle = Math.atan2(made[1], made[0]) - Math.atan2(asked[1], asked[0]);
      result.phase = (180 / Math.PI) * Math.atan2(Math.sin(angle), Math.cos(angle));
    }
  }
  return result;
}

/** The Fourier coefficient of a column at a frequency: its cosine and its sine part. */
function component(
  samples: Samples,
  column: string,
  first: number,
  end: number,
  frequency: number,
): [number, number] {
  let mean = 0;
  for (let row = first; row < end; ++row) mean += samples.value(column, row) / (end - first);
  let real = 0;
  let imaginary = 0;
  for (let row = first; row < end; ++row) {
    const angle = 2 * Math.PI * frequency * samples.time(row);
    real += (samples.value(column, row) - mean) * Math.cos(angle);
    imaginary -= (samples.value(column, row) - mean) * Math.sin(angle);
  }
  return [real, imaginary];
}
