// What the command palette finds.
export interface Choice {
  name: string;
  keys?: string;
  run: () => void;
}

/** Without accents and capitals: a Greek writer in a hurry leaves accents out. */
export const plain = (words: string): string => words.normalize('NFD').replace(/\p{M}/gu, '').toLowerCase();

/** All that have each written word; those that begin with it first. */
export function found(choices: readonly Choice[], query: string): Choice[] {
  const parts = plain(query).split(/\s+/).filter((p) => p !== '');
  const begins = (choice: Choice): boolean => parts.length > 0 && plain(choice.name).startsWith(parts[0]!);
  return choices.filter((choice) => parts.every((part) => plain(choice.name).includes(part)))
    .map((choice, i) => ({ choice, rank: (begins(choice) ? 0 : choices.length) + i }))
    .sort((a, b) => a.rank - b.rank).map(({ choice }) => choice);
}
