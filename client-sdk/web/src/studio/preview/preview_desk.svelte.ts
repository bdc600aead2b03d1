// The draft's preview as the page has it: what the gateway says of it once a second, what its world sends, what is asked of it.
import { ApiError } from '../../console/api';
import { Tape } from '../../playback/tape';
import { TapeWriter } from '../../playback/tape_writer';
import { Connection } from '../../wire/connection';
import { decodeFrame } from '../../wire/frame';
import { eventOf, kNothingKnown, parseMessage, reduce, type KioskState, type Quantity, type WorldEvent } from '../../wire/messages';
import type { Draft } from '../draft';
import { wantedIn } from '../flow/flow';
import type { DeviceOrder } from '../../console/devices';
import { kFetches_ms, LostHold } from './lost_hold';
import type { Preview } from './preview';
import { Series } from './preview_series';
import { sentence, type StudioRequests } from '../requests';
import type { View } from '../view';
import type { Move } from '../visits/moves';
import { Recorder } from '../visits/recorder';

const kLookEvery_ms = 1_000;
/** While none runs: another author may start it. */
const kLookIdly_ms = 5_000;
const kMostOrders = 4;
const kDrawEvery_ms = 100;
/** As on a visit's tape. */
const kOnTape: readonly string[] = ['world', 'scene', 'presentation'];
/** A page that nobody sees lets go of the preview, so that the gateway can end it. */
const kUnseen_ms = 600_000;

export class PreviewDesk {
  /** Null: the gateway was not asked yet. */
  now = $state.raw<Preview | null>(null);
  trouble = $state('');
  /** Orders are on their way. */
  busy = $state(false);
  /** The page is open, and was seen lately. */
  seen = $state(false);
  quantities = $state.raw<Quantity[]>([]);
  /** By quantity, where the author has chosen; the others are plotted where a step waits for them. */
  chosen = $state<Record<string, boolean>>({});
  /** The step that the next one begins at, "use/lift"; "": where the exhibit does. */
  from = $state('');
  /** The visit that is played once the draft as it is stored runs; "": none. */
  playNext = $state('');
  /** Seconds of world time in the plots; 0: all. */
  window_s = $state(30);
  /** Grows when the series has something new to draw. */
  drawn = $state(0);
  /** Grows with what the author has done in it. */
  acts = $state(0);
  /** What the author's hand has lost without being opened; "": nothing. */
  lost = $state('');
  private readonly hold = new LostHold();
  private looksForIt: ReturnType<typeof setTimeout> | undefined;
  readonly series = new Series();
  private readonly recorder = new Recorder();
  private readonly writer = new TapeWriter();
  /** What is played back; null: the trial itself is shown. */
  tape = $state.raw<Tape | null>(null);
  private pace = 1;
  private world: KioskState = kNothingKnown;
  private connection: Connection | null = null;
  private socket = '';
  private stale = false;
  private drawnAt = 0;
  private asked = 0;
  /** The draft's revision that was last to go into the world that runs. */
  private carried = 0;
  private orders = 0;
  private line = Promise.resolve();
  private next: ReturnType<typeof setTimeout> | undefined;
  private unseen: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly name: string,
    private readonly requests: StudioRequests,
    private readonly draft: Draft,
  ) {}

  get runs(): boolean {
    return this.now?.state === 'running';
  }
  get isOn(): boolean {
    return this.runs || this.now?.state === 'starting';
  }
  /** The part of the page is shown for the first time. */
  begin(): void {
    if (this.seen) return;
    document.addEventListener('visibilitychange', this.noteSeen);
    this.wake();
  }
  /** Signed in again. */
  hurry(): void {
    if (this.seen) void this.look();
  }
  end(): void {
    document.removeEventListener('visibilitychange', this.noteSeen);
    clearTimeout(this.unseen);
    this.sleep();
  }
  /** Starts it, or starts it anew, with the draft as it is stored. */
  start(revision: number, step: string): Promise<void> {
    this.forgetLost();
    return this.order(() => this.requests.startPreview(this.name, revision, step));
  }
  stop(): Promise<void> {
    return this.order(() => this.requests.stopPreview(this.name));
  }
  setPace(pace: number): Promise<void> {
    return this.order(() => this.requests.pacePreview(this.name, { pace }));
  }
  /** Pauses, or goes on as before. */
  togglePause(): Promise<void> {
    return this.setPace(this.now?.pace === 0 ? this.pace : 0);
  }
  step(ticks: number): Promise<void> {
    return this.order(() => this.requests.pacePreview(this.name, { ticks }));
  }
  /** Its program answers in what is told of the device. */
  askDevice(order: DeviceOrder): Promise<void> {
    return this.order(() => this.requests.askDevice(this.name, order));
  }
  /** A scripted visitor comes, and plays a visit of what runs; "": it goes. */
  play(visit: string): Promise<void> {
    this.recorder.stop();
    this.acts = 0;
    return this.order(() => this.requests.playVisit(this.name, visit));
  }
  /** Plays a visit of the draft as it is stored. What runs takes over the newest edits first, or starts anew. */
  playSoon(visit: string): void {
    this.playNext = visit;
    this.catchUp();
  }
  /** What the author has done so far, as a scripted visit does it, and how much of it no visit can do. */
  shown(view: View): { moves: Move[]; leftOut: number } {
    return { moves: this.recorder.moves(view, this.world), leftOut: this.recorder.leftOut };
  }
  /** Whether there is something to be played back. */
  get hasTape(): boolean {
    void this.drawn;
    return this.writer.isLong;
  }
  /** All that was seen of it since it began is shown again, or it is itself. */
  playBack(on: boolean): void {
    this.tape = on ? new Tape(this.writer.bytes()) : null;
  }
  /** The author has opened the hand, in the page of the trial. */
  letGo(): void {
    this.hold.letGo(performance.now());
  }
  forgetLost(): void {
    clearTimeout(this.looksForIt);
    this.hold.forget();
    this.lost = '';
  }
  forgetShown(): void {
    this.recorder.clear();
    this.acts = 0;
  }
  /** Names of the quantities that are plotted, in the exhibit's order. */
  plotted(view: View): string[] {
    const wanted = new Set(wantedIn(view, this.now?.activity ?? '').map((w) => w.quantity));
    const usual = this.quantities.some((q) => wanted.has(q.name)) ? wanted : new Set(this.quantities.slice(0, 2).map((q) => q.name));
    return this.quantities.map((q) => q.name).filter((name) => this.chosen[name] ?? usual.has(name));
  }

  /** The bodies of what runs that a hand can take, turn, slide or place. */
  handled(): string[] {
    const { presentation, objects } = this.world;
    const worked = new Set(presentation?.affordances.map((one) => one.object));
    return objects.filter((one) => worked.has(one.index)).map((one) => one.name);
  }

  private noteSeen = (): void => {
    clearTimeout(this.unseen);
    if (document.hidden) this.unseen = setTimeout(() => this.sleep(), kUnseen_ms);
    else if (!this.seen) this.wake();
  };
  private wake(): void {
    this.seen = true;
    void this.look();
  }
  private sleep(): void {
    this.seen = false;
    clearTimeout(this.next);
    this.listen('');
  }
  private look(): Promise<void> {
    return this.ask(() => this.requests.preview(this.name));
  }
  /** One after another, so that each step is done; a key that is held down does not run ahead of the world. */
  private async order(request: () => Promise<Preview>): Promise<void> {
    if (this.orders >= kMostOrders) return;
    ++this.orders;
    this.busy = true;
    await (this.line = this.line.then(() => this.ask(request)));
    this.busy = --this.orders > 0;
  }
  /** Answers may overtake each other: only the newest question's counts. */
  private async ask(request: () => Promise<Preview>): Promise<void> {
    const mine = ++this.asked;
    clearTimeout(this.next);
    try {
      const said = await request();
      if (mine === this.asked) this.take(said);
    } catch (error) {
      if (mine === this.asked) this.fail(error);
    }
    if (mine === this.asked && this.seen)
      this.next = setTimeout(() => void this.look(), this.isOn ? kLookEvery_ms : kLookIdly_ms);
  }
  private take(said: Preview): void {
    this.trouble = '';
    if (said.pace > 0) this.pace = said.pace;
    this.now = said;
    if (this.seen) this.listen(said.state === 'running' ? said.socket : '');
    if (!this.isOn) this.playNext = '';
    this.catchUp();
    if (said.state !== 'none' && said.revision > (this.draft.state.view?.revision ?? 0)) void this.draft.refresh();
  }
  /** Brings what runs up to the stored draft, and plays the visit that waits for that. */
  private catchUp(): void {
    const { view, waiting } = this.draft.state;
    if (!this.runs || !view || waiting > 0) return;
    const { revision, kept, begins, visit } = this.now!;
    const next = this.playNext;
    const isNew = revision >= view.revision;
    if (next !== '' && isNew && begins === '') {
      this.playNext = '';
      void this.play(next);
    } else if (next !== '' && (isNew || kept.revision >= view.revision)) {
      if (this.orders === 0) void this.start(view.revision, '');
    } else if (view.revision > Math.max(revision, kept.revision, this.carried) && visit.state !== 'playing') {
      if (!view.problems.some((p) => p.severity === 'error')) this.carryOn(view.revision);
    }
  }
  /** What was edited meanwhile goes into the world that runs; once for each state of the draft. It disables no button. */
  private carryOn(revision: number): void {
    this.carried = revision;
    this.letGo();  // all hands do
    this.line = this.line.then(() => this.ask(() => this.requests.editPreview(this.name, revision).catch((error: unknown) => {
      // Somebody was quicker: what runs now is seen by a look.
      if (error instanceof ApiError && error.status === 409) return this.requests.preview(this.name);
      throw error;
    })));
  }
  private fail(error: unknown): void {
    this.trouble = sentence(error);
    this.playNext = '';
    const status = error instanceof ApiError ? error.status : 0;
    if (status === 401) this.draft.signOut();
    // Somebody has changed the draft: it is shown as it is now, and can be started.
    if (status === 409) void this.draft.refresh();
  }

  /** To another world, or to none: "". */
  private listen(socket: string): void {
    if (socket === this.socket) return;
    this.connection?.end();
    this.socket = socket;
    this.connection = null;
    if (socket === '') return;
    this.series.clear();
    this.writer.clear();
    this.tape = null;
    this.forgetShown();
    this.forgetLost();
    this.world = kNothingKnown;
    this.connection = new Connection(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}${socket}`, {
      opened: () => undefined,
      closed: () => undefined,
      text: (json) => this.hearText(json),
      bytes: (bytes) => this.hearFrame(bytes),
    });
  }
  private hearText(json: string): void {
    const message = parseMessage(json);
    if (!message) return;
    if (message.type === 'event') this.hearEvent(eventOf(message));
    this.world = reduce(this.world, message);
    if (kOnTape.includes(message.type)) this.writer.text(json);
    if (message.type !== 'world') return;
    const { quantities, activity, step } = this.world.world!;
    this.recorder.enter(activity);
    this.series.enter(activity, step, quantities.map((q) => q.name));
    this.quantities = quantities;
    this.stale = true;
  }
  private hearEvent(event: WorldEvent): void {
    const { name, state } = this.now?.visit ?? { name: '', state: 'done' };
    this.recorder.hear(event, this.world);
    if (name !== '' && state === 'playing') this.recorder.stop();  // it is a visitor who does it
    else this.watchHold(event);
    this.acts = this.recorder.count;
  }
  private watchHold(event: WorldEvent): void {
    this.hold.hear(event, performance.now());
    if (event.kind === 'grasped') this.lost = '';
    if (event.kind !== 'released') return;
    clearTimeout(this.looksForIt);
    this.looksForIt = setTimeout(() => (this.lost = this.hold.at(performance.now())), kFetches_ms + kDrawEvery_ms);
  }
  private hearFrame(bytes: ArrayBuffer): void {
    const frame = decodeFrame(bytes);
    if (!frame) return;
    if (frame.tick !== this.series.newest?.tick) this.stale = true;
    this.series.add(frame.tick, frame.quantities);
    this.recorder.see(frame, this.world);
    this.writer.frame(frame.tick, bytes);
    const now = performance.now();
    if (!this.stale || now - this.drawnAt < kDrawEvery_ms) return;
    [this.stale, this.drawnAt] = [false, now];
    ++this.drawn;
  }
}
