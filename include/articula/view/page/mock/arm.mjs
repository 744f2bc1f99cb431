// SPDX-License-Identifier: Apache-2.0
// A simulated arm with two vertical axes, to develop the page without a compiler. Its joints are
// independent; the real simulator is articula's.

const period = 1e-3;
export const joints = [
  {
    name: 'shoulder_active_joint',
    lower: -1.5708,
    upper: 1.5708,
    velocity: 2.27,
    effort: 27.94,
    inertia: 0.42,
    damping: 29.79,
  },
  {
    name: 'elbow_active_joint',
    lower: -1.5708,
    upper: 1.5708,
    velocity: 23.08,
    effort: 13.62,
    inertia: 0.03,
    damping: 2.64,
  },
];

const link = (name, length, width, height, color) =>
  `<link name="${name}">${
    length === 0
      ? ''
      : `
  <visual><origin xyz="${length / 2} 0 0"/><geometry><box size="${length} ${width} ${height}"/></geometry>
  <material name="${name}"><color rgba="${color} 1"/></material></visual>
  <visual><geometry><cylinder radius="${width * 0.75}" length="${height * 1.4}"/></geometry><material name="${name}"/></visual>`
  }</link>`;

const joint = (name, type, parent, child, xyz, limits) => `<joint name="${name}" type="${type}">
  <origin xyz="${xyz}"/><parent link="${parent}"/><child link="${child}"/><axis xyz="0 0 1"/>${
    limits
      ? `<limit lower="${limits.lower}" upper="${limits.upper}" velocity="${limits.velocity}" effort="${limits.effort}"/>`
      : ''
  }</joint>`;

const urdf = `<?xml version="1.0"?><robot name="q2d">
  <link name="base_link"><visual><origin xyz="0 0 0.06"/><geometry><box size="0.24 0.2 0.12"/></geometry>
  <material name="base"><color rgba="0.35 0.38 0.42 1"/></material></visual></link>
  ${joint(joints[0].name, 'revolute', 'base_link', 'shoulder_link', '0 0 0.1477', joints[0])}
  ${link('shoulder_link', 0.343, 0.07, 0.04, '0.75 0.77 0.8')}
  ${joint(joints[1].name, 'revolute', 'shoulder_link', 'elbow_link', '0.343 0 0.04', joints[1])}
  ${link('elbow_link', 0.267, 0.055, 0.035, '0.9 0.9 0.92')}
  ${joint('end_joint', 'fixed', 'elbow_link', 'tool_link', '0.267 0 0')}<link name="tool_link"/></robot>`;

export const sheet = {
  name: 'q2d',
  urdf,
  period,
  is_simulated: true,
  commands: ['effort'],
  mimics: [],
  links: ['base_link', 'shoulder_link', 'elbow_link', 'tool_link'],
  joints: joints.map(({name, lower, upper, velocity, effort}) => ({
    name,
    type: 'revolute',
    limits: {lower, upper, velocity, effort, acceleration: null, jerk: null},
  })),
};

export class Arm {
  number = 0;
  time = 0;
  mode = 'active';
  fault = 'ok';
  advice = '';
  motion = 'rest';
  paused = false;
  speed = 1;
  controllers = [
    {name: 'pid', status: 'inactive'},
    {name: 'pid_plus_gravity', status: 'active'},
  ];
  position = [0, 0];
  velocity = [0, 0];
  effort = [0, 0];
  integral = [0, 0];
  reference = [0, 0];
  referenceVelocity = [0, 0];
  pull = null; // {link, point, force}
  source = null; // time -> [positions, velocities, done]
  gains = {p: [2310, 339], i: [4640, 851], d: [0.299, 0.351]};
  mass = 1; // of the links, relative to the described ones

  /** One cycle: reference, control, motion. */
  step() {
    if (this.source) {
      const [position, velocity, done] = this.source(this.time);
      this.reference = position;
      this.referenceVelocity = velocity;
      if (done) this.rest();
    }
    const torque = this.pullTorque();
    joints.forEach((joint, j) => {
      const error = this.reference[j] - this.position[j];
      const rate = this.referenceVelocity[j] - this.velocity[j];
      const {p, i, d} = this.gains;
      this.integral[j] = clamp(this.integral[j] + i[j] * error * period, joint.effort);
      const asked = this.mode === 'active' ? p[j] * error + this.integral[j] + d[j] * rate : 0;
      this.effort[j] = clamp(asked, joint.effort);
      const decay = Math.exp((-joint.damping / (this.mass * joint.inertia)) * period); // exact for a constant torque
      const end = (this.effort[j] + torque[j]) / joint.damping;
      this.velocity[j] = end + (this.velocity[j] - end) * decay;
      this.position[j] += this.velocity[j] * period;
    });
    ++this.number;
    this.time += period;
  }

  rest() {
    this.source = null;
    this.motion = 'rest';
    this.referenceVelocity = [0, 0];
  }

  reset(position) {
    this.position = [...position];
    this.reference = [...position];
    this.velocity = [0, 0];
    this.integral = [0, 0];
    this.number = 0;
    this.time = 0;
    this.rest();
  }

  pullTorque() {
    if (!this.pull) return [0, 0];
    const [fx, fy] = this.pull.force;
    const [q1, q2] = this.position;
    const elbow = [0.343 * Math.cos(q1), 0.343 * Math.sin(q1)];
    const [x, y] = this.pull.point;
    const onElbow = this.pull.link === 'elbow_link' || this.pull.link === 'tool_link';
    const angle = onElbow ? q1 + q2 : q1;
    const arm = [
      Math.cos(angle) * x - Math.sin(angle) * y,
      Math.sin(angle) * x + Math.cos(angle) * y,
    ];
    const about = (from) => from[0] * fy - from[1] * fx;
    return onElbow ? [about([elbow[0] + arm[0], elbow[1] + arm[1]]), about(arm)] : [about(arm), 0];
  }
}

function clamp(value, size) {
  return Math.max(-size, Math.min(size, value));
}
