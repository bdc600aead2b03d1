// The part of the usual view that shows large where hands work: client-sdk/scene/step_view.cpp and workplace.cpp.
import { Box2, Box3, Matrix4, Vector2, Vector3 } from 'three';
import type { Affordance } from '../wire/messages';
import { halfTan, narrowedTo, rigid, seenBox, type Camera } from './camera';

const kLeastHalf_m = 0.3;
const kFollows_s = 0.3;
const kRemembers_s = 3;
const kForgets_s = 0.7;
const kAbove = 0.9;
const kBelow = 0.34;
const kAside = 0.5;
const kLarger = 1.2;
const kRoomy = 1.03;
const kNear = 0.1;
const kSlack = 0.02;
const kArrived = 0.0003;
const kSameDepth = 0.15;

const clamp = (x: number, low: number, high: number): number => Math.min(Math.max(x, low), high);
const approach = (from: number, to: number, s: number): number => (Math.abs(to - from) < kArrived ? to : from + s * (to - from));

/** The value nearest to `value` whose room of below and above contains [low, high]. */
function containing(value: number, low: number, high: number, below: number, above: number): number {
  return clamp(value, Math.min(high - above, low + below), Math.max(high - above, low + below));
}

/** A window of the usual view. */
interface Part {
  x: number;
  y: number;
  share: number;
  depth: number;
}

export class StepView {
  private worked = new Box2();
  private lowerSince = [0, 0];
  private upperSince = [0, 0];
  private wanted: Part = { x: 0, y: 0, share: 1, depth: 1 };
  private halfway: Part = { ...this.wanted };
  private part: Part = { ...this.wanted };
  private p: Vector3 | null = null;
  private seenAt = 0;

  /** Once a picture: where hands work, and seconds of any clock. */
  follow(work: Box3, usual: Camera, aspect: number, now: number): void {
    const first = !this.p || !this.p.equals(usual.p);
    const passed = first ? 0 : Math.max(now - this.seenAt, 0);
    const s = first ? 1 : 1 - Math.exp(-passed / kFollows_s);
    this.seenAt = now;
    const ahead = usual.target.clone().sub(usual.p);
    if (first) {
      this.wanted = { x: 0, y: 0, share: 1, depth: ahead.length() };
      this.halfway = { ...this.wanted };
      this.part = { ...this.wanted };
      this.worked.makeEmpty();
    }
    this.p = usual.p.clone();
    const seen = seenBox(usual, work);
    if (seen.isEmpty()) {
      this.wanted = { x: 0, y: 0, share: 1, depth: this.wanted.depth };
      this.worked = seen;
    } else {
      const depth = ahead.normalize().dot(work.getCenter(new Vector3()).sub(usual.p));
      if (Math.abs(depth - this.wanted.depth) > kSameDepth * depth) this.wanted.depth = depth;
      this.remember(seen, passed);
      this.wanted = this.partFor(usual, aspect);
    }
    this.halfway = go(this.halfway, this.wanted, s);
    this.part = go(this.part, this.halfway, s);
  }
  /** In place of follow() while a pointer drags something, which must stay under it. */
  hold(now: number): void {
    this.seenAt = now;
  }
  shown(usual: Camera, aspect: number): Camera {
    const { x, y, share, depth } = this.part;
    if (share === 1 && x === 0 && y === 0) return usual;
    return narrowedTo(usual, x, y, share * halfTan(usual, aspect), aspect, depth);
  }
  get isNarrow(): boolean {
    return this.part.share < 0.7;
  }

  private remember(seen: Box2, passed: number): void {
    if (this.worked.isEmpty()) this.worked = seen.clone();
    const s = 1 - Math.exp(-passed / kForgets_s);
    (['x', 'y'] as const).forEach((axis, i) => {
      const size = this.worked.max[axis] - this.worked.min[axis];
      const side = (bound: Vector2, since: number[], now: number, outwards: number): void => {
        const beyond = outwards * (now - bound[axis]);
        since[i] = beyond >= -kNear * size ? 0 : since[i]! + passed;
        if (beyond > 0) bound[axis] = now + outwards * kSlack * size;
        if (since[i]! > kRemembers_s) bound[axis] += s * (now - bound[axis]);
      };
      side(this.worked.min, this.lowerSince, seen.min[axis], -1);
      side(this.worked.max, this.upperSince, seen.max[axis], 1);
    });
  }

  private partFor(usual: Camera, aspect: number): Part {
    const part = { ...this.wanted };
    const whole = halfTan(usual, aspect);
    const size = this.worked.getSize(new Vector2());
    const least = Math.max(kLeastHalf_m / part.depth, size.y / (kAbove + kBelow), size.x / (2 * kAside * aspect));
    const needed = Math.min(least / whole, 1);
    if (part.share < needed || part.share > kLarger * needed) part.share = Math.min(kRoomy * needed, 1);
    const half = part.share * whole;
    const { min, max } = this.worked;
    const aside = kAside * aspect * half;
    part.x = containing(part.x, min.x, max.x, aside, aside);
    part.y = containing(part.y, min.y, max.y, kBelow * half, kAbove * half);
    // What the usual view does not show may come under captions and gauges, but not where hands work.
    const mostX = aspect * (whole - kAside * half);
    part.x = clamp(part.x, -mostX, mostX);
    part.y = clamp(part.y, kBelow * half - whole, whole - half);
    return part;
  }
}

function go(from: Part, to: Part, s: number): Part {
  return {
    x: approach(from.x, to.x, s),
    y: approach(from.y, to.y, s),
    share: approach(from.share, to.share, s),
    depth: approach(from.depth, to.depth, s),
  };
}

export interface WorkingHand {
  box: Box3;
  holding: boolean;
}
/** An object's pose in W and its box in its own frame. */
export interface Standing {
  X: Matrix4;
  box: Box3;
}

const kHeld_m = 0.1;
const kAroundGoal_m = 0.06;

export function isEnabled(affordance: Affordance, agents: readonly string[]): boolean {
  return affordance.agent === '' || agents.includes(affordance.agent);
}

function nearestPlace(standing: Standing, p: Vector3): Vector3 {
  return standing.box.clampPoint(p.clone().applyMatrix4(standing.X.clone().invert()), new Vector3()).applyMatrix4(standing.X);
}

/** More boxes would take long to give way to. */
const kMostSeen = 16;

export interface Workplace {
  /** Hands, what they can take, and where that belongs; what counts most first. */
  seen: Box3[];
  /** All of that, and where a crank leads a hand; empty: there is nothing to take. */
  work: Box3;
}

/** Where hands work in this step. */
export function workplace(
  hands: readonly WorkingHand[],
  affordances: readonly Affordance[],
  agents: readonly string[],
  standing: (object: number) => Standing | null,
): Workplace {
  const places: Box3[] = [];
  const arcs: Box3[] = [];
  const enabled = affordances.filter((a) => isEnabled(a, agents));
  const base = (a: Affordance): Matrix4 => (a.base == null ? new Matrix4() : (standing(a.base)?.X.clone() ?? new Matrix4()));
  const addGoals = (object: number): void => {
    for (const goal of enabled) {
      if ((goal.kind !== 'placed' && goal.kind !== 'brought') || goal.object !== object) continue;
      const p = new Vector3(...goal.AJ.slice(0, 3) as [number, number, number]).applyMatrix4(base(goal));
      places.push(new Box3(p.clone().subScalar(kAroundGoal_m), p.addScalar(kAroundGoal_m)));
    }
  };
  const addArc = (hand: WorkingHand, object: number): void => {
    const half = hand.box.getSize(new Vector3()).divideScalar(2);
    for (const joint of enabled) {
      if (joint.kind !== 'turns' || joint.object !== object) continue;
      const X = base(joint).multiply(rigid(joint.AJ));
      const p = hand.box.getCenter(new Vector3()).applyMatrix4(X.clone().invert());
      for (const turn of [-Math.PI / 2, -Math.PI / 4, Math.PI / 4, Math.PI / 2]) {
        const q = p.clone().applyAxisAngle(new Vector3(0, 0, 1), turn).applyMatrix4(X);
        arcs.push(new Box3(q.clone().sub(half), q.add(half)));
      }
    }
  };
  for (const affordance of enabled) {
    if (affordance.kind !== 'taken') continue;
    const object = standing(affordance.object);
    if (!object || object.box.isEmpty()) continue;
    if (hands.length === 0) {
      places.push(object.box.clone().applyMatrix4(object.X));
      addGoals(affordance.object);
    }
    for (const hand of hands) {
      const p = nearestPlace(object, hand.box.getCenter(new Vector3()));
      if (!hand.holding) {
        places.push(new Box3(p, p.clone()));
      } else if (hand.box.distanceToPoint(p) <= kHeld_m) {
        places.push(new Box3(p, p.clone()));
        addGoals(affordance.object);
        addArc(hand, affordance.object);
      }
    }
  }
  const seen = [...hands.map((hand) => hand.box), ...places];
  const work = new Box3();
  if (places.length > 0) for (const box of [...seen, ...arcs]) work.union(box);
  return { seen: seen.slice(0, kMostSeen), work };
}
