// All words that visitors read or hear, with the languages side by side.
import { child, childSets, languagesOf, stringAt, stringsAt, type MetaSet, type View } from '../view';

export interface WordRow {
  /** Of the set of words: "activities/use/steps/lift/text". */
  path: string;
  /** caption, hint, answer:crank ... */
  what: string;
  /** By language code; missing: "". */
  words: Record<string, string>;
  /** Languages in which it must not be empty, and is. */
  missing: string[];
  /** Visitors can do without it. */
  optional: boolean;
}
export interface WordGroup {
  /** What the words belong to: a path, or a DEF. */
  owner: string;
  kind: 'exhibit' | 'body' | 'activity' | 'step' | 'question' | 'quantity';
  name: string;
  rows: WordRow[];
}

/** Without these a visitor does not know where they are or what to do. */
const kNeeded = ['title', 'caption', 'question', 'low', 'high'];

function groupOf(kind: WordGroup['kind'], owner: string, name: string, set: MetaSet | undefined, usual: readonly string[],
  languages: readonly string[], path = owner === '' ? 'text' : `${owner}/text`): WordGroup {
  const known = new Map<string, Record<string, string>>();
  usual.forEach((what) => known.set(what, {}));
  const text = child(set, 'text');
  for (const one of text?.kind === 'set' ? text.children : []) {
    const dot = one.name.lastIndexOf('.');
    const [what, code] = [one.name.slice(0, dot), one.name.slice(dot + 1)];
    if (one.kind !== 'value' || dot < 1 || what === 'audio') continue;
    known.set(what, { ...known.get(what), [code]: String(Array.isArray(one.value) ? one.value.join(' ') : one.value) });
  }
  const rows = [...known].map(([what, given]) => {
    const words = Object.fromEntries(languages.map((code) => [code, given[code] ?? '']));
    const optional = (!kNeeded.includes(what) || kind === 'body') && !what.startsWith('answer:');
    const needed = !optional || languages.some((code) => words[code] !== '');
    return { path, what, words, optional, missing: needed ? languages.filter((code) => words[code]!.trim() === '') : [] };
  });
  return { owner, kind, name, rows };
}

function questionWhats(question: MetaSet): string[] {
  const answers = child(question, 'answers');
  const kind = child(question, 'kind');
  if (kind?.kind === 'value' && String(kind.value) === 'scale') return ['question', 'low', 'high'];
  const names = answers?.kind === 'value' ? (Array.isArray(answers.value) ? answers.value : [answers.value]).map(String) : [];
  return ['question', ...names.map((name) => `answer:${name}`)];
}

export function wordGroups(view: View): WordGroup[] {
  const languages = languagesOf(view);
  const out = [groupOf('exhibit', '', view.name, view.metadata, ['title'], languages)];
  for (const activity of childSets(child(view.metadata, 'activities'))) {
    const base = `activities/${activity.name}`;
    out.push(groupOf('activity', base, activity.name, activity, ['title', 'goal'], languages));
    for (const step of childSets(child(activity, 'steps')))
      out.push(groupOf('step', `${base}/steps/${step.name}`, step.name, step, ['caption', 'hint', 'narration'], languages));
    for (const question of childSets(child(activity, 'questionnaire')))
      out.push(groupOf('question', `${base}/questionnaire/${question.name}`, question.name, question, questionWhats(question), languages));
  }
  for (const quantity of childSets(child(view.metadata, 'quantities')))
    out.push(groupOf('quantity', `quantities/${quantity.name}`, quantity.name, quantity, ['label'], languages));
  const agents = childSets(child(view.metadata, 'agents')).map((agent) => `agents/${agent.name}`);
  const taken = new Set(agents.filter((agent) => stringAt(view, `${agent}/type`) === 'simulation.grasp')
    .flatMap((agent) => stringsAt(view, `${agent}/bodies`)));
  for (const body of view.bodies) {
    const set = body.sets.find((s) => s.name === 'mechane:body');
    if (child(set, 'text') || taken.has(body.def))
      out.push(groupOf('body', body.def, body.def, set, ['title'], languages, `${body.def}/mechane:body/text`));
  }
  return out;
}
export const missingIn = (groups: readonly WordGroup[]): number =>
  groups.reduce((sum, group) => sum + group.rows.reduce((s, row) => s + row.missing.length, 0), 0);
