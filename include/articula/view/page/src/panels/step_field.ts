// SPDX-License-Identifier: Apache-2.0
import {element, numberField, select} from '../dom';
import type {Session} from '../session';
import {isPrismatic, positionUnit} from '../wire';

/** A test step in the simulated futures: it shows the gains also where the robot rests. */
export class StepField {
  readonly box: HTMLElement;
  private readonly joint: HTMLSelectElement;
  private readonly height: HTMLInputElement;

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
    const unit = element('span', {class: 'unit'});
    this.box = element(
      'div',
      {class: 'row step', title: 'A step of the reference in the simulated futures alone'},
      element('span', {class: 'muted'}, 'Simulated step'),
      this.joint,
      input,
      unit,
    );
    session.on('robot', (sheet) => {
      this.joint.replaceChildren(
        element('option', {value: ''}, 'none'),
        ...sheet.joints.map(({name}) => element('option', {value: name}, name)),
      );
      this.choose();
    });
  }

  /** The height by joint; empty: no step. */
  get steps(): Record<string, number> {
    const height = this.height.valueAsNumber;
    return this.joint.value !== '' && Number.isFinite(height) ? {[this.joint.value]: height} : {};
  }

  private choose(): void {
    const joint = this.session.sheet?.joints.find(({name}) => name === this.joint.value);
    this.height.hidden = !joint;
    const unit = this.box.querySelector('.unit');
    if (unit) unit.textContent = joint ? positionUnit(joint) : '';
    if (joint) this.height.value = isPrismatic(joint) ? '0.01' : '0.1';
    this.changed();
  }
}
