// SPDX-License-Identifier: Apache-2.0
import {ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3} from 'three';

const up = new Vector3(0, 1, 0); // the axis of three's cylinders and cones

/** An arrow with a body: lines are one pixel thin in browsers. */
export class ForceArrow extends Group {
  private readonly shaft: Mesh;
  private readonly head: Mesh;

  constructor() {
    super();
    const material = new MeshBasicMaterial({
      color: 0xff7a1a,
      depthTest: false,
      transparent: true,
      opacity: 0.95,
    });
    this.shaft = new Mesh(new CylinderGeometry(1, 1, 1, 12), material);
    this.head = new Mesh(new ConeGeometry(1, 1, 16), material);
    this.add(this.shaft, this.head);
    this.renderOrder = this.shaft.renderOrder = this.head.renderOrder = 2; // in front of the robot
    this.visible = false;
  }

  /** @param thickness  of the shaft [m] */
  point(from: Vector3, to: Vector3, thickness: number): void {
    const way = to.clone().sub(from);
    const length = way.length();
    this.visible = length > 1e-4;
    if (!this.visible) return;
    const head = Math.min(0.4 * length, 6 * thickness);
    this.position.copy(from);
    this.quaternion.setFromUnitVectors(up, way.normalize());
    this.shaft.scale.set(thickness / 2, length - head, thickness / 2);
    this.shaft.position.y = (length - head) / 2;
    this.head.scale.set(head / 3, head, head / 3);
    this.head.position.y = length - head / 2;
  }
}
