// Frames as the gateway writes them, for tests: written by hand from the wire's description, not with the decoder's code.

export interface BodySpec {
  object: number;
  visible?: number;
  pose: number[];
}
export interface FrameSpec {
  sequence?: number;
  tick?: number;
  skipped?: number;
  age?: number;
  bodies?: BodySpec[];
  quantities?: number[];
  hands?: { user: number; kind: number; stale?: number; holding?: number; force?: number[]; segments: number[][] }[];
  ropes?: { diameter: number; points: number[][] }[];
}

export const kStill = [0, 0, 0, 0, 0, 0, 1];

export function frameBytes(spec: FrameSpec): ArrayBuffer {
  const { bodies = [], quantities = [], hands = [], ropes = [] } = spec;
  const size =
    48 + 36 * bodies.length + 4 * quantities.length +
    hands.reduce((sum, h) => sum + 20 + 28 * h.segments.length, 0) +
    ropes.reduce((sum, r) => sum + 8 + 12 * r.points.length, 0);
  const view = new DataView(new ArrayBuffer(size));
  view.setUint8(0, 1);
  view.setUint8(1, 1);
  view.setUint16(2, 54_321, true); // when it was sent
  view.setUint32(4, spec.skipped ?? 0, true);
  view.setBigUint64(8, BigInt(spec.sequence ?? 1), true);
  view.setBigUint64(16, BigInt(spec.tick ?? 0), true);
  view.setFloat64(24, spec.age ?? 0, true);
  [bodies, quantities, hands, ropes].forEach((list, i) => view.setUint32(32 + 4 * i, list.length, true));
  let at = 48;
  const u8 = (v: number): void => view.setUint8(at++, v);
  const u32 = (v: number): void => (view.setUint32(at, v, true), void (at += 4));
  const f32 = (v: number): void => (view.setFloat32(at, v, true), void (at += 4));
  for (const body of bodies) {
    u32(body.object);
    u32(body.visible ?? 1);
    body.pose.forEach(f32);
  }
  quantities.forEach(f32);
  for (const hand of hands) {
    [hand.user, hand.kind, hand.stale ?? 0, hand.holding ?? 0].forEach(u8);
    (hand.force ?? [0, 0, 0]).forEach(f32);
    u32(hand.segments.length);
    hand.segments.flat().forEach(f32);
  }
  for (const rope of ropes) {
    f32(rope.diameter);
    u32(rope.points.length);
    rope.points.flat().forEach(f32);
  }
  return view.buffer as ArrayBuffer;
}
