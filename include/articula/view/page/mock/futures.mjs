// SPDX-License-Identifier: Apache-2.0
// The futures of the mock arm: robots of other masses, with some gains and perhaps from a recorded cycle.
import {Arm, joints, sheet} from './arm.mjs';

const shares = [0, 0.1, 0.5, 0.9, 1];
const number = (x) => (Number.isFinite(x) ? x : null);

/** The answer of /futures. */
export function futures(arm, gains, question) {
  const {count = 100, horizon = 1, samples = 50, mass = 0.2, start} = question;
  const all = Array.from({length: count}, (_, k) =>
    future(arm, gains, question, 1 + mass * (count > 1 ? (2 * k) / (count - 1) - 1 : 0)),
  );
  const shuffled = all.map((_, k) => all[(k * 37) % count]);
  return {
    success: true,
    message: 'done',
    time: start?.time ?? arm.time,
    horizon,
    samples,
    count,
    unstable: all.filter(({swings}) => swings >= 4).length,
    non_finite: 0,
    shares,
    joints: joints.map(({name}, j) => ({
      name,
      quantiles: shares.map((share) =>
        Array.from({length: samples + 1}, (_, sample) => {
          const values = all.map(({positions}) => positions[sample][j]).sort((a, b) => a - b);
          return values[Math.round(share * (count - 1))];
        }),
      ),
      curves: shuffled.slice(0, 8).map(({positions}) => positions.map((q) => q[j])),
    })),
    margins: joints.map((joint, j) => ({
      controller: 'pid_plus_gravity',
      joint: joint.name,
      ...margins(joint, gains.p[j], gains.i[j], gains.d[j]),
    })),
  };
}

/** One future: positions at the samples, and how often a drive swings between its limits at the end. */
function future(arm, gains, question, mass) {
  const {horizon = 1, samples = 50, start, steps = {}, reference_step: step} = question;
  const references = question.references?.map(({position}) => position);
  const offset = joints.map(({name}) => steps[name] ?? 0);
  const own = Object.assign(new Arm(), {mass, gains, integral: [...arm.integral]});
  own.position = [...(start?.position ?? arm.position)];
  own.velocity = [...(start?.velocity ?? arm.velocity)];
  if (start) own.integral = [...question.history.at(-1).command[0]]; // the load that it carries
  own.velocity = own.velocity.map((v) => v + 1e-3 * Math.sign(mass - 1)); // as noise would do
  const cycles = Math.round(horizon / sheet.period);
  const positions = [[...own.position]];
  const sides = [0, 0];
  let swings = 0;
  for (let cycle = 0; cycle < cycles; ++cycle) {
    const place = Math.floor((cycle * sheet.period) / (step || sheet.period) + 1e-9);
    const reference = references
      ? references[Math.min(place, references.length - 1)]
      : (start?.position ?? arm.reference);
    own.reference = reference.map((q, j) => q + offset[j]);
    own.step();
    if (4 * cycle >= 3 * cycles) {
      joints.forEach(({effort}, j) => {
        if (Math.abs(own.effort[j]) < effort) return;
        const side = Math.sign(own.effort[j]);
        if (sides[j] * side < 0) ++swings;
        sides[j] = side;
      });
    }
    if ((cycle + 1) * samples >= positions.length * cycles) positions.push([...own.position]);
  }
  return {positions, swings};
}

/** The margins of a joint as an inertia with damping, under a PID controller with half a period of delay. */
function margins({inertia, damping}, p, i, d) {
  const delay = sheet.period / 2;
  const loop = (w) => {
    const gain = Math.hypot(p, d * w - i / w) / (w * Math.hypot(inertia * w, damping));
    const phase =
      Math.atan2(d * w - i / w, p) - Math.PI / 2 - Math.atan2(inertia * w, damping) - w * delay;
    return {gain, phase};
  };
  let crossover = NaN;
  let critical = NaN;
  for (let w = 0.1; w < Math.PI / sheet.period; w *= 1.002) {
    if (loop(w).gain >= 1) crossover = w;
    if (Number.isNaN(critical) && loop(w).phase < -Math.PI && w > crossover) critical = w;
  }
  const phase = Math.PI + loop(crossover).phase;
  return {
    stable: phase > 0,
    gain_margin: number(1 / loop(critical).gain),
    phase_margin: number(phase),
    delay_margin: number(phase / crossover),
  };
}
