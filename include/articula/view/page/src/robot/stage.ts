// SPDX-License-Identifier: Apache-2.0
import {
  BasicShadowMap,
  Box3,
  Color,
  DirectionalLight,
  HemisphereLight,
  Matrix4,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  Sphere,
  Vector3,
  WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {colour, onTheme} from '../theme';
import {drawsInSoftware} from '../graphics';
import {Compass} from './compass';
import {Ground} from './ground';

const usual = new Vector3(0.75, -0.85, 0.62).normalize(); // from the front, the right and above
const spare = 1.3; // room around the robot, for its motions and the buttons at the edges

/** Camera, light and ground. Draws only when something has changed, which spares batteries. */
export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(35, 1, 0.01, 200);
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  frames = 0; // drawn so far
  private readonly renderer: WebGLRenderer;
  readonly compass = new Compass((from) => this.look(from));
  readonly ground: Ground;
  private readonly sun = new DirectionalLight(0xffffff, 2.1);
  private radius = 1;
  private readonly box = new Box3();
  private stale = true;

  constructor(box: HTMLElement) {
    // Smooth edges multiply the work, which a processor alone is too slow for.
    const software = drawsInSoftware();
    this.renderer = new WebGLRenderer({antialias: !software, powerPreference: 'high-performance'});
    this.renderer.setPixelRatio(software ? 1 : Math.min(devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = software ? BasicShadowMap : PCFShadowMap;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.setScalar(software ? 512 : 2048);
    this.sun.shadow.bias = -1e-3;
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute('aria-label', 'The robot in 3D');
    this.canvas.setAttribute('role', 'img');
    box.append(this.canvas);
    this.camera.up.set(0, 0, 1); // as in URDF
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener('change', () => this.invalidate());
    this.scene.add(new HemisphereLight(0xffffff, 0x6b7178, 1.1), this.sun, this.sun.target);
    this.scene.add(this.camera);
    this.ground = new Ground(this.scene);
    new ResizeObserver(() => this.resize(box)).observe(box);
    onTheme(() => this.paint());
    this.paint();
  }

  invalidate(): void {
    this.stale = true;
  }

  /** Draws if something has changed. To be called once per frame of the display. */
  draw(): void {
    this.controls.update();
    if (!this.stale) return;
    this.stale = false;
    this.renderer.render(this.scene, this.camera);
    this.compass.show(this.camera.quaternion);
    ++this.frames;
  }

  /** Shows the whole of a robot. Its ground is at its lowest point, or at 0. */
  fit(box: Box3): void {
    const sphere = box.getBoundingSphere(new Sphere());
    this.radius = Math.max(sphere.radius, 0.05);
    this.box.copy(box);
    this.look(usual);
    this.camera.near = this.radius / 100;
    this.camera.far = this.radius * 200;
    this.camera.updateProjectionMatrix();
    this.sun.target.position.copy(sphere.center);
    this.sun.position.set(-1.6, -2, 5).multiplyScalar(this.radius).add(sphere.center);
    const {camera} = this.sun.shadow;
    camera.left = camera.bottom = -2 * this.radius; // the robot moves
    camera.right = camera.top = 2 * this.radius;
    camera.near = this.radius;
    camera.far = 12 * this.radius;
    camera.updateProjectionMatrix();
    this.ground.place(Math.min(0, box.min.z), this.radius);
  }

  /** Shows the whole robot from a direction. */
  look(from: Vector3): void {
    const direction = from.clone();
    if (Math.hypot(from.x, from.y) < 1e-6) direction.y -= 1e-4; // straight from above nothing is up
    direction.normalize();
    const center = this.box.getCenter(new Vector3());
    const turn = new Matrix4().lookAt(direction, new Vector3(), this.camera.up).invert();
    const half = Math.tan((this.camera.fov * Math.PI) / 360) / spare;
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const {min, max} = this.box;
      const point = new Vector3(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z);
      const {x, y, z} = point.sub(center).applyMatrix4(turn);
      distance = Math.max(distance, z + Math.abs(y) / half, z + Math.abs(x) / half / this.camera.aspect);
    }
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(direction, Math.max(distance, this.radius));
    this.invalidate();
  }

  set gridVisible(visible: boolean) {
    this.ground.visible = visible;
    this.invalidate();
  }

  private paint(): void {
    this.scene.background = new Color(colour('--stage'));
    this.ground.paint();
    this.invalidate();
  }

  private resize(box: HTMLElement): void {
    const {clientWidth: width, clientHeight: height} = box;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.invalidate();
    this.draw(); // at once: a resized canvas is empty
  }
}
