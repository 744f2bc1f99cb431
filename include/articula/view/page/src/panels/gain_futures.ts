// SPDX-License-Identifier: Apache-2.0
import type {Playback} from '../playback';
import type {Session} from '../session';
import type {Futures, RobotSheet} from '../wire';
import {recordedStart} from './recorded_start';

const rest = 100; // ms between two questions: the fan follows the loop, and a core is not busy

/** What to simulate. */
export interface Proposal {
  gains: Record<string, number>; // that differ from the loop's
  steps: () => Record<string, number>; // added to the reference of joints, when it is asked [rad or m]
  count: number; // of simulated robots
}

/** Asks for futures while gains are typed that the loop does not have, or a test step is chosen. */
export class GainFutures {
  private proposal: Proposal | null = null;
  private isAsking = false;

  /** @param show receives the futures, or the reason why there are none */
  constructor(
    private readonly session: Session,
    private readonly playback: Playback,
    private readonly show: (futures: Futures | null, refusal: string) => void,
  ) {}

  /** Something to simulate; null: nothing. */
  propose(proposal: Proposal | null): void {
    this.proposal = proposal;
    if (proposal === null) this.end('');
    else if (!this.isAsking) void this.ask();
  }

  // One question at a time: the next one has what is proposed by then. From a recorded cycle the same
  // question has the same answer, and from the present another one.
  private async ask(): Promise<void> {
    this.isAsking = true;
    let last: unknown[] = [];
    let isRefused = false;
    while (this.proposal !== null) {
      const {past} = this.playback;
      const asked = [this.proposal, past?.samples, past?.row];
      if (!past || asked.some((part, k) => part !== last[k])) {
        last = asked;
        isRefused = await this.answer(this.proposal, this.session.sheet);
      }
      await new Promise((resolve) => setTimeout(resolve, isRefused ? 10 * rest : rest));
    }
    this.isAsking = false;
  }

  private async answer(proposal: Proposal, sheet: RobotSheet | null): Promise<boolean> {
    const {past} = this.playback;
    const start = past && sheet ? recordedStart(past, sheet) : {};
    const steps = proposal.steps();
    const reference = this.session.samples?.latest('reference_position') ?? [];
    const goals = Object.fromEntries(
      (sheet?.joints ?? []).map(({name}, k) => [name, reference[k] + (steps[name] ?? NaN)]),
    );
    const answer = await this.session.askQuietly('/futures', {...proposal, steps, ...start});
    if (this.proposal === null) return false;
    if (answer.success) {
      const futures = {...answer, steps, goals: past ? {} : goals} as unknown as Futures;
      this.session.showFutures(futures);
      this.show(futures, '');
    } else {
      this.end(answer.message);
    }
    return !answer.success;
  }

  private end(refusal: string): void {
    this.session.showFutures(null);
    this.show(null, refusal);
  }
}
