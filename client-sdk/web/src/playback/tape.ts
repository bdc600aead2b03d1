// A recorded visit as the gateway gives it (STREAM.md): what a display heard of it, to be shown at any moment and any speed.
import { decodeFrame, type Frame } from '../wire/frame';
import { interpolate } from '../wire/history';
import { kNothingKnown, parseMessage, reduce, textIn, type KioskState, type Texts } from '../wire/messages';

const kText = 1;
const kFrame = 2;
const kHead = 8;
const kTickAt = 16;
/** Longer pauses between frames are shown as pauses, not as slow motion. */
const kGap_s = 0.5;

interface FramePlace {
  /** Seconds since the first frame. */
  at: number;
  from: number;
  size: number;
}
interface Chapter {
  at: number;
  state: KioskState;
  activity: string;
  step: string;
  title: Texts;
  caption: Texts;
}

const textsOf = (v: unknown): Texts =>
  typeof v === 'object' && v !== null
    ? Object.fromEntries(Object.entries(v).filter((entry): entry is [string, string] => typeof entry[1] === 'string'))
    : {};

export class Tape {
  private readonly frames: FramePlace[] = [];
  private readonly chapters: Chapter[] = [];
  private shown: { index: number; a: Frame; b: Frame } | null = null;

  /** Throws where the bytes are no tape. */
  constructor(private readonly bytes: ArrayBuffer) {
    const view = new DataView(bytes);
    const decoder = new TextDecoder();
    let state: KioskState = { ...kNothingKnown, link: 'joined' };
    let waiting: Chapter | null = null;
    let first: bigint | null = null;
    for (let at = 0; at < bytes.byteLength; ) {
      if (at + kHead > bytes.byteLength) throw new RangeError('a tape that ends in the middle');
      const [kind, size] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
      const from = at + kHead;
      if (from + size > bytes.byteLength) throw new RangeError('a tape that ends in the middle');
      at = from + 4 * Math.ceil(size / 4);
      if (kind === kText) {
        const message = parseMessage(decoder.decode(new Uint8Array(bytes, from, size)));
        if (!message) throw new RangeError('a tape with an unreadable text');
        state = reduce(state, message);
        const last: Chapter | undefined = waiting ?? this.chapters.at(-1);
        const words: Pick<Chapter, 'title' | 'caption'> = message.type === 'world'
          ? { title: textsOf(message.title), caption: textsOf(message.caption) }
          : { title: last?.title ?? {}, caption: last?.caption ?? {} };
        waiting = { at: 0, state, activity: state.world?.activity ?? '', step: state.world?.step ?? '', ...words };
      } else if (kind === kFrame && size >= kTickAt + 8) {
        const tick = view.getBigUint64(from + kTickAt, true);
        first ??= tick;
        const time = Math.max(Number(tick - first) / 1000, this.frames.at(-1)?.at ?? 0);
        if (waiting) this.chapters.push({ ...waiting, at: time });
        waiting = null;
        this.frames.push({ at: time, from, size });
      }
    }
    if (this.frames.length < 2 || this.chapters.length === 0) throw new RangeError('a tape without a picture');
  }

  get duration(): number {
    return this.frames.at(-1)!.at;
  }
  /** Where each step begins, in seconds; one that comes again stands there again. */
  get steps(): { at: number; step: string }[] {
    return this.chapters
      .filter(({ step, activity }, i) => {
        const before = this.chapters[i - 1];
        return step !== '' && (step !== before?.step || activity !== before.activity);
      })
      .map(({ at, step }) => ({ at, step }));
  }
  get languages(): string[] {
    return [...new Set(this.chapters.flatMap((c) => Object.keys(c.caption)))].sort();
  }
  /** What is known at a moment: the same object while nothing changes. */
  stateAt(at: number): KioskState {
    return this.chapterAt(at).state;
  }
  wordsAt(at: number, language: string): { title: string; caption: string } {
    const { title, caption } = this.chapterAt(at);
    return { title: textIn(title, language), caption: textIn(caption, language) };
  }
  frameAt(at: number): Frame | null {
    const index = Math.max(0, Math.min(lastNotAfter(this.frames, at), this.frames.length - 2));
    if (this.shown?.index !== index) {
      const [a, b] = [this.decode(index), this.decode(index + 1)];
      if (!a || !b) return null;
      this.shown = { index, a, b };
    }
    const [from, to] = [this.frames[index]!.at, this.frames[index + 1]!.at];
    const share = to - from > kGap_s || to === from ? (at >= to ? 1 : 0) : (at - from) / (to - from);
    return interpolate(this.shown.a, this.shown.b, Math.min(Math.max(share, 0), 1));
  }

  private chapterAt(at: number): Chapter {
    return this.chapters[Math.max(0, lastNotAfter(this.chapters, at))]!;
  }
  private decode(index: number): Frame | null {
    const { from, size } = this.frames[index]!;
    return decodeFrame(this.bytes.slice(from, from + size));
  }
}

/** The index of the last entry that is not later than a moment; -1: all are. Entries are sorted. */
export function lastNotAfter(entries: readonly { at: number }[], at: number): number {
  let [low, high] = [0, entries.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (entries[middle]!.at <= at) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Where a tape is: it stops by itself at the end, and begins anew from there. */
export class Player {
  at = 0;
  playing = false;
  speed = 1;
  constructor(readonly duration: number) {}

  toggle(): void {
    if (!this.playing && this.at >= this.duration) this.at = 0;
    this.playing = !this.playing;
  }
  seek(at: number): void {
    this.at = Math.min(Math.max(at, 0), this.duration);
  }
  pass(seconds: number): void {
    if (!this.playing) return;
    this.seek(this.at + this.speed * Math.min(Math.max(seconds, 0), 0.25));
    if (this.at >= this.duration) this.playing = false;
  }
}
