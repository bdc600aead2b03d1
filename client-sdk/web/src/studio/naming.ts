// Names of things and exhibits: what may be in them, and what is wrong with one.
import type { StudioWords } from './words';

/** `page`: of what stands in addresses: exhibits, visits. `thing`: of what an exhibit has. */
export type NameKind = 'page' | 'thing';

const kRules: Record<NameKind, { first: RegExp; other: RegExp }> = {
  page: { first: /[a-z0-9]/, other: /[a-z0-9-]/ },
  thing: { first: /[A-Za-z]/, other: /[A-Za-z0-9_-]/ },
};

/** In words, with the letter that cannot be there; "": nothing is wrong. Blanks around a name are no part of it. */
export function nameFault(given: string, kind: NameKind, words: StudioWords): string {
  const name = given.trim();
  const { first, other } = kRules[kind];
  const own = words.naming;
  const wrong = [...name].find((letter) => !other.test(letter));
  if (wrong === undefined) return name === '' || first.test(name[0]!) ? '' : own.first[kind](name[0]!);
  if (/\s/.test(wrong)) return own.blank;
  // Many look like Latin ones: Α, ο, Τ.
  if (/\p{Script=Greek}/u.test(wrong)) return own.greek(wrong);
  return kind === 'page' && /[A-Z]/.test(wrong) ? own.capital(wrong) : own.letter[kind](wrong);
}
