// A joint in the making, and joints as the picture shows them. Points and axes are in W, as the exhibit stands at the start.
import { Quaternion, Vector3 } from 'three';
import type { PoseArray } from '../../wire/messages';
import { isFreeName, numbersFrom, type Command, type JointKind, type Vector } from '../commands';
import { outlineAt, type View } from '../view';

export type AxisFrame = 'world' | 'own';
export const kAxes = ['x', 'y', 'z'] as const;
export const kJointKinds: readonly JointKind[] = ['hinge', 'slider', 'ball'];
const kNodes: Record<string, JointKind> = { SingleAxisHingeJoint: 'hinge', SliderJoint: 'slider', BallJoint: 'ball' };
const kStops = { hinge: ['minAngle', 'maxAngle'], slider: ['minSeparation', 'maxSeparation'] } as const;

/** What an author has chosen of it so far. */
export interface JointPlan {
  kind: JointKind;
  /** A body that is not fixed; "": none yet. */
  moves: string;
  /** "": the room. */
  against: string;
  frame: AxisFrame;
  axis: (typeof kAxes)[number];
  /** As typed. */
  anchor: string;
  stops: [string, string];
  name: string;
}
/** What is drawn of a joint. */
export interface JointMark {
  kind: JointKind;
  at: Vector;
  axis: Vector;
}

export const newPlan = (view: View, moves: string): JointPlan =>
  ({ kind: 'hinge', moves, against: '', frame: 'world', axis: 'z', anchor: '', stops: ['', ''], name: freeJointName(view) });

export function freeJointName(view: View): string {
  for (let n = 1; ; ++n) if (isFreeName(view, 'agents', `JOINT_${n}`)) return `JOINT_${n}`;
}
export const movableBodies = (view: View): string[] => view.bodies.map((b) => b.def).filter((def) => outlineAt(view, def)?.movable);

const three = (numbers: readonly number[] | null): Vector | null => (numbers?.length === 3 ? (numbers as Vector) : null);
export const neat = (v: Vector3): Vector => v.toArray().map((x) => Number(x.toFixed(7)) + 0) as Vector;

export function axisOf(plan: JointPlan, pose: PoseArray | null): Vector {
  const along = new Vector3(...kAxes.map((axis) => (axis === plan.axis ? 1 : 0)));
  if (plan.frame === 'own' && pose) along.applyQuaternion(new Quaternion(pose[3], pose[4], pose[5], pose[6]));
  return neat(along);
}

/** Null: its point is not given yet. A slider is drawn where what moves is. */
export function markOfPlan(view: View, plan: JointPlan): JointMark | null {
  const pose = outlineAt(view, plan.moves)?.pose ?? null;
  const at = three(plan.kind === 'slider' && plan.anchor === '' ? (pose?.slice(0, 3) ?? null) : numbersFrom(plan.anchor));
  return at && { kind: plan.kind, at, axis: axisOf(plan, pose) };
}

/** Null: the draft has no such joint, or the picture cannot show its kind. */
export function markOfJoint(view: View, def: string): JointMark | null {
  const joint = view.joints.find((j) => j.def === def);
  const kind = kNodes[joint?.type ?? ''];
  if (!joint || !kind) return null;
  const read = (field: string): Vector | null => three(numbersFrom(joint.fields[field] ?? ''));
  const moves = outlineAt(view, joint.body2 || joint.body1)?.pose ?? null;
  const at = kind === 'slider' ? three(moves?.slice(0, 3) ?? null) : (read('anchorPoint') ?? [0, 0, 0]);
  return at && { kind, at, axis: read('axis') ?? [0, 1, 0] };
}

/** What is wrong with what was typed as stops: they go together, or not at all. */
export function stopsOf({ kind, stops }: JointPlan): { fields: [string, number][] } | null {
  if (kind === 'ball' || stops.every((s) => s.trim() === '')) return { fields: [] };
  const numbers = numbersFrom(stops.join(' '));
  if (!numbers || numbers.length !== 2 || numbers[0]! > numbers[1]!) return null;
  const unit = kind === 'hinge' ? Math.PI / 180 : 1;
  return { fields: numbers.map((n, i) => [kStops[kind][i]!, Number((n * unit).toFixed(6))]) };
}

/** One step: the joint with its stops. Null: something is missing or wrong. */
export function joinCommands(view: View, plan: JointPlan): Command[] | null {
  const stops = stopsOf(plan);
  const anchor = three(numbersFrom(plan.anchor));
  if (plan.moves === '' || plan.moves === plan.against || !stops || (plan.kind !== 'slider' && !anchor)) return null;
  const bodies = plan.against === '' ? { body1: plan.moves } : { body1: plan.against, body2: plan.moves };
  return [
    { op: 'join', kind: plan.kind, ...bodies, ...(plan.kind !== 'slider' && { anchor: anchor! }),
      ...(plan.kind !== 'ball' && { axis: axisOf(plan, outlineAt(view, plan.moves)?.pose ?? null) }), name: plan.name },
    ...stops.fields.map(([field, value]): Command => ({ op: 'field', node: plan.name, field, value: String(value) })),
  ];
}
