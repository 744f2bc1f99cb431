// SPDX-License-Identifier: Apache-2.0
import {
  BufferGeometry,
  Group,
  Line,
  LineBasicMaterial,
  Quaternion,
  Vector3,
  type Object3D,
} from 'three';
import type {URDFJoint, URDFRobot} from 'urdf-loader';
import type {SheetJoint} from '../wire';

const along = new Vector3(0, 0, 1);
const axisMaterial = new LineBasicMaterial({color: 0x3fb6a8});
const limitMaterial = new LineBasicMaterial({color: 0xe0605f});

/**
 * The axis of each joint that can be commanded, and the range of its motion: an arc with two spokes
 * at its limits, or a line for a joint that slides. They stand in the frame in which the joint is
 * at 0.
 */
export function jointAxes(robot: URDFRobot, joints: SheetJoint[], size: number): Object3D[] {
  return joints.flatMap(({name, type, limits}) => {
    const joint = robot.joints[name];
    if (!joint?.parent) return [];
    const group = new Group();
    const {position, quaternion} = atZero(joint);
    group.position.copy(position);
    group.quaternion
      .copy(quaternion)
      .multiply(new Quaternion().setFromUnitVectors(along, joint.axis.clone().normalize()));
    group.add(line([new Vector3(0, 0, -size), new Vector3(0, 0, size)], axisMaterial));
    const {lower, upper} = limits;
    if (type === 'prismatic') {
      if (lower !== null && upper !== null)
        group.add(line([new Vector3(0, 0, lower), new Vector3(0, 0, upper)], limitMaterial));
    } else {
      const from = lower ?? -Math.PI;
      const to = upper ?? Math.PI;
      const arc = Array.from({length: 49}, (_, k) =>
        spoke(from + ((to - from) * k) / 48, size * 0.7),
      );
      const ends = lower === null ? arc : [new Vector3(), ...arc, new Vector3()];
      group.add(line(ends, limitMaterial));
    }
    joint.parent.add(group);
    return [group];
  });
}

/** The joint's frame at position 0, wherever the joint is now. */
function atZero(joint: URDFJoint): {position: Vector3; quaternion: Quaternion} {
  const before = joint.angle;
  joint.setJointValue(0);
  const result = {position: joint.position.clone(), quaternion: joint.quaternion.clone()};
  joint.setJointValue(before);
  return result;
}

function spoke(angle: number, size: number): Vector3 {
  return new Vector3(size * Math.cos(angle), size * Math.sin(angle), 0);
}

function line(points: Vector3[], material: LineBasicMaterial): Line {
  return new Line(new BufferGeometry().setFromPoints(points), material);
}
