// The subjects of the studio's help: which there are, which belongs to a part of the page, and which of them tell of something.
import { plain } from '../palette';
import type { Language } from '../words';
import type { PartName } from '../workspace.svelte';
import { kEnglishHelp } from './english';
import { kGreekHelp } from './greek';

export const kTopics = ['begin', 'picture', 'things', 'joints', 'steps', 'words', 'files', 'catalogue', 'try', 'versions', 'publish',
  'keys'] as const;
export type TopicName = (typeof kTopics)[number];
export interface Topic {
  title: string;
  /** What this part of the page is for. */
  what: string;
  /** What one does there, in the order in which it is done. */
  how: string[];
  /** What others have learnt. */
  tips?: string[];
  keys?: [key: string, does: string][];
}
export interface HelpWords {
  help: string;
  open: string;
  close: string;
  subjects: string;
  search: string;
  nothing: string;
  how: string;
  tips: string;
  keys: string;
  topics: Record<TopicName, Topic>;
}

export const helpWords = (language: Language): HelpWords => (language === 'el' ? kGreekHelp : kEnglishHelp);
export const kTopicOf: Record<PartName, TopicName> = {
  scene: 'picture', flow: 'steps', words: 'words', files: 'files', try: 'try', versions: 'versions',
};
export const isTopic = (name: string | undefined): name is TopicName => kTopics.some((one) => one === name);

/** Subjects that have each written word; those with it in the title first. */
export function topicsAbout(words: HelpWords, query: string): TopicName[] {
  const wanted = plain(query).split(/\s+/).filter((one) => one !== '');
  const all = ({ title, what, how, tips = [], keys = [] }: Topic): string =>
    plain([title, what, ...how, ...tips, ...keys.flat()].join(' '));
  const inTitle = (name: TopicName): boolean => wanted.some((one) => plain(words.topics[name].title).includes(one));
  const found = kTopics.filter((name) => wanted.every((one) => all(words.topics[name]).includes(one)));
  return [...found.filter(inTitle), ...found.filter((name) => !inTitle(name))];
}
