// SPDX-License-Identifier: Apache-2.0
import {
  Box3,
  LoadingManager,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  SphereGeometry,
  Vector3,
} from 'three';
import URDFLoader, {type URDFRobot} from 'urdf-loader';
import {drawsInSoftware} from '../graphics';
import type {RobotSheet} from '../wire';
import {addBones} from './bones';
import {MeshLoader} from './mesh_loader';

/** A robot and the shadow of its reference, made from the URDF. */
export class RobotModel {
  readonly measured: URDFRobot;
  readonly reference: URDFRobot;
  readonly shadow = new MeshBasicMaterial({
    transparent: true,
    opacity: 0.32,
    depthWrite: false,
    // Where the shadow coincides with the robot, it is a little behind.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 4,
  });
  private readonly names: string[];
  private placed: number[] = [];

  /** @param changed  is called when a mesh has arrived, with what could not be read so far */
  constructor(sheet: RobotSheet, query: string, changed: (failures: string[]) => void) {
    this.names = sheet.joints.map(({name}) => name);
    const meshes = new MeshLoader(query);
    const arrived = () => {
      this.cast(this.reference);
      castShadows(this.measured);
      changed(meshes.failures);
    };
    this.measured = parse(sheet.urdf, meshes, arrived);
    this.reference = parse(sheet.urdf, meshes, arrived);
    this.cast(this.reference);
    castShadows(this.measured);
  }

  /** Moves robot and shadow. False if both stay where they are, but for less than can be seen. */
  place(measured: number[], reference: number[]): boolean {
    const next = [...measured, ...reference, this.showsReference ? 1 : 0];
    const moved = next.some((value, k) => !(Math.abs(value - this.placed[k]) < 2e-5));
    if (!moved) return false;
    this.placed = next;
    this.names.forEach((name, joint) => {
      if (Number.isFinite(measured[joint])) this.measured.setJointValue(name, measured[joint]);
      if (Number.isFinite(reference[joint])) this.reference.setJointValue(name, reference[joint]);
    });
    // A shadow that coincides with the robot only flickers.
    const distance = Math.max(
      ...this.names.map((_, joint) => Math.abs(measured[joint] - reference[joint])),
      0,
    );
    this.reference.visible = this.showsReference && distance > 3e-3;
    return true;
  }

  showsReference = true;

  /** The box around the robot, in the root link's frame. */
  bounds(): Box3 {
    const box = new Box3();
    this.measured.updateMatrixWorld(true);
    this.measured.traverse((part) => {
      if (part instanceof Mesh && !isExtra(part)) box.expandByObject(part);
    });
    return box.isEmpty() ? new Box3().setFromCenterAndSize(new Vector3(), new Vector3(0.5, 0.5, 0.5)) : box;
  }

  /** The link that ends the longest chain of joints. */
  toolLink(): string {
    const depth = (object: Object3D): number => (object.parent ? 1 + depth(object.parent) : 0);
    const links = Object.values(this.measured.links);
    return links.reduce((best, link) => (depth(link) > depth(best) ? link : best)).urdfName;
  }

  dispose(): void {
    for (const robot of [this.measured, this.reference]) {
      robot.removeFromParent();
      robot.traverse((part) => {
        if (part instanceof Mesh) part.geometry.dispose();
      });
    }
  }

  private cast(robot: URDFRobot): void {
    robot.traverse((part) => {
      if (!(part instanceof Mesh)) return;
      part.material = this.shadow;
      part.renderOrder = 1;
    });
  }
}

const extra = 'articula_extra';

/** Marks what is drawn on a robot and is no part of it: it has no shadow, and cannot be pulled. */
export function markExtra(object: Object3D): void {
  object.traverse((part) => {
    part.userData[extra] = true;
    part.castShadow = false;
    part.raycast = () => {};
  });
}

function isExtra(part: Object3D): boolean {
  return part.userData[extra] === true;
}

function castShadows(robot: URDFRobot): void {
  robot.traverse((part) => {
    part.castShadow = part instanceof Mesh && !isExtra(part);
    part.receiveShadow = part.castShadow && !drawsInSoftware(); // a processor alone has the ground's
  });
}

function parse(urdf: string, meshes: MeshLoader, arrived: () => void): URDFRobot {
  const loader = new URDFLoader(new LoadingManager());
  loader.packages = (name: string) => `meshes/${name}`;
  loader.loadMeshCb = (url, manager, material, done) => {
    void meshes.load(url, manager, material).then((mesh) => {
      done(mesh);
      arrived();
    });
  };
  const robot = loader.parse(urdf);
  // The robot is shown where it is measured, also beyond its limits.
  for (const joint of Object.values(robot.joints)) joint.ignoreLimits = true;
  if (!/<visual[\s>]/.test(urdf)) addBones(robot);
  if (drawsInSoftware()) coarsenSpheres(robot);
  return robot;
}

// The loader's spheres have 1740 triangles each, three quarters of those of a PR2. A processor alone
// takes half of a picture's time for them.
function coarsenSpheres(robot: URDFRobot): void {
  robot.traverse((part) => {
    if (!(part instanceof Mesh) || !(part.geometry instanceof SphereGeometry)) return;
    part.geometry = new SphereGeometry(part.geometry.parameters.radius, 16, 10);
  });
}
