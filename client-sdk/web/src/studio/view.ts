// What the gateway says of a draft and of what may stand in it: read from its JSON, whatever is missing.
import { fields, list, number, text, type Fields } from '../console/api';
import type { PoseArray, Texts } from '../wire/messages';

export interface Problem {
  severity: 'error' | 'warning';
  message: string;
  remedy: string;
  line: number;
  place: string;
  /** Of the metadata, where it has one. */
  path: string;
  /** DEF of the X3D node. */
  node: string;
}
export interface OutlineNode {
  def: string;
  type: string;
  line: number;
  pose: PoseArray | null;
  movable: boolean;
  children: OutlineNode[];
}
export interface MetaSet {
  kind: 'set';
  name: string;
  line: number;
  children: Meta[];
}
export interface MetaValue {
  kind: 'value';
  name: string;
  line: number;
  value: Value;
}
export type Meta = MetaSet | MetaValue;
export type Value = number | boolean | string | (number | boolean | string)[];
/** A node with fields, as the inspector shows it. */
export interface NodeFields {
  def: string;
  type: string;
  line: number;
  fields: Record<string, string>;
  /** Our sets on the node: mechane:haptic, mechane:body, mechane:agent. */
  sets: MetaSet[];
  /** Of a joint; "": the room. */
  body1: string;
  body2: string;
}
export interface View {
  name: string;
  revision: number;
  by: string;
  canUndo: boolean;
  canRedo: boolean;
  undoes: string;
  redoes: string;
  problems: Problem[];
  outline: OutlineNode[];
  metadata: MetaSet;
  bodies: NodeFields[];
  joints: NodeFields[];
  /** Viewpoints. */
  views: NodeFields[];
  /** DEFs that the last step added. */
  added: string[];
  /** What of a merged exhibit is another here. */
  merged: MergeNote[];
}
/** `renamed`: both had the name `theirs`; otherwise there is only one such value, and `here` is kept. */
export interface MergeNote {
  what: string;
  theirs: string;
  here: string;
  renamed: boolean;
}
export interface Exhibit {
  name: string;
  title: Texts;
  draft: { revision: number; by: string; changed: number; problems: number } | null;
  /** Another for each picture; "": there is none. */
  picture: string;
}
export interface Library {
  exhibits: Exhibit[];
  templates: { name: string; title: Texts }[];
}
export interface Version {
  number: number;
  title: string;
  by: string;
  /** Seconds since 1970. */
  made: number;
}

/** Words by language. */
export const textsOf = (v: unknown): Texts => Object.fromEntries(Object.entries(fields(v)).map(([code, words]) => [code, text(words)]));

export function libraryOf(v: unknown): Library {
  const all = fields(v);
  return {
    exhibits: list(all.exhibits).map(fields).map((e) => {
      const draft = e.draft ? fields(e.draft) : null;
      return {
        name: text(e.name),
        title: textsOf(e.title),
        draft: draft && { revision: number(draft.revision), by: text(draft.by), changed: number(draft.changed_s),
          problems: number(draft.problems) },
        picture: e.picture === null ? '' : text(e.picture),
      };
    }),
    templates: list(all.templates).map(fields).map((t) => ({ name: text(t.name), title: textsOf(t.title) })),
  };
}

export const versionsOf = (v: unknown): Version[] => list(fields(v).versions).map(fields).map((one) => ({
  number: number(one.number), title: text(one.title), by: text(one.by), made: number(one.made_s),
}));

function valueOf(v: unknown): Value {
  if (Array.isArray(v)) return v.map((one) => (typeof one === 'number' || typeof one === 'boolean' ? one : text(one)));
  return typeof v === 'number' || typeof v === 'boolean' ? v : text(v);
}
function metaOf(v: unknown): Meta {
  const m = fields(v);
  const common = { name: text(m.name), line: number(m.line) };
  if (m.kind === 'set') return { kind: 'set', ...common, children: list(m.children).map(metaOf) };
  return { kind: 'value', ...common, value: valueOf(m.value) };
}
const setOf = (v: unknown, name: string): MetaSet => {
  const meta = metaOf({ ...fields(v), kind: 'set' });
  return { ...(meta as MetaSet), name: meta.name || name };
};

const shownAs = (v: unknown): string => (Array.isArray(v) ? v.join(' ') : typeof v === 'string' ? v : v == null ? '' : String(v));

function nodeOf(v: unknown, type: string): NodeFields {
  const n = fields(v);
  return {
    def: text(n.def),
    type: text(n.type) || type,
    line: number(n.line),
    fields: Object.fromEntries(Object.entries(fields(n.fields)).map(([name, value]) => [name, shownAs(value)])),
    sets: Object.entries(fields(n.sets)).map(([name, set]) => setOf(set, name)),
    body1: text(n.body1),
    body2: text(n.body2),
  };
}
export function poseOf(v: unknown): PoseArray | null {
  const given = list(v).map(number);
  return given.length === 7 ? (given as PoseArray) : null;
}
const outlineOf = (v: unknown): OutlineNode => {
  const n = fields(v);
  return { def: text(n.def), type: text(n.type), line: number(n.line), pose: poseOf(n.pose), movable: n.movable === true,
    children: list(n.children).map(outlineOf) };
};

export function viewOf(v: unknown): View {
  const w: Fields = fields(v);
  return {
    name: text(w.name),
    revision: number(w.revision),
    by: text(w.by),
    canUndo: w.canUndo === true,
    canRedo: w.canRedo === true,
    undoes: text(w.undoes),
    redoes: text(w.redoes),
    problems: list(w.problems).map(fields).map((p) => ({
      severity: p.severity === 'warning' ? 'warning' : 'error', message: text(p.message), remedy: text(p.remedy), line: number(p.line),
      place: text(p.place), path: text(p.path), node: text(p.node),
    })),
    outline: list(w.outline).map(outlineOf),
    metadata: setOf(w.metadata, 'mechane:scenario'),
    bodies: list(w.bodies).map((b) => nodeOf(b, 'RigidBody')),
    joints: list(w.joints).map((j) => nodeOf(j, '')),
    views: list(w.views).map((v) => nodeOf(v, 'Viewpoint')),
    added: list(w.added).map(text),
    merged: list(w.merged).map(fields)
      .map((m) => ({ what: text(m.what), theirs: text(m.theirs), here: text(m.here), renamed: m.renamed === true })),
  };
}

/** The child of that name. */
export const child = (set: Meta | undefined, name: string): Meta | undefined =>
  (set?.kind === 'set' ? set.children.find((c) => c.name === name) : undefined);
export const childSets = (set: Meta | undefined): MetaSet[] =>
  (set?.kind === 'set' ? set.children.filter((c): c is MetaSet => c.kind === 'set') : []);
/** What stands at a path: within the scenario's metadata, or "DEF/mechane:haptic/..." of a node. */
export function metaAt(view: View, path: string): Meta | undefined {
  const parts = path === '' ? [] : path.split('/');
  const node = parts[1]?.startsWith('mechane:') ? [...view.bodies, ...view.joints].find((n) => n.def === parts[0]) : undefined;
  let at: Meta | undefined = node ? node.sets.find((s) => s.name === parts[1]) : view.metadata;
  for (const name of parts.slice(node ? 2 : 0)) at = child(at, name);
  return at;
}
export const stringAt = (view: View, path: string): string => {
  const at = metaAt(view, path);
  return at?.kind === 'value' ? String(Array.isArray(at.value) ? (at.value[0] ?? '') : at.value) : '';
};
export const stringsAt = (view: View, path: string): string[] => {
  const at = metaAt(view, path);
  if (at?.kind !== 'value') return [];
  return (Array.isArray(at.value) ? at.value : [at.value]).map(String);
};
export const languagesOf = (view: View): string[] => {
  const codes = stringsAt(view, 'languages').filter((code) => code !== '');
  return codes.length > 0 ? codes : ['el', 'en'];
};
export const nodeAt = (view: View, def: string): NodeFields | undefined =>
  [...view.bodies, ...view.joints, ...view.views].find((n) => n.def === def);
/** The body that the last step added. */
/** Where a new body stands in no other one's place: the nearest to the middle, on a grid. */
export function freePlace(view: View): [number, number, number] {
  const taken = view.bodies.map((body) => outlineAt(view, body.def)?.pose).filter((pose) => pose != null);
  const kGrid_m = 0.8, kMost = 8;
  const cells = Array.from({ length: 2 * kMost + 1 }, (_, i) => kMost - i);
  const places = cells.flatMap((z) => cells.map((x) => [x * kGrid_m, z * kGrid_m] as const));
  const far = ([x, z]: readonly [number, number]): number => Math.hypot(x, z);
  const free = places.sort((a, b) => far(a) - far(b)).find(([x, z]) => taken.every((p) => Math.hypot(p[0] - x, p[2] - z) > kGrid_m - 0.1));
  const [x, z] = free ?? [0, 0];
  return [Number(x.toFixed(2)), 0.5, Number(z.toFixed(2))];
}
export const addedBody = (view: View): string | undefined => view.added.find((def) => view.bodies.some((b) => b.def === def));
export function outlineAt(view: View, def: string, nodes: readonly OutlineNode[] = view.outline): OutlineNode | undefined {
  for (const node of nodes) {
    const found = node.def === def ? node : outlineAt(view, def, node.children);
    if (found) return found;
  }
  return undefined;
}
