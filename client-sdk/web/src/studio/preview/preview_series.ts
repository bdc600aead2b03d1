// The quantities of a running world over its time, and its steps. A long run takes no more memory than a short one: what is older
// is kept less finely.

export interface Sample {
  tick: number;
  /** In the order of `names`. */
  values: Float32Array;
}
/** A step, while it went on. `to` is null of the one that goes on now. */
export interface Band {
  activity: string;
  step: string;
  from: number;
  to: number | null;
}

const kMostSamples = 4_096;
const kMostBands = 256;

export class Series {
  private kept: Sample[] = [];
  private past: Band[] = [];
  private names: readonly string[] = [];
  private activity = '';
  private step = '';
  private begun = 0;

  constructor(private readonly most = kMostSamples) {}

  get samples(): readonly Sample[] {
    return this.kept;
  }
  get newest(): Sample | undefined {
    return this.kept.at(-1);
  }
  get bands(): Band[] {
    return [...this.past, { activity: this.activity, step: this.step, from: this.begun, to: null }];
  }
  /** A paused world sends the same tick again; one that begins anew has an earlier one. */
  add(tick: number, values: Float32Array): void {
    const last = this.newest?.tick ?? -1;
    if (tick === last) return;
    if (tick < last) this.clear();
    if (this.kept.length === 0) this.begun = tick;
    this.kept.push({ tick, values });
    if (this.kept.length > this.most) this.kept = this.kept.filter((_, i) => i >= this.most / 2 || i % 2 === 0);
  }
  /** What the world is in now, and what its frames tell. */
  enter(activity: string, step: string, names: readonly string[]): void {
    if (names.join('\n') !== this.names.join('\n')) this.clear();
    this.names = names;
    if (activity === this.activity && step === this.step) return;
    const now = this.newest?.tick ?? 0;
    if (now > this.begun) this.past.push({ activity: this.activity, step: this.step, from: this.begun, to: now });
    if (this.past.length > kMostBands) this.past.shift();
    Object.assign(this, { activity, step, begun: now });
  }
  clear(): void {
    this.kept = [];
    this.past = [];
    this.begun = 0;
  }
}
