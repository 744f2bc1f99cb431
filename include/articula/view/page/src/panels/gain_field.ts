// SPDX-License-Identifier: Apache-2.0
import {element, unitText} from '../dom';
import type {Parameter} from '../wire';
import {GainSlider} from './gain_slider';

/** The field of one gain, with its slider, unit and range. */
export class GainField {
  readonly box: HTMLElement;
  readonly isShort: boolean; // as p, i, d: they stand side by side
  private readonly input: HTMLInputElement;
  private readonly slider: GainSlider;
  readonly refusal = element('p', {class: 'refusal', role: 'alert'}); // below the fields

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
      title: `${description}\n${name}, ${range} ${unitText(unit)}`,
      input: () => {
        this.slider.show(this.value);
        this.mark();
        changed();
      },
      change: () => this.slider.reach(this.value), // not while it is typed
    });
    this.slider = new GainSlider(parameter, (value) => {
      this.input.value = String(value);
      this.mark();
      changed();
    });
    const bound = lowest !== null && highest === null ? `≥ ${lowest}` : range;
    this.box = element(
      'label',
      {class: this.isShort ? 'gain' : 'gain long'},
      element('span', {class: 'label'}, ...breakable(label)),
      this.input,
      this.slider.input,
      element('span', {class: 'unit'}, unitText(unit || '1')),
      element('span', {class: 'bound'}, bound),
    );
    this.reset();
  }

  /** The number in the field; NaN if there is none, as in that of a clamp that does not act. */
  get value(): number {
    return this.input.value === '' ? NaN : this.input.valueAsNumber;
  }

  /** What the port gets for it. An empty field asks for no limit, as that of a clamp. */
  get setting(): number | 'inf' | '-inf' {
    if (!Number.isNaN(this.value)) return this.value;
    return this.parameter.highest === null ? 'inf' : '-inf';
  }

  /** Whether the field holds text that is no number. */
  get isMalformed(): boolean {
    return this.input.validity.badInput;
  }

  get isChanged(): boolean {
    return !Object.is(this.value, this.parameter.value ?? NaN);
  }

  /** The value that holds in the loop. A number that the user is about to change stays. */
  holds(value: number | null): void {
    const changed = this.isChanged;
    this.parameter.value = Number.isFinite(value) ? value : null;
    if (!changed || !this.isChanged) this.reset();
    this.mark();
  }

  reset(): void {
    this.input.value = String(this.parameter.value ?? ''); // a field cannot hold infinity
    this.slider.around(this.parameter.value ?? NaN);
    this.refuse('');
    this.mark();
  }

  refuse(reason: string): void {
    this.refusal.textContent = reason;
    if (reason) this.refusal.closest('details')?.setAttribute('open', '');
    this.input.setAttribute('aria-invalid', String(reason !== ''));
  }

  enable(on: boolean): void {
    this.input.disabled = this.slider.input.disabled = !on;
  }

  private mark(): void {
    this.box.classList.toggle('changed', this.isChanged);
  }
}

/** A name that may go on in a second line after each underscore. */
function breakable(name: string): (string | Node)[] {
  return name.split(/(?<=_)/).flatMap((part, k) => (k > 0 ? [element('wbr'), part] : [part]));
}
