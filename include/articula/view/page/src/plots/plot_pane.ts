// SPDX-License-Identifier: Apache-2.0
import uPlot from 'uplot';
import {button, element, format} from '../dom';
import type {Shown} from '../playback';
import type {Samples} from '../samples';
import {withPlainCanvas} from '../graphics';
import {colour, jointColour} from '../theme';
import type {Futures, RobotSheet} from '../wire';
import {niceRange, timeAxis, valueAxis} from './axes';
import {plotColumns} from './decimate';
import {drawFan, type FanJoints, withFan} from './fan';
import {type Quantity, quantitiesOf, type Signal, signalsOf} from './quantities';
import {QuantityMenu} from './quantity_menu';

/** What a pane asks of the panel that holds it. */
export interface PaneOwner {
  zoom(from: number, to: number): void; // to a range of time
  live(): void;
  mark(time: number, second: boolean): void; // sets one of the two cursors
  markers(): (number | null)[];
  shown(): Shown | null; // a cycle of the past
  futures(): Futures | null; // to be drawn over the positions
  changed(pane: PlotPane): void; // other quantities
  remove(pane: PlotPane): void;
}

/** One plot: some quantities of the joints that the panel has chosen. */
export class PlotPane {
  readonly box: HTMLElement;
  signals: Signal[] = [];
  private readonly canvas = element('div', {class: 'canvas'});
  private readonly readout = element('div', {class: 'readout'});
  private readonly all: Quantity[];
  private readonly menu: QuantityMenu;
  private plot: uPlot | null = null;
  private joints: number[] = [];

  constructor(
    private readonly sheet: RobotSheet,
    public keys: string[],
    private readonly owner: PaneOwner,
    private readonly sync: string,
  ) {
    this.all = quantitiesOf(sheet);
    this.menu = new QuantityMenu(this.all, keys, (key, on) => this.choose(key, on));
    this.box = element(
      'section',
      {class: 'pane', 'aria-label': 'Plot'},
      element(
        'header',
        {},
        this.menu.box,
        this.readout,
        button('×', () => owner.remove(this), {
          class: 'quiet',
          title: 'Remove this plot',
          'aria-label': 'Remove this plot',
        }),
      ),
      this.canvas,
    );
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  private choose(key: string, on: boolean): void {
    this.keys = this.all.map((q) => q.key).filter((k) => (k === key ? on : this.keys.includes(k)));
    this.owner.changed(this);
  }

  /** Makes the plot anew for other joints, quantities or colours. */
  rebuild(joints: number[]): void {
    this.joints = joints;
    this.plot?.destroy();
    this.plot = null;
    const chosen = this.all.filter(({key}) => this.keys.includes(key));
    this.signals = signalsOf(this.sheet, chosen, joints);
    this.menu.show(chosen);
    if (this.signals.length === 0) return;
    const {owner} = this;
    const units = [...new Set(this.signals.map(({unit}) => unit))];
    this.plot = withPlainCanvas(
      () =>
        new uPlot(
          {
            width: Math.max(this.canvas.clientWidth, 60),
            height: Math.max(this.canvas.clientHeight, 60),
            legend: {show: false},
            padding: [6, units.length > 1 ? 0 : 20, 0, 0],
            scales: {
              x: {time: false},
              ...Object.fromEntries(units.map((unit) => [
                  unit,
                  {
                    range: (plot: uPlot, low: number, high: number) =>
                      niceRange(plot, ...withFan(owner.futures(), this.fanJoints, unit, low, high)),
                  },
                ])),
            },
            axes: [timeAxis(), ...units.slice(0, 2).map((unit, k) => valueAxis(unit, k === 0))],
            series: [
              {},
              ...this.signals.map(({quantity, joint, unit}) => ({
                scale: unit,
                stroke:
                  joint < 0
                    ? colour(quantity.key === 'latency' ? '--series-1' : '--series-0')
                    : jointColour(joint),
                width: 1.5,
                dash: this.dash({quantity, joint, unit}),
                alpha: quantity.dash.length > 0 ? 0.8 : 1,
                points: {show: false},
                pxAlign: 0,
              })),
            ],
            cursor: {
              sync: {key: this.sync, setSeries: false},
              drag: {x: true, y: false, setScale: false},
              points: {size: 5},
              bind: {
                dblclick: () => () => {
                  this.owner.live();
                  return null;
                },
              },
            },
            hooks: {
              setSelect: [(plot) => this.selected(plot)],
              setCursor: [() => this.showValues()],
              draw: [
                (plot) => this.drawFutures(plot),
                (plot) => this.drawMarkers(plot),
                (plot) => this.drawShown(plot),
              ],
            },
          },
          [[]],
          this.canvas,
        ),
    );
    this.plot.over.addEventListener('click', (event) => {
      if (this.plot && event.detail === 1 && this.plot.select.width < 3) {
        this.owner.mark(this.plot.posToVal(event.offsetX, 'x'), event.shiftKey);
      }
    });
  }

  /** Shows a range of time. */
  show(samples: Samples, from: number, to: number): void {
    if (!this.plot) return;
    const first = Math.max(samples.first, samples.rowAt(from) - 1);
    const end = Math.min(samples.end, samples.rowAt(to) + 1);
    const columns = plotColumns(samples, this.signals, first, end, 1.5 * this.canvas.clientWidth);
    this.plot.batch(() => {
      this.plot?.setData(columns as uPlot.AlignedData, false);
      this.plot?.setScale('x', {min: from, max: to});
      // uPlot ranges the other scales only when it sets data with scales.
      this.plot?.redraw(false, true);
    });
    this.showValues();
  }

  // A reference is dashed beside its measurement, and a full line without it.
  private dash({quantity, joint, unit}: Omit<Signal, 'label'>): number[] {
    const hasPartner = this.signals.some(
      (other) => other.joint === joint && other.unit === unit && other.quantity.dash.length === 0,
    );
    return hasPartner ? quantity.dash : [];
  }

  private selected(plot: uPlot): void {
    const {left, width} = plot.select;
    if (width < 3) return;
    this.owner.zoom(plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x'));
    plot.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
  }

  // Values under the mouse, else those of the cycle that is shown, else the newest ones.
  private showValues(): void {
    if (!this.plot) return;
    const last = this.plot.data[0].length - 1;
    const {idx} = this.plot.cursor;
    const past = typeof idx === 'number' ? null : this.owner.shown();
    const shown = this.signals.slice(0, 8);
    while (this.readout.children.length > shown.length) this.readout.lastChild?.remove();
    shown.forEach(({quantity, joint, label, unit}, k) => {
      const item = (this.readout.children[k] ??
        this.readout.appendChild(element('span'))) as HTMLElement;
      const value = past
        ? quantity.reader(past.samples, joint)(past.row)
        : this.plot?.data[k + 1]?.[idx ?? last];
      const text = `${format(value as number | undefined, 4)} ${unit}`;
      if (item.textContent !== text) item.textContent = text;
      item.title = label;
      item.className = this.dash({quantity, joint, unit}).length > 0 ? 'dashed' : '';
      item.style.setProperty(
        '--line',
        joint < 0
          ? colour(quantity.key === 'latency' ? '--series-1' : '--series-0')
          : jointColour(joint),
      );
    });
  }

  private get fanJoints(): FanJoints {
    return this.signals.filter(({quantity}) => quantity.key === 'position');
  }

  private drawFutures(plot: uPlot): void {
    const futures = this.owner.futures();
    if (futures) drawFan(plot, futures, this.fanJoints);
  }

  private drawMarkers(plot: uPlot): void {
    const {ctx, bbox} = plot;
    this.owner.markers().forEach((time, k) => {
      if (time === null) return;
      const x = plot.valToPos(time, 'x', true);
      if (x < bbox.left || x > bbox.left + bbox.width) return;
      ctx.save();
      ctx.strokeStyle = ctx.fillStyle = colour('--text');
      ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
      ctx.textAlign = 'left';
      ctx.font = `${11 * devicePixelRatio}px system-ui, sans-serif`;
      ctx.fillText('AB'[k], x + 4 * devicePixelRatio, bbox.top + 12 * devicePixelRatio);
      ctx.restore();
    });
  }

  private drawShown(plot: uPlot): void {
    const past = this.owner.shown();
    if (!past) return;
    const {ctx, bbox} = plot;
    const x = plot.valToPos(past.samples.time(past.row), 'x', true);
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    ctx.fillStyle = colour('--accent');
    ctx.fillRect(x - devicePixelRatio / 2, bbox.top, devicePixelRatio, bbox.height);
  }

  private resize(): void {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    if (this.plot && width > 0 && height > 0) this.plot.setSize({width, height});
    else if (width > 0) this.rebuild(this.joints);
  }

  destroy(): void {
    this.menu.destroy();
    this.plot?.destroy();
    this.box.remove();
  }
}
