// SPDX-License-Identifier: Apache-2.0
import {button, element} from '../dom';
import type {Session} from '../session';
import type {JointsPanel} from './joints_panel';

export interface Pose {
  positions: Record<string, number>;
  duration: number; // from the pose before [s]
}

/** Key poses: recorded from the sliders, kept by the browser, played as a trajectory. */
export class PosesPanel {
  readonly box = element('section', {class: 'panel-part'});
  private poses: Pose[] = [];
  private readonly empty = element(
    'p',
    {class: 'hint'},
    'Record adds the position of the sliders. Play moves through all poses.',
  );
  private readonly list = element('ol', {class: 'poses'});
  private readonly play = button('Play', () => void this.playAll(), {
    title: 'Play all poses as a trajectory',
  });

  constructor(
    private readonly session: Session,
    private readonly joints: JointsPanel,
  ) {
    this.box.append(
      element('h2', {}, 'Key poses'),
      this.empty,
      this.list,
      element(
        'div',
        {class: 'row'},
        button('Record', () => this.record(), {title: 'Add the position of the sliders'}),
        this.play,
        button('Clear', () =>
          this.change(() => {
            this.poses = [];
          }),
        ),
      ),
    );
    session.on('robot', () => this.read());
    session.on('situation', () => this.enable());
    session.on('connection', () => this.enable());
  }

  /** The poses in the list. Those that are set are kept by the browser when the user changes one. */
  get content(): Pose[] {
    return this.poses;
  }

  set content(poses: Pose[]) {
    this.poses = poses;
    this.show();
  }

  private get key(): string {
    return `articula.poses.${this.session.sheet?.name}`;
  }

  private read(): void {
    try {
      this.poses = JSON.parse(localStorage.getItem(this.key) ?? '[]');
    } catch {
      this.poses = []; // what another version has stored is not worth a failure
    }
    this.show();
  }

  private change(edit: () => void): void {
    edit();
    localStorage.setItem(this.key, JSON.stringify(this.poses));
    this.show();
  }

  private record(): void {
    this.change(() => this.poses.push({positions: this.joints.goals(), duration: 1}));
  }

  private async playAll(): Promise<void> {
    const names = this.session.sheet?.joints.map(({name}) => name) ?? [];
    let time = 0;
    const points = this.poses.map(({positions, duration}) => ({
      positions: names.map((name) => positions[name] ?? 0),
      time_from_start: (time += duration),
    }));
    const answer = await this.session.ask('/play_trajectory', {joint_names: names, points});
    if (answer.success) this.session.notify(`Trajectory: ${answer.message || 'done'}`);
  }

  private show(): void {
    this.empty.hidden = this.poses.length > 0;
    this.list.replaceChildren(
      ...this.poses.map((pose, k) => {
        const values = Object.values(pose.positions)
          .map((value) => value.toFixed(2))
          .join(', ');
        const duration = element('input', {
          type: 'number',
          min: 0.05,
          step: 0.1,
          value: pose.duration,
          'aria-label': `Seconds to pose ${k + 1}`,
          change: () =>
            this.change(() => {
              pose.duration = Math.max(0.05, duration.valueAsNumber || 1);
            }),
        });
        return element(
          'li',
          {},
          button(values, () => this.joints.setGoals(pose.positions), {
            class: 'quiet values',
            title: 'Set the sliders to this pose',
          }),
          duration,
          element('span', {class: 'unit'}, 's'),
          button('×', () => this.change(() => this.poses.splice(k, 1)), {
            class: 'quiet',
            title: 'Remove this pose',
            'aria-label': `Remove pose ${k + 1}`,
          }),
        );
      }),
    );
    this.enable();
  }

  private enable(): void {
    this.play.disabled = !this.session.mayOperate || this.poses.length === 0;
  }
}
