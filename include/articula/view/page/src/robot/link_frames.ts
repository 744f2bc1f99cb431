// SPDX-License-Identifier: Apache-2.0
import {CylinderGeometry, Euler, Group, Mesh, MeshBasicMaterial, type Object3D} from 'three';
import type {URDFRobot} from 'urdf-loader';

// Turns the axis of three's cylinders, y, into x, y and z.
const turns = [new Euler(0, 0, -Math.PI / 2), new Euler(), new Euler(Math.PI / 2, 0, 0)];
const colours = [0xe5484d, 0x46a758, 0x3e8bff];

/** The frame of each link: x red, y green, z blue. */
export function linkFrames(robot: URDFRobot, length: number): Object3D[] {
  const shape = new CylinderGeometry(0.03 * length, 0.03 * length, length, 8);
  shape.translate(0, length / 2, 0);
  const materials = colours.map((color) => new MeshBasicMaterial({color, depthTest: false, transparent: true}));
  return Object.values(robot.links).map((link) => {
    const frame = new Group();
    turns.forEach((turn, k) => {
      const axis = new Mesh(shape, materials[k]);
      axis.rotation.copy(turn);
      axis.renderOrder = 3; // in front of the robot, which would hide most of them
      frame.add(axis);
    });
    link.add(frame);
    return frame;
  });
}
