// SPDX-License-Identifier: Apache-2.0
import {
  Euler,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  Quaternion,
  SphereGeometry,
  type Object3D,
} from 'three';
import type {URDFLink, URDFRobot} from 'urdf-loader';

/**
 * For each link with mass the solid ellipsoid that has its inertia. A wrong inertia is seen at
 * once: its ellipsoid is larger than the link, or lies across it.
 */
export function inertiaEllipsoids(robot: URDFRobot): Object3D[] {
  const sphere = new SphereGeometry(1, 24, 16);
  const material = new MeshLambertMaterial({
    color: 0xd8943b,
    transparent: true,
    opacity: 0.55,
    depthWrite: false,
  });
  return Object.values(robot.links).flatMap((link) => {
    const inertial = link.inertial as URDFLink['inertial'] | undefined;
    if (!inertial || !(inertial.mass > 0)) return [];
    const {ixx, ixy, ixz, iyy, iyz, izz} = inertial.inertia;
    const {values, axes} = principalAxes([
      [ixx, ixy, ixz],
      [ixy, iyy, iyz],
      [ixz, iyz, izz],
    ]);
    // A solid ellipsoid with the semi-axes a, b, c: I_a = m (b^2 + c^2)/5, and so on.
    const sum = values[0] + values[1] + values[2];
    const sizes = values.map((value) =>
      Math.sqrt(Math.max(1e-12, (2.5 / inertial.mass) * (sum - 2 * value))),
    );
    const shape = new Mesh(sphere, material);
    const [roll, pitch, yaw] = inertial.origin.rpy;
    shape.position.fromArray(inertial.origin.xyz);
    shape.quaternion.setFromEuler(new Euler(roll, pitch, yaw, 'ZYX')).multiply(axes);
    shape.scale.fromArray(sizes);
    shape.renderOrder = 1;
    link.add(shape);
    return [shape];
  });
}

/** Eigenvalues and -vectors of a symmetric matrix by Jacobi's rotations. */
function principalAxes(matrix: number[][]): {values: number[]; axes: Quaternion} {
  const a = matrix.map((row) => [...row]);
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < 12; ++sweep) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ]) {
      if (Math.abs(a[p][q]) < 1e-300) continue;
      const angle = 0.5 * Math.atan2(2 * a[p][q], a[q][q] - a[p][p]);
      const c = Math.cos(angle);
      const s = Math.sin(angle);
      for (const m of [a, v]) {
        for (const row of m) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
      }
      for (let k = 0; k < 3; ++k)
        [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
    }
  }
  const m = new Matrix4().set(
    v[0][0],
    v[0][1],
    v[0][2],
    0,
    v[1][0],
    v[1][1],
    v[1][2],
    0,
    v[2][0],
    v[2][1],
    v[2][2],
    0,
    0,
    0,
    0,
    1,
  );
  return {values: [a[0][0], a[1][1], a[2][2]], axes: new Quaternion().setFromRotationMatrix(m)};
}
