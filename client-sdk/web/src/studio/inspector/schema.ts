// What may stand in an exhibit, by the server's own tables: forms are made from them.
import { fields, list, text } from '../../console/api';
import { numbersFrom } from '../commands';
import { child, childSets, type Meta, type MetaSet, type NodeFields, type View } from '../view';

export type KeyType = 'string' | 'strings' | 'number' | 'numbers' | 'vector' | 'rotation' | 'matrix' | 'boolean' | 'set';
export interface Key {
  name: string;
  type: KeyType;
  unit: string;
  least: number | null;
  most: number | null;
  choices: string[];
  usual: string;
  /** Of numbers: how many; null: any count. */
  count: number | null;
  doc: string;
  /** What kind of names it holds: body, joint, agent, quantity, step ... */
  names: string;
  required: boolean;
  /** A required key may be left out where one of this name is written. */
  unless: string;
}
export interface Table {
  /** "step", or as a key of the table around it: "steps", "trigger:*". */
  name: string;
  doc: string;
  keys: Key[];
  sets: Table[];
  /** The author chooses the names of the sets in it; each is as this table says. */
  each: Table | null;
}
export interface Part {
  name: string;
  title: Record<string, string>;
}
export interface Schema {
  metadata: Table[];
  agents: Table[];
  machines: Table[];
  nodes: Table[];
  parts: Part[];
}

const kTypes: readonly string[] = ['string', 'strings', 'number', 'numbers', 'vector', 'rotation', 'matrix', 'boolean', 'set'];
const limit = (v: unknown): number | null => (typeof v === 'number' && Number.isFinite(v) ? v : null);

function keyOf(v: unknown): Key {
  const k = fields(v);
  const type = text(k.type);
  return {
    name: text(k.name),
    type: (kTypes.includes(type) ? type : 'string') as KeyType,
    unit: text(k.unit),
    least: limit(k.least),
    most: limit(k.most),
    choices: Array.isArray(k.choices) ? k.choices.map(text) : text(k.choices).split(' ').filter((c) => c !== ''),
    usual: k.default === undefined || k.default === null ? '' : Array.isArray(k.default) ? k.default.join(' ') : String(k.default),
    count: limit(k.count),
    doc: text(k.doc),
    names: text(k.names),
    required: k.required === true,
    unless: text(k.unless),
  };
}
function tableOf(v: unknown): Table {
  const t = fields(v);
  const sets = list(t.sets).map(tableOf);
  // Of sets whose names the author chooses, the gateway describes one, named "*".
  return {
    name: text(t.name),
    doc: text(t.doc),
    keys: list(t.keys).map(keyOf).filter((k) => k.type !== 'set'),
    sets: sets.filter((s) => s.name !== '*'),
    each: sets.find((s) => s.name === '*') ?? null,
  };
}
export function schemaOf(v: unknown): Schema {
  const s = fields(v);
  return {
    metadata: list(s.metadata).map(tableOf),
    agents: list(s.agents).map(tableOf),
    machines: list(s.machines).map(tableOf),
    nodes: list(s.nodes).map(tableOf),
    parts: list(s.parts).map(fields).map((p) => ({
      name: text(p.name), title: Object.fromEntries(Object.entries(fields(p.title)).map(([code, words]) => [code, text(words)])),
    })),
  };
}

/** Whether a name is one of a pattern: "trigger:1" of "trigger:*". */
export const fits = (pattern: string, name: string): boolean =>
  (pattern.endsWith('*') ? name.startsWith(pattern.slice(0, -1)) : pattern === name);
const inner = (table: Table | null, name: string): Table | null => table?.sets.find((s) => fits(s.name, name)) ?? table?.each ?? null;
export const keyIn = (table: Table | null, name: string): Key | null =>
  table?.keys.find((k) => k.name === name) ?? table?.keys.find((k) => fits(k.name, name)) ?? null;

/** The table of an agent or a machine: by the type that it has. */
function typed(tables: readonly Table[], view: View, group: string, name: string): Table | null {
  const type = child(child(child(view.metadata, group), name), 'type');
  return ofType(tables, type);
}
/** With the type itself, by which another is chosen. */
function ofType(tables: readonly Table[], type: Meta | undefined): Table | null {
  const table = type?.kind === 'value' ? tables.find((t) => t.name === String(type.value)) : undefined;
  const key: Key = { name: 'type', type: 'string', unit: '', least: null, most: null, choices: tables.map((t) => t.name), usual: '',
    count: null, doc: table?.doc ?? '', names: '', required: true, unless: '' };
  return { name: table?.name ?? '', doc: table?.doc ?? '', keys: [key, ...(table?.keys ?? []).filter((k) => k.name !== 'type')],
    sets: table?.sets ?? [], each: null };
}
/** The table of the set at a path; null: the schema has none. */
export function tableAt(schema: Schema, view: View, path: string): Table | null {
  const parts = path === '' ? [] : path.split('/');
  const ours = parts[1]?.startsWith('mechane:') ? parts[1] : 'mechane:scenario';
  if (ours === 'mechane:agent') {
    const set = view.joints.find((j) => j.def === parts[0])?.sets.find((s) => s.name === ours);
    const type = child(set, 'type');
    return ofType(schema.agents, type);
  }
  if (parts.length === 2 && parts[0] === 'agents') return typed(schema.agents, view, 'agents', parts[1]!);
  if (parts.length === 2 && parts[0] === 'machines') return typed(schema.machines, view, 'machines', parts[1]!);
  let table: Table | null = schema.metadata.find((t) => t.name === ours) ?? null;
  for (const name of parts.slice(ours === 'mechane:scenario' ? 0 : 2)) table = inner(table, name);
  return table;
}
export const nodeTable = (schema: Schema, type: string): Table | null => schema.nodes.find((t) => t.name === type) ?? null;

/** The names of a body's copies, after the name for all of them where a list may hold it. Null: the body has no copies. */
function copiesOf(body: NodeFields, many: boolean): string[] | null {
  const copies = child(body.sets.find((s) => s.name === 'mechane:body'), 'copies');
  const numbers = (key: string): number[] => {
    const one = child(copies, key);
    return one?.kind === 'value' ? (numbersFrom([one.value].flat().join(' ')) ?? []) : [];
  };
  const count = numbers('count')[0] ?? numbers('positions').length / 3;
  if (!copies || !(count >= 1)) return null;
  return [...(many ? [`${body.def}-*`] : []), ...Array.from({ length: Math.min(count, 200) }, (_, i) => `${body.def}-${i + 1}`)];
}

/** Names that a key may hold, from the draft itself. `path`: of the set around the key. */
export function namesFor(view: View, kind: string, path: string, many = false): string[] {
  const named = (group: string): string[] => (childSets(view.metadata).find((s) => s.name === group)?.children ?? []).map((c) => c.name);
  const activity = /^activities\/([^/]+)/.exec(path)?.[1];
  switch (kind) {
    case 'body':
      return view.bodies.flatMap((body) => copiesOf(body, many) ?? [body.def]);
    case 'joint':
      return view.joints.map((j) => j.def);
    case 'agent':
      return [...named('agents'), ...view.joints.filter((j) => j.sets.some((s) => s.name === 'mechane:agent')).map((j) => j.def)];
    case 'quantity':
      return named('quantities');
    case 'activity':
      return named('activities');
    case 'step': {
      const steps = activity ? (child(child(child(view.metadata, 'activities'), activity), 'steps') as MetaSet | undefined) : undefined;
      return [...childSets(steps).map((s) => s.name), 'end'];
    }
    case 'view':
    case 'model': {
      const type = kind === 'view' ? 'Viewpoint' : 'Inline';
      return view.outline.filter((n) => n.type === type).map((n) => n.def);
    }
    default:
      return [];
  }
}

/** What is wrong with a number by a key's range: the end that it must keep; null: nothing. */
export function beyond(key: Key, value: number): { least: number } | { most: number } | null {
  if (key.least !== null && value < key.least) return { least: key.least };
  if (key.most !== null && value > key.most) return { most: key.most };
  return null;
}
