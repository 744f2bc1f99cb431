// SPDX-License-Identifier: Apache-2.0
import {Color, type Object3D, Sphere} from 'three';
import {element, format, select, toggle} from '../dom';
import type {Playback} from '../playback';
import type {Session} from '../session';
import {colour, onTheme} from '../theme';
import type {RobotSheet} from '../wire';
import {inertiaEllipsoids} from './inertia_ellipsoids';
import {jointAxes} from './joint_axes';
import {linkFrames} from './link_frames';
import {PullTool} from './pull_tool';
import {markExtra, RobotModel} from './robot_model';
import {Stage} from './stage';
import {Trail} from './trail';

/** The robot in 3D as it is measured, its reference as a shadow, and the trail of a link. */
export class RobotView {
  readonly stage: Stage;
  readonly pull: PullTool;
  model: RobotModel | null = null;
  private readonly trail = new Trail();
  private readonly force = element('output', {class: 'force', hidden: true});
  private readonly past = element('output', {class: 'past', hidden: true});
  private readonly scale = element('output', {class: 'scale muted', title: 'The ground'});
  private readonly tool = select('Link of the trail', [], () => this.restartTrail());
  private readonly shown = {frames: false, axes: false, inertia: false};
  private extras: Record<keyof RobotView['shown'], Object3D[]> = {
    frames: [],
    axes: [],
    inertia: [],
  };
  private radius = 1;
  private drawnRow = -1;
  private wasPast = false;

  constructor(
    box: HTMLElement,
    private readonly session: Session,
    private readonly playback: Playback,
  ) {
    this.stage = new Stage(box);
    this.stage.scene.add(this.trail.line);
    this.pull = new PullTool(
      this.stage,
      (request) => void session.askQuietly('/pull', request),
      (newtons) => this.showForce(newtons),
    );
    const corner = element('div', {class: 'corner'}, this.stage.compass.box, this.scale);
    box.append(this.toolbar(), this.force, this.past, corner);
    session.on('robot', (sheet) => this.load(sheet));
    session.on('situation', () => this.situationChanged());
    playback.on('changed', () => this.playbackChanged());
    session.on('connection', (connected) => {
      if (!connected) this.pull.release();
    });
    onTheme(() => this.paint());
    this.paint();
  }

  /** To be called once per frame of the display. */
  draw(now: number): void {
    const shown = this.playback.shown;
    if (this.model && shown && shown.row !== this.drawnRow) {
      const {samples, row} = shown;
      this.drawnRow = row;
      if (!this.model.place(samples.at('position', row), samples.at('reference_position', row)))
        return this.finish(now);
      const link = this.model.measured.links[this.tool.value];
      if (link && this.trail.line.visible && !this.wasPast)
        this.trail.add(link, this.radius * 2e-3, this.radius * 0.5);
      this.stage.invalidate();
    }
    this.finish(now);
  }

  // A recorded robot is not pulled at, and its user must not take it for the real one.
  private playbackChanged(): void {
    const {past} = this.playback;
    this.past.hidden = !past;
    if (past) {
      const time = past.samples.time(past.row).toFixed(3);
      this.past.textContent = `Recorded at ${time} s. The robot itself may be elsewhere.`;
    }
    if (this.wasPast === (past !== null)) return;
    this.wasPast = past !== null;
    if (this.wasPast) this.pull.release();
    else this.restartTrail();
    this.situationChanged();
  }

  private finish(now: number): void {
    this.pull.update(now);
    this.stage.draw();
  }

  fit(): void {
    if (!this.model) return;
    const box = this.model.bounds();
    this.radius = box.getBoundingSphere(new Sphere()).radius;
    this.stage.fit(box);
    const {square} = this.stage.ground;
    this.scale.textContent = `Squares of ${square < 1 ? `${Math.round(100 * square)} cm` : `${square} m`}`;
  }

  restartTrail(): void {
    this.trail.clear();
    this.stage.invalidate();
  }

  private load(sheet: RobotSheet): void {
    this.model?.dispose();
    const told = new Set<string>();
    try {
      this.model = new RobotModel(sheet, location.search, (failures) => {
        for (const text of failures.filter((failure) => !told.has(failure))) {
          told.add(text);
          this.session.notify(`A mesh cannot be shown. ${text}`, true);
        }
        this.fit();
      });
    } catch (error) {
      this.model = null;
      this.session.notify(`The robot cannot be shown: ${(error as Error).message}`, true);
      return;
    }
    this.stage.scene.add(this.model.measured, this.model.reference);
    this.tool.replaceChildren(
      ...Object.keys(this.model.measured.links).map((name) =>
        element('option', {value: name}, name),
      ),
    );
    this.tool.value = this.model.toolLink();
    this.pull.robot = this.model.measured;
    this.drawnRow = -1;
    this.restartTrail();
    this.paint();
    this.fit();
    this.addExtras(sheet);
    this.pull.reach = this.radius;
    this.pull.efforts = new Map(
      sheet.joints
        .filter(({limits}) => limits.effort !== null)
        .map(({name, limits}) => [name, limits.effort ?? 0]),
    );
  }

  private addExtras(sheet: RobotSheet): void {
    const robot = this.model?.measured;
    if (!robot) return;
    this.extras = {
      frames: linkFrames(robot, 0.16 * this.radius),
      axes: jointAxes(robot, sheet.joints, 0.25 * this.radius),
      inertia: inertiaEllipsoids(robot),
    };
    Object.values(this.extras).flat().forEach(markExtra);
    for (const kind of ['frames', 'axes', 'inertia'] as const) this.show(kind, this.shown[kind]);
  }

  private show(kind: keyof RobotView['shown'], on: boolean): void {
    this.shown[kind] = on;
    for (const extra of this.extras[kind]) extra.visible = on;
    this.stage.invalidate();
  }

  private toolbar(): HTMLElement {
    return element(
      'div',
      {class: 'overlay top-left', role: 'toolbar', 'aria-label': 'What the 3D view shows'},
      toggle(
        'Reference',
        true,
        (on) => {
          if (this.model) this.model.showsReference = on;
          this.drawnRow = -1;
        },
        {title: 'Show the reference as a shadow'},
      ),
      toggle('Frames', false, (on) => this.show('frames', on), {
        title: 'Show the frame of each link: x red, y green, z blue',
      }),
      toggle('Axes', false, (on) => this.show('axes', on), {
        title: 'Show the axis and the limits of each joint',
      }),
      toggle('Inertia', false, (on) => this.show('inertia', on), {
        title: 'Show the ellipsoid that has the inertia of each link',
      }),
      toggle(
        'Grid',
        true,
        (on) => {
          this.stage.gridVisible = on;
          this.scale.hidden = !on;
        },
        {title: 'Show the ground'},
      ),
      toggle(
        'Trail',
        true,
        (on) => {
          this.trail.line.visible = on;
          this.restartTrail();
        },
        {title: 'Show the path of a link'},
      ),
      this.tool,
      element(
        'button',
        {type: 'button', click: () => this.fit(), title: 'Show the whole robot'},
        'Fit',
      ),
    );
  }

  private situationChanged(): void {
    const simulated = this.session.sheet?.is_simulated ?? false;
    this.pull.enabled = simulated && this.session.mayOperate && !this.playback.past;
    this.stage.canvas.title = this.pull.enabled
      ? 'Drag the robot to pull at it, with Shift four times as hard. Drag beside it to turn it.'
      : '';
  }

  private showForce(newtons: number | null): void {
    this.force.hidden = newtons === null;
    if (newtons !== null) this.force.textContent = `${format(newtons, 3)} N`;
  }

  private paint(): void {
    this.trail.line.material.color = new Color(colour('--accent'));
    this.model?.shadow.color.set(colour('--accent'));
    this.stage.invalidate();
  }
}
