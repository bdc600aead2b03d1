// What an author does in a draft that is tried, as the moves of a scripted visit. Told by the frames and the events of its world; pure.
import { Quaternion, Vector3 } from 'three';
import type { Vector } from '../commands';
import { kPose, type Frame } from '../../wire/frame';
import type { Affordance, KioskState, PoseArray, WorldEvent } from '../../wire/messages';
import type { View } from '../view';
import { workedAngles, type Work } from './angles';
import type { Move } from './moves';

/** A world's ticks are of 1 ms. */
const kTick_s = 1e-3;
const kSampleEvery = 20;
/** Ten minutes of one hold, and more holds than a visitor makes. */
const kMostSamples = 30_000;
const kMostHolds = 60;
/** What was let go is where it came to rest by then: a place takes it home. */
const kSettles = 600;
const kSettlesWithin_m = 0.15;
/** In ticks. A hand that takes a crank or a slider again this soon had lost it, and did not mean to let go. */
const kBackWithin = 2000;
/** A person's hand. */
const kMost_mPerS = 0.6;
const kReach_s = 2;
const kGrasp_s = 0.6;
const kRelease_s = 0.5;
/** Less than this was no carrying. */
const kCarried_m = 0.02;
const kCarried_rad = 0.15;
/** A way is kept as straight pieces that differ from it by less than this. */
const kWay_m = 0.05;

export interface Pose {
  p: Vector3;
  q: Quaternion;
}
export interface Sample {
  tick: number;
  body: Pose;
  /** Of each hinge, in the order of the affordances; NaN: it was not to be seen. */
  angles: number[];
  /** Of what each hinge turns, in the frame of the held body. */
  turned: (Pose | null)[];
}
interface Hold {
  body: string;
  object: number;
  hand: number | null;
  from: number;
  to: number | null;
  grip: Vector | null;
  samples: Sample[];
  settled: Pose | null;
}
/** A sign that was pressed. */
interface Press {
  body: string;
  at: number;
}

const poseFrom = (a: ArrayLike<number>, at = 0): Pose =>
  ({ p: new Vector3(a[at], a[at + 1], a[at + 2]), q: new Quaternion(a[at + 3], a[at + 4], a[at + 5], a[at + 6]) });
const of = (pose: PoseArray): Pose => poseFrom(pose);
const times = (a: Pose, b: Pose): Pose => ({ p: b.p.clone().applyQuaternion(a.q).add(a.p), q: a.q.clone().multiply(b.q) });
function within(a: Pose, b: Pose): Pose {
  const back = a.q.clone().invert();
  return { p: b.p.clone().sub(a.p).applyQuaternion(back), q: back.clone().multiply(b.q) };
}
/** About z, of a hinge's second frame in its first; within half a turn. */
const angleAboutZ = ({ q }: Pose): number => 2 * (q.w < 0 ? Math.atan2(-q.z, -q.w) : Math.atan2(q.z, q.w));
const rounded = (v: Vector3, digits = 4): Vector => v.toArray().map((x) => Number(x.toFixed(digits)) + 0) as Vector;
const seconds = (ticks: number): number => Number((ticks * kTick_s).toFixed(1));

/** The axis and the angle, as X3D writes a rotation. */
export function rotationOf(q: Quaternion): [number, number, number, number] {
  const half = Math.acos(Math.min(Math.abs(q.w), 1));
  const axis = new Vector3(q.x, q.y, q.z).multiplyScalar(q.w < 0 ? -1 : 1);
  if (axis.length() < 1e-6) return [0, 1, 0, 0];
  return [...rounded(axis.normalize()), Number((2 * half).toFixed(4))];
}

/** One activity, from its beginning. A world that begins anew is recorded anew. */
export class Recorder {
  private holds: Hold[] = [];
  private presses: Press[] = [];
  private steps: number[] = [];
  private tick = 0;
  private activity = '';
  private isOn = true;
  /** Holds of further hands at the same time, and those past the limits: they are not part of the visit. */
  leftOut = 0;

  get isEmpty(): boolean {
    return this.holds.length === 0 && this.presses.length === 0;
  }
  /** Grows with what was recorded; for who shows it. */
  get count(): number {
    return this.holds.length + this.presses.length + (this.holds.at(-1)?.to != null ? 1 : 0);
  }
  clear(): void {
    this.holds = [];
    this.presses = [];
    this.steps = [];
    this.leftOut = 0;
  }
  /** Somebody else has the exhibit now: nothing is recorded until the activity begins anew. */
  stop(): void {
    this.clear();
    this.isOn = false;
  }
  enter(activity: string): void {
    if (activity !== this.activity) this.begin();
    this.activity = activity;
  }
  begin(): void {
    this.clear();
    this.isOn = true;
  }

  hear(event: WorldEvent, world: KioskState): void {
    if (event.kind === 'activity_started') this.begin();
    else if (!this.isOn) return;
    else if (event.kind === 'step_started') this.steps.push(event.tick);
    else if (event.kind === 'grasped') this.grasped(event, world);
    else if (event.kind === 'released') this.released(event);
    else if (event.kind === 'pointed' && event.object) this.presses.push({ body: event.object, at: event.tick });
  }
  private grasped({ tick, object: body }: WorldEvent, world: KioskState): void {
    const object = world.objects.find((o) => o.name === body);
    if (!object || this.open || this.holds.length >= kMostHolds) {
      this.leftOut += 1;
      return;
    }
    this.holds.push({ body, object: object.index, hand: null, from: tick, to: null, grip: null, samples: [], settled: null });
  }
  private released({ tick, object }: WorldEvent): void {
    const hold = this.open;
    if (hold?.body === object) hold.to = tick;
  }
  private get open(): Hold | undefined {
    return this.holds.find((h) => h.to === null);
  }

  see(frame: Frame, world: KioskState): void {
    if (frame.tick < this.tick) this.begin();
    this.tick = frame.tick;
    const last = this.holds.at(-1);
    if (!last || frame.tick < last.from) return;
    const poses = new Map(Array.from(frame.objects, (object, i) => [object, poseFrom(frame.poses, kPose * i)]));
    const body = poses.get(last.object);
    if (!body) return;
    if (last.to !== null) {
      if (frame.tick <= last.to + kSettles) last.settled = body;
      return;
    }
    this.takeGrip(last, frame, body);
    const newest = last.samples.at(-1)?.tick ?? -kSampleEvery;
    if (frame.tick < newest + kSampleEvery || last.samples.length >= kMostSamples) return;
    const hinges = hingesOf(world);
    const ends = hinges.map((h) => this.frames(h, poses, world));
    last.samples.push({ tick: frame.tick, body, angles: ends.map((e) => (e ? angleAboutZ(within(e.a, e.b)) : NaN)),
      turned: ends.map((e) => e && within(body, e.object)) });
  }
  private takeGrip(hold: Hold, frame: Frame, body: Pose): void {
    if (hold.grip) return;
    const hand = frame.hands.filter((h) => h.holding).map((h) => poseFrom(h.segments))
      .sort((a, b) => a.p.distanceTo(body.p) - b.p.distanceTo(body.p))[0];
    if (hand) hold.grip = rounded(within(body, hand).p);
  }
  private frames({ object, base, AJ, BJ }: Affordance, poses: Map<number, Pose>, world: KioskState):
  { a: Pose; b: Pose; object: Pose } | null {
    const at = (index: number): Pose | undefined => {
      const rest = world.objects.find((o) => o.index === index)?.pose;
      return poses.get(index) ?? (rest && of(rest));
    };
    const [moved, fixed] = [at(object), base == null ? of([0, 0, 0, 0, 0, 0, 1]) : at(base)];
    return moved && fixed ? { a: times(fixed, of(AJ)), b: times(moved, of(BJ)), object: moved } : null;
  }

  /** The visit so far. What the author thought between two moves is left out, what the exhibit did by itself is waited for. */
  moves(view: View, world: KioskState): Move[] {
    const acts = [...this.holdsIn(world), ...this.presses].sort((a, b) => startOf(a) - startOf(b));
    const out: Move[] = [];
    let free = 0;
    for (const act of acts) {
      const waited = this.stepWithin(free, startOf(act));
      if (waited > 0) out.push({ kind: 'wait', seconds: seconds(waited) });
      out.push(...('at' in act ? pressMoves(act) : holdMoves(act, view, world, this.tick)));
      free = 'at' in act ? act.at : (act.to ?? this.tick);
    }
    if (out.length > 0) out.push({ kind: 'wait', seconds: Math.max(seconds(this.stepWithin(free, Infinity)), 1) });
    return out;
  }
  /** The holds; those between which the hand lost a crank or a slider are one. */
  private holdsIn(world: KioskState): Hold[] {
    const guided = new Set(world.presentation?.affordances.filter((a) => a.kind === 'turns' || a.kind === 'slides').map((a) => a.object));
    const out: Hold[] = [];
    for (const hold of this.holds) {
      const before = out.at(-1);
      const lost = before?.to != null && before.body === hold.body && guided.has(hold.object) && hold.from - before.to <= kBackWithin &&
        this.stepWithin(before.to, hold.from) === 0 && !this.presses.some(({ at }) => at > before.to! && at < hold.from);
      if (!lost) out.push(hold);
      else out.splice(-1, 1, { ...hold, from: before.from, grip: before.grip ?? hold.grip, samples: [...before.samples, ...hold.samples] });
    }
    return out;
  }
  /** From a moment until the last step that began before another, and a little; 0: none did. */
  private stepWithin(from: number, to: number): number {
    const last = this.steps.filter((t) => t > from && t < to).at(-1);
    return last === undefined ? 0 : last - from + 500;
  }
}

const startOf = (act: Hold | Press): number => ('at' in act ? act.at : act.from);
const hingesOf = (world: KioskState): Affordance[] => world.presentation?.affordances.filter((a) => a.kind === 'turns') ?? [];

const pressMoves = ({ body }: Press): Move[] =>
  [{ kind: 'reach', body, grip: [0, 0, 0], seconds: kReach_s }, { kind: 'wait', seconds: 1 }];

function holdMoves(hold: Hold, view: View, world: KioskState, now: number): Move[] {
  const begin: Move[] = [{ kind: 'reach', body: hold.body, grip: hold.grip ?? [0, 0, 0], seconds: kReach_s },
    { kind: 'grasp', body: hold.body, seconds: kGrasp_s }];
  const end: Move[] = hold.to === null ? [] : [{ kind: 'release', seconds: kRelease_s }];
  return [...begin, ...(workMoves(hold, view, world) ?? carryMoves(hold, now)), ...end];
}

/** Null: it has turned no hinge. */
function workMoves(hold: Hold, view: View, world: KioskState): Move[] | null {
  const names = new Map(world.objects.map((o) => [o.index, o.name]));
  const hinges = hingesOf(world).map((hinge) => {
    const ends = [names.get(hinge.object) ?? '', hinge.base == null ? '' : (names.get(hinge.base) ?? '')].sort().join(' ');
    return { own: hinge.object === hold.object,
      joint: view.joints.find((j) => [j.body1, j.body2].sort().join(' ') === ends)?.def ?? '' };
  });
  let best: { joint: string; own: boolean; work: Work[]; way: number } | null = null;
  for (const [i, { joint, own }] of hinges.entries()) {
    if (joint === '' || !own && !movesWith(hold.samples, i)) continue;
    const { work, way_rad: way } = workedAngles(hold.samples.map((s) => ({ at_s: s.tick * kTick_s, angle: s.angles[i]! })));
    if (work.length > 0 && (!best || (own && !best.own) || (own === best.own && way > best.way))) best = { joint, own, work, way };
  }
  return best && best.work.map((one): Move => ({ ...one, joint: best.joint }));
}
/** What the hinge turns keeps its place in the held body's frame: the two are one. */
function movesWith(samples: readonly Sample[], hinge: number): boolean {
  const places = samples.map((s) => s.turned[hinge]).filter((pose) => pose != null);
  return places.length > 1 && places.every((p) => p.p.distanceTo(places[0]!.p) < 0.02 && p.q.angleTo(places[0]!.q) < 0.1);
}

function carryMoves(hold: Hold, now: number): Move[] {
  const way = hold.samples.map((s) => ({ tick: s.tick, ...s.body }));
  const [first, last] = [way[0], way.at(-1)];
  if (!first || !last) return [];
  if (hold.settled && hold.settled.p.distanceTo(last.p) < kSettlesWithin_m)
    way.push({ tick: last.tick, ...hold.settled });  // a place has taken it home
  const moved = way.some((s) => s.p.distanceTo(first.p) > kCarried_m || s.q.angleTo(first.q) > kCarried_rad);
  if (!moved) {
    const held = seconds((hold.to ?? now) - hold.from) - kGrasp_s;
    return held > 0.5 ? [{ kind: 'wait', seconds: Number(held.toFixed(1)) }] : [];
  }
  const kept = straightened(way.map((s) => s.p), kWay_m).map((i) => way[i]!);
  return kept.slice(1).map((to, i): Move => {
    const from = kept[i]!;
    const least = from.p.distanceTo(to.p) / kMost_mPerS;
    return { kind: 'move_to', body: hold.body, position: rounded(to.p), orientation: rotationOf(to.q),
      seconds: Number(Math.max(seconds(to.tick - from.tick), least, 0.5).toFixed(1)) };
  });
}

/** Indices of the points that a way keeps, so that it differs nowhere by more than `most` (Douglas and Peucker 1973). */
export function straightened(points: readonly Vector3[], most: number): number[] {
  const kept = new Set([0, points.length - 1]);
  const open: [number, number][] = [[0, points.length - 1]];
  for (let range = open.pop(); range; range = open.pop()) {
    const [from, to] = range;
    const along = points[to]!.clone().sub(points[from]!);
    const length2 = Math.max(along.lengthSq(), 1e-12);
    let [worst, at] = [most, -1];
    for (let i = from + 1; i < to; ++i) {
      const off = points[i]!.clone().sub(points[from]!);
      const s = Math.min(Math.max(off.dot(along) / length2, 0), 1);
      const away = off.addScaledVector(along, -s).length();
      if (away > worst) [worst, at] = [away, i];
    }
    if (at < 0) continue;
    kept.add(at);
    open.push([from, at], [at, to]);
  }
  return [...kept].sort((a, b) => a - b);
}
