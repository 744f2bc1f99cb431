// SPDX-License-Identifier: Apache-2.0
import {element} from '../dom';
import type {Parameter} from '../wire';

/** A slider from a tenth of a gain to ten times of it, logarithmic. Its left end is 0 where 0 is allowed. */
export class GainSlider {
  readonly input: HTMLInputElement;
  private middle = 1; // the gain in the middle of the slider
  private decades = 1; // on either side of it

  /** @param moved receives the gain, with three digits */
  constructor(
    private readonly parameter: Parameter,
    moved: (value: number) => void,
  ) {
    const {name, unit, description} = parameter;
    this.input = element('input', {
      type: 'range',
      step: 0.01, // 2.3 %
      'aria-label': `Slider of ${name} [${unit}]`,
      title: `${description}\nFrom a tenth of the gain in the middle to ten times of it, with 0 at the left end if it is allowed`,
      input: () => {
        const value = this.value;
        this.tell(value);
        moved(value);
      },
    });
  }

  /** Puts a gain into the middle. */
  around(value: number): void {
    // Nothing tells how large a gain can become that is 0: four decades around 1.
    [this.middle, this.decades] = value === 0 ? [1, 2] : [value, 1];
    this.input.min = String(-this.decades);
    this.input.max = String(this.decades);
    this.show(value);
  }

  /** Puts a gain into the middle that is beyond the ends. */
  reach(value: number): void {
    if (!(Math.abs(this.placeOf(value)) <= this.decades)) this.around(value);
  }

  /** Shows a gain; at an end one that is beyond it. */
  show(value: number): void {
    const place = this.placeOf(value);
    this.input.hidden = !Number.isFinite(value); // as that of a clamp that does not act
    if (Number.isFinite(place)) this.input.valueAsNumber = place; // the browser keeps it in the range
    this.tell(value);
  }

  private placeOf(value: number): number {
    return value === 0 ? -this.decades : Math.log10(value / this.middle);
  }

  private get value(): number {
    const {lowest, highest} = this.parameter;
    const [low, high] = [lowest ?? -Infinity, highest ?? Infinity];
    const place = this.input.valueAsNumber;
    if (place <= -this.decades && low <= 0 && high >= 0) return 0;
    if (Math.abs(place) < 1e-6) return this.middle; // with all its digits
    const value = Number((this.middle * 10 ** place).toPrecision(3));
    return Math.min(high, Math.max(low, value));
  }

  private tell(value: number): void {
    this.input.setAttribute('aria-valuetext', `${value} ${this.parameter.unit}`);
  }
}
