// The outliner's tree: what stands in the exhibit, and what happens in it.
import { child, childSets, type OutlineNode, type View } from './view';

export type Group = 'bodies' | 'joints' | 'agents' | 'machines' | 'activities' | 'quantities' | 'effects' | 'visits' | 'views' | 'other';
export interface TreeNode {
  /** What the selection is called: "node:DEF", "path:agents/HOLD"; "group:bodies" cannot be selected. */
  id: string;
  name: string;
  /** Beside the name: the type. */
  more: string;
  group: Group | null;
  children: TreeNode[];
}
export interface TreeRow {
  node: TreeNode;
  level: number;
  open: boolean;
  place: number;
  count: number;
}

export const nodeId = (def: string): string => `node:${def}`;
export const pathId = (path: string): string => `path:${path}`;
export const selectedNode = (id: string): string => (id.startsWith('node:') ? id.slice(5) : '');
export const selectedPath = (id: string): string | null => (id.startsWith('path:') ? id.slice(5) : null);

const isJoint = (type: string): boolean => type.endsWith('Joint');
const group = (name: Group, children: TreeNode[]): TreeNode => ({ id: `group:${name}`, name, more: '', group: name, children });
const leaf = (node: OutlineNode): TreeNode =>
  ({ id: nodeId(node.def), name: node.def, more: node.type === 'RigidBody' ? '' : node.type, group: null,
    children: node.children.filter((c) => c.def).map(leaf) });

function sets(view: View, name: 'agents' | 'machines' | 'quantities' | 'effects' | 'visits'): TreeNode {
  const found = child(view.metadata, name);
  const typeOf = (meta: (typeof found & { kind: 'set' })['children'][number]): string => {
    const type = child(meta, 'type') ?? child(meta, 'kind');
    return type?.kind === 'value' ? String(type.value) : '';
  };
  return group(name, (found?.kind === 'set' ? found.children : []).map((meta) => (
    { id: pathId(`${name}/${meta.name}`), name: meta.name, more: typeOf(meta), group: null, children: [] })));
}

export function treeOf(view: View): TreeNode[] {
  const flat = (nodes: readonly OutlineNode[]): OutlineNode[] => nodes.flatMap((n) => [n, ...flat(n.children)]);
  const nodes = view.outline.filter((n) => n.def !== '');
  const inOutline = new Set(flat(nodes).map((n) => n.def));
  const missing = (defs: { def: string; type: string }[]): TreeNode[] => defs.filter((d) => !inOutline.has(d.def))
    .map((d) => ({ id: nodeId(d.def), name: d.def, more: d.type === 'RigidBody' ? '' : d.type, group: null, children: [] }));
  const metadataNames = new Set(['agents', 'machines'].flatMap((g) => childSets(child(view.metadata, g)).map((s) => s.name)));
  const bodies = nodes.filter((n) => n.type === 'RigidBody');
  const joints = nodes.filter((n) => isJoint(n.type));
  const views = nodes.filter((n) => n.type === 'Viewpoint');
  const others = nodes.filter((n) => n.type !== 'RigidBody' && n.type !== 'Viewpoint' && !isJoint(n.type) && !metadataNames.has(n.def));
  const activities = childSets(child(view.metadata, 'activities')).map((activity): TreeNode => ({
    id: pathId(`activities/${activity.name}`), name: activity.name, more: '', group: null,
    children: childSets(child(activity, 'steps')).map((step) => (
      { id: pathId(`activities/${activity.name}/steps/${step.name}`), name: step.name, more: '', group: null, children: [] })),
  }));
  const all = [
    group('bodies', [...bodies.map(leaf), ...missing(view.bodies)]), group('joints', [...joints.map(leaf), ...missing(view.joints)]),
    sets(view, 'machines'), sets(view, 'agents'),
    group('activities', activities), sets(view, 'quantities'), sets(view, 'effects'), sets(view, 'visits'),
    group('views', views.map((v) => ({ ...leaf(v), more: '' }))), group('other', others.map(leaf)),
  ];
  return [{ id: pathId(''), name: view.name, more: '', group: null, children: [] }, ...all.filter((g) => g.children.length > 0)];
}

/** Rows from top to bottom; with a filter, all that has it in its name, with what is around it. */
export function rowsOf(tree: readonly TreeNode[], closed: ReadonlySet<string>, filter: string): TreeRow[] {
  const wanted = filter.trim().toLowerCase();
  const has = (node: TreeNode): boolean =>
    (node.group === null && `${node.name} ${node.more}`.toLowerCase().includes(wanted)) || node.children.some(has);
  const below = (nodes: readonly TreeNode[], level: number): TreeRow[] => {
    const shown = wanted === '' ? nodes : nodes.filter(has);
    return shown.flatMap((node, i) => {
      const open = node.children.length > 0 && (wanted !== '' || !closed.has(node.id));
      return [{ node, level, open, place: i + 1, count: shown.length }, ...(open ? below(node.children, level + 1) : [])];
    });
  };
  return below(tree, 1);
}

/** The row that a key leads to; null: the key is not one of the tree's. */
export function rowAfter(rows: readonly TreeRow[], at: number, key: string): number | null {
  const last = rows.length - 1;
  switch (key) {
    case 'ArrowDown':
      return Math.min(at + 1, last);
    case 'ArrowUp':
      return Math.max(at - 1, 0);
    case 'Home':
      return 0;
    case 'End':
      return last;
    default:
      return null;
  }
}
/** The row around one. */
export function rowAround(rows: readonly TreeRow[], at: number): number {
  for (let i = at - 1; i >= 0; --i) if (rows[i]!.level < rows[at]!.level) return i;
  return at;
}

/** What is to be selected, and which field is to have the focus, for a place in the draft. */
export function whereIs(tree: readonly TreeNode[], path: string, node: string): { selection: string; field: string } | null {
  const ids = new Set<string>();
  const collect = (nodes: readonly TreeNode[]): void => nodes.forEach((n) => {
    ids.add(n.id);
    collect(n.children);
  });
  collect(tree);
  const parts = path === '' ? [] : path.split('/');
  if (parts[1]?.startsWith('mechane:') && ids.has(nodeId(parts[0]!))) return { selection: nodeId(parts[0]!), field: path };
  for (let n = parts.length; n > 0; --n) {
    const id = pathId(parts.slice(0, n).join('/'));
    if (ids.has(id)) return { selection: id, field: path };
  }
  if (node !== '' && ids.has(nodeId(node))) return { selection: nodeId(node), field: path };
  return path === '' && node === '' ? null : { selection: pathId(''), field: path };
}

export const isThere = (tree: readonly TreeNode[], id: string): boolean => tree.some((n) => n.id === id || isThere(n.children, id));
