// SPDX-License-Identifier: Apache-2.0
import {element} from '../dom';
import type {Parameter} from '../wire';

/** The field of one gain, with its unit and range. */
export class GainField {
  readonly box: HTMLElement;
  readonly isShort: boolean; // as p, i, d: they stand side by side
  private readonly input: HTMLInputElement;
  private readonly refusal = element('span', {class: 'refusal', role: 'alert'});

  constructor(
    readonly parameter: Parameter,
    label: string,
    changed: () => void,
  ) {
    this.isShort = label.length <= 3;
    const {name, unit, lowest, highest, description} = parameter;
    const range = `${lowest ?? '−∞'} … ${highest ?? '∞'}`;
    this.input = element('input', {
      type: 'number',
      step: 'any',
      placeholder: 'none',
      'aria-label': `${name} [${unit}]`,
      title: `${description}\n${name}, ${range} ${unit}`,
      input: () => {
        this.mark();
        changed();
      },
    });
    const bound = lowest !== null && highest === null ? `≥ ${lowest}` : range;
    this.box = element(
      'label',
      {class: this.isShort ? 'gain' : 'gain long'},
      element('span', {class: 'label'}, label),
      this.input,
      element('span', {class: 'unit'}, `${unit || '1'}`),
      element('span', {class: 'bound'}, bound),
      this.refusal,
    );
    this.reset();
  }

  /** The number in the field; NaN if there is none. */
  get value(): number {
    return this.input.value === '' ? NaN : this.input.valueAsNumber;
  }

  get isChanged(): boolean {
    return !Object.is(this.value, this.parameter.value ?? NaN);
  }

  /** The value that holds in the loop. A number that the user is about to change stays. */
  holds(value: number): void {
    const changed = this.isChanged;
    this.parameter.value = value;
    if (!changed || this.value === value) this.reset();
    this.mark();
  }

  reset(): void {
    this.input.value = String(this.parameter.value ?? ''); // a field cannot hold infinity
    this.refuse('');
    this.mark();
  }

  refuse(reason: string): void {
    this.refusal.textContent = reason;
    if (reason) this.box.closest('details')?.setAttribute('open', '');
    this.input.setAttribute('aria-invalid', String(reason !== ''));
  }

  enable(on: boolean): void {
    this.input.disabled = !on;
  }

  private mark(): void {
    this.box.classList.toggle('changed', this.isChanged);
  }
}
