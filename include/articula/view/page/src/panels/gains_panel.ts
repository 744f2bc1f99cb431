// SPDX-License-Identifier: Apache-2.0
import {button, element, format, select} from '../dom';
import type {Playback} from '../playback';
import type {Session} from '../session';
import {type Futures, type Parameter, positionUnit} from '../wire';
import {GainField} from './gain_field';
import {GainFutures} from './gain_futures';
import {marginText} from './margin_text';
import {StepField} from './step_field';

/** The joint in "<controller>.<joint>.<gain>". */
function jointOf({name}: Parameter): string {
  return name.split('.').at(-2) ?? '';
}

/** Gains by controller and joint. All changed ones are applied together, or none of them. */
export class GainsPanel {
  readonly box = element('form', {
    class: 'panel',
    submit: (event: Event) => {
      event.preventDefault();
      void this.apply();
    },
  });
  private fields: GainField[] = [];
  private refusedInFan = new Set<GainField>();
  private margins = new Map<string, HTMLElement>(); // by controller and joint
  private readonly futures: GainFutures;
  private readonly step: StepField;
  private readonly count = select(
    'Number of simulated robots',
    [
      ['100', '100 robots'],
      ['1000', '1000 robots'],
    ],
    () => this.propose(),
  );
  private readonly fan = element('p', {class: 'hint fan', role: 'status'});
  private readonly list = element('div', {});
  private readonly applyButton = element(
    'button',
    {type: 'submit', class: 'primary', title: 'Set the changed gains (Enter)'},
    'Apply',
  );
  private readonly revert = button('Revert', () => {
    for (const field of this.fields) field.reset();
    this.outcome.textContent = '';
    this.propose();
  });
  private readonly outcome = element('p', {class: 'hint', role: 'status'});

  constructor(
    private readonly session: Session,
    private readonly playback: Playback,
  ) {
    this.step = new StepField(session, () => this.propose());
    this.box.append(
      element('div', {class: 'row futures'}, this.step.box, this.count),
      this.list,
      element(
        'div',
        {class: 'foot'},
        this.fan,
        element('div', {class: 'row'}, this.applyButton, this.revert, this.outcome),
      ),
    );
    this.futures = new GainFutures(session, playback, (futures, refusal) =>
      this.tell(futures, refusal),
    );
    this.box.noValidate = true; // the loop decides what is valid
    session.on('parameters', (parameters) => this.load(parameters));
    session.on('values', (values) => this.update(values));
    session.on('situation', () => this.enable());
    session.on('connection', () => this.enable());
  }

  private load(parameters: Parameter[]): void {
    const groups = new Map<string, Map<string, GainField[]>>(); // controller, joint
    this.margins.clear();
    this.fields = parameters.map((parameter) => {
      const parts = parameter.name.split('.');
      const gain = parts.pop() ?? '';
      const joint = jointOf(parameter);
      const controller = parts.slice(0, -1).join('.');
      const field = new GainField(parameter, gain, () => {
        this.outcome.textContent = '';
        this.propose();
      });
      const joints = groups.get(controller) ?? new Map<string, GainField[]>();
      joints.set(joint, [...(joints.get(joint) ?? []), field]);
      groups.set(controller, joints);
      return field;
    });
    this.list.replaceChildren(
      ...[...groups].map(([controller, joints]) =>
        element(
          'details',
          {open: true},
          element('summary', {}, controller),
          ...[...joints].map(([joint, fields]) => this.group(`${controller}.${joint}`, joint, fields)),
        ),
      ),
    );
    if (parameters.length === 0)
      this.list.append(element('p', {class: 'hint'}, 'The controllers have no gains to set.'));
    this.propose();
  }

  // The gains that everybody tunes are seen at once, the many others on demand.
  private group(key: string, joint: string, fields: GainField[]): HTMLElement {
    const long = fields.filter(({isShort}) => !isShort);
    const rest = element(
      'details',
      {class: 'more'},
      element('summary', {}, `${long.length} more`),
      ...long.flatMap(({box, refusal}) => [box, refusal]),
    );
    const short = fields.filter(({isShort}) => isShort);
    const margins = element('p', {class: 'margins'});
    this.margins.set(key, margins);
    return element(
      'fieldset',
      {},
      element('legend', {}, joint),
      ...short.map(({box}) => box),
      ...short.map(({refusal}) => refusal),
      margins,
      long.length > 0 ? rest : null,
    );
  }

  private update(values: Map<string, number | null>): void {
    for (const field of this.fields) {
      const value = values.get(field.parameter.name);
      if (value !== undefined) field.holds(value);
    }
    this.propose();
  }

  private async apply(): Promise<void> {
    const changed = this.fields.filter((field) => field.isChanged);
    for (const field of this.fields) field.refuse('');
    this.outcome.textContent = '';
    const malformed = this.fields.filter((field) => field.isMalformed);
    for (const field of malformed) field.refuse('A number is missing.');
    if (changed.length === 0 || malformed.length > 0) return;
    const given = changed.map((field) => field.value);
    const values = Object.fromEntries(changed.map((field) => [field.parameter.name, field.setting]));
    const answer = await this.session.askQuietly('/set_parameters', {values});
    if (answer.success) {
      changed.forEach((field, k) => field.holds(given[k]));
      this.outcome.textContent =
        changed.length === 1 ? 'One gain is set.' : `${changed.length} gains are set.`;
    } else {
      const named = changed.filter(({parameter}) => answer.message.includes(parameter.name));
      for (const field of named.length > 0 ? named : changed) field.refuse(answer.message);
    }
    this.propose();
  }

  // What the loop would do with the numbers in the fields, before they are applied.
  private propose(): void {
    this.enable();
    const changed = this.fields.filter((field) => field.isChanged);
    const complete = changed.every((field) => !Number.isNaN(field.value));
    const differs = changed.length > 0 || this.step.isChosen;
    if (!differs || !complete || !this.session.mayOperate) return this.futures.propose(null);
    const entries = changed.map((field) => [field.parameter.name, field.value]);
    const tuned = new Set(changed.map(({parameter}) => jointOf(parameter)));
    this.futures.propose({
      gains: Object.fromEntries(entries),
      steps: () => this.step.steps(tuned, this.isMoving),
      count: Number(this.count.value),
    });
  }

  private tell(futures: Futures | null, refusal: string): void {
    for (const [key, line] of this.margins) {
      const own = futures?.margins.find(({controller, joint}) => `${controller}.${joint}` === key);
      line.textContent = own ? marginText(own) : '';
      line.classList.toggle('bad', own?.stable === false);
    }
    const bad = futures ? futures.unstable + futures.non_finite : 0;
    this.fan.textContent = futures
      ? `${futures.count} simulated robots with these gains${this.from(futures)}${this.after(futures)}: ${bad === 0 ? 'no drive swings between its limits' : `${bad} unstable`}.`
      : refusal;
    if (futures) this.fan.textContent += this.idle();
    this.fan.classList.toggle('bad', bad > 0 || refusal !== '');
    for (const field of this.refusedInFan) field.refuse('');
    this.refusedInFan = new Set(this.fields.filter((field) => refusal.includes(field.parameter.name)));
    for (const field of this.refusedInFan) field.refuse(refusal);
  }

  // The robots are simulated with the controllers that are active.
  private idle(): string {
    const changed = this.fields.filter((field) => field.isChanged);
    const states = this.session.situation?.controllers ?? [];
    return states
      .filter(({name, status}) => {
        const isChanged = changed.some(({parameter}) => parameter.name.startsWith(`${name}.`));
        return isChanged && status !== 'active';
      })
      .map(({name}) => ` ${name} is not active: its gains change nothing in them.`)
      .join('');
  }

  private from({time}: Futures): string {
    return this.playback.past ? `, from ${time.toFixed(3)} s on` : '';
  }

  private after({steps}: Futures): string {
    const texts = Object.entries(steps).map(([name, height]) => {
      const joint = this.session.sheet?.joints.find((own) => own.name === name);
      return `${format(height, 3)} ${joint ? positionUnit(joint) : ''}`;
    });
    return texts.length > 0 ? `, after a step of ${[...new Set(texts)].join(' and ')}` : '';
  }

  // A recording is compared with what the gains would have made of it: a step would disturb that.
  private get isMoving(): boolean {
    return this.playback.past !== null || this.session.situation?.motion !== 'rest';
  }

  private enable(): void {
    const may = this.session.mayOperate;
    const changed = this.fields.some((field) => field.isChanged);
    for (const field of this.fields) field.enable(may);
    this.applyButton.disabled = !may || !changed;
    this.revert.disabled = !changed;
  }
}
