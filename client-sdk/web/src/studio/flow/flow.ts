// The steps of an activity in the order written, and which agents are on in each.
import { child, childSets, metaAt, stringAt, stringsAt, type Meta, type MetaSet, type View } from '../view';
import type { StudioWords } from '../words';

export interface Cell {
  agent: string;
  on: boolean;
  /** The step says so itself; else it is as before. */
  said: boolean;
}
export interface StepRow {
  name: string;
  path: string;
  first: boolean;
  cells: Cell[];
  triggers: MetaSet[];
}

export const activitiesOf = (view: View): string[] => childSets(child(view.metadata, 'activities')).map((a) => a.name);

/** All that can be switched on and off: agents, and joints that are agents. */
export function agentsOf(view: View): string[] {
  const own = childSets(child(view.metadata, 'agents')).map((a) => a.name);
  const joints = view.joints.map((j) => j.def);
  const said = activitiesOf(view).flatMap((a) => stepsIn(view, a))
    .flatMap((step) => ['enable', 'disable'].flatMap((key) => strings(child(step, key))));
  return [...new Set([...own, ...joints.filter((j) => said.includes(j) || isAgent(view, j)), ...said])];
}
const isAgent = (view: View, joint: string): boolean =>
  view.joints.some((j) => j.def === joint && j.sets.some((s) => s.name === 'mechane:agent'));
function strings(meta: Meta | undefined): string[] {
  if (meta?.kind !== 'value') return [];
  return (Array.isArray(meta.value) ? meta.value : [meta.value]).map(String).filter((s) => s !== '');
}

export const stepsIn = (view: View, activity: string): MetaSet[] => childSets(metaAt(view, `activities/${activity}/steps`));

export function stepsOf(view: View, activity: string): StepRow[] {
  const base = `activities/${activity}`;
  const steps = stepsIn(view, activity);
  const first = stringAt(view, `${base}/first`) || steps[0]?.name;
  const on = new Set<string>();
  const agents = agentsOf(view);
  return steps.map((step) => {
    const path = `${base}/steps/${step.name}`;
    const [enabled, disabled] = [stringsAt(view, `${path}/enable`), stringsAt(view, `${path}/disable`)];
    enabled.forEach((a) => on.add(a));
    disabled.forEach((a) => on.delete(a));
    return {
      name: step.name,
      path,
      first: step.name === first,
      cells: agents.map((agent) => ({ agent, on: on.has(agent), said: enabled.includes(agent) || disabled.includes(agent) })),
      triggers: childSets(step).filter((s) => s.name.startsWith('trigger:')),
    };
  });
}

const word = (set: MetaSet, key: string): string => {
  const meta = child(set, key);
  if (meta?.kind !== 'value') return '';
  return Array.isArray(meta.value) ? meta.value.join(' ') : String(meta.value);
};
const kSigns: Record<string, string> = { '<': '<', '>': '>', '=': '=' };

/** A trigger's comparisons: the one that it has itself, or its rules. */
function rulesOf(trigger: MetaSet): MetaSet[] {
  const rules = childSets(trigger).filter((s) => s.name.startsWith('rule:'));
  return rules.length > 0 ? rules : [trigger];
}

/** The field that a trigger's form begins with, from the step: "trigger:1/quantity". */
export function firstFieldOf(trigger: MetaSet): string {
  const [rule] = rulesOf(trigger);
  return `${trigger.name}/${rule === trigger ? '' : `${rule!.name}/`}quantity`;
}

/** "height > 0.965 for 0.3 s → guide". */
export function ruleText(trigger: MetaSet, words: StudioWords): string {
  const one = (set: MetaSet): string => [word(set, 'quantity') || '?',
    kSigns[word(set, 'op')] ?? '?', words.decimal(word(set, 'value')) || '?'].join(' ');
  const joined = rulesOf(trigger).map(one).join(word(trigger, 'match') === 'any' ? words.or : words.and);
  const hold = word(trigger, 'holdSeconds');
  const next = word(trigger, 'next') || 'end';
  return `${joined}${hold && Number(hold) > 0 ? words.heldFor(words.decimal(hold)) : ''} → ${next === 'end' ? words.theEnd : next}`;
}

/** A value that a step's triggers wait for. */
export interface Wanted {
  step: string;
  quantity: string;
  op: string;
  value: number;
}
/** All that an activity's steps wait for, in the unit of the quantity. */
export const wantedIn = (view: View, activity: string): Wanted[] =>
  stepsOf(view, activity).flatMap(({ name, triggers }) => triggers.flatMap(rulesOf)
    .map((rule) => ({ step: name, quantity: word(rule, 'quantity'), op: word(rule, 'op'), value: Number(word(rule, 'value') || NaN) }))
    .filter((wanted) => wanted.quantity !== '' && Number.isFinite(wanted.value)));
