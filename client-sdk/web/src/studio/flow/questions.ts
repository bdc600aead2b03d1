// The questions that visitors are asked after an activity, and the commands that change them.
import { freeName, type Command } from '../commands';
import { child, childSets, metaAt, stringAt, stringsAt, type View } from '../view';

export type QuestionKind = 'choice' | 'scale';
export interface Question {
  name: string;
  path: string;
  kind: QuestionKind;
  /** Of a choice: names of its answers, in the order shown. */
  answers: string[];
  /** The right answer's name; "": none is right or wrong. */
  correct: string;
}

const setOf = (activity: string): string => `activities/${activity}/questionnaire`;

export const questionsOf = (view: View, activity: string): Question[] => childSets(metaAt(view, setOf(activity))).map(({ name }) => {
  const path = `${setOf(activity)}/${name}`;
  return { name, path, kind: stringAt(view, `${path}/kind`) === 'scale' ? 'scale' : 'choice',
    answers: stringsAt(view, `${path}/answers`).filter((one) => one !== ''), correct: stringAt(view, `${path}/correct`) };
});

export const freeQuestion = (view: View, activity: string): string => freeName(view, setOf(activity), 'question-');
/** The visits' records have these names in columns. */
export const isPlainName = (name: string): boolean => /^[a-z][a-z0-9_-]{0,30}$/i.test(name);
export const isTakenQuestion = (view: View, activity: string, name: string): boolean =>
  child(metaAt(view, setOf(activity)), name) !== undefined;

const kFirstAnswers = ['answer-1', 'answer-2'];

export function addQuestion(activity: string, name: string, kind: QuestionKind): Command[] {
  const path = `${setOf(activity)}/${name}`;
  return [{ op: 'set', path: `${path}/kind`, value: kind },
    ...(kind === 'choice' ? [{ op: 'set', path: `${path}/answers`, value: kFirstAnswers } as const] : []),
    { op: 'add', path: `${path}/text` }];
}
/** The last one goes with the set around it. */
export function removeQuestion(view: View, question: Question): Command[] {
  const around = question.path.slice(0, question.path.lastIndexOf('/'));
  return [{ op: 'remove', path: childSets(metaAt(view, around)).length > 1 ? question.path : around }];
}

/** Removes those of a set's entries for which this holds. */
function removing(view: View, set: string, goes: (name: string) => boolean): Command[] {
  const here = metaAt(view, set);
  const names = (here?.kind === 'set' ? here.children : []).map((one) => one.name);
  return names.filter(goes).map((name) => ({ op: 'remove', path: `${set}/${name}` }));
}
/** A question of another kind has no use for the answers, or for the ends of the scale. */
export function setKind(view: View, { path, kind }: Question, to: QuestionKind): Command[] {
  if (kind === to) return [];
  const keys = to === 'scale' ? ['answers', 'correct'] : ['steps'];
  const texts = to === 'scale' ? (name: string) => name.startsWith('answer:') : (name: string) => /^(low|high)\./.test(name);
  return [{ op: 'set', path: `${path}/kind`, value: to }, ...removing(view, path, (name) => keys.includes(name)),
    ...removing(view, `${path}/text`, texts),
    ...(to === 'choice' ? [{ op: 'set', path: `${path}/answers`, value: kFirstAnswers } as const] : [])];
}

const answersCommand = ({ path }: Question, answers: string[]): Command => ({ op: 'set', path: `${path}/answers`, value: answers });
const isTextOf = (answer: string) => (name: string): boolean => name.slice(0, name.lastIndexOf('.')) === `answer:${answer}`;

export const orderAnswers = (question: Question, answers: string[]): Command[] => [answersCommand(question, answers)];
export function addAnswer(question: Question): Command[] {
  for (let n = 1; ; ++n)
    if (!question.answers.includes(`answer-${n}`)) return [answersCommand(question, [...question.answers, `answer-${n}`])];
}
export function removeAnswer(view: View, question: Question, answer: string): Command[] {
  return [answersCommand(question, question.answers.filter((one) => one !== answer)),
    ...(question.correct === answer ? [{ op: 'remove', path: `${question.path}/correct` } as const] : []),
    ...removing(view, `${question.path}/text`, isTextOf(answer))];
}
/** With its words, which have its name in theirs. */
export function renameAnswer(view: View, question: Question, answer: string, to: string): Command[] {
  const text = `${question.path}/text`;
  const words = removing(view, text, isTextOf(answer)).flatMap((gone) => {
    if (gone.op !== 'remove') return [];
    const code = gone.path.slice(gone.path.lastIndexOf('.'));
    return [{ op: 'set', path: `${text}/answer:${to}${code}`, value: stringAt(view, gone.path) } as const, gone];
  });
  return [answersCommand(question, question.answers.map((one) => (one === answer ? to : one))),
    ...(question.correct === answer ? [{ op: 'set', path: `${question.path}/correct`, value: to } as const] : []), ...words];
}
/** "": none is right or wrong. */
export function setCorrect(question: Question, answer: string): Command[] {
  if (answer === question.correct) return [];
  const path = `${question.path}/correct`;
  return [answer === '' ? { op: 'remove', path } : { op: 'set', path, value: answer }];
}
