// SPDX-License-Identifier: Apache-2.0
// Sources of the mock arm's reference: functions of time that return [positions, velocities, done].

/** A smooth motion to a position. */
export function go(arm, goal, speed) {
  const from = [...arm.reference];
  const limits = [2.27, 23.08];
  const duration = Math.max(
    0.05,
    ...goal.map((to, j) => (1.875 * Math.abs(to - from[j])) / (limits[j] * speed)),
  );
  const start = arm.time;
  return (time) => {
    const s = Math.min(1, (time - start) / duration);
    const share = s ** 3 * (10 - 15 * s + 6 * s * s);
    const rate = (30 * s * s * (1 - s) ** 2) / duration;
    return [
      goal.map((to, j) => from[j] + share * (to - from[j])),
      goal.map((to, j) => rate * (to - from[j])),
      s >= 1,
    ];
  };
}

/** Straight lines between points. */
export function trajectory(arm, names, points, jointNames) {
  const start = arm.time;
  const from = [...arm.reference];
  const at = (point) =>
    jointNames.map((name, j) => point.positions[names.indexOf(name)] ?? from[j]);
  return (time) => {
    const t = time - start;
    let before = {time: 0, position: from};
    for (const point of points) {
      const after = {time: point.time_from_start, position: at(point)};
      if (t < after.time) {
        const share = (t - before.time) / (after.time - before.time);
        const rate = after.position.map(
          (to, j) => (to - before.position[j]) / (after.time - before.time),
        );
        return [
          before.position.map((value, j) => value + share * (after.position[j] - value)),
          rate,
          false,
        ];
      }
      before = after;
    }
    return [before.position, [0, 0], true];
  };
}

/** Signals added to the present reference. */
export function signals(arm, list, duration, jointNames) {
  const start = arm.time;
  const from = [...arm.reference];
  return (time) => {
    const t = time - start;
    const done = t >= duration;
    const position = [...from];
    for (const signal of list) {
      const j = jointNames.indexOf(signal.joint);
      if (!done || signal.kind === 'step') position[j] += value(signal, t);
    }
    return [position, [0, 0], done];
  };
}

function value(signal, t) {
  const turns = (signal.frequency ?? 0) * t;
  switch (signal.kind) {
    case 'step':
      return t < signal.start ? 0 : signal.height;
    case 'sine':
      return signal.amplitude * Math.sin(2 * Math.PI * turns);
    case 'square':
      return turns % 1 < 0.5 ? signal.amplitude : -signal.amplitude;
    case 'chirp': {
      const growth = Math.log(signal.last_frequency / signal.first_frequency) / signal.duration;
      if (t > signal.duration) return 0;
      const w = 2 * Math.PI * signal.first_frequency;
      return (
        signal.amplitude * Math.sin(growth === 0 ? w * t : (w * Math.expm1(growth * t)) / growth)
      );
    }
    default:
      return 0;
  }
}
