// What a new exhibit is called where its author has not said it yet.
import type { Command } from '../commands';
import { exhibitName } from './files';
import type { Library } from '../view';
import { studioWords, type Language } from '../words';

/** Those of the templates' texts. */
export const kTitleLanguages: readonly Language[] = ['el', 'en'];
export type Titles = Record<Language, string>;

/** An exhibit's name by its English title; "": it has no Latin letter. */
export const nameOfTitle = (title: string): string => (/[a-z0-9]/i.test(title) ? exhibitName(title.replaceAll('.', ' ')) : '');

/** Titles that no exhibit here has, nor a name that comes of them: "My exhibit", "My exhibit 2" ... */
export function freeTitles({ exhibits }: Library): Titles {
  const isFree = (titles: Titles): boolean => exhibits.every((one) =>
    one.name !== nameOfTitle(titles.en) && kTitleLanguages.every((code) => one.title[code] !== titles[code]));
  for (let n = 1; ; ++n) {
    const of = (code: Language): string => `${studioWords(code).newTitleUsual}${n > 1 ? ` ${n}` : ''}`;
    const titles = { el: of('el'), en: of('en') };
    if (isFree(titles)) return titles;
  }
}
export const titleCommands = (titles: Titles): Command[] =>
  kTitleLanguages.map((code): Command => ({ op: 'set', path: `text/title.${code}`, value: titles[code].trim() }));
