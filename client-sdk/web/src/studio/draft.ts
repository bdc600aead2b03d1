// A draft at the gateway and one's edits of it, one after another: each is sent with the revision that it was made for, so that
// nobody's work is overwritten unseen. Edits wait while the gateway or the session is away.
import { ApiError } from '../console/api';
import type { Edit } from './commands';
import type { View } from './view';

export type Order = { kind: 'edit'; edit: Edit } | { kind: 'undo' | 'redo' } | { kind: 'restore'; version: number } |
  { kind: 'merge'; from: string };
/** The requests that a draft needs. Errors are ApiErrors. */
export interface DraftRequests {
  view(): Promise<View>;
  send(order: Order, revision: number): Promise<View>;
  /** The name of who is signed in. */
  me(): string;
}
export interface Refusal {
  message: string;
  remedy: string;
}
export interface DraftState {
  view: View | null;
  /** What somebody else has made of it meanwhile, while nothing of one's own waits; null: nothing. */
  theirs: View | null;
  /** Edits that are not stored yet. */
  waiting: number;
  away: boolean;
  signedOut: boolean;
  /** Somebody else has edited meanwhile; `mine`: one's own edits that were not taken. */
  conflict: { by: string; mine: string[] } | null;
  /** By the edit's id. */
  refusals: Record<string, Refusal>;
}
export type Outcome = 'done' | 'refused' | 'dropped';

const kAgain_ms = 2_000;
/** The gateway or what is before it is not there, or is busy: what was asked may be asked again. */
const isAway = (status: number): boolean => status === 0 || status === 429 || (status >= 502 && status <= 504);

interface Waiting {
  order: Order;
  settle: (outcome: Outcome) => void;
}

export class Draft {
  state: DraftState = { view: null, theirs: null, waiting: 0, away: false, signedOut: false, conflict: null, refusals: {} };
  private queue: Waiting[] = [];
  private running = false;
  private again: ReturnType<typeof setTimeout> | undefined;
  /** The answer to the first edit was lost: it may have been taken. */
  private unsure = false;
  private ended = false;

  constructor(
    private readonly requests: DraftRequests,
    private readonly changed: (state: DraftState) => void,
  ) {}

  open(): Promise<void> {
    return this.run();
  }
  end(): void {
    this.ended = true;
    clearTimeout(this.again);
  }
  edit(edit: Edit): Promise<Outcome> {
    if (edit.commands.length === 0) return Promise.resolve('done');
    return this.give({ kind: 'edit', edit });
  }
  undo(): Promise<Outcome> {
    return this.give({ kind: 'undo' });
  }
  redo(): Promise<Outcome> {
    return this.give({ kind: 'redo' });
  }
  restore(version: number): Promise<Outcome> {
    return this.give({ kind: 'restore', version });
  }
  /** Adds all of another exhibit: "exhibit:NAME" or "draft:NAME". */
  merge(from: string): Promise<Outcome> {
    return this.give({ kind: 'merge', from });
  }
  /** The network is said to be back. */
  hurry(): void {
    clearTimeout(this.again);
    this.again = undefined;
    void this.run();
  }
  /** Signed in again. */
  resume(): void {
    this.put({ signedOut: false });
    void this.run();
  }
  /** Another request was told that nobody is signed in. */
  signOut(): void {
    this.put({ signedOut: true });
  }
  /** Somebody else has changed the draft, and nothing of one's own waits: it is shown as it is now. */
  async refresh(): Promise<void> {
    if (this.queue.length > 0) return;
    const theirs = await this.requests.view().catch(() => null);  // the next look finds out why
    if (theirs && this.queue.length === 0 && theirs.revision > (this.state.view?.revision ?? 0)) this.put({ view: theirs });
  }
  /** Finds out whether somebody else has changed it. */
  async look(): Promise<void> {
    const { view, conflict, signedOut, away } = this.state;
    if (!view || conflict || signedOut || away || this.queue.length > 0) return;
    const theirs = await this.requests.view().catch(() => null);  // an edit finds out why
    if (theirs && this.queue.length === 0) this.put({ theirs });
  }
  showTheirs(): void {
    if (this.state.theirs) this.put({ view: this.state.theirs });
  }
  /** After a conflict: one's own edits, upon the other's. */
  applyAgain(): void {
    this.put({ conflict: null });
    void this.run();
  }
  dropMine(): void {
    for (const { settle } of this.queue.splice(0)) settle('dropped');
    this.put({ conflict: null });
  }
  forgive(id: string): void {
    if (!(id in this.state.refusals)) return;
    const { [id]: _, ...refusals } = this.state.refusals;
    this.put({ refusals });
  }

  private put(some: Partial<DraftState>): void {
    const next = { ...this.state, ...some, waiting: this.queue.length };
    const isNews = next.theirs !== null && next.theirs.revision > (next.view?.revision ?? 0);
    this.state = { ...next, theirs: isNews ? next.theirs : null };
    this.changed(this.state);
  }
  private give(order: Order): Promise<Outcome> {
    return new Promise((settle) => {
      this.queue.push({ order, settle });
      this.put({});
      void this.run();
    });
  }

  private async run(): Promise<void> {
    if (this.running) return;
    this.running = true;
    try {
      while (this.mayGoOn()) await this.pass();
    } finally {
      this.running = false;
    }
  }
  private mayGoOn(): boolean {
    const { view, conflict, signedOut } = this.state;
    return !this.ended && !conflict && !signedOut && this.again === undefined && (!view || this.queue.length > 0);
  }
  private async pass(): Promise<void> {
    const { view } = this.state;
    const first = view ? this.queue[0] : undefined;
    try {
      if (!view || !first) return this.put({ view: await this.requests.view(), away: false });
      const next = await this.requests.send(first.order, view.revision);
      this.settleFirst('done', next);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      await this.fail(error, first);
    }
  }
  private settleFirst(outcome: Outcome, view: View | null, refusal?: Refusal): void {
    const { order, settle } = this.queue.shift()!;
    this.unsure = false;
    const id = order.kind === 'edit' ? order.edit.id : '';
    const { [id]: _, ...refusals } = this.state.refusals;
    this.put({ ...(view && { view }), away: false, refusals: refusal ? { ...refusals, [id]: refusal } : refusals });
    settle(outcome);
  }
  private async fail(error: ApiError, first: Waiting | undefined): Promise<void> {
    if (error.status === 401) return this.put({ signedOut: true, away: false });
    if (isAway(error.status)) {
      this.unsure ||= first !== undefined;
      this.put({ away: true });
      this.again = setTimeout(() => {
        this.again = undefined;
        void this.run();
      }, kAgain_ms);
      return;
    }
    if (!first) {
      this.put({ away: false, refusals: { ...this.state.refusals, '': { message: error.message, remedy: error.remedy } } });
      this.ended = true;  // there is no such draft
      return;
    }
    if (error.status === 409) return this.meet(first, error);
    this.settleFirst('refused', null, { message: error.message, remedy: error.remedy });
  }
  /** The draft has another revision than ours. */
  private async meet(first: Waiting, refused: ApiError): Promise<void> {
    let theirs: View;
    const before = this.state.view!.revision;
    try {
      theirs = await this.requests.view();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      return this.fail(error.status === 401 ? error : new ApiError(0, error.message, error.remedy), first);
    }
    // It was taken, only its answer was lost.
    if (this.unsure && theirs.by === this.requests.me() && theirs.revision === before + 1) return this.settleFirst('done', theirs);
    // Another reason than the revision, such as nothing to undo.
    if (theirs.revision === before) return this.settleFirst('refused', theirs, { message: refused.message, remedy: refused.remedy });
    this.unsure = false;
    // Another's step is not undone by a key that was meant for one's own.
    const dropped = this.queue.filter((w) => w.order.kind !== 'edit');
    this.queue = this.queue.filter((w) => w.order.kind === 'edit');
    const mine = this.queue.map((w) => (w.order.kind === 'edit' ? w.order.edit.what : ''));
    this.put({ view: theirs, away: false, conflict: { by: theirs.by, mine } });
    for (const { settle } of dropped) settle('dropped');
  }
}
