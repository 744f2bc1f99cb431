// SPDX-License-Identifier: Apache-2.0
import {element, format} from '../dom';
import {jointColour} from '../theme';
import {isPrismatic, positionRange, positionUnit, type SheetJoint} from '../wire';

/** Slider, number and measured position of one joint. */
export class JointRow {
  readonly box: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly number: HTMLInputElement;
  private readonly needle = element('i', {class: 'needle', title: 'Measured position'});
  private readonly measured = element('output', {class: 'measured', title: 'Measured position'});
  private readonly range: [number, number];
  private readonly step: number;
  /** [rad or m]; the slider itself rounds it, beyond a limit if need be. */
  goal = 0;
  /** True from the user's first touch on, until the goal is reached or given up. */
  touched = false;

  constructor(
    readonly joint: SheetJoint,
    index: number,
    change: (row: JointRow) => void,
  ) {
    this.range = positionRange(joint);
    this.step = isPrismatic(joint) ? 0.001 : 0.01;
    const [min, max] = this.range;
    const unit = positionUnit(joint);
    /** False for a text that is no number. The field then shows again where Go moves the joint. */
    const input = (from: HTMLInputElement): boolean => {
      if (from.value === '' || !Number.isFinite(from.valueAsNumber)) {
        this.set(this.goal);
        return false;
      }
      this.set(Math.min(max, Math.max(min, from.valueAsNumber)));
      this.touched = true;
      this.mark();
      change(this);
      return true;
    };
    // Some browsers make tiny steps by the arrow keys if step is "any": they are handled here.
    this.slider = element('input', {
      type: 'range',
      min,
      max,
      step: 'any',
      'aria-label': `${joint.name} [${unit}]`,
      input: () => input(this.slider),
      keydown: (event: KeyboardEvent) => this.key(event, () => input(this.slider)),
    });
    this.number = element('input', {
      type: 'number',
      min,
      max,
      step: this.step,
      'aria-label': `Goal of ${joint.name} [${unit}]`,
      change: () => input(this.number),
      // Enter moves the robot, and comes before the change.
      keydown: (event: KeyboardEvent) => {
        if (event.key === 'Enter' && !input(this.number)) event.stopPropagation();
      },
    });
    this.box = element(
      'div',
      {class: 'joint'},
      element('b', {class: 'name', title: joint.name}, joint.name),
      this.measured,
      element('div', {class: 'track'}, this.slider, this.needle),
      this.number,
      element('span', {class: 'unit'}, unit),
      element('span', {class: 'limit'}, format(joint.limits.lower, 3)),
      element('span', {class: 'limit'}, format(joint.limits.upper, 3)),
    );
    this.box.style.setProperty('--line', jointColour(index));
    this.set(0);
  }

  /** Shows what is measured, and the reference as long as the user has no goal of his own. */
  show(measured: number, reference: number): void {
    const [min, max] = this.range;
    const share = Math.min(1, Math.max(0, (measured - min) / (max - min)));
    this.needle.style.setProperty('--share', share.toFixed(4));
    this.measured.textContent = format(measured, 4);
    if (!this.touched && document.activeElement !== this.number && Number.isFinite(reference))
      this.set(reference);
  }

  setGoal(value: number): void {
    const [min, max] = this.range;
    this.set(Math.min(max, Math.max(min, value)));
    this.touched = true;
    this.mark();
  }

  giveUp(): void {
    this.touched = false;
    this.mark();
  }

  enable(on: boolean): void {
    this.slider.disabled = this.number.disabled = !on;
  }

  private set(value: number): void {
    this.goal = value;
    this.slider.value = String(value);
    this.number.value = value.toFixed(isPrismatic(this.joint) ? 4 : 3);
    this.slider.setAttribute('aria-valuetext', `${this.number.value} ${positionUnit(this.joint)}`);
  }

  private mark(): void {
    this.box.classList.toggle('touched', this.touched);
  }

  private key(event: KeyboardEvent, changed: () => void): void {
    const steps: Record<string, number> = {
      ArrowRight: 1,
      ArrowUp: 1,
      ArrowLeft: -1,
      ArrowDown: -1,
      PageUp: 10,
      PageDown: -10,
    };
    const step = steps[event.key];
    if (step === undefined) return;
    event.preventDefault();
    this.slider.value = String(
      this.slider.valueAsNumber + step * this.step * (event.shiftKey ? 0.1 : 1),
    );
    changed();
  }
}
