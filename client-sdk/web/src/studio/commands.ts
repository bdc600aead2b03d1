// Edits of a draft as the gateway takes them: each is one undoable step.
import type { PoseArray } from '../wire/messages';
import { child, metaAt, stringsAt, type Value, type View } from './view';

export type Command =
  | { op: 'set'; path: string; value: Value }
  | { op: 'add'; path: string; after?: string }
  | { op: 'reorder'; path: string; after?: string }
  | { op: 'remove'; path: string }
  | { op: 'field'; node: string; field: string; value: string }
  | { op: 'rename'; kind: RenameKind; from: string; to: string }
  | { op: 'insert'; part: string; position: Vector }
  | { op: 'insert'; url: string; node: string; mass: number; name: string; position: Vector }
  | { op: 'duplicate'; node: string }
  | { op: 'delete'; node: string }
  | { op: 'move'; node: string; pose: PoseArray }
  | { op: 'join'; kind: JointKind; body1: string; body2?: string; anchor?: Vector; axis?: Vector; name: string }
  | { op: 'view'; pose: PoseArray; fieldOfView: number }
  | { op: 'meta'; name: string; value: string };
export type Vector = [number, number, number];
export type JointKind = 'hinge' | 'slider' | 'ball';
export type RenameKind = 'thing' | 'quantity' | 'activity' | 'step' | 'visit' | 'effect';

export interface Edit {
  /** Where what is wrong with it is shown: a field's path, or "" for the whole page. */
  id: string;
  /** In words, for the author. */
  what: string;
  commands: Command[];
}

/** Numbers as a person writes them: "0,5" is 0.5; blanks or ';' between. Null: something is not a number. */
export function numbersFrom(written: string): number[] | null {
  const tokens = written.trim().split(/[\s;]+/).filter((t) => t !== '');
  const numbers = tokens.map((t) => (/^[-+]?(\d+([.,]\d*)?|[.,]\d+)(e[-+]?\d+)?$/i.test(t) ? Number(t.replace(',', '.')) : NaN));
  return tokens.length > 0 && numbers.every(Number.isFinite) ? numbers : null;
}
/** Tenths of a millimetre, and of what the eye sees of a turn. */
export const tidy = (pose: PoseArray): PoseArray => pose.map((x, i) => Number(x.toFixed(i < 3 ? 5 : 7))) as PoseArray;
/** Six digits are more than a maker of exhibits measures. */
export const written = (n: number): string => String(Number(n.toPrecision(6)));

/** Words of visitors; none: the value goes, where there was one. */
export function wordsCommand(view: View, path: string, words: string): Command[] {
  if (words.trim() !== '') return [{ op: 'set', path, value: words.trim() }];
  return metaAt(view, path) ? [{ op: 'remove', path }] : [];
}

export type Switch = 'on' | 'off' | 'same';

/** Switches an agent where a step begins, or leaves it as it was before. */
export function switchCommands(view: View, step: string, agent: string, to: Switch): Command[] {
  const out: Command[] = [];
  for (const [key, here] of [['enable', to === 'on'], ['disable', to === 'off']] as const) {
    const path = `${step}/${key}`;
    const before = stringsAt(view, path).filter((a) => a !== '');
    const after = here ? [...new Set([...before, agent])] : before.filter((a) => a !== agent);
    if (after.length === before.length) continue;
    out.push(after.length === 0 ? { op: 'remove', path } : { op: 'set', path, value: after });
  }
  return out;
}

/** A name in a set that is not taken: "trigger:3", "step-2". */
export function freeName(view: View, set: string, begin: string): string {
  const here = metaAt(view, set);
  for (let n = 1; ; ++n) if (!child(here, `${begin}${n}`)) return `${begin}${n}`;
}

export const kAddable = ['agents', 'machines', 'quantities', 'effects', 'activities'] as const;
export type Addable = (typeof kAddable)[number];
/** Agents, machines and nodes share their names. */
export function isFreeName(view: View, kind: Addable, name: string): boolean {
  const groups = kind === 'agents' || kind === 'machines' ? ['agents', 'machines'] : [kind];
  const isNode = groups.length > 1 && [...view.outline, ...view.bodies, ...view.joints].some((n) => n.def === name);
  return !isNode && groups.every((group) => !metaAt(view, `${group}/${name}`));
}
/** `type`: of agents and machines; of a quantity its source, of an effect its kind. An activity begins with one step. */
export function addCommands(kind: Addable, name: string, type: string): Command[] {
  const path = `${kind}/${name}`;
  if (kind === 'activities') return [{ op: 'set', path: `${path}/steps/begin/hintSeconds`, value: 20 }];
  const key = kind === 'quantities' ? 'source' : kind === 'effects' ? 'kind' : 'type';
  return [{ op: 'set', path: `${path}/${key}`, value: type }];
}

const kDegree = Math.PI / 180;
/** Turns about x, then y, then z of the world, in degrees, as a quaternion; and back. */
export function quaternionFrom(degrees: readonly number[]): [number, number, number, number] {
  const [c1, c2, c3] = degrees.map((d) => Math.cos((d * kDegree) / 2)) as [number, number, number];
  const [s1, s2, s3] = degrees.map((d) => Math.sin((d * kDegree) / 2)) as [number, number, number];
  return [s1 * c2 * c3 - c1 * s2 * s3, c1 * s2 * c3 + s1 * c2 * s3, c1 * c2 * s3 - s1 * s2 * c3, c1 * c2 * c3 + s1 * s2 * s3];
}
export function degreesOf([, , , x, y, z, w]: PoseArray): [number, number, number] {
  const sine = Math.min(Math.max(2 * (w * y - z * x), -1), 1);
  // Looking straight along an axle, two of the turns are one: all of it is given to the first.
  const straight = Math.abs(sine) > 0.999999;
  const turns = straight
    ? [2 * Math.atan2(x, w), Math.asin(sine), 0]
    : [Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), Math.asin(sine), Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))];
  return turns.map((t) => Number((t / kDegree).toFixed(3)) + 0) as [number, number, number];
}
