import { expect, it } from 'vitest';
import { lastNotAfter, Player, Tape } from '../src/playback/tape';
import { TapeWriter } from '../src/playback/tape_writer';
import { frameBytes } from './bytes';

/** A tape as STREAM.md has it. */
function tapeOf(parts: (object | { frame: ArrayBuffer })[]): ArrayBuffer {
  const chunks = parts.map((part) => {
    const payload = 'frame' in part ? new Uint8Array(part.frame as ArrayBuffer) : new TextEncoder().encode(JSON.stringify(part));
    const chunk = new Uint8Array(8 + 4 * Math.ceil(payload.length / 4));
    new DataView(chunk.buffer).setUint32(0, 'frame' in part ? 2 : 1, true);
    new DataView(chunk.buffer).setUint32(4, payload.length, true);
    chunk.set(payload, 8);
    return chunk;
  });
  const all = new Uint8Array(chunks.reduce((sum, c) => sum + c.length, 0));
  chunks.reduce((at, c) => (all.set(c, at), at + c.length), 0);
  return all.buffer;
}
const world = (step: string, caption: string): object =>
  ({ type: 'world', world: 'w', scenario: 's', activity: 'use', step, agents: [], quantities: [],
    caption: { en: caption }, title: { en: 'Screw' } });
const frame = (tick: number, x: number): { frame: ArrayBuffer } =>
  ({ frame: frameBytes({ sequence: tick, tick, bodies: [{ object: 0, pose: [x, 0, 0, 0, 0, 0, 1] }] }) });
const scene = { type: 'scene', objects: [{ index: 0, name: 'A', movable: true, pose: [0, 0, 0, 0, 0, 0, 1] }] };
const parts: (object | { frame: ArrayBuffer })[] = [world('take', 'Take it'), scene, frame(5000, 0), frame(5100, 1),
  world('turn', 'Turn it'), frame(5200, 2), frame(7200, 10)];

it('shows the world at any moment, forwards and backwards', () => {
  const tape = new Tape(tapeOf(parts));
  const x = (at: number): number => tape.frameAt(at)!.poses[0]!;
  expect(tape.duration).toBeCloseTo(2.2);
  expect(x(0)).toBe(0);
  expect(x(0.15)).toBeCloseTo(1.5);
  expect(x(0.05)).toBeCloseTo(0.5);
  expect(x(1)).toBe(2);
  expect(x(99)).toBe(10);
  expect(x(-1)).toBe(0);
});

it('knows the steps, what is said in them, and the state before and after', () => {
  const tape = new Tape(tapeOf(parts));
  expect(tape.steps).toEqual([{ at: 0, step: 'take' }, { at: 0.2, step: 'turn' }]);
  expect(tape.wordsAt(0.1, 'el')).toEqual({ title: 'Screw', caption: 'Take it' });
  expect(tape.wordsAt(0.2, 'en').caption).toBe('Turn it');
  expect(tape.stateAt(0.1).world?.step).toBe('take');
  expect(tape.stateAt(0.3).objects).toHaveLength(1);
  expect(tape.stateAt(0.3)).toBe(tape.stateAt(2));
  expect(tape.languages).toEqual(['en']);
});

it('is written as it is read: each tick once, and no more than it may have', () => {
  const write = (writer: TapeWriter): TapeWriter => {
    for (const part of parts) {
      if ('frame' in part && part.frame instanceof ArrayBuffer)
        writer.frame(Number(new DataView(part.frame).getBigUint64(16, true)), part.frame);
      else writer.text(JSON.stringify(part));
    }
    return writer;
  };
  const writer = write(new TapeWriter());
  const bytes = new Uint8Array(writer.bytes());
  expect(bytes).toEqual(new Uint8Array(tapeOf(parts)));
  const last = frame(7200, 11).frame;
  writer.frame(7200, last);
  expect([writer.bytes().byteLength, writer.full, writer.isLong]).toEqual([bytes.length, false, true]);
  const short = write(new TapeWriter(bytes.length - 1));
  expect(short.full).toBe(true);
  expect(new Tape(short.bytes()).duration).toBeCloseTo(0.2);
  short.clear();
  expect([short.isLong, short.full, short.bytes().byteLength]).toEqual([false, false, 0]);
});

it('what is no tape, or half of one, is refused', () => {
  const whole = tapeOf(parts);
  expect(() => new Tape(new ArrayBuffer(0))).toThrow(RangeError);
  expect(() => new Tape(whole.slice(0, whole.byteLength - 8))).toThrow(RangeError);
  expect(() => new Tape(whole.slice(4))).toThrow(RangeError);
  expect(() => new Tape(tapeOf([world('take', ''), frame(1, 0)]))).toThrow(RangeError);
});

it('a player keeps within its tape, at its speed, and stops at the end', () => {
  const player = new Player(10);
  player.pass(1);
  expect(player.at).toBe(0);
  player.toggle();
  player.speed = 4;
  player.pass(0.1);
  expect(player.at).toBeCloseTo(0.4);
  player.pass(60);
  expect(player.at, 'a page that slept does not jump').toBeCloseTo(1.4);
  player.seek(99);
  player.pass(0.1);
  expect([player.at, player.playing]).toEqual([10, false]);
  player.toggle();
  expect([player.at, player.playing]).toEqual([0, true]);
});

it('finds the last entry that is not later', () => {
  const entries = [0, 1, 1, 3].map((at) => ({ at }));
  expect([-1, 0, 0.5, 1, 2, 3, 9].map((at) => lastNotAfter(entries, at))).toEqual([-1, 0, 0, 2, 2, 3, 3]);
});
