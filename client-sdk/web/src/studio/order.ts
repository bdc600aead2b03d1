// Putting sets of the metadata in another order: steps, activities, questions, triggers, moves.
import type { Command } from './commands';
import { stepsIn } from './flow/flow';
import { child, childSets, metaAt, stringAt, type View } from './view';

const around = (path: string): string => path.split('/').slice(0, -1).join('/');
const nameOf = (path: string): string => path.split('/').at(-1) ?? '';
/** "trigger:" of "trigger:2": what is counted among others of its kind. */
const kindOf = (name: string): string => (/:\d+$/.test(name) ? name.slice(0, name.lastIndexOf(':') + 1) : '');

/** The sets that a set stands among, in the order written. */
export function siblingsOf(view: View, path: string): string[] {
  const kind = kindOf(nameOf(path));
  const all = childSets(around(path) === '' ? view.metadata : metaAt(view, around(path))).map((one) => one.name);
  return kind === '' ? all : all.filter((name) => kindOf(name) === kind);
}
/** Sets of which the order matters: it is that in which they are done, asked, or looked at. */
export const isOrdered = (path: string): boolean =>
  /^activities\/[^/]+$|^activities\/[^/]+\/(steps|questionnaire)\/[^/]+$|^visits\/[^/]+$|\/(trigger|rule|move):\d+$/.test(path);

/** Names with one of them moved by one place: up (-1) or down (1); null: it is at that end. */
export function moved(names: readonly string[], name: string, by: -1 | 1): string[] | null {
  const at = names.indexOf(name), to = at + by;
  if (at < 0 || to < 0 || to >= names.length) return null;
  const out = names.filter((one) => one !== name);
  out.splice(to, 0, name);
  return out;
}

/** The commands that move a set by one place; none where it is at that end. `follow`: rules that lead from a step to the one after it do so
 * in the new order, too. */
export function orderCommands(view: View, path: string, by: -1 | 1, follow: boolean): Command[] {
  const name = nameOf(path);
  const order = moved(siblingsOf(view, path), name, by);
  if (order === null) return [];
  const place = order.indexOf(name);
  // The first of its kind may stand after sets of another kind.
  const all = childSets(around(path) === '' ? view.metadata : metaAt(view, around(path))).map((one) => one.name);
  const after = place > 0 ? order[place - 1] : all[all.indexOf(order[1]!) - 1];
  const reorder: Command = { op: 'reorder', path, ...(after && { after }) };
  const activity = /^activities\/([^/]+)\/steps\/[^/]+$/.exec(path)?.[1];
  return activity && follow ? [reorder, ...followCommands(view, activity, order)] : [reorder];
}

function followCommands(view: View, activity: string, after: readonly string[]): Command[] {
  const base = `activities/${activity}`;
  const before = stepsIn(view, activity).map((step) => step.name);
  const next = (order: readonly string[], name: string): string => order[order.indexOf(name) + 1] ?? 'end';
  const out: Command[] = [];
  const lead = (step: string, path: string): void => {
    const [was, will] = [next(before, step), next(after, step)];
    if ((stringAt(view, path) || 'end') === was && was !== will) out.push({ op: 'set', path, value: will });
  };
  for (const step of stepsIn(view, activity)) {
    const path = `${base}/steps/${step.name}`;
    for (const one of childSets(step)) if (one.name.startsWith('trigger:')) lead(step.name, `${path}/${one.name}/next`);
    if (Number(stringAt(view, `${path}/timeoutSeconds`)) > 0) lead(step.name, `${path}/timeoutNext`);
  }
  const isFirst = child(metaAt(view, base), 'first') && stringAt(view, `${base}/first`) === before[0];
  if (isFirst && before[0] !== after[0]) out.push({ op: 'set', path: `${base}/first`, value: after[0]! });
  return out;
}

/** Alt with an arrow: up (-1) or down (1); null: another key. */
export function orderKey(event: KeyboardEvent): -1 | 1 | null {
  if (!event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return null;
  return event.key === 'ArrowUp' ? -1 : event.key === 'ArrowDown' ? 1 : null;
}
