// SPDX-License-Identifier: Apache-2.0
import {
  Color,
  DirectionalLight,
  Fog,
  GridHelper,
  HemisphereLight,
  PerspectiveCamera,
  Scene,
  type Sphere,
  Vector3,
  WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {colour, onTheme} from '../theme';
import {drawsInSoftware} from '../graphics';

/** Camera, light and ground. Draws only when something has changed, which spares batteries. */
export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(35, 1, 0.01, 200);
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  frames = 0; // drawn so far
  private readonly renderer: WebGLRenderer;
  private readonly sun = new DirectionalLight(0xffffff, 1.7);
  private grid = new GridHelper();
  private radius = 1;
  private showsGrid = true;
  private stale = true;

  constructor(box: HTMLElement) {
    // Smooth edges multiply the work, which a processor alone is too slow for.
    const software = drawsInSoftware();
    this.renderer = new WebGLRenderer({antialias: !software, powerPreference: 'high-performance'});
    this.renderer.setPixelRatio(software ? 1 : Math.min(devicePixelRatio, 2));
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute('aria-label', 'The robot in 3D');
    this.canvas.setAttribute('role', 'img');
    box.append(this.canvas);
    this.camera.up.set(0, 0, 1); // as in URDF
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener('change', () => this.invalidate());
    this.scene.add(new HemisphereLight(0xffffff, 0x6b7178, 1.1), this.sun, this.camera);
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
    ++this.frames;
  }

  /** Looks at a robot from the front, the right and above. */
  fit(sphere: Sphere, lowest: number): void {
    this.radius = Math.max(sphere.radius, 0.05);
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (1.06 * this.radius) / Math.sin((this.camera.fov * Math.PI) / 360) / narrow;
    const direction = new Vector3(0.75, -0.85, 0.62).normalize();
    this.controls.target.copy(sphere.center);
    this.camera.position.copy(sphere.center).addScaledVector(direction, distance);
    this.camera.near = this.radius / 100;
    this.camera.far = this.radius * 200;
    this.camera.updateProjectionMatrix();
    this.sun.position.set(this.radius * 2, -this.radius * 3, this.radius * 5);
    this.ground(lowest);
    this.invalidate();
  }

  set gridVisible(visible: boolean) {
    this.showsGrid = visible;
    this.grid.visible = visible;
    this.invalidate();
  }

  private ground(height: number): void {
    this.grid.removeFromParent();
    this.grid.dispose();
    // Squares of 0.1, 1, 10 ... m, whatever gives the robot some of them.
    const square = 10 ** Math.round(Math.log10(this.radius / 4));
    this.grid = new GridHelper(40 * square, 40, colour('--grid-axis'), colour('--grid'));
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.z = height;
    this.grid.visible = this.showsGrid;
    this.scene.add(this.grid);
    this.scene.fog = new Fog(colour('--stage'), this.radius * 4, this.radius * 4 + 16 * square);
  }

  private paint(): void {
    this.scene.background = new Color(colour('--stage'));
    this.ground(this.grid.position.z);
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
