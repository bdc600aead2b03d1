// Frames of the last moments, and the world between two of them: as the native display's client does it. Milliseconds.
import { kPose, type Frame, type HandFrame } from './frame';

const kFrames = 16;
/** A clock that is farther off than this was set anew. */
const kJump = 250;
/** How far a frame moves the estimate towards a longer delay, as a share. */
const kCreep = 200;
const kExtrapolateAtMost = 50;
const kLeastStep = 10;
/** Pictures show the world as it was this long ago, so that there is nearly always a later frame. */
export const kDelay = 33;

/** From the sender's clock to this one's: the frames that travelled fastest tell it. */
export class ClockOffset {
  private offset: number | null = null;

  toLocal(sent: number, received: number): number {
    const measured = received - sent;
    if (this.offset === null || measured < this.offset || measured - this.offset > kJump) this.offset = measured;
    else this.offset += (measured - this.offset) / kCreep;
    return sent + this.offset;
  }
}

/** Between two poses in flat arrays: places linearly, rotations along the shorter way. t may be a little above 1. */
export function betweenPoses(a: Float32Array, b: Float32Array, at: number, t: number, out: Float32Array): void {
  for (let k = 0; k < 3; ++k) out[at + k] = a[at + k]! + t * (b[at + k]! - a[at + k]!);
  let dot = 0;
  for (let k = 3; k < kPose; ++k) dot += a[at + k]! * b[at + k]!;
  const sign = dot < 0 ? -1 : 1;
  const angle = Math.acos(Math.min(Math.abs(dot), 1));
  const sine = Math.sin(angle);
  const near = sine < 1e-4;
  const ofA = near ? 1 - t : Math.sin((1 - t) * angle) / sine;
  const ofB = sign * (near ? t : Math.sin(t * angle) / sine);
  let norm = 0;
  for (let k = 3; k < kPose; ++k) {
    const q = ofA * a[at + k]! + ofB * b[at + k]!;
    out[at + k] = q;
    norm += q * q;
  }
  norm = Math.sqrt(norm) || 1;
  for (let k = 3; k < kPose; ++k) out[at + k] = out[at + k]! / norm;
}

function blend(a: Float32Array, b: Float32Array, t: number): Float32Array {
  if (a.length !== b.length) return b;
  return b.map((value, i) => a[i]! + t * (value - a[i]!));
}

function poses(a: Float32Array, b: Float32Array, t: number): Float32Array {
  if (a.length !== b.length) return b;
  const out = new Float32Array(b.length);
  for (let at = 0; at + kPose <= b.length; at += kPose) betweenPoses(a, b, at, t, out);
  return out;
}

const sameList = (a: Uint32Array, b: Uint32Array): boolean => a.length === b.length && a.every((v, i) => v === b[i]);

/** Hands of a frame are told apart by user, kind and which of these it is. */
function sameHand(frame: Frame, of: Frame, index: number): HandFrame | undefined {
  const hand = of.hands[index]!;
  const alike = (h: HandFrame): boolean => h.user === hand.user && h.whole === hand.whole;
  const number = of.hands.slice(0, index).filter(alike).length;
  return frame.hands.filter(alike)[number];
}

export function interpolate(a: Frame, b: Frame, t: number): Frame {
  return {
    ...b,
    poses: sameList(a.objects, b.objects) ? poses(a.poses, b.poses, t) : b.poses,
    quantities: blend(a.quantities, b.quantities, t),
    hands: b.hands.map((hand, i) => {
      const before = sameHand(a, b, i);
      return before ? { ...hand, segments: poses(before.segments, hand.segments, t) } : hand;
    }),
    ropes: b.ropes.map((rope, i) => {
      const before = a.ropes.length === b.ropes.length ? a.ropes[i] : undefined;
      return before ? { ...rope, points: blend(before.points, rope.points, t) } : rope;
    }),
  };
}

export class FrameHistory {
  private entries: { time: number; frame: Frame }[] = [];
  private clock = new ClockOffset();

  /** `received`: when this browser received it, less the time that it waited at the gateway. */
  add(frame: Frame, received: number): void {
    const last = this.entries.at(-1);
    if (last && frame.sequence <= last.frame.sequence) return;
    const time = this.clock.toLocal(frame.tick, received);
    this.entries.push({ time: last ? Math.max(time, last.time + 0.001) : time, frame });
    if (this.entries.length > kFrames) this.entries.shift();
  }
  clear(): void {
    this.entries = [];
    this.clock = new ClockOffset();
  }
  newest(): Frame | null {
    return this.entries.at(-1)?.frame ?? null;
  }
  /** The world at a time of this clock. */
  at(time: number): Frame | null {
    const first = this.entries[0];
    const last = this.entries.at(-1);
    if (!first || !last) return null;
    const then = Math.min(time, last.time + kExtrapolateAtMost);
    if (first === last || then <= first.time) return first.frame;
    let later = this.entries.findIndex((entry) => entry.time > then);
    if (later < 0) later = this.entries.length - 1;
    const before = this.entries[later - 1]!;
    const after = this.entries[later]!;
    const gap = after.time - before.time;
    // Two frames at nearly the same time say little about speed.
    const t = then > after.time ? 1 + (then - after.time) / Math.max(gap, kLeastStep) : (then - before.time) / gap;
    return interpolate(before.frame, after.frame, t);
  }
}
