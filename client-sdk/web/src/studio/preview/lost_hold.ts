// A thing that the author's hand held in a trial, and that was torn from it: told apart from a hand that was opened, and from a step or
// an edit that took the thing.
import type { WorldEvent } from '../../wire/messages';

/** The hand goes back for what it has lost, and mostly takes it again by then. */
export const kFetches_ms = 1_200;
/** Between the author's letting go and the world's word of it; also of an edit that goes into what runs. */
const kOnItsWay_ms = 1_500;
/** The step that switches the hand off says so in the same moment. */
const kSameMoment = 50;

export class LostHold {
  private let_ms = -Infinity;
  private stepped = -Infinity;
  private torn: { body: string; tick: number; at_ms: number; let: boolean } | null = null;

  /** The author has opened the hand, or something is done by which all hands let go. */
  letGo(now_ms: number): void {
    this.let_ms = now_ms;
  }
  hear({ kind, tick, object }: WorldEvent, now_ms: number): void {
    if (kind === 'grasped') this.torn = null;
    else if (kind === 'released') this.torn = { body: object, tick, at_ms: now_ms, let: now_ms - this.let_ms < kOnItsWay_ms };
    else if (/^(step|activity)_/.test(kind)) this.stepped = tick;
  }
  /** The thing that is lost now; "": none. */
  at(now_ms: number): string {
    const { torn } = this;
    if (!torn || torn.let || now_ms - torn.at_ms < kFetches_ms) return '';
    return Math.abs(torn.tick - this.stepped) <= kSameMoment ? '' : torn.body;
  }
  forget(): void {
    this.torn = null;
  }
}
