// SPDX-License-Identifier: Apache-2.0
import {element, formatTime} from '../dom';
import type {Samples} from '../samples';
import type {Statistics} from '../wire';

const perDecade = 5;
const lowest = -7; // 0.1 us
const decades = 5; // up to 10 ms
const bins = perDecade * decades;

/** How often which latency occurred, on logarithmic axes: what matters is the tail. */
export class LatencyHistogram {
  readonly box = element('div', {class: 'histogram', hidden: true});
  private readonly bars = element('div', {class: 'bars', role: 'img'});
  private readonly figures = element('div', {class: 'figures'});

  constructor() {
    const ticks = element('div', {class: 'ticks'});
    for (let d = 0; d <= decades; ++d)
      ticks.append(element('span', {}, formatTime(10 ** (lowest + d)).replace('.0', '')));
    for (let k = 0; k < bins; ++k) this.bars.append(element('i'));
    this.box.append(
      element('h3', {}, 'Latency of the cycles in the window'),
      this.bars,
      ticks,
      this.figures,
    );
  }

  update(samples: Samples, first: number, end: number, statistics: Statistics | null): void {
    if (this.box.hidden) return;
    const counts = new Array<number>(bins).fill(0);
    const latency = samples.reader('latency');
    for (let row = first; row < end; ++row) {
      const place = Math.floor(perDecade * (Math.log10(Math.max(latency(row), 1e-12)) - lowest));
      ++counts[Math.max(0, Math.min(bins - 1, place))];
    }
    const top = Math.log10(Math.max(10, ...counts));
    counts.forEach((count, k) => {
      const bar = this.bars.children[k] as HTMLElement;
      bar.style.height = count === 0 ? '0' : `${4 + (96 * Math.log10(count)) / top}%`;
      bar.title = `${formatTime(10 ** (lowest + k / perDecade))} and more: ${count} cycles`;
    });
    const s = statistics;
    this.figures.replaceChildren(
      ...(s
        ? [
            ['since the start', ''],
            ['median', formatTime(s.latency_median)],
            ['99 %', formatTime(s.latency_99)],
            ['longest', formatTime(s.latency_max)],
            ['update, median', formatTime(s.execution_median)],
            ['update, longest', formatTime(s.execution_max)],
            ['overruns', String(s.overruns)],
            ['cycles', String(s.cycles)],
            ['not shown', String(s.dropped)],
          ].map(([name, value]) => element('span', {}, name, element('b', {}, value)))
        : []),
    );
    const words = s
      ? `Latency: median ${formatTime(s.latency_median)}, longest ${formatTime(s.latency_max)}`
      : 'Latency';
    this.bars.setAttribute('aria-label', words);
  }
}
