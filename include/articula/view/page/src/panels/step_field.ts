// SPDX-License-Identifier: Apache-2.0
import {element, numberField, select} from '../dom';
import type {Session} from '../session';
import {isPrismatic, positionRange, positionUnit, type SheetJoint} from '../wire';

const automatic = 'changed'; // no joint's name, since the options of joints have a prefix
const prefix = 'joint ';

/** A test step in the simulated futures: it shows the gains also where the robot rests. */
export class StepField {
  readonly box: HTMLElement;
  private readonly joint: HTMLSelectElement;
  private readonly height: HTMLInputElement;
  private readonly unit = element('span', {class: 'unit'});

  constructor(
    private readonly session: Session,
    private readonly changed: () => void,
  ) {
    this.joint = select('Joint of the test step', [], () => this.choose());
    const {input} = numberField('Height of the test step', 0.1, '', {
      'aria-label': 'Height of the test step',
      input: () => changed(),
    });
    this.height = input;
    this.box = element(
      'div',
      {class: 'row step', title: 'A step of the reference in the simulated futures alone'},
      element('span', {class: 'muted'}, 'Simulated step'),
      this.joint,
      input,
      this.unit,
    );
    session.on('robot', (sheet) => {
      this.joint.replaceChildren(
        element('option', {value: automatic}, 'changed joints'),
        element('option', {value: ''}, 'none'),
        ...sheet.joints.map(({name}) => element('option', {value: prefix + name}, name)),
      );
      this.choose();
    });
  }

  /** Whether the user has chosen a joint: its step is simulated with the gains of the loop, too. */
  get isChosen(): boolean {
    return this.joint.value.startsWith(prefix);
  }

  /**
   * The height by joint; empty: no step.
   * @param tuned     names of the joints whose gains are changed
   * @param isMoving  the reference moves: then the gains are seen without a step
   */
  steps(tuned: Set<string>, isMoving: boolean): Record<string, number> {
    const joints = this.session.sheet?.joints ?? [];
    if (this.isChosen) {
      const height = this.height.valueAsNumber;
      return Number.isFinite(height) ? {[this.joint.value.slice(prefix.length)]: height} : {};
    }
    if (this.joint.value !== automatic || isMoving) return {};
    const reference = this.session.samples?.latest('reference_position') ?? [];
    const steps = joints.flatMap((joint, k): [string, number][] =>
      tuned.has(joint.name) ? [[joint.name, stepOf(joint, reference[k])]] : [],
    );
    return Object.fromEntries(steps);
  }

  private choose(): void {
    const name = this.joint.value.slice(prefix.length);
    const joint = this.isChosen ? this.session.sheet?.joints.find((own) => own.name === name) : null;
    this.height.hidden = !joint;
    this.unit.textContent = joint ? positionUnit(joint) : '';
    if (joint) this.height.value = String(usualStep(joint));
    this.changed();
  }
}

function usualStep(joint: SheetJoint): number {
  return isPrismatic(joint) ? 0.01 : 0.1;
}

/** A step from a position that stays within the limits, at most a fifth of the range. */
function stepOf(joint: SheetJoint, from: number): number {
  const [low, high] = positionRange(joint);
  const height = Math.min(usualStep(joint), (high - low) / 5);
  return from + height <= high ? height : -height;
}
