// SPDX-License-Identifier: Apache-2.0
import {button, element, select, setPressed, toggle} from '../dom';
import type {Playback, Shown} from '../playback';
import type {Session} from '../session';
import {jointColour, onTheme} from '../theme';
import type {Futures, RobotSheet} from '../wire';
import {csvText, saveFile} from './csv';
import {LatencyHistogram} from './histogram';
import {mcapFile} from './mcap';
import {cursorLine, stepLines} from './metrics_line';
import {PlotPane, type PaneOwner} from './plot_pane';

const interval = 1000 / 30; // ms between two drawings: plots need no more
const share = 0.15; // of the time that drawing plots may take: the robot comes first

/** All plots: they share time, joints and cursors. */
export class PlotPanel implements PaneOwner {
  private panes: PlotPane[] = [];
  private joints: number[] = [];
  private window = 10; // s
  private held: [number, number] | null = null; // the range of a paused or zoomed view
  private marked: [number | null, number | null] = [null, null];
  private lastDrawn = 0;
  private cost = 0; // ms that a drawing takes
  private lastMetrics = 0;
  private readonly histogram = new LatencyHistogram();
  private readonly chips = element('div', {
    class: 'chips',
    role: 'group',
    'aria-label': 'Joints in the plots',
  });
  private readonly list = element('div', {class: 'panes'});
  private readonly metrics = element('div', {class: 'metrics', 'aria-live': 'off'});
  private readonly pauseButton = toggle('Pause', false, (on) => (on ? this.playback.hold() : this.live()), {
    title: 'Stop the plots; the loop goes on',
  });

  constructor(
    box: HTMLElement,
    private readonly session: Session,
    private readonly playback: Playback,
  ) {
    const windows: [string, string][] = [1, 2, 5, 10, 30, 60].map((s) => [String(s), `${s} s`]);
    const span = select('Time shown', windows, (value) => {
      this.window = Number(value);
      this.live();
    });
    span.value = String(this.window);
    const bar = element(
      'div',
      {class: 'bar'},
      this.chips,
      element('span', {class: 'stretch'}),
      span,
      this.pauseButton,
      toggle(
        'Latency',
        false,
        (on) => {
          this.histogram.box.hidden = !on;
          this.lastDrawn = 0;
        },
        {title: 'Show how often which latency occurs'},
      ),
      button('Add plot', () => this.add(['velocity'])),
      button('CSV', () => this.save(), {title: 'Save what the plots show as a CSV file'}),
      button('MCAP', () => void this.saveMcap(), {
        title: 'Save all quantities of the time shown as an MCAP file, to replay it',
      }),
    );
    this.list.append(this.histogram.box);
    box.append(bar, this.list, this.metrics);
    session.on('robot', (sheet) => this.load(sheet));
    session.on('futures', (futures) => {
      this.lastDrawn = 0;
      if (futures && playback.past) this.include(futures.time + futures.horizon);
    });
    playback.on('changed', () => this.follow());
    onTheme(() => {
      if (session.sheet)
        this.load(
          session.sheet,
          this.panes.map(({keys}) => keys),
        );
    });
  }

  draw(now: number): void {
    const {statistics} = this.session;
    const {samples} = this.playback;
    if (!samples || now - this.lastDrawn < Math.max(interval, this.cost / share)) return;
    if (this.held && this.lastDrawn > 0) return;
    this.lastDrawn = now = performance.now();
    const [from, to] = this.range();
    for (const pane of this.panes) pane.show(samples, from, to);
    this.histogram.update(samples, samples.rowAt(from), samples.rowAt(to), statistics);
    if (now - this.lastMetrics > 250 || this.held) this.showMetrics(now);
    this.cost = performance.now() - now;
  }

  zoom(from: number, to: number): void {
    this.held = [from, to];
    this.lastDrawn = 0;
    this.playback.hold();
  }

  live(): void {
    this.playback.live();
  }

  mark(time: number, second: boolean): void {
    this.marked[second ? 1 : 0] = time;
    this.playback.hold(); // a moving plot would carry the cursor away
    this.lastDrawn = 0;
  }

  markers(): (number | null)[] {
    return this.marked;
  }

  shown(): Shown | null {
    return this.playback.past;
  }

  futures(): Futures | null {
    return this.session.futures;
  }

  changed(pane: PlotPane): void {
    pane.rebuild(this.joints);
    this.lastDrawn = 0;
  }

  remove(pane: PlotPane): void {
    this.panes = this.panes.filter((other) => other !== pane);
    pane.destroy();
  }

  private add(keys: string[]): void {
    const {sheet} = this.session;
    if (!sheet) return;
    const pane = new PlotPane(sheet, keys, this, 'articula');
    this.panes.push(pane);
    this.list.insertBefore(pane.box, this.histogram.box);
    this.changed(pane);
  }

  private load(
    sheet: RobotSheet,
    keys = [['position', 'reference_position'], [`command.${sheet.commands[0] ?? 'effort'}`]],
  ): void {
    for (const pane of this.panes) pane.destroy();
    this.panes = [];
    // Many joints in one plot tell nothing: some to begin with.
    if (this.joints.length === 0 || this.joints.some((joint) => joint >= sheet.joints.length)) {
      this.joints = sheet.joints.map((_, joint) => joint).slice(0, 3);
    }
    this.chips.replaceChildren(
      ...sheet.joints.map(({name}, joint) => {
        const chip = toggle(name, this.joints.includes(joint), (on) => this.choose(joint, on), {
          class: 'chip',
        });
        chip.style.setProperty('--line', jointColour(joint));
        return chip;
      }),
    );
    for (const list of keys) this.add(list);
    this.live();
  }

  private choose(joint: number, on: boolean): void {
    this.joints = this.joints.filter((other) => other !== joint);
    if (on) this.joints = [...this.joints, joint].sort((a, b) => a - b);
    for (const pane of this.panes) this.changed(pane);
  }

  // The playback is held or goes on, or it shows another time, which the plots have to contain.
  private follow(): void {
    this.lastDrawn = 0;
    setPressed(this.pauseButton, this.playback.isHeld);
    if (!this.playback.isHeld) {
      this.held = null;
      this.marked = [null, null];
      return;
    }
    this.held ??= this.range();
    const {past} = this.playback;
    if (past) this.include(past.samples.time(past.row));
  }

  private include(time: number): void {
    if (!this.held) return;
    const [from, to] = this.held;
    const shift = Math.min(0, time - from) + Math.max(0, time - to);
    this.held = [from + shift, to + shift];
  }

  private range(): [number, number] {
    if (this.held) return this.held;
    const now = this.playback.samples?.lastTime ?? 0;
    const {futures} = this.session;
    const last = futures ? Math.max(now, futures.time + futures.horizon) : now;
    // Before the window is full, the lines grow from its left end.
    return last < this.window ? [0, this.window] : [last - this.window, last];
  }

  private showMetrics(now: number): void {
    const {sheet} = this.session;
    const {samples} = this.playback;
    if (!samples || !sheet) return;
    this.lastMetrics = now;
    const [from, to] = this.range();
    const signals = this.panes.flatMap((pane) => pane.signals.slice(0, 4));
    this.metrics.replaceChildren(
      ...cursorLine(samples, signals, this.marked),
      ...stepLines(samples, sheet, this.joints, from, to),
    );
  }

  private save(): void {
    const {sheet} = this.session;
    const {samples} = this.playback;
    if (!samples || !sheet) return;
    const [from, to] = this.range();
    const signals = this.panes.flatMap((pane) => pane.signals);
    saveFile(
      `${sheet.name}_${to.toFixed(1)}s.csv`,
      [csvText(samples, signals, samples.rowAt(from), samples.rowAt(to))],
      'text/csv',
    );
  }

  private async saveMcap(): Promise<void> {
    const {sheet} = this.session;
    const {samples} = this.playback;
    if (!samples || !sheet) return;
    const [from, to] = this.range();
    const rows = samples.copy(); // the ring goes on while the file is made
    saveFile(
      `${sheet.name}_${to.toFixed(1)}s.mcap`,
      await mcapFile(rows, sheet, rows.rowAt(from), rows.rowAt(to + sheet.period / 2)),
      'application/octet-stream',
    );
  }
}
