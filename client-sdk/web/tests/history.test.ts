import { describe, expect, it } from 'vitest';
import { decodeFrame, type Frame } from '../src/wire/frame';
import { ClockOffset, FrameHistory, interpolate } from '../src/wire/history';
import { frameBytes, kStill } from './bytes';

const turned = (angle: number): number[] => [0, 0, 0, 0, Math.sin(angle / 2), 0, Math.cos(angle / 2)];
const at = (sequence: number, tick: number, x: number): Frame =>
  decodeFrame(frameBytes({ sequence, tick, bodies: [{ object: 0, pose: [x, 0, 0, 0, 0, 0, 1] }], quantities: [x] }))!;
const xOf = (frame: Frame | null): number => frame!.poses[0]!;

describe('between two frames', () => {
  it('places go straight and rotations the shorter way, at unit length', () => {
    const a = decodeFrame(frameBytes({ bodies: [{ object: 0, pose: turned(0) }] }))!;
    const far = turned(1.6);
    const b = decodeFrame(frameBytes({ bodies: [{ object: 0, pose: far.map((v, i) => (i < 3 ? v : -v)) }] }))!;
    const q = interpolate(a, b, 0.25).poses;
    expect(2 * Math.atan2(Math.abs(q[4]!), Math.abs(q[6]!))).toBeCloseTo(0.4, 5);
    expect(Math.hypot(q[3]!, q[4]!, q[5]!, q[6]!)).toBeCloseTo(1, 6);
  });

  it('bodies of another list are not mixed', () => {
    const a = decodeFrame(frameBytes({ bodies: [{ object: 0, pose: kStill }] }))!;
    const b = decodeFrame(frameBytes({ bodies: [{ object: 1, pose: [4, 0, 0, 0, 0, 0, 1] }] }))!;
    expect(xOf(interpolate(a, b, 0.5))).toBe(4);
  });

  it('a hand goes on from the same hand, and a new one stands where it is', () => {
    const hand = (user: number, x: number): Parameters<typeof frameBytes>[0] => ({
      hands: [{ user, kind: 0, segments: [[x, 0, 0, 0, 0, 0, 1]] }],
    });
    const a = decodeFrame(frameBytes(hand(1, 0)))!;
    expect(interpolate(a, decodeFrame(frameBytes(hand(1, 2)))!, 0.5).hands[0]!.segments[0]).toBe(1);
    expect(interpolate(a, decodeFrame(frameBytes(hand(2, 2)))!, 0.5).hands[0]!.segments[0]).toBe(2);
  });
});

describe('the history', () => {
  it('shows the world between frames, with jitter on the way', () => {
    const history = new FrameHistory();
    [0, 4, 1, 9, 0].forEach((late, i) => history.add(at(i + 1, 33 * i, i), 1000 + 33 * i + late));
    expect(xOf(history.at(1000 + 33 * 1.5))).toBeCloseTo(1.5, 2);
  });

  it('goes on for a moment after the last frame, and then stands', () => {
    const history = new FrameHistory();
    history.add(at(1, 0, 0), 1000);
    history.add(at(2, 33, 1), 1033);
    expect(xOf(history.at(1033 + 33))).toBeCloseTo(2, 5);
    expect(xOf(history.at(9000))).toBeCloseTo(1 + 50 / 33, 5);
  });

  it('leaves out what came too late', () => {
    const history = new FrameHistory();
    history.add(at(2, 33, 1), 1033);
    history.add(at(1, 0, 0), 1040);
    expect(xOf(history.at(0))).toBe(1);
  });

  it('follows a clock that was set anew', () => {
    const clock = new ClockOffset();
    expect(clock.toLocal(0, 100)).toBe(100);
    expect(clock.toLocal(10, 90)).toBe(90);
    expect(clock.toLocal(0, 5000)).toBe(5000);
  });
});
