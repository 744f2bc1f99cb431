// SPDX-License-Identifier: Apache-2.0
import type {Session} from '../session';
import type {Futures} from '../wire';

const rest = 100; // ms between two questions: the fan follows the loop, and a core is not busy

/** Asks for futures while gains are typed that the loop does not have. */
export class GainFutures {
  private gains: Record<string, number> | null = null;
  private isAsking = false;

  /** @param show receives the futures, or the reason why there are none */
  constructor(
    private readonly session: Session,
    private readonly show: (futures: Futures | null, refusal: string) => void,
  ) {}

  /** Other gains than the loop's; null: none. */
  propose(gains: Record<string, number> | null): void {
    this.gains = gains;
    if (gains === null) this.end('');
    else if (!this.isAsking) void this.ask();
  }

  // One question at a time: the next one has the gains that are typed by then.
  private async ask(): Promise<void> {
    this.isAsking = true;
    while (this.gains !== null) {
      const asked = this.gains;
      const answer = await this.session.askQuietly('/futures', {gains: asked});
      if (this.gains === null) break;
      if (answer.success) {
        const futures = answer as unknown as Futures;
        this.session.showFutures(futures);
        this.show(futures, '');
      } else {
        this.end(answer.message);
      }
      await new Promise((resolve) => setTimeout(resolve, answer.success ? rest : 10 * rest));
    }
    this.isAsking = false;
  }

  private end(refusal: string): void {
    this.session.showFutures(null);
    this.show(null, refusal);
  }
}
