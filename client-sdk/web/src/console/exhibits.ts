// Exhibits of a running server, as the gateway tells of them; what an order does to them, in words.
import { fields, list, number, text } from './api';

export interface Exhibit {
  id: string;
  /** By language. */
  title: Record<string, string>;
  contentHash: string;
  /** Worlds that run it as it is now. */
  worlds: number;
  /** Worlds that run what it was before, until their visits end. */
  formerWorlds: number;
}
export interface Exhibits {
  server: string;
  /** What to do before anything can be changed; empty: it can. */
  remedy: string;
  /** The one whose file the server reads now; empty: none. */
  preparing: string;
  /** Home first. */
  exhibits: Exhibit[];
  /** In the server's folder of exhibits, not loaded. */
  loadable: string[];
}
export type ExhibitVerb = 'load' | 'replace' | 'retire';

const exhibitOf = (v: unknown): Exhibit => {
  const e = fields(v);
  return {
    id: text(e.id), contentHash: text(e.contentHash), worlds: number(e.worlds), formerWorlds: number(e.formerWorlds),
    title: Object.fromEntries(Object.entries(fields(e.title)).map(([language, words]) => [language, text(words)])),
  };
};

export function exhibitsOf(v: unknown): Exhibits {
  const e = fields(v);
  return {
    server: text(e.server), remedy: text(e.remedy), preparing: text(e.preparing),
    exhibits: list(e.exhibits).map(exhibitOf).filter((one) => one.id !== ''),
    loadable: list(e.loadable).map(text).filter((name) => name !== ''),
  };
}

/** Its title in English, where it has one. */
export const titleOf = (exhibit: Exhibit): string => exhibit.title.en || Object.values(exhibit.title)[0] || exhibit.id;
/** Its titles in other languages, each with its language. */
export const otherTitles = (exhibit: Exhibit): [string, string][] =>
  Object.entries(exhibit.title).filter(([, words]) => words !== '' && words !== titleOf(exhibit));

const worlds = (count: number): string => (count === 1 ? '1 world' : `${count} worlds`);
export function worldsOf(exhibit: Exhibit): string {
  const now = exhibit.worlds === 0 ? 'not open' : `${worlds(exhibit.worlds)} open`;
  return exhibit.formerWorlds === 0 ? now : `${now}, ${worlds(exhibit.formerWorlds)} with a visit that finishes on its former form`;
}

/** What came of an order. `changed`: the file was another one than before. */
export function orderDone(verb: ExhibitVerb, now: boolean, changed: boolean): string {
  if (verb === 'load') return 'It is loaded: kiosks can open it.';
  if (verb === 'retire') return `It is retired. ${now ? 'Visits in progress end.' : 'Visits in progress finish on it.'}`;
  const visits = now ? 'Visits on a former form end.' : 'Visits in progress finish on the former one.';
  return changed ? `The new form is in use. ${visits}` : `Its file has not changed: it stays as it is.${now ? ` ${visits}` : ''}`;
}

/** "42 s", "3 min 5 s". */
export const lasting = (seconds: number): string =>
  seconds < 60 ? `${Math.floor(seconds)} s` : `${Math.floor(seconds / 60)} min ${Math.floor(seconds % 60)} s`;
