// The studio's names of things, against the server's tables.
import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { labelOf, placeLabel, typeLabel } from '../src/studio/help/labels';
import { studioWords } from '../src/studio/words';

const reference = readFileSync(new URL('../../../scenarios/REFERENCE.md', import.meta.url), 'utf8');
const tables = reference.split(/^### /m).slice(1).map((table) => table.split(/^## /m)[0]!);

it('every property and every type has a name for educators, in both languages', () => {
  const keys = new Set(tables.flatMap((table) => [...table.matchAll(/^\| `([A-Za-z0-9]+)` \|/gm)].map((row) => row[1]!)));
  const types = tables.map((table) => table.split('\n')[0]!).filter((name) => /^(geometry|machine|simulation|touch)\./.test(name));
  expect([keys.size > 200, types.length > 30]).toEqual([true, true]);
  for (const language of ['en', 'el'] as const) {
    expect([...keys].filter((key) => labelOf(key, language) === '')).toEqual([]);
    expect(types.filter((type) => typeLabel(type, language) === '')).toEqual([]);
  }
});

it('a place is named as the forms name it', () => {
  const place = (path: string, language: 'en' | 'el' = 'en'): string => placeLabel(path, studioWords(language), language);
  expect(place('activities/use/steps/lift/trigger:1/op')).toBe('use, lift, Rule 1, Comparison');
  expect(place('activities/use/steps/lift/trigger:1/op', 'el')).toBe('use, lift, Κανόνας 1, Σύγκριση');
  expect(place('activities/use/steps/lift/text/caption.el')).toBe('use, lift, Caption (el)');
  expect(place('agents/ROPE/drumRadius')).toBe('ROPE, Radius of the drum');
  expect(place('FRAME/mechane:haptic/stiffness')).toBe('FRAME, What touch feels, Hardness');
  expect([place('CRANK'), place('activities'), place('object')]).toEqual(['CRANK', 'activities', 'object']);
});
