// The museum's catalogue, as the gateway answers it.
import { fields, list, number, text } from '../../console/api';
import type { Texts } from '../../wire/messages';
import { usesOf, type FileUse } from './files';
import { textsOf } from '../view';

export const kKinds = ['exhibit', 'draft', 'mesh', 'sound', 'template', 'part'] as const;
export type KindFilter = (typeof kKinds)[number];
export type ItemKind = Exclude<KindFilter, 'draft'>;
export interface About {
  description: string;
  licence: string;
  author: string;
  source: string;
  tags: string[];
  languages: string[];
}
export interface Item {
  kind: ItemKind;
  name: string;
  /** From the museum's folder; "": it is of the library. */
  path: string;
  /** Whose file it is. */
  exhibit: string;
  title: Texts;
  bytes: number;
  published: boolean;
  draft: boolean;
  about: About;
  uses: FileUse[];
}
export interface Catalogue {
  items: Item[];
  /** How many there are, whatever was looked for. */
  all: number;
  tags: string[];
  licences: string[];
  languages: string[];
  notice: string;
}
/** "": all. */
export interface Query {
  text: string;
  kind: KindFilter | '';
  tag: string;
  /** "-": it has none. */
  licence: string;
  language: string;
}
export const kEverything: Query = { text: '', kind: '', tag: '', licence: '', language: '' };

const texts = (v: unknown): string[] => list(v).map(text);
const kindOf = (v: unknown): ItemKind => kKinds.find((kind): kind is ItemKind => kind === v && kind !== 'draft') ?? 'exhibit';
export const aboutOf = (v: unknown): About => {
  const about = fields(v);
  return { description: text(about.description), licence: text(about.licence), author: text(about.author), source: text(about.source),
    tags: texts(about.tags), languages: texts(about.languages) };
};
export const catalogueOf = (v: unknown): Catalogue => {
  const all = fields(v);
  const notice = fields(all.notice);
  return {
    items: list(all.items).map(fields).map((item) => ({
      kind: kindOf(item.kind), name: text(item.name), path: text(item.path), exhibit: text(item.exhibit), title: textsOf(item.title),
      bytes: number(item.bytes), published: item.published === true, draft: item.draft === true, about: aboutOf(item.about),
      uses: usesOf(item.uses),
    })),
    all: number(all.all), tags: texts(all.tags), licences: texts(all.licences), languages: texts(all.languages),
    notice: [text(notice.error), text(notice.remedy)].filter((one) => one !== '').join('; '),
  };
};
/** The part of the address after "?". */
export const queryText = (query: Query): string =>
  new URLSearchParams(Object.entries(query).filter(([, value]) => value !== '')).toString();
export const isFiltered = (query: Query): boolean => queryText(query) !== '';
export const isFile = (item: Item): boolean => item.kind === 'mesh' || item.kind === 'sound';
/** "wood, ξύλο , wood" is two of them. */
export const wordsIn = (written: string): string[] =>
  [...new Set(written.split(',').map((one) => one.trim().replace(/\s+/g, ' ')).filter((one) => one !== ''))];
/** The commands by which an exhibit's file says something else of itself. */
export const metaCommands = (before: About, after: About): { op: 'meta'; name: string; value: string }[] => {
  const said = (about: About): [string, string][] => [['description', about.description], ['license', about.licence],
    ['creator', about.author], ['reference', about.source], ['subject', about.tags.join(', ')]];
  const old = new Map(said(before));
  return said(after).filter(([name, value]) => old.get(name) !== value).map(([name, value]) => ({ op: 'meta', name, value }));
};
