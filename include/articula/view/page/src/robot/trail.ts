// SPDX-License-Identifier: Apache-2.0
import {
  BufferAttribute,
  BufferGeometry,
  Line,
  LineBasicMaterial,
  type Object3D,
  Vector3,
} from 'three';

const capacity = 1500; // points

/** The path of a link's origin. */
export class Trail {
  readonly line: Line<BufferGeometry, LineBasicMaterial>;
  private readonly points = new Float32Array(3 * capacity);
  private readonly last = new Vector3(Infinity, 0, 0);
  private readonly now = new Vector3();
  private count = 0;

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(this.points, 3));
    this.line = new Line(geometry, new LineBasicMaterial());
    this.line.frustumCulled = false; // its bounds change with every point
    geometry.setDrawRange(0, 0);
  }

  /**
   * Adds the place of a link if it is at least `distance` [m] from the last one. Begins anew if it
   * is as far as `jump` [m]: the robot was reset or spawned elsewhere.
   */
  add(link: Object3D, distance: number, jump: number): void {
    link.getWorldPosition(this.now);
    const step = this.now.distanceTo(this.last);
    if (step < distance) return;
    if (step > jump) this.count = 0;
    this.last.copy(this.now);
    if (this.count === capacity) {
      this.points.copyWithin(0, 3 * (capacity / 2));
      this.count = capacity / 2;
    }
    this.now.toArray(this.points, 3 * this.count++);
    this.line.geometry.setDrawRange(0, this.count);
    this.line.geometry.getAttribute('position').needsUpdate = true;
  }

  clear(): void {
    this.count = 0;
    this.last.set(Infinity, 0, 0);
    this.line.geometry.setDrawRange(0, 0);
  }
}
