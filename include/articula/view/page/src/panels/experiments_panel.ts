// SPDX-License-Identifier: Apache-2.0
import {button, element, format, formatTime, numberField, select} from '../dom';
import {type Response, responseTo} from '../plots/response';
import type {Session} from '../session';
import {effortUnit, positionUnit, type RobotSheet, type SheetJoint} from '../wire';

type Kind = 'step' | 'square' | 'sine' | 'chirp';
const kinds: [Kind, string][] = [
  ['step', 'Step'],
  ['square', 'Square'],
  ['sine', 'Sine'],
  ['chirp', 'Chirp'],
];

/** What the fields hold. */
export interface Experiment {
  kind: string;
  joint: string;
  target: string;
  numbers: Record<string, number>; // amplitude, frequency, last frequency, duration
}

/** Excites a joint by one click and says what the joint made of it. */
export class ExperimentsPanel {
  readonly box = element('div', {class: 'panel'});
  private kind: Kind = 'step';
  private readonly joint = select('Joint', [], () => this.unitChanged());
  private readonly target = select(
    'Quantity',
    [
      ['position', 'position'],
      ['effort', 'effort'],
    ],
    () => this.unitChanged(),
  );
  private readonly amplitude = numberField('Amplitude', 0.2, 'rad');
  private readonly frequency = numberField('Frequency', 0.5, 'Hz', {min: 0.01});
  private readonly last = numberField('Last frequency', 5, 'Hz', {min: 0.01});
  private readonly duration = numberField('Duration', 4, 's', {min: 0.1});
  private readonly run: HTMLButtonElement;
  private readonly tabs = element('div', {
    class: 'row segments',
    role: 'group',
    'aria-label': 'Signal',
  });
  private readonly results = element('div', {class: 'results', 'aria-live': 'polite'});

  constructor(private readonly session: Session) {
    this.run = button('Run', () => void this.start(), {class: 'primary'});
    for (const [kind, text] of kinds)
      this.tabs.append(button(text, () => this.choose(kind), {'data-kind': kind, class: 'toggle'}));
    this.box.append(
      this.tabs,
      element(
        'div',
        {class: 'grid'},
        element('label', {class: 'field'}, element('span', {}, 'Joint'), this.joint),
        element('label', {class: 'field'}, element('span', {}, 'Quantity'), this.target),
        this.amplitude.box,
        this.frequency.box,
        this.last.box,
        this.duration.box,
      ),
      element(
        'div',
        {class: 'row'},
        this.run,
        button('Stop', () => void session.ask('/stop')),
      ),
      element('p', {class: 'hint'}, 'The signal is added to the present reference.'),
      this.results,
    );
    session.on('robot', (sheet) => this.load(sheet));
    session.on('situation', () => this.enable());
    session.on('connection', () => this.enable());
    this.choose('step');
  }

  get experiment(): Experiment {
    const numbers = this.fields.map(({name, valueAsNumber}): [string, number] => [name, valueAsNumber]);
    return {
      kind: this.kind,
      joint: this.joint.value,
      target: this.target.value,
      numbers: Object.fromEntries(numbers),
    };
  }

  /** What does not exist here stays as it is. */
  set experiment({kind, joint, target, numbers}: Experiment) {
    const known = kinds.find(([own]) => own === kind);
    if (known) this.choose(known[0]);
    for (const [box, value] of [[this.joint, joint], [this.target, target]] as const)
      if ([...box.options].some((option) => option.value === value)) box.value = value;
    for (const field of this.fields) if (field.name in numbers) field.value = String(numbers[field.name]);
    this.unitChanged();
  }

  private get fields(): HTMLInputElement[] {
    return [this.amplitude, this.frequency, this.last, this.duration].map(({input}) => input);
  }

  private load(sheet: RobotSheet): void {
    this.joint.replaceChildren(
      ...sheet.joints.map(({name}) => element('option', {value: name}, name)),
    );
    this.unitChanged();
  }

  private choose(kind: Kind): void {
    this.kind = kind;
    for (const tab of this.tabs.children)
      tab.setAttribute('aria-pressed', String((tab as HTMLElement).dataset.kind === kind));
    this.frequency.box.hidden = kind === 'step';
    this.last.box.hidden = kind !== 'chirp';
    // A chirp is fast at its end: with the step's amplitude it would exceed velocity limits.
    [this.amplitude.input.value, this.frequency.input.value] =
      kind === 'chirp' ? ['0.03', '0.2'] : ['0.2', '0.5'];
  }

  private unitChanged(): void {
    const joint = this.session.sheet?.joints.find(({name}) => name === this.joint.value);
    const unit = this.amplitude.box.querySelector('.unit');
    if (joint && unit)
      unit.textContent = this.target.value === 'position' ? positionUnit(joint) : effortUnit(joint);
  }

  private signal(): Record<string, number> {
    const amplitude = this.amplitude.input.valueAsNumber;
    const frequency = this.frequency.input.valueAsNumber;
    switch (this.kind) {
      case 'step':
        return {height: amplitude, start: 0.2}; // the rest before it shows where the step began
      case 'chirp':
        return {
          amplitude,
          first_frequency: frequency,
          last_frequency: this.last.input.valueAsNumber,
          duration: this.duration.input.valueAsNumber,
        };
      default:
        return {amplitude, frequency};
    }
  }

  /** What the fields hold that tells one run from another. */
  private shape(): string {
    const unit = this.amplitude.box.querySelector('.unit')?.textContent ?? '';
    const amplitude = `${this.amplitude.input.value} ${unit}`;
    if (this.kind === 'step') return amplitude;
    if (this.kind !== 'chirp') return `${amplitude}, ${this.frequency.input.value} Hz`;
    return `${amplitude}, ${this.frequency.input.value} to ${this.last.input.value} Hz`;
  }

  private async start(): Promise<void> {
    const {samples, sheet} = this.session;
    if (!samples || !sheet) return;
    const name = this.joint.value;
    const joint = sheet.joints.findIndex((each) => each.name === name);
    const kind = this.kind;
    const target = this.target.value;
    const signal = this.signal();
    const title = `${kind} on ${name}: ${this.shape()}`;
    const duration = this.duration.input.valueAsNumber;
    const answer = await this.session.ask('/play_signals', {
      signals: [{joint: name, kind, target, ...signal}],
      duration,
    });
    if (!answer.success || answer.cycle === undefined) return;
    // What follows the signal, as the way back, does not count.
    const end = answer.cycle + Math.round(duration / sheet.period) - 1;
    await this.session.arrival(end);
    if (samples !== this.session.samples) return;
    const [from, to] = [answer.cycle, end].map((cycle) => samples.time(samples.rowOf(cycle)));
    const result = responseTo(samples, joint, from, to, kind, signal.frequency ?? 0);
    this.results.prepend(this.describe(result, title, target, sheet.joints[joint]));
    while (this.results.children.length > 8) this.results.lastChild?.remove();
  }

  private describe(
    result: Response,
    title: string,
    target: string,
    joint: SheetJoint,
  ): HTMLElement {
    const rows: [string, string][] = [];
    const unit = positionUnit(joint);
    const {step} = result;
    if (step) {
      rows.push(
        ['rise time (10 % to 90 %)', formatTime(step.rise)],
        ['overshoot', `${format(100 * step.overshoot, 3)} %`],
        ['settling time (2 %)', formatTime(step.settling)],
        ['error at the end', `${format(step.error, 5)} ${unit}`],
      );
    }
    if (result.gain !== null)
      rows.push(
        ['gain at the frequency', format(result.gain, 4)],
        ['phase', `${format(result.phase ?? NaN, 3)}°`],
      );
    if (target === 'position') {
      rows.push(
        ['root mean square error', `${format(result.rootMeanSquare, 5)} ${unit}`],
        ['largest error', `${format(result.largest, 5)} ${unit}`],
      );
    }
    rows.push(['largest effort', `${format(result.effort, 3)} ${effortUnit(joint)}`]);
    return element(
      'table',
      {},
      element('caption', {}, title),
      element(
        'tbody',
        {},
        ...rows.map(([what, value]) =>
          element('tr', {}, element('th', {scope: 'row'}, what), element('td', {}, value)),
        ),
      ),
    );
  }

  private enable(): void {
    this.run.disabled = !this.session.mayOperate;
  }
}
