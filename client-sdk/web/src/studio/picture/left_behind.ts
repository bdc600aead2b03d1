// Joints of bodies that an edit moves. Where all that a joint connects moves alike, it goes along; the others stay, and can be taken along.
import type { Vector3 } from 'three';
import { quaternion, vector } from '../../scene/camera';
import type { PoseArray } from '../../wire/messages';
import { written, type Command } from '../commands';
import { outlineAt, type View } from '../view';
import { markOfJoint, neat, type JointMark } from './joint';

export interface JointsOfMoved {
  /** Commands for the step that moves the bodies. */
  together: Command[];
  left: { def: string; commands: Command[] }[];
}
interface Place {
  at: Vector3;
  axis: Vector3;
}
/** Poses that a drag wrote are rounded, so bodies that move alike do so to within this, in m, and as a share of an axis. */
const kAlike = 1e-4;
const kMoved = 1e-6;

const placeOf = ({ at, axis }: JointMark): Place => ({ at: vector(at), axis: vector(axis) });
const areNear = (one: Place, other: Place): boolean =>
  one.at.distanceTo(other.at) < kAlike && one.axis.distanceTo(other.axis) < kAlike * one.axis.length();

/** Where a joint would be if a body took it along. */
function carried({ at, axis }: Place, from: PoseArray, to: PoseArray): Place {
  const turn = quaternion(to).multiply(quaternion(from).invert());
  return { at: at.clone().sub(vector(from)).applyQuaternion(turn).add(vector(to)), axis: axis.clone().applyQuaternion(turn) };
}

function commandsTo(def: string, kind: JointMark['kind'], from: Place, to: Place): Command[] {
  const field = (name: string, before: Vector3, after: Vector3): Command[] => (before.distanceTo(after) < kMoved ? []
    : [{ op: 'field', node: def, field: name, value: neat(after).map(written).join(' ') }]);
  const point = kind === 'slider' ? [] : field('anchorPoint', from.at, to.at);
  return kind === 'ball' ? point : [...point, ...field('axis', from.axis, to.axis)];
}

export function jointsOfMoved(view: View, commands: readonly Command[]): JointsOfMoved {
  const moves = new Map(commands.flatMap((c) => (c.op === 'move' ? [[c.node, c.pose] as const] : [])));
  const out: JointsOfMoved = { together: [], left: [] };
  for (const { def, body1, body2 } of moves.size > 0 ? view.joints : []) {
    const mark = markOfJoint(view, def);
    if (!mark) continue;
    const here = placeOf(mark);
    const ends = [body1, body2].map((body) => {
      const [from, to] = [outlineAt(view, body)?.pose, moves.get(body)];
      return from && to ? carried(here, from, to) : null;
    });
    const along = ends[0] ?? ends[1];
    const follow = along ? commandsTo(def, mark.kind, here, along) : [];
    if (!along || follow.length === 0) continue;
    if (ends.every((end) => end !== null && areNear(end, along))) out.together.push(...follow);
    else out.left.push({ def, commands: follow });
  }
  return out;
}
