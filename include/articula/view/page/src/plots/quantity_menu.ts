// SPDX-License-Identifier: Apache-2.0
import {element} from '../dom';
import type {Quantity} from './quantities';

/** The menu by which a plot's quantities are chosen. */
export class QuantityMenu {
  readonly box: HTMLDetailsElement;
  private readonly title = element('summary', {
    class: 'chip',
    title: 'Choose what this plot shows',
  });
  private readonly choices = element('div', {class: 'choices'});
  private readonly end = new AbortController(); // of what listens outside of the menu

  constructor(all: Quantity[], keys: string[], choose: (key: string, on: boolean) => void) {
    this.box = element('details', {class: 'menu'}, this.title, this.choices);
    for (const {key, label} of all) {
      const box = element('input', {type: 'checkbox', change: () => choose(key, box.checked)});
      box.checked = keys.includes(key);
      this.choices.append(element('label', {}, box, label));
    }
    this.box.addEventListener('toggle', () => this.place());
    this.box.addEventListener('focusout', ({relatedTarget}) => this.leave(relatedTarget));
    document.addEventListener('pointerdown', ({target}) => this.leave(target), {
      signal: this.end.signal,
    });
  }

  show(chosen: Quantity[]): void {
    this.title.textContent = chosen.map(({label}) => label).join(', ') || 'nothing chosen';
  }

  destroy(): void {
    this.end.abort();
  }

  private leave(target: EventTarget | null): void {
    if (target && !this.box.contains(target as Node)) this.box.open = false;
  }

  // Above the title if there is no room below. The area of the plots would cut off what exceeds it.
  private place(): void {
    const {left, top, bottom} = this.title.getBoundingClientRect();
    const height = this.choices.offsetHeight + 4;
    const fits = bottom + height < innerHeight;
    this.choices.style.left = `${left}px`;
    this.choices.style.top = `${Math.max(8, fits ? bottom + 4 : top - height)}px`;
  }
}
