// SPDX-License-Identifier: Apache-2.0
// The services of the mock server: what each does to the arm.
import {sheet} from './arm.mjs';
import {futures} from './futures.mjs';
import {go, signals, trajectory} from './motions.mjs';

const names = sheet.joints.map(({name}) => name);
const done = {success: true, message: 'done'};
const refuse = (message) => ({success: false, message});

export function parameters(arm) {
  const units = {p: 'N m/rad', i: 'N m/(rad s)', d: 'N m s/rad'};
  return names.flatMap((joint, j) =>
    Object.keys(units).map((gain) => ({
      name: `pid_plus_gravity.${joint}.${gain}`,
      value: arm.gains[gain][j],
      unit: units[gain],
      lowest: 0,
      highest: null,
      description: `The gain ${gain} of the joint ${joint}.`,
    })),
  );
}

export function setParameters(arm, values) {
  const known = parameters(arm);
  for (const [name, value] of Object.entries(values)) {
    if (!known.some((entry) => entry.name === name))
      return refuse(`${name}: there is no such parameter`);
    if (!(value >= 0)) return refuse(`${name}: ${value} is below the lowest value, 0`);
  }
  for (const [name, value] of Object.entries(values)) {
    const [, joint, gain] = name.split('.');
    arm.gains[gain][names.indexOf(joint)] = value;
  }
  return done;
}

/** Positions by name as an array; the others rest. Or a refusal. */
function goal(arm, positions) {
  const result = [...arm.reference];
  for (const [name, value] of Object.entries(positions)) {
    const j = names.indexOf(name);
    if (j < 0) return refuse(`there is no joint ${name}`);
    const {lower, upper} = sheet.joints[j].limits;
    if (value < lower || value > upper)
      return refuse(`${name}: ${value} rad is outside of its limits, ${lower} .. ${upper} rad`);
    result[j] = value;
  }
  return result;
}

function move(arm, motion, source) {
  if (arm.mode !== 'active') return refuse(`the loop is ${arm.mode}`);
  arm.motion = motion;
  arm.source = source;
  const cycle = arm.number + 1;
  // The answer comes when the motion has ended.
  return new Promise((resolve) => {
    const timer = setInterval(() => {
      if (arm.source === source) return;
      clearInterval(timer);
      resolve({success: true, message: 'goal reached', cycle});
    }, 10);
  });
}

export const services = {
  activate: (arm) => {
    if (arm.mode === 'fault') return refuse('acknowledge the fault first');
    arm.mode = 'active';
    return done;
  },
  deactivate: (arm) => {
    arm.mode = 'inactive';
    arm.rest();
    return done;
  },
  acknowledge_fault: (arm) => {
    if (arm.mode !== 'fault') return refuse('there is no fault');
    arm.mode = 'inactive';
    arm.reference = [...arm.position];
    return done;
  },
  go: (arm, {positions, speed = 1}) => {
    const to = goal(arm, positions);
    if (!Array.isArray(to)) return to;
    void move(arm, 'go', go(arm, to, speed));
    return done;
  },
  set_reference: (arm, {positions}) => {
    const to = goal(arm, positions);
    if (!Array.isArray(to)) return to;
    arm.rest();
    arm.reference = to;
    return done;
  },
  play_trajectory: (arm, {joint_names, points}) =>
    move(arm, 'trajectory', trajectory(arm, joint_names, points, names)),
  play_signals: (arm, request) =>
    move(arm, 'signals', signals(arm, request.signals, request.duration, names)),
  stop: (arm) => {
    arm.rest();
    return done;
  },
  switch_controllers: (arm, {start = [], stop = [], replace = false}) => {
    const status = (name) => arm.controllers.find((c) => c.name === name)?.status;
    for (const name of start)
      if (status(name) === 'active') return refuse(`${name}: already active`);
    for (const name of stop) if (status(name) !== 'active') return refuse(`${name}: not active`);
    const left = arm.controllers.filter((c) => c.status === 'active' && !stop.includes(c.name));
    if (start.length > 0 && left.length > 0 && !replace)
      return refuse(`${start[0]}: another controller of these joints is active or starts, too; stop it or replace it`);
    for (const c of arm.controllers) {
      if (start.includes(c.name)) c.status = 'active';
      else if (stop.includes(c.name) || (start.length > 0 && replace)) c.status = 'inactive';
    }
    return done;
  },
  set_parameters: (arm, {values}) => setParameters(arm, values),
  futures: (arm, question) => {
    const proposed = {gains: structuredClone(arm.gains)};
    const answer = setParameters(proposed, question.gains ?? {});
    return answer.success ? futures(arm, proposed.gains, question) : answer;
  },
  pause: (arm, {paused}) => {
    arm.paused = paused;
    return done;
  },
  step: (arm, {cycles = 1}) => {
    arm.pendingSteps = (arm.pendingSteps ?? 0) + cycles;
    return done;
  },
  set_speed: (arm, {factor}) => {
    arm.speed = factor;
    return done;
  },
  reset: (arm, {positions = {}}) => {
    arm.reset(names.map((name) => positions[name] ?? 0));
    return done;
  },
  pull: (arm, request) => {
    arm.pull = request.force.every((x) => x === 0) ? null : request;
    return done;
  },
  fail: (arm) => {
    // only here: lets the page show a fault
    arm.mode = 'fault';
    arm.fault = 'stale state';
    arm.advice = 'Check the cable of the drive and acknowledge the fault.';
    return done;
  },
};
