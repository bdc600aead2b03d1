// Where an author is in the tour. It is kept in this browser, so that it can be left and taken up again.
import { kStops, type StopName } from './stops';

const kKey = 'mechane.tour';

export class Tour {
  on = $state(false);
  /** The number of the stop; after the last one: all is done. */
  at = $state(0);
  /** The name of the draft that it makes. */
  exhibit = $state('');
  /** The author has gone back, or is told what is done: nothing goes on by itself. */
  held = $state(false);
  /** What was done last. */
  before = $state<StopName | null>(null);
  stop = $derived<StopName | null>(kStops[this.at] ?? null);

  constructor() {
    try {
      const { at, exhibit } = JSON.parse(localStorage.getItem(kKey) ?? '{}') as { at?: number; exhibit?: string };
      if (typeof at === 'number' && at in kStops && typeof exhibit === 'string') [this.at, this.exhibit] = [at, exhibit];
    } catch {
      // Somebody else's, or a browser that keeps nothing.
    }
  }
  /** Begins, or goes on where it was left. */
  begin(): void {
    if (this.stop === null) this.anew();
    this.on = true;
  }
  anew(): void {
    Object.assign(this, { at: 0, exhibit: '', held: false, before: null });
    this.keep();
  }
  leave(): void {
    this.on = false;
    if (this.stop === null) this.anew();
  }
  done(exhibit: string): void {
    const stop = this.stop;
    if (this.at === 0) this.exhibit = exhibit;
    this.go(1);
    this.before = stop;
  }
  go(by: 1 | -1): void {
    this.at = Math.max(this.at + by, 0);
    this.held = by < 0;
    this.before = null;
    this.keep();
  }
  private keep(): void {
    try {
      if (this.at > 0 && this.stop) localStorage.setItem(kKey, JSON.stringify({ at: this.at, exhibit: this.exhibit }));
      else localStorage.removeItem(kKey);
    } catch {
      // Then it is not taken up again.
    }
  }
}
