// SPDX-License-Identifier: Apache-2.0
import {Mesh, type Object3D, Plane, Raycaster, Vector2, Vector3} from 'three';
import type {URDFJoint, URDFLink, URDFRobot} from 'urdf-loader';
import {ForceArrow} from './force_arrow';
import type {Stage} from './stage';

/** A force on a point of a link, in the words of the service /pull. */
export interface PullRequest {
  link: string;
  point: number[]; // in the link's frame [m]
  force: number[]; // in the root link's frame [N]
}

const interval = 1000 / 30; // ms between two requests: the force of a hand changes slower

/** Turns a drag on the robot into the force of a spring between the grabbed point and the mouse. */
export class PullTool {
  enabled = false;
  reach = 1; // of the robot [m]
  efforts = new Map<string, number>(); // largest of each joint [N m or N]
  robot: URDFRobot | null = null;
  private link: URDFLink | null = null;
  private readonly point = new Vector3(); // grabbed, in the link's frame
  private readonly plane = new Plane();
  private readonly target = new Vector3();
  private readonly force = new Vector3();
  private readonly ray = new Raycaster();
  private readonly arrow = new ForceArrow();
  private largest = 0; // N
  private lastSent = 0;

  /** @param send   receives at most 30 requests per second, and 0 N at the end
   *  @param shown  receives the size of the force, null at the end */
  constructor(
    private readonly stage: Stage,
    private readonly send: (pull: PullRequest) => void,
    private readonly shown: (newtons: number | null) => void,
  ) {
    stage.scene.add(this.arrow);
    const canvas = stage.canvas;
    // Capturing: the tool sees the pointer before the camera's controls do.
    canvas.addEventListener('pointerdown', (event) => this.grab(event), {capture: true});
    canvas.addEventListener('pointermove', (event) => this.move(event), {capture: true});
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      canvas.addEventListener(name, () => this.release(), {capture: true});
    }
    addEventListener('blur', () => this.release());
  }

  /** Follows the robot, which moves under the force. */
  update(now: number): void {
    if (!this.link) return;
    const from = this.link.localToWorld(this.point.clone());
    this.force.copy(this.target).sub(from);
    this.arrow.point(from, this.target, 4e-3 * this.stage.camera.position.distanceTo(from));
    // A drag over half of the robot's reach gives the whole force.
    this.force.multiplyScalar((2 * this.largest) / this.reach).clampLength(0, this.largest);
    this.shown(this.force.length());
    this.stage.invalidate();
    if (now - this.lastSent < interval) return;
    this.lastSent = now;
    this.request(this.link.urdfName);
  }

  /** Ends the force. */
  release(): void {
    if (!this.link) return;
    const name = this.link.urdfName;
    this.link = null;
    this.force.set(0, 0, 0);
    this.arrow.visible = false;
    this.stage.controls.enabled = true;
    this.request(name);
    this.shown(null);
    this.stage.invalidate();
  }

  private request(link: string): void {
    this.send({link, point: this.point.toArray(), force: this.force.toArray()});
  }

  private grab(event: PointerEvent): void {
    if (!this.enabled || event.button !== 0 || !this.robot) return;
    this.aim(event);
    const hit = this.ray
      .intersectObject(this.robot, true)
      .find(({object}) => object instanceof Mesh && object.visible);
    const link = hit && linkOf(hit.object);
    if (!hit || !link) return;
    this.link = link;
    const strength = event.shiftKey ? 4 : 1;
    this.largest = Math.min(900, strength * this.bearableForce(link, hit.point)); // N
    this.target.copy(hit.point);
    this.point.copy(link.worldToLocal(hit.point.clone()));
    this.plane.setFromNormalAndCoplanarPoint(
      this.stage.camera.getWorldDirection(new Vector3()),
      hit.point,
    );
    this.stage.controls.enabled = false;
    this.stage.canvas.setPointerCapture(event.pointerId);
    event.preventDefault();
  }

  private move(event: PointerEvent): void {
    if (!this.link) return;
    this.aim(event);
    this.ray.ray.intersectPlane(this.plane, this.target);
  }

  // The force that the weakest joint before the link can just resist. Joints that a force cannot
  // turn at all, since it acts close to their axis, do not count.
  private bearableForce(link: URDFLink, point: Vector3): number {
    let force = Infinity;
    for (let at: Object3D | null = link; at; at = at.parent) {
      const joint = at as URDFJoint;
      const effort = joint.isURDFJoint ? this.efforts.get(joint.urdfName) : undefined;
      if (effort === undefined) continue;
      const axis = joint.axis.clone().transformDirection(joint.matrixWorld);
      const arm = point.clone().sub(joint.getWorldPosition(new Vector3()));
      const lever = joint.jointType === 'prismatic' ? 1 : arm.cross(axis).length();
      if (lever > 0.02 * this.reach) force = Math.min(force, effort / lever);
    }
    return Number.isFinite(force) ? force : 50;
  }

  private aim(event: PointerEvent): void {
    const {left, top, width, height} = this.stage.canvas.getBoundingClientRect();
    const place = new Vector2(
      (2 * (event.clientX - left)) / width - 1,
      1 - (2 * (event.clientY - top)) / height,
    );
    this.ray.setFromCamera(place, this.stage.camera);
  }
}

function linkOf(object: Object3D): URDFLink | null {
  for (let at: Object3D | null = object; at; at = at.parent) {
    if ((at as URDFLink).isURDFLink) return at as URDFLink;
  }
  return null;
}
