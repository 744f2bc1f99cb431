// SPDX-License-Identifier: Apache-2.0
// The messages that the server of the view sends, as its documentation has them.

/** Limits of a joint; null means that there is none. Units: rad or m, and per s. */
export interface JointLimits {
  lower: number | null;
  upper: number | null;
  velocity: number | null;
  effort: number | null;
}

export interface SheetJoint {
  name: string;
  type: string; // "revolute", "continuous", "prismatic"
  limits: JointLimits;
}

/** What does not change while a loop runs. */
export interface RobotSheet {
  name: string;
  joints: SheetJoint[];
  links: string[]; // the root first
  commands: string[]; // the quantities of the loop's command, as "effort"
  urdf: string;
  period: number; // of the loop [s]
  is_simulated: boolean;
}

export interface ControllerInfo {
  name: string;
  status: 'inactive' | 'active' | 'failed';
}

/** What changes seldom. */
export interface Situation {
  mode: string; // "inactive", "starting", "active", "fault"
  fault: string;
  advice: string;
  motion: string; // the source of the reference: "rest", "go", "trajectory", "signals", "stop"
  operator: string; // empty: nobody
  you_operate: boolean;
  operates: boolean; // the server lets clients operate
  controllers: ControllerInfo[];
  paused: boolean;
  speed: number;
}

/** Cycles in columns: `position[joint][sample]`. */
export interface Cycles {
  number: number[];
  time: number[];
  status: number[];
  latency: number[];
  period: number[];
  update: number[];
  position: number[][];
  velocity: number[][];
  effort: number[][];
  reference_position: number[][];
  reference_velocity: number[][];
  reference_acceleration: number[][];
  reference_effort: number[][];
  command: Record<string, number[][]>;
  input: Record<(typeof inputs)[number], number[]>; // what else the commands depend on
  changes: LoopChange[]; // of the controllers
  dropped: number;
}

/** The inputs of a cycle, as C++'s CycleInput has them. */
export const inputs = [
  'read',
  'write',
  'request',
  'change',
  'posted',
  'overruns',
  'missed',
] as const;

/** New gains, or a request to switch, before a cycle. */
export interface LoopChange {
  cycle: number;
  change: object;
}

/** The statuses of a cycle by number, as C++'s Status has them. */
export const statuses = [
  'ok',
  'non-finite state',
  'non-finite reference',
  'non-finite command',
  'hardware fault',
  'stale state',
  'stale reference',
  'limit exceeded',
  'overrun',
  'inactive',
];

export interface Parameter {
  name: string; // <controller>.<joint>.<gain>
  value: number | null; // null: infinite, as a clamp that does not act
  unit: string;
  lowest: number | null;
  highest: number | null;
  description: string;
}

export interface Statistics {
  cycles: number;
  overruns: number;
  dropped: number;
  latency_median: number;
  latency_99: number;
  latency_max: number;
  execution_median: number;
  execution_99: number;
  execution_max: number;
}

export interface LogEntry {
  timestamp: {sec: number; nsec: number};
  level: number; // 2 information, 3 warning, 4 error
  message: string;
}

/** Simulated robots with other gains, masses and friction: the answer of /futures. */
export interface Futures {
  time: number; // of the loop, at the first sample [s]
  horizon: number; // until the last sample [s]
  samples: number; // beside the first
  count: number;
  unstable: number; // of them
  non_finite: number; // likewise
  steps: Record<string, number>; // added to references, by joint [rad or m]: the page's, as is the next
  goals: Record<string, number>; // of joints with a step; NaN of others
  shares: number[]; // of the futures below each quantile
  joints: {name: string; quantiles: (number | null)[][]; curves: (number | null)[][]}[];
  margins: {
    controller: string;
    joint: string;
    stable: boolean;
    gain_margin: number | null; // null: infinite
    phase_margin: number | null; // [rad]
    delay_margin: number | null; // [s]
  }[];
}

/** Every service answers so; `success: false` is a refusal, and the message is its reason. */
export interface ServiceAnswer {
  success: boolean;
  message: string;
  cycle?: number; // the first one after the loop began what was asked
}

export function isPrismatic(joint: SheetJoint): boolean {
  return joint.type === 'prismatic';
}

export function positionUnit(joint: SheetJoint): string {
  return isPrismatic(joint) ? 'm' : 'rad';
}

export function effortUnit(joint: SheetJoint): string {
  return isPrismatic(joint) ? 'N' : 'N m';
}

/** The range of a joint's slider. A joint without limits turns at most once in either direction. */
export function positionRange(joint: SheetJoint): [number, number] {
  const reach = isPrismatic(joint) ? 1 : Math.PI;
  return [joint.limits.lower ?? -reach, joint.limits.upper ?? reach];
}
