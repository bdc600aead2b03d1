import { expect, it } from 'vitest';
import { aboutOf, catalogueOf, isFiltered, kEverything, metaCommands, queryText, wordsIn, type About } from '../src/studio/shelf/catalogue';
import { catalogueWords } from '../src/studio/shelf/catalogue_words';

const about: About = { description: 'A gear', licence: 'CC0-1.0', author: 'Ελένη', source: '', tags: ['wood', 'ξύλο'], languages: [] };

it('asks only for what is chosen, and for all of its letters', () => {
  expect([queryText(kEverything), isFiltered(kEverything)]).toEqual(['', false]);
  const asked = new URLSearchParams(queryText({ ...kEverything, text: 'γρανάζι & 100%', licence: '-' }));
  expect([...asked]).toEqual([['text', 'γρανάζι & 100%'], ['licence', '-']]);
});
it('reads the catalogue, whatever is missing in it', () => {
  expect(catalogueOf(null)).toEqual({ items: [], all: 0, tags: [], licences: [], languages: [], notice: '' });
  const [item] = catalogueOf({ items: [{ kind: 'mesh', path: 'a/files/b.glb', about, uses: [{ place: 'Inline B', line: 3, exhibit: 'a',
    draft: true }] }] }).items;
  expect(item).toMatchObject({ kind: 'mesh', about, bytes: 0, uses: [{ place: 'Inline B', line: 3, exhibit: 'a', draft: true }] });
  expect(catalogueOf({ items: [{ kind: 'draft' }], notice: { error: 'x is damaged', remedy: 'mend it' } })).toMatchObject(
    { items: [{ kind: 'exhibit', about: aboutOf({}) }], notice: 'x is damaged; mend it' });
});
it('writes of an exhibit only what is new of it', () => {
  expect(metaCommands(about, about)).toEqual([]);
  expect(metaCommands(about, { ...about, licence: '', tags: wordsIn(' wood,, γρανάζι  μικρό,wood') })).toEqual([
    { op: 'meta', name: 'license', value: '' }, { op: 'meta', name: 'subject', value: 'wood, γρανάζι μικρό' }]);
});
it('has its words in both languages', () => {
  const [el, en] = [catalogueWords('el'), catalogueWords('en')];
  expect(Object.keys(el)).toEqual(Object.keys(en));
  for (const [key, words] of Object.entries(el)) if (typeof words === 'string') expect(words, key).toMatch(/[α-ωά-ώ]/);
  expect(el.use('γερανός', true, 'Inline A', 3)).toBe('γερανός (σχέδιο): Inline A, γραμμή 3');
});
