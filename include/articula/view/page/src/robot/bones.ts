// SPDX-License-Identifier: Apache-2.0
import {
  Box3,
  CylinderGeometry,
  Mesh,
  MeshPhongMaterial,
  SphereGeometry,
  Vector3,
  type Object3D,
} from 'three';
import type {URDFJoint, URDFRobot} from 'urdf-loader';

const up = new Vector3(0, 1, 0); // the axis of three's cylinders

/** Draws the links of a robot without visuals: a bone to each joint, a drum about each axis. */
export function addBones(robot: URDFRobot): void {
  const joints = Object.values(robot.joints);
  const size = 0.02 * extent(joints);
  const bone = new MeshPhongMaterial({color: 0xc6ccd3});
  const drum = new MeshPhongMaterial({color: 0x66707b});
  for (const joint of joints) {
    const length = joint.position.length();
    // The small links of a hand would disappear in bones as thick as those of the arm.
    const radius = length > 1e-6 ? Math.min(size, Math.max(0.2 * size, 0.15 * length)) : size / 2;
    if (length > 1e-6 && joint.parent) {
      const shape = new Mesh(new CylinderGeometry(radius, radius, length, 16), bone);
      shape.position.copy(joint.position).multiplyScalar(0.5);
      shape.quaternion.setFromUnitVectors(up, joint.position.clone().normalize());
      joint.parent.add(shape);
    }
    joint.add(
      joint.jointType === 'fixed'
        ? new Mesh(new SphereGeometry(radius, 16, 10), bone)
        : drumOf(joint, radius, drum),
    );
  }
}

function drumOf(joint: URDFJoint, radius: number, material: MeshPhongMaterial): Object3D {
  const shape = new Mesh(
    new CylinderGeometry(radius * 1.5, radius * 1.5, radius * 4, 24),
    material,
  );
  shape.quaternion.setFromUnitVectors(up, joint.axis.clone().normalize());
  return shape;
}

/** The length of the box around all joints. */
function extent(joints: URDFJoint[]): number {
  const box = new Box3();
  for (const joint of joints) box.expandByPoint(joint.getWorldPosition(new Vector3()));
  return box.isEmpty() ? 0.5 : Math.max(box.getSize(new Vector3()).length(), 0.05);
}
