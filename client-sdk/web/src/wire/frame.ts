// A scene frame of the gateway, decoded from bytes. Little-endian, W: y up, metres. Poses are px py pz qx qy qz qw.

/** Floats of a pose. */
export const kPose = 7;
const kHeaderBytes = 48;
const kBodyBytes = 36;
const kHandBytes = 20;
const kRopeBytes = 8;
// More than any world has; a larger count means that these are not a frame's bytes.
const kMostBodies = 65_536;
const kMostQuantities = 4_096;
const kMostHands = 256;
const kMostSegments = 64;
const kMostRopes = 256;
const kMostPoints = 4_096;

export interface HandFrame {
  user: number;
  /** All segments of a hand, or only its tip. */
  whole: boolean;
  stale: boolean;
  holding: boolean;
  /** Newtons in W. */
  force: Float32Array;
  /** kPose floats each; of a one-point hand one. */
  segments: Float32Array;
}

export interface RopeFrame {
  diameter: number;
  /** x y z of each point, from its drum to its end. */
  points: Float32Array;
}

export interface Frame {
  /** Frames that this browser was too slow for, since it joined. */
  skipped: number;
  sequence: number;
  /** Of the world, 1 ms each. */
  tick: number;
  /** How long the frame waited at the gateway, seconds. */
  age: number;
  /** Indices into the manifest, rising. */
  objects: Uint32Array;
  visible: Uint8Array;
  /** kPose floats for each object. */
  poses: Float32Array;
  quantities: Float32Array;
  hands: HandFrame[];
  ropes: RopeFrame[];
}

/** Reads numbers one after the other; past the end it only notes that there are too few. */
class Reader {
  at = kHeaderBytes;
  short = false;
  constructor(private readonly view: DataView) {}

  private take(bytes: number): number {
    const from = this.at;
    this.at += bytes;
    if (this.at > this.view.byteLength) this.short = true;
    return from;
  }
  byte(): number {
    const from = this.take(1);
    return this.short ? 0 : this.view.getUint8(from);
  }
  u32(): number {
    const from = this.take(4);
    return this.short ? 0 : this.view.getUint32(from, true);
  }
  f32(): number {
    const from = this.take(4);
    return this.short ? 0 : this.view.getFloat32(from, true);
  }
  floats(count: number): Float32Array {
    const from = this.take(4 * count);
    const out = new Float32Array(this.short ? 0 : count);
    for (let i = 0; i < out.length; ++i) out[i] = this.view.getFloat32(from + 4 * i, true);
    return out;
  }
}

function readHand(reader: Reader): HandFrame | null {
  const user = reader.byte();
  const whole = reader.byte() !== 0;
  const stale = reader.byte() !== 0;
  const holding = reader.byte() !== 0;
  const force = reader.floats(3);
  const count = reader.u32();
  if (reader.short || count === 0 || count > kMostSegments) return null;
  return { user, whole, stale, holding, force, segments: reader.floats(kPose * count) };
}

function readRope(reader: Reader): RopeFrame | null {
  const diameter = reader.f32();
  const count = reader.u32();
  if (reader.short || count > kMostPoints) return null;
  return { diameter, points: reader.floats(3 * count) };
}

/** Null for bytes that are not exactly one frame of this version. */
export function decodeFrame(bytes: ArrayBuffer): Frame | null {
  if (bytes.byteLength < kHeaderBytes) return null;
  const view = new DataView(bytes);
  if (view.getUint8(0) !== 1 || view.getUint8(1) !== 1) return null;
  const n = view.getUint32(32, true);
  const m = view.getUint32(36, true);
  const h = view.getUint32(40, true);
  const r = view.getUint32(44, true);
  if (n > kMostBodies || m > kMostQuantities || h > kMostHands || r > kMostRopes) return null;
  // Before anything is allocated: are there as many bytes as the counts need at least?
  if (bytes.byteLength < kHeaderBytes + kBodyBytes * n + 4 * m + kHandBytes * h + kRopeBytes * r) return null;
  const frame: Frame = {
    skipped: view.getUint32(4, true),
    sequence: Number(view.getBigUint64(8, true)),
    tick: Number(view.getBigUint64(16, true)),
    age: view.getFloat64(24, true),
    objects: new Uint32Array(n),
    visible: new Uint8Array(n),
    poses: new Float32Array(kPose * n),
    quantities: new Float32Array(0),
    hands: [],
    ropes: [],
  };
  const reader = new Reader(view);
  for (let i = 0; i < n; ++i) {
    frame.objects[i] = reader.u32();
    frame.visible[i] = reader.u32() === 0 ? 0 : 1;
    for (let k = 0; k < kPose; ++k) frame.poses[kPose * i + k] = reader.f32();
  }
  frame.quantities = reader.floats(m);
  for (let i = 0; i < h; ++i) {
    const hand = readHand(reader);
    if (!hand) return null;
    frame.hands.push(hand);
  }
  for (let i = 0; i < r; ++i) {
    const rope = readRope(reader);
    if (!rope) return null;
    frame.ropes.push(rope);
  }
  return reader.short || reader.at !== bytes.byteLength ? null : frame;
}
