// SPDX-License-Identifier: Apache-2.0
import {button, element, toggle} from '../dom';
import type {Playback} from '../playback';
import type {Session} from '../session';
import type {RobotSheet} from '../wire';
import {JointRow} from './joint_row';

const interval = 50; // ms between two updates of the numbers: nobody reads faster

/** Sliders of all joints. Go moves to them along a profile; live drag lets the reference follow. */
export class JointsPanel {
  readonly box = element('div', {class: 'panel'});
  private rows: JointRow[] = [];
  private isLive = false;
  private following: number[] = []; // the reference that live drag publishes
  private lastTime = 0;
  private lastShown = 0;
  private readonly list = element('div', {class: 'joints'});
  private readonly speed = element('input', {
    type: 'range',
    min: 0.05,
    max: 1,
    step: 0.05,
    value: 0.5,
    'aria-label': 'Share of the highest speed',
  });
  private readonly go = button('Go', () => void this.move(), {
    class: 'primary',
    title: 'Move to the sliders (Enter)',
  });
  private readonly live = toggle('Live drag', false, (on) => this.setLive(on), {
    title: 'The reference follows the sliders at once, at most at the chosen speed',
  });
  private readonly place: HTMLButtonElement;
  private readonly others: HTMLButtonElement[];

  constructor(
    private readonly session: Session,
    private readonly playback: Playback,
  ) {
    const zero = button('To zero', () => this.all((row) => row.setGoal(0)), {
      title: 'Set all sliders to 0',
    });
    const undo = button('Undo', () => this.all((row) => row.giveUp()), {
      title: 'Set the sliders to the present reference',
    });
    this.place = button('Place', () => void this.reset(), {
      title: 'Reset the simulation: the robot is at rest at the positions of the sliders',
    });
    this.others = [zero, undo, this.place];
    const share = element('output', {class: 'unit'});
    const showShare = () => {
      share.textContent = `${Math.round(100 * this.speed.valueAsNumber)} %`;
    };
    this.speed.addEventListener('input', showShare);
    showShare();
    this.box.append(
      this.list,
      element(
        'div',
        {class: 'row'},
        this.go,
        zero,
        undo,
        this.place,
        element('span', {class: 'stretch'}),
        this.live,
      ),
      element('label', {class: 'row'}, element('span', {}, 'Speed'), this.speed, share),
    );
    this.box.addEventListener('keydown', (event) => {
      if (
        event.key === 'Enter' &&
        (event.target as HTMLElement).tagName === 'INPUT' &&
        !this.isLive
      )
        void this.move();
    });
    session.on('robot', (sheet) => this.load(sheet));
    session.on('situation', () => this.enable());
    session.on('connection', () => this.enable());
  }

  /** The sliders' positions by joint. */
  goals(): Record<string, number> {
    return Object.fromEntries(this.rows.map((row) => [row.joint.name, row.goal]));
  }

  setGoals(positions: Record<string, number>): void {
    for (const row of this.rows)
      if (row.joint.name in positions) row.setGoal(positions[row.joint.name]);
    this.enable();
  }

  private all(change: (row: JointRow) => void): void {
    this.rows.forEach(change);
    this.enable();
  }

  /** Moves the joints whose sliders were touched. */
  async move(): Promise<void> {
    const touched = this.rows.filter((row) => row.touched);
    if (touched.length === 0) return;
    const positions = Object.fromEntries(touched.map((row) => [row.joint.name, row.goal]));
    const answer = await this.session.ask('/go', {positions, speed: this.speed.valueAsNumber});
    if (!answer.success) return this.enable();
    // The answer may name joints that no controller moves.
    if (answer.message !== 'done') this.session.notify(answer.message);
    // The answer can come at the end of the motion, when a slider may have another goal.
    for (const row of touched) if (row.goal === positions[row.joint.name]) row.giveUp();
    this.enable();
  }

  private async reset(): Promise<void> {
    const answer = await this.session.ask('/reset', {positions: this.goals()});
    if (answer.success) this.all((row) => row.giveUp());
  }

  /** To be called once per frame of the display. */
  draw(now: number): void {
    const samples = this.session.samples;
    if (!samples || samples.end === samples.first) return;
    const elapsed = Math.min(0.1, (now - this.lastTime) * 1e-3);
    this.lastTime = now;
    const reference = samples.latest('reference_position');
    if (now - this.lastShown > interval && this.box.offsetParent !== null) {
      // else it is hidden
      this.lastShown = now;
      const {past} = this.playback;
      const measured = past ? past.samples.at('position', past.row) : samples.latest('position');
      const shadow = past ? past.samples.at('reference_position', past.row) : reference;
      this.rows.forEach((row, joint) => row.show(measured[joint], shadow[joint]));
    }
    if (this.isLive) this.follow(reference, elapsed);
  }

  // A slider can jump, a reference must not: it approaches the slider at the chosen speed.
  private follow(reference: number[], elapsed: number): void {
    const moving = this.rows.map((row, joint) => ({row, joint})).filter(({row}) => row.touched);
    if (moving.length === 0) return;
    const message = {name: [] as string[], position: [] as number[]};
    for (const {row, joint} of moving) {
      const from = this.following[joint] ?? reference[joint];
      const most = (row.joint.limits.velocity ?? 1) * this.speed.valueAsNumber * elapsed;
      const way = row.goal - from;
      this.following[joint] = from + Math.max(-most, Math.min(most, way));
      message.name.push(row.joint.name);
      message.position.push(this.following[joint]);
      if (Math.abs(way) <= most && Math.abs(reference[joint] - row.goal) < 1e-6) {
        row.giveUp();
        delete this.following[joint];
      }
    }
    this.session.publish('/reference', message);
  }

  private setLive(on: boolean): void {
    this.isLive = on;
    this.following = [];
    this.enable();
  }

  private load(sheet: RobotSheet): void {
    this.rows = sheet.joints.map((joint, index) => new JointRow(joint, index, () => this.enable()));
    this.list.replaceChildren(...this.rows.map(({box}) => box));
    this.following = [];
    this.place.hidden = !sheet.is_simulated;
    this.enable();
  }

  private enable(): void {
    const may = this.session.mayOperate;
    for (const row of this.rows) row.enable(may);
    for (const each of [...this.others, this.live]) each.disabled = !may;
    this.go.disabled = this.isLive || !may || !this.rows.some(({touched}) => touched);
  }
}
