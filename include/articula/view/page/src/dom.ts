// SPDX-License-Identifier: Apache-2.0
// Short ways to make elements.

type Child = Node | string | null | undefined;
type Attributes = Record<
  string,
  string | number | boolean | null | undefined | ((event: never) => void)
>;

/**
 * Makes an element. Functions are listeners, true is an attribute without value, null is left
 * out.
 */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name, value as EventListener);
    else if (value === true) made.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined)
      made.setAttribute(name, String(value));
  }
  made.append(
    ...children.filter((child): child is Node | string => child !== null && child !== undefined),
  );
  return made;
}

export function button(
  text: string,
  click: () => void,
  attributes: Attributes = {},
): HTMLButtonElement {
  return element('button', {type: 'button', click, ...attributes}, text);
}

/** A switch button: `pressed` is told to assistive tools, too. */
export function toggle(
  text: string,
  pressed: boolean,
  change: (on: boolean) => void,
  attributes: Attributes = {},
) {
  const made = button(
    text,
    () => {
      const on = made.getAttribute('aria-pressed') !== 'true';
      setPressed(made, on);
      change(on);
    },
    {'aria-pressed': String(pressed), class: 'toggle', ...attributes},
  );
  return made;
}

export function setPressed(target: HTMLElement, on: boolean): void {
  target.setAttribute('aria-pressed', String(on));
}

export function select(
  label: string,
  options: [value: string, text: string][],
  change: (value: string) => void,
) {
  const made = element('select', {'aria-label': label, change: () => change(made.value)});
  made.append(...options.map(([value, text]) => element('option', {value}, text)));
  return made;
}

/** A labelled number field. */
export function numberField(label: string, value: number, unit = '', attributes: Attributes = {}) {
  const input = element('input', {
    type: 'number',
    step: 'any',
    value,
    name: label.toLowerCase(),
    ...attributes,
  });
  const box = element(
    'label',
    {class: 'field'},
    element('span', {}, label),
    input,
    unit ? element('span', {class: 'unit'}, unit) : null,
  );
  return {box, input};
}

/** A number with as many digits as its size deserves, so that columns keep their width. */
export function format(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size >= 1e5) return value.toExponential(2).replace('-', '−');
  const whole = Math.max(0, Math.floor(Math.log10(Math.max(size, 1))));
  const text = value.toFixed(Math.max(0, digits - 1 - whole));
  return (Number(text) === 0 ? text.replace('-', '') : text).replace('-', '−');
}

/** A duration in the unit that suits it. */
export function formatTime(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return '–';
  if (Math.abs(seconds) >= 1) return `${seconds.toFixed(2)} s`;
  if (Math.abs(seconds) >= 1e-3) return `${(seconds * 1e3).toFixed(seconds < 0.1 ? 1 : 0)} ms`;
  return `${(seconds * 1e6).toFixed(1)} µs`;
}

/** A unit as it is printed: "N m s^2/rad" becomes "N m s²/rad". */
export function unitText(unit: string): string {
  return unit.replaceAll(/\^([0-9])/g, (_, digit: string) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(digit)]);
}
