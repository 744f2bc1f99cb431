// SPDX-License-Identifier: Apache-2.0
import {Quaternion, Vector3} from 'three';

const size = 76; // pixels
const arm = 25; // pixels
const axes: [name: string, direction: Vector3, series: string][] = [
  ['x', new Vector3(1, 0, 0), 'var(--axis-x)'],
  ['y', new Vector3(0, 1, 0), 'var(--axis-y)'],
  ['z', new Vector3(0, 0, 1), 'var(--axis-z)'],
];

/** The directions of x, y and z in a corner of the view. A click on one looks along it. */
export class Compass {
  readonly box = svg('svg', {
    class: 'compass',
    viewBox: `${-size / 2} ${-size / 2} ${size} ${size}`,
    width: size,
    height: size,
  });
  private readonly arms: {part: SVGElement; line: SVGElement; head: SVGElement}[];
  private readonly shown = new Quaternion(0, 0, 0, 0);

  /** @param look receives the direction in which the camera shall stand */
  constructor(look: (from: Vector3) => void) {
    this.arms = axes.map(([name, direction, colour]) => {
      const line = svg('line', {stroke: colour, 'stroke-width': 2.5, 'stroke-linecap': 'round'});
      const disc = svg('circle', {r: 8, fill: colour});
      const text = svg('text', {'text-anchor': 'middle', y: 4});
      text.textContent = name;
      const head = svg('g', {role: 'button', tabindex: 0, 'aria-label': `Look along ${name}`}, disc, text);
      head.addEventListener('click', () => look(direction));
      head.addEventListener('keydown', (event) => {
        if ((event as KeyboardEvent).key === 'Enter') look(direction);
      });
      const title = svg('title', {});
      title.textContent = `Look along ${name}`;
      head.append(title);
      const part = svg('g', {}, line, head);
      this.box.append(part);
      return {part, line, head};
    });
  }

  /** Follows the camera. */
  show(camera: Quaternion): void {
    if (this.shown.angleTo(camera) < 1e-3) return;
    this.shown.copy(camera);
    const back = camera.clone().invert();
    const places = axes.map(([, direction]) => direction.clone().applyQuaternion(back));
    this.arms.forEach(({line, head}, k) => {
      const [x, y] = [arm * places[k].x, -arm * places[k].y];
      line.setAttribute('x2', x.toFixed(1));
      line.setAttribute('y2', y.toFixed(1));
      head.setAttribute('transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
    });
    // What is nearer is drawn later, unless somebody has moved there by the keyboard.
    if (this.box.contains(document.activeElement)) return;
    const order = [...this.arms.keys()].sort((a, b) => places[a].z - places[b].z);
    this.box.append(...order.map((k) => this.arms[k].part));
  }
}

function svg(tag: string, attributes: Record<string, string | number>, ...children: Element[]): SVGElement {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}
