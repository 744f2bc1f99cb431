// SPDX-License-Identifier: Apache-2.0
import {
  BufferGeometry,
  Color,
  Float32BufferAttribute,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  PlaneGeometry,
  ShadowMaterial,
  type Scene,
} from 'three';
import {colour} from '../theme';

const reach = 24; // squares from the origin to where the lines have faded

/** Squares on the ground, which fade away from the robot, and the shadow that falls on them. */
export class Ground {
  square = 0.1; // side of a square [m]
  private height = 0;
  private readonly lines = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({vertexColors: true, transparent: true, depthWrite: false}),
  );
  private readonly floor = new Mesh(new PlaneGeometry(), new ShadowMaterial({depthWrite: false}));

  constructor(scene: Scene) {
    this.floor.receiveShadow = true;
    this.floor.renderOrder = -2; // below the lines
    this.lines.renderOrder = -1;
    this.lines.frustumCulled = false;
    scene.add(this.floor, this.lines);
  }

  set visible(visible: boolean) {
    this.lines.visible = this.floor.visible = visible;
  }

  /** @param radius of the robot [m] */
  place(height: number, radius: number): void {
    this.height = height;
    // Squares of 0.1, 1, 10 ... m, whatever gives the robot some of them.
    this.square = 10 ** Math.round(Math.log10(radius / 4));
    this.paint();
  }

  /** To be called when the colours are others. */
  paint(): void {
    this.floor.material.opacity = Number(colour('--shadow'));
    this.floor.scale.setScalar(2 * reach * this.square);
    this.floor.position.z = this.lines.position.z = this.height;
    this.lines.scale.setScalar(this.square);
    const [plain, tenth] = ['--grid', '--grid-axis'].map((name) => new Color(colour(name)));
    const [alongX, alongY] = ['--axis-x', '--axis-y'].map((name) =>
      new Color(colour(name)).lerp(plain, 0.35),
    );
    const points: number[] = [];
    const colours: number[] = [];
    const vertex = (x: number, y: number, {r, g, b}: Color) => {
      points.push(x, y, 0);
      colours.push(r, g, b, Math.max(0, 1 - (Math.hypot(x, y) / reach) ** 1.5));
    };
    // In parts of a square: lines with an end behind the camera get lost where software draws them.
    for (let line = -reach; line <= reach; ++line) {
      const own = line % 10 === 0 ? tenth : plain;
      for (let k = -reach; k < reach; ++k) {
        if (Math.hypot(line, k + 0.5) > reach) continue;
        for (const end of [k, k + 1]) vertex(end, line, line === 0 ? alongX : own);
        for (const end of [k, k + 1]) vertex(line, end, line === 0 ? alongY : own);
      }
    }
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry()
      .setAttribute('position', new Float32BufferAttribute(points, 3))
      .setAttribute('color', new Float32BufferAttribute(colours, 4));
  }
}
