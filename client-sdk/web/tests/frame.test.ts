import { describe, expect, it } from 'vitest';
import { decodeFrame } from '../src/wire/frame';
import { frameBytes, kStill } from './bytes';

const kFull = {
  sequence: 7,
  tick: 123_456,
  skipped: 3,
  age: 0.25,
  bodies: [
    { object: 2, pose: [1, 2, 3, 0, 0, 0, 1] },
    { object: 5, visible: 0, pose: kStill },
  ],
  quantities: [1.5, -2],
  hands: [
    { user: 1, kind: 0, holding: 1, force: [0, 1, 2], segments: [kStill] },
    { user: 2, kind: 1, stale: 1, segments: Array(16).fill(kStill) as number[][] },
  ],
  ropes: [{ diameter: 0.5, points: [[0, 0, 0], [0, 1, 0]] }],
};

describe('a frame', () => {
  it('has everything that was written', () => {
    const frame = decodeFrame(frameBytes(kFull))!;
    expect(frame).toMatchObject({ sequence: 7, tick: 123_456, skipped: 3, age: 0.25 });
    expect([...frame.objects]).toEqual([2, 5]);
    expect([...frame.visible]).toEqual([1, 0]);
    expect([...frame.poses.subarray(0, 3)]).toEqual([1, 2, 3]);
    expect([...frame.quantities]).toEqual([1.5, -2]);
    expect(frame.hands.map((h) => [h.user, h.whole, h.stale, h.holding, h.segments.length])).toEqual([
      [1, false, false, true, 7],
      [2, true, true, false, 112],
    ]);
    expect([...frame.hands[0]!.force]).toEqual([0, 1, 2]);
    expect(frame.ropes[0]!.diameter).toBe(0.5);
    expect([...frame.ropes[0]!.points]).toEqual([0, 0, 0, 0, 1, 0]);
  });

  it('is refused when bytes are missing or left over, wherever', () => {
    const whole = new Uint8Array(frameBytes(kFull));
    for (let length = 0; length < whole.length; ++length) expect(decodeFrame(whole.slice(0, length).buffer)).toBeNull();
    expect(decodeFrame(new Uint8Array([...whole, 0]).buffer)).toBeNull();
  });

  it('is refused when it is of another kind or version', () => {
    for (const [at, value] of [[0, 2], [1, 2]] as const) {
      const bytes = new Uint8Array(frameBytes({}));
      bytes[at] = value;
      expect(decodeFrame(bytes.buffer)).toBeNull();
    }
  });

  it('is refused without memory for counts that cannot be', () => {
    for (const at of [32, 36, 40, 44]) {
      const bytes = frameBytes(kFull);
      new DataView(bytes).setUint32(at, 0xffff_ffff, true);
      expect(decodeFrame(bytes)).toBeNull();
    }
  });

  it('never throws, whatever byte is wrong', () => {
    const whole = new Uint8Array(frameBytes(kFull));
    for (let at = 0; at < whole.length; ++at) {
      const bytes = whole.slice();
      bytes[at] = bytes[at]! ^ 0xff;
      expect(() => decodeFrame(bytes.buffer)).not.toThrow();
    }
  });

  it('is refused when a hand has no segment', () => {
    expect(decodeFrame(frameBytes({ hands: [{ user: 1, kind: 0, segments: [] }] }))).toBeNull();
  });
});
