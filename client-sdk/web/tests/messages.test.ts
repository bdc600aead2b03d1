import { describe, expect, it } from 'vitest';
import { kNothingKnown, parseMessage, reduce, textIn, type KioskState } from '../src/wire/messages';

const after = (...messages: object[]): KioskState =>
  messages.map((m) => parseMessage(JSON.stringify(m))!).reduce(reduce, kNothingKnown);

describe('the state', () => {
  it('keeps the last of each message', () => {
    const state = after(
      { type: 'hello', mayPoint: true, display: 'web-1' },
      { type: 'link', state: 'searching' },
      { type: 'link', state: 'joined' },
      { type: 'world', world: 'a', scenario: 's', agents: ['TURN'], quantities: [{ name: 'q', unit: 'l' }] },
    );
    expect(state).toMatchObject({ mayPoint: true, display: 'web-1', link: 'joined' });
    expect(state.world).toMatchObject({ world: 'a', agents: ['TURN'], quantities: [{ name: 'q', unit: 'l' }] });
  });

  it('forgets a world of before with its pointer and presentation', () => {
    const state = after(
      { type: 'world', world: 'a' },
      { type: 'presentation', world: 'a', views: [] },
      { type: 'pointer', phase: 'holding', p: [0, 0, 0] },
      { type: 'world', world: 'b' },
    );
    expect(state.pointer).toBeNull();
    expect(state.presentation).toBeNull();
  });

  it('knows each hand of a page', () => {
    const hand = { phase: 'holding', object: 4, p: [0, 1, 0] };
    const { pointer } = after({ type: 'pointer', ...hand, others: [{ ...hand, object: 5 }, null] });
    expect([pointer!, ...pointer!.others].map((h) => [h.phase, h.object])).toEqual([['holding', 4], ['holding', 5]]);
    expect(after({ type: 'pointer', ...hand }).pointer!.others).toEqual([]);
  });

  it('is whole whatever a message lacks or has wrong', () => {
    for (const type of ['hello', 'link', 'world', 'scene', 'presentation', 'overlay', 'pointer', 'bye']) {
      for (const bad of [{}, { objects: 1, views: 'x', effects: {}, panel: [], gauges: [null], pose: 3, p: [NaN], state: 'x' }])
        expect(() => after({ type, ...bad })).not.toThrow();
    }
    const [object] = after({ type: 'scene', objects: [{ index: 1, pose: [1, 2] }] }).objects;
    expect(object!.pose).toEqual([0, 0, 0, 0, 0, 0, 1]);
  });

  it('lets no gauge leave its scale', () => {
    const { overlay } = after({ type: 'overlay', gauges: [{ label: 'a', fraction: 7, goal: -3 }, { label: 'b', fraction: 0.5 }] });
    expect(overlay!.gauges.map((g) => [g.fraction, g.goal])).toEqual([[1, 0], [0.5, null]]);
  });

  it('takes a gauge of an older gateway as one that begins at 0', () => {
    const { overlay } = after({ type: 'overlay', gauges: [{ label: 'a', begin: '-5', end: '20' }, { label: 'a', end: '20' }] });
    expect(overlay!.gauges.map((g) => [g.begin, g.end])).toEqual([['-5', '20'], ['0', '20']]);
  });

  it('is not changed by a message of a newer gateway', () => {
    expect(after({ type: 'hologram', x: 1 })).toEqual(kNothingKnown);
  });

  it('ends a farewell when the gateway greets again', () => {
    expect(after({ type: 'bye', reason: 'r', remedy: 'm' }).bye).toEqual({ reason: 'r', remedy: 'm' });
    expect(after({ type: 'bye', reason: 'r' }, { type: 'hello' }).bye).toBeNull();
  });
});

it('a text that is no message is none', () => {
  for (const json of ['', '{', '[]', '3', 'null', '{"type":3}', '{}']) expect(parseMessage(json)).toBeNull();
});

it('a text is in the language, else in English, else in any', () => {
  expect(textIn({ el: 'α', en: 'a' }, 'el')).toBe('α');
  expect(textIn({ el: 'α', en: 'a' }, 'fr')).toBe('a');
  expect(textIn({ el: 'α' }, 'fr')).toBe('α');
  expect(textIn({}, 'fr')).toBe('');
});
