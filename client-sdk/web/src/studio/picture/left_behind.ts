// Joints of bodies that an edit moves: those whose bodies all move alike go with them; the others stay, and can be taken along.
import { Quaternion, Vector3 } from 'three';
import type { PoseArray } from '../../wire/messages';
import { tidy, written, type Command } from '../commands';
import { outlineAt, type NodeFields, type View } from '../view';
import { markOfJoint } from './joint';

export interface JointsOfMoved {
  /** Belong into the same step. */
  together: Command[];
  left: { def: string; commands: Command[] }[];
}

/** Where a body's motion takes a joint's point and axis; null: nowhere else. */
function carried(view: View, joint: NodeFields, body: string, to: PoseArray): Command[] | null {
  const from = outlineAt(view, body)?.pose;
  const mark = markOfJoint(view, joint.def);
  if (!from || !mark) return null;
  const rotation = ([, , , x, y, z, w]: PoseArray): Quaternion => new Quaternion(x, y, z, w).normalize();
  const turn = rotation(to).multiply(rotation(from).invert());
  const axis = new Vector3(...mark.axis).applyQuaternion(turn);
  const at = new Vector3(...mark.at).sub(new Vector3(from[0], from[1], from[2])).applyQuaternion(turn).add(new Vector3(to[0], to[1], to[2]));
  const out: Command[] = [];
  for (const [field, now, then, has] of [['anchorPoint', mark.at, at, mark.kind !== 'slider'], ['axis', mark.axis, axis, mark.kind !== 'ball']] as const)
    if (has && then.distanceTo(new Vector3(...now)) > 1e-6)
      out.push({ op: 'field', node: joint.def, field, value: tidy([...then.toArray(), 0, 0, 0, 1]).slice(0, 3).map(written).join(' ') });
  return out.length > 0 ? out : null;
}

export function jointsOfMoved(view: View, commands: readonly Command[]): JointsOfMoved {
  const moves = new Map(commands.flatMap((c) => (c.op === 'move' ? [[c.node, c.pose] as const] : [])));
  const out: JointsOfMoved = { together: [], left: [] };
  for (const joint of moves.size > 0 ? view.joints : []) {
    const ends = [joint.body1, joint.body2].map((body) => {
      const to = moves.get(body);
      return to ? carried(view, joint, body, to) : null;
    });
    const along = ends[0] ?? ends[1];
    if (!along) continue;
    if (JSON.stringify(ends[0]) === JSON.stringify(ends[1])) out.together.push(...along);
    else out.left.push({ def: joint.def, commands: along });
  }
  return out;
}
