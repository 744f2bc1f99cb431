// SPDX-License-Identifier: Apache-2.0
import {Emitter} from './emitter';
import type {Samples} from './samples';
import type {Session} from './session';

/** A cycle of a recording. */
export interface Shown {
  samples: Samples;
  row: number;
}

/**
 * Which time the page shows: the present, or one of the recording that it holds. A recording that is
 * held stays as it is while cycles arrive.
 */
export class Playback extends Emitter<{changed: null}> {
  private held: Samples | null = null;
  private row: number | null = null; // null: the present
  private time = 0; // of the loop, while it plays [s]
  private last = 0; // ms

  constructor(private readonly session: Session) {
    super();
    session.on('robot', () => this.live());
  }

  isPlaying = false;

  get isHeld(): boolean {
    return this.held !== null;
  }

  /** The recording in the plots. */
  get samples(): Samples | null {
    return this.held ?? this.session.samples;
  }

  /** The cycle of the past that the user has chosen. */
  get past(): Shown | null {
    return this.held && this.row !== null ? {samples: this.held, row: this.row} : null;
  }

  /** The cycle that the robot shows. */
  get shown(): Shown | null {
    const {samples} = this.session;
    const present = samples && samples.end > samples.first ? {samples, row: samples.end - 1} : null;
    return this.past ?? present;
  }

  /** Keeps the recording as it is; the robot goes on to show the present. */
  hold(): void {
    if (this.held) return;
    const {samples} = this.session;
    if (samples && samples.end > samples.first) this.held = samples.copy();
    this.emit('changed', null);
  }

  /** Shows a cycle of the recording. */
  seek(row: number): void {
    if (!this.held) this.hold();
    if (!this.held) return;
    this.row = Math.max(this.held.first, Math.min(this.held.end - 1, row));
    this.time = this.held.time(this.row);
    this.emit('changed', null);
  }

  /** Plays the recording from the cycle that is shown, or from its start if that is the last one. */
  play(on: boolean): void {
    this.isPlaying = on;
    this.last = 0;
    if (on && !this.past) this.hold();
    if (on && this.held && (this.row ?? this.held.end - 1) >= this.held.end - 1)
      this.seek(this.held.first);
    this.emit('changed', null);
  }

  /** Goes on with the present. */
  live(): void {
    this.held = null;
    this.row = null;
    this.isPlaying = false;
    this.emit('changed', null);
  }

  /** To be called once per frame of the display. */
  advance(now: number): void {
    if (!this.isPlaying || !this.held) return;
    const elapsed = this.last > 0 ? (now - this.last) * 1e-3 : 0;
    this.last = now;
    const time = this.time + elapsed;
    const row = this.held.rowAt(time);
    if (row >= this.held.end - 1) this.isPlaying = false;
    this.seek(row);
    this.time = time;
  }
}
