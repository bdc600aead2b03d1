import { Quaternion, Vector3 } from 'three';
import { expect, it } from 'vitest';
import { unwrapped, workedAngles } from '../src/studio/visits/angles';
import { visitCommands, visitsOf, withMistakes, type Move } from '../src/studio/visits/moves';
import { Recorder, rotationOf, straightened } from '../src/studio/visits/recorder';
import { visitWords } from '../src/studio/visits/words';
import { viewOf } from '../src/studio/view';
import type { Frame } from '../src/wire/frame';
import { kNothingKnown, reduce, type KioskState } from '../src/wire/messages';

const kTurn = 2 * Math.PI;
const about = (axis: [number, number, number], angle: number): Quaternion => new Quaternion().setFromAxisAngle(new Vector3(...axis), angle);
const view = viewOf({ joints: [{ def: 'AXLE', type: 'SingleAxisHingeJoint', body1: 'POST', body2: 'CRANK' },
  { def: 'OTHER', type: 'SingleAxisHingeJoint', body1: 'POST', body2: 'WHEEL' }],
metadata: { name: 'mechane:scenario', kind: 'set', children: [{ name: 'visits', kind: 'set', children: [
  { name: 'old', kind: 'set', children: [{ name: 'activity', kind: 'value', value: 'use' }] },
  { name: 'else', kind: 'set', children: [{ name: 'activity', kind: 'value', value: 'build' }] }] }] } });
const thing = (index: number, name: string, pose = [0, 1, 0, 0, 0, 0, 1]): object => ({ index, name, pose, movable: true });
// The hinge's z is the world's x.
const kZIsX = [0, Math.SQRT1_2, 0, Math.SQRT1_2];
const hinge = (object: number): object => ({ kind: 'turns', agent: '', object, base: 0, AJ: [0, 0, 0, ...kZIsX], BJ: [0, 0, 0, ...kZIsX] });
const world: KioskState = [
  { type: 'world', world: 'w', activity: 'use' },
  { type: 'scene', objects: [thing(0, 'POST'), thing(1, 'CRANK'), thing(2, 'BOX', [0.5, 0, 0, 0, 0, 0, 1]), thing(3, 'WHEEL')] },
  { type: 'presentation', world: 'w', affordances: [hinge(1), hinge(3)] },
].reduce((state, message) => reduce(state, message), kNothingKnown);

interface Moved {
  object: number;
  p: number[];
  q?: Quaternion;
}
function frameAt(tick: number, moved: Moved[], hand: number[] | null): Frame {
  const poses = moved.flatMap(({ p, q = new Quaternion() }) => [...p, q.x, q.y, q.z, q.w]);
  return {
    tick, sequence: tick, skipped: 0, age: 0, objects: Uint32Array.from(moved.map((m) => m.object)), visible: new Uint8Array(moved.length),
    poses: Float32Array.from(poses), quantities: new Float32Array(0), ropes: [],
    hands: hand ? [{ user: 0, whole: false, stale: false, holding: true, force: new Float32Array(3),
      segments: Float32Array.from([...hand, 0, 0, 0, 1]) }] : [],
  };
}
const event = (kind: string, tick: number, object = ''): Parameters<Recorder['hear']>[0] =>
  ({ kind, tick, subject: 'k/0', object, value: 0 });

/** A hand takes a thing at `from`, moves it by `at`, and lets go after `lasts`. */
function hold(recorder: Recorder, body: string, from: number, lasts: number, at: (s: number) => { moved: Moved[]; hand: number[] }): void {
  recorder.hear(event('grasped', from, body), world);
  for (let t = 0; t <= lasts; t += 10) {
    const { moved, hand } = at(t / 1000);
    recorder.see(frameAt(from + t, moved, hand), world);
  }
  recorder.hear(event('released', from + lasts, body), world);
}
const crankAt = (angle: number): { moved: Moved[]; hand: number[] } => ({
  moved: [{ object: 1, p: [0, 1, 0], q: about([1, 0, 0], angle) }],
  hand: new Vector3(0.1, 0.25, 0).applyQuaternion(about([1, 0, 0], angle)).add(new Vector3(0, 1, 0)).toArray(),
});

it('angles go on over whole turns', () => {
  for (const rate of [-9, -1, 0.3, 6]) {
    const wanted = Array.from({ length: 400 }, (_, i) => rate * i * 0.02);
    const seen = wanted.map((a) => Math.atan2(Math.sin(a), Math.cos(a)));
    unwrapped(seen).forEach((a, i) => expect(a).toBeCloseTo(wanted[i]!, 6));
  }
});

it('a crank that was turned is turned as far by the visit, whichever way, and pauses do not slow it', () => {
  for (const [turns, rate] of [[2.5, 15], [-0.7, 8], [0.06, 10], [12, 30]] as const) {
    const recorder = new Recorder();
    const lasts = Math.ceil((Math.abs(turns) / rate) * 60_000 / 10) * 10;
    const rest = 3000;
    const angle = (s: number): number => kTurn * turns * Math.min(Math.max(s * 1000 < lasts / 2 ? s * 1000 : s * 1000 - rest,
      Math.min(s * 1000, lasts / 2)) / lasts, 1);
    hold(recorder, 'CRANK', 1000, lasts + rest, (s) => crankAt(angle(s)));
    const moves = recorder.moves(view, world);
    expect(moves.map((m) => m.kind)).toEqual(['reach', 'grasp', 'turn', 'release', 'wait']);
    const [reach, , turn] = moves as [Extract<Move, { kind: 'reach' }>, Move, Extract<Move, { kind: 'turn' }>];
    reach.grip.forEach((x, i) => expect(x).toBeCloseTo([0.1, 0.25, 0][i]!, 3));
    expect(turn.joint).toBe('AXLE');
    expect(turn.turns).toBeCloseTo(turns, 1);
    expect(turn.rpm / rate).toBeGreaterThan(0.85);
    expect(turn.rpm / rate).toBeLessThan(1.2);
  }
});

it('a crank that the hand has lost and has back at once was worked once, unless a step ended meanwhile', () => {
  const turned = (recorder: Recorder): string[] =>
    recorder.moves(view, world).map((m) => (m.kind === 'turn' ? `${m.kind} ${m.turns.toFixed(1)}` : m.kind));
  const record = (gap: number, step: boolean): string[] => {
    const recorder = new Recorder();
    for (let i = 0; i < 20; ++i) {
      const from = 1000 + i * (200 + gap);
      hold(recorder, 'CRANK', from, 200, (s) => crankAt(kTurn * 0.05 * (i + s / 0.2)));  // each a twentieth of a turn
      if (step && i === 9) recorder.hear(event('step_started', from + 250), world);
    }
    return turned(recorder);
  };
  expect(record(300, false)).toEqual(['reach', 'grasp', 'turn 1.0', 'release', 'wait']);
  expect(record(300, true)).toEqual(['reach', 'grasp', 'turn 0.5', 'release', 'wait', 'reach', 'grasp', 'turn 0.5', 'release', 'wait']);
  expect(record(2500, false).filter((move) => move === 'grasp').length).toBe(20);
});

it('to and fro is a swing, there and back are two turns', () => {
  const swung = Array.from({ length: 1000 }, (_, i) => ({ at_s: i * 0.01, angle: -0.5 * Math.sin(kTurn * 0.6 * i * 0.01) }));
  const { work: [swing] } = workedAngles(swung);
  expect(swing).toMatchObject({ kind: 'swing' });
  if (swing?.kind !== 'swing') throw new Error('no swing');
  expect(swing.angle).toBeCloseTo(-0.5, 1);
  expect(swing.cycles).toBeGreaterThan(5);
  expect(swing.perMinute / 36).toBeCloseTo(1, 1);
  const back = Array.from({ length: 400 }, (_, i) => ({ at_s: i * 0.01, angle: i < 200 ? i * 0.01 : 4 - i * 0.01 }));
  expect(workedAngles(back).work.map((w) => w.kind === 'turn' && Math.sign(w.turns))).toEqual([1, -1]);
  expect(workedAngles([]).work).toEqual([]);
  expect(workedAngles([{ at_s: 0, angle: NaN }, { at_s: 1, angle: 0.01 }]).work).toEqual([]);
});

it('what hangs together with what is held turns its hinge', () => {
  const recorder = new Recorder();
  hold(recorder, 'BOX', 0, 4000, (s) => {
    const q = about([1, 0, 0], s);
    return { moved: [{ object: 2, p: new Vector3(0, 0.3, 0).applyQuaternion(q).add(new Vector3(0, 1, 0)).toArray(), q },
      { object: 3, p: [0, 1, 0], q }], hand: [0, 1, 0] };
  });
  expect(recorder.moves(view, world)[2]).toMatchObject({ kind: 'turn', joint: 'OTHER' });
});

it('a thing that was carried round a corner goes round it, to where its place has taken it', () => {
  const recorder = new Recorder();
  const way = (s: number): number[] => (s < 1 ? [0.5, s, 0] : [0.5 - (s - 1), 1, 0]);
  hold(recorder, 'BOX', 500, 2000, (s) => ({ moved: [{ object: 2, p: way(s) }], hand: way(s) }));
  recorder.see(frameAt(2900, [{ object: 2, p: [-0.52, 0.98, 0] }], null), world);
  recorder.see(frameAt(9000, [{ object: 2, p: [-5, -5, 0] }], null), world);
  const moves = recorder.moves(view, world);
  expect(moves.map((m) => m.kind)).toEqual(['reach', 'grasp', 'move_to', 'move_to', 'release', 'wait']);
  const places = moves.flatMap((m) => (m.kind === 'move_to' ? [m.position] : []));
  [[0.5, 1, 0], [-0.52, 0.98, 0]].forEach((p, i) => p.forEach((x, k) => expect(places[i]![k]).toBeCloseTo(x, 1)));
  moves.forEach((m) => 'seconds' in m && expect(m.seconds).toBeGreaterThan(0.4));
});

it('thinking is left out, what the exhibit does by itself is waited for', () => {
  const recorder = new Recorder();
  const still = { moved: [{ object: 2, p: [0.5, 0, 0] }], hand: [0.5, 0.1, 0] };
  recorder.hear(event('pointed', 500, 'WHEEL'), world);
  hold(recorder, 'BOX', 30_000, 1000, () => still);
  recorder.hear(event('step_started', 34_000), world);
  hold(recorder, 'BOX', 60_000, 3000, () => still);
  const moves = recorder.moves(view, world);
  expect(moves.map((m) => m.kind).join(' ')).toBe('reach wait reach grasp release wait reach grasp wait release wait');
  expect(moves[5]).toEqual({ kind: 'wait', seconds: 3.5 });
});

it('begins anew with the activity, leaves a second hand out, and rests while somebody else is there', () => {
  const recorder = new Recorder();
  const still = { moved: [{ object: 2, p: [0.5, 0, 0] }], hand: [0.5, 0.1, 0] };
  recorder.hear(event('grasped', 10, 'BOX'), world);
  recorder.hear(event('grasped', 20, 'CRANK'), world);
  expect([recorder.leftOut, recorder.isEmpty]).toEqual([1, false]);
  recorder.hear(event('activity_started', 30), world);
  expect([recorder.leftOut, recorder.isEmpty]).toEqual([0, true]);
  hold(recorder, 'BOX', 100, 100, () => still);
  recorder.see(frameAt(5, [], null), world);
  expect(recorder.isEmpty).toBe(true);
  recorder.stop();
  hold(recorder, 'BOX', 10, 100, () => still);
  expect(recorder.moves(view, world)).toEqual([]);
  recorder.hear(event('activity_started', 500), world);
  hold(recorder, 'BOX', 600, 100, () => still);
  expect(recorder.isEmpty).toBe(false);
  recorder.hear(event('grasped', 900, 'NOBODY'), world);
  expect(recorder.leftOut).toBe(1);
});

it('a rotation is written as X3D writes it', () => {
  expect(rotationOf(new Quaternion())).toEqual([0, 1, 0, 0]);
  for (const [x, y, z, angle] of [[1, 0, 0, 0.4], [0, 0.6, 0.8, 3], [0, 0, -1, 1]] as const) {
    const q = about([x, y, z], angle);
    for (const one of [q, new Quaternion(-q.x, -q.y, -q.z, -q.w)])
      rotationOf(one).forEach((v, i) => expect(v).toBeCloseTo([x, y, z, angle][i]!, 3));
  }
});

it('a way differs from its straight pieces by no more than it may', () => {
  for (let seed = 1; seed < 20; ++seed) {
    const points = Array.from({ length: 60 }, (_, i) => new Vector3(i * 0.05, Math.sin(seed * i * 0.07), Math.cos(seed + i * 0.11)));
    const kept = straightened(points, 0.05);
    expect([kept[0], kept.at(-1)]).toEqual([0, 59]);
    kept.slice(1).forEach((to, k) => {
      const [a, b] = [points[kept[k]!]!, points[to]!];
      for (let i = kept[k]!; i <= to; ++i) {
        const along = b.clone().sub(a);
        const s = Math.min(Math.max(points[i]!.clone().sub(a).dot(along) / along.lengthSq(), 0), 1);
        expect(a.clone().addScaledVector(along, s).distanceTo(points[i]!)).toBeLessThanOrEqual(0.05 + 1e-9);
      }
    });
  }
});

const kMoves: Move[] = [
  { kind: 'reach', body: 'CRANK', grip: [0, 0.25, 0], seconds: 2 }, { kind: 'grasp', body: 'CRANK', seconds: 0.6 },
  { kind: 'turn', joint: 'AXLE', turns: 2, rpm: 20 }, { kind: 'release', seconds: 0.5 },
];
it('a visit is written move by move, in the place of one of its name', () => {
  expect(visitsOf(view, 'use')).toEqual(['old']);
  const fresh = visitCommands(view, 'shown', 'use', kMoves)!;
  expect(fresh[0]).toEqual({ op: 'set', path: 'visits/shown/activity', value: 'use' });
  expect(fresh).toContainEqual({ op: 'set', path: 'visits/shown/move:3/turns', value: 2 });
  expect(fresh).toContainEqual({ op: 'set', path: 'visits/shown/move:1/grip', value: [0, 0.25, 0] });
  expect(visitCommands(view, 'old', 'use', kMoves)![0]).toEqual({ op: 'remove', path: 'visits/old' });
  expect(visitCommands(view, 'long', 'use', Array.from({ length: 300 }, () => kMoves[3]!))).toBeNull();
});

it('who makes mistakes has turned as far in the end', () => {
  const wrong = withMistakes(kMoves);
  const turns = wrong.flatMap((m) => (m.kind === 'turn' ? [m.turns] : []));
  expect(turns.length).toBe(3);
  expect(Math.min(...turns)).toBeLessThan(0);
  expect(turns.reduce((sum, t) => sum + t, 0)).toBeCloseTo(2, 6);
  expect(wrong.filter((m) => m.kind === 'grasp').length).toBe(2);
  const carry: Move[] = [kMoves[0]!, kMoves[1]!,
    { kind: 'move_to', body: 'CRANK', position: [0, 0, 0], orientation: [0, 1, 0, 0], seconds: 1 }];
  expect(withMistakes(carry).map((m) => m.kind)).toEqual(['reach', 'grasp', 'wait', 'release', 'wait', 'reach', 'grasp', 'move_to']);
});

it('every move is told in both languages', () => {
  const all: Move[] = [...kMoves, { kind: 'wait', seconds: 1 }, { kind: 'swing', joint: 'AXLE', angle: 0.3, cycles: 4, perMinute: 30 },
    { kind: 'move_to', body: 'BOX', position: [0, 1, 2], orientation: [0, 1, 0, 0], seconds: 1 }];
  for (const language of ['el', 'en'] as const)
    for (const move of all) expect(visitWords(language).move(move)).not.toMatch(/undefined|NaN|^$/);
});
