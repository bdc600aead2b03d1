import { expect, it } from 'vitest';
import {
  axisEnd, dayColumns, funnel, markColumns, percent, seconds, timeBars, visitsAddress, visitsOf, type StepFigures,
} from '../src/console/visits';

const step = (name: string, visits: number, left: number, medianS = 0, p90S = 0): StepFigures => ({
  step: name, visits, done: visits - left, timedOut: 0, skipped: 0, left, hints: 0, time: { count: medianS ? visits : 0, medianS, p90S },
});

it('reads figures, whatever is missing', () => {
  const figures = visitsOf({
    days: 7, visits: 1, activities: [{ scenario: 's', activity: 'use', steps: [{ step: 'take', visits: 3, time: { medianS: 4 } }] }],
    recent: [{ visit: 'k7m2', remarks: [{ author: 'eleni', text: 'laughed', at: 0 }] }], exhibitNames: ['s', 3],
  });
  expect(figures.activities[0]).toMatchObject({
    activity: 'use', left: 0, steps: [{ step: 'take', visits: 3, time: { count: 0, medianS: 4 } }],
  });
  expect(figures.recent[0]!.remarks).toEqual([{ when: '', author: 'eleni', text: 'laughed', at: 0 }]);
  expect(figures.exhibitNames).toEqual(['s']);
  expect(() => [visitsOf(null), visitsOf({ recent: 3, perDay: [null] })]).not.toThrow();
});

it('an address names only what was chosen, and escapes it', () => {
  expect(visitsAddress('/api/visits', { days: 7, exhibit: '', language: '' })).toBe('/api/visits?days=7');
  expect(visitsAddress('/api/visits.csv', { days: 30, exhibit: 'a&b', language: 'el' }))
    .toBe('/api/visits.csv?days=30&exhibit=a%26b&language=el');
});

it('an axis ends at a round number that holds all', () => {
  for (const most of [0, 0.3, 1, 1.5, 2, 3, 7, 10, 11, 49.9, 99, 12345]) {
    const end = axisEnd(most);
    expect(end).toBeGreaterThanOrEqual(most);
    expect(end).toBeLessThanOrEqual(Math.max(1, 2.5 * most));
    expect(['1', '2', '5']).toContain(end.toExponential()[0]);
  }
});

it('bars lie on the axis, the median before nine of ten, and steps without a time have none', () => {
  const { end, bars } = timeBars([step('take', 5, 0, 2, 4), step('turn', 5, 1, 8, 17), step('new', 0, 0)]);
  expect(end).toBe(20);
  expect(bars.map((b) => b.step)).toEqual(['take', 'turn']);
  for (const bar of bars) expect(bar.median <= bar.p90 && bar.p90 <= 1).toBe(true);
  expect(bars[1]!.p90).toBeCloseTo(0.85);
  expect(timeBars([])).toEqual({ end: 1, bars: [] });
});

it('the funnel parts those who came to a step into who stayed and who left', () => {
  const rows = funnel([step('take', 10, 2), step('turn', 8, 3), step('fill', 5, 0)]);
  expect(rows.map((r) => [r.reached, r.left])).toEqual([[10, 2], [8, 3], [5, 0]]);
  expect(rows[0]!.stayed + rows[0]!.gone).toBeCloseTo(1);
  expect(rows[1]!.stayed).toBeCloseTo(0.5);
  expect(funnel([step('take', 0, 0)])[0]).toMatchObject({ stayed: 0, gone: 0 });
});

it('satisfied is above the middle of the scale', () => {
  expect(markColumns([1, 0, 2, 4, 8]).map((c) => c.satisfied)).toEqual([false, false, false, true, true]);
  expect(markColumns([1, 1, 1, 1]).map((c) => c.satisfied)).toEqual([false, false, true, true]);
  expect(markColumns([0, 0, 2, 4]).map((c) => c.share)).toEqual([0, 0, 0.5, 1]);
});

it('columns of days lose no visit, and each but the first is of as many days', () => {
  const days = Array.from({ length: 366 }, (_, i) => ({ day: `d${i}`, visits: i % 7, done: i % 3 }));
  for (const most of [1, 12, 31, 400]) {
    const columns = dayColumns(days, most);
    expect(columns.length).toBeLessThanOrEqual(most);
    expect(columns.reduce((sum, c) => sum + c.visits, 0)).toBe(days.reduce((sum, d) => sum + d.visits, 0));
    expect([columns[0]!.from, columns.at(-1)!.to]).toEqual(['d0', 'd365']);
  }
  expect(dayColumns([], 31)).toEqual([]);
});

it('words for people', () => {
  expect([percent(1, 3), percent(0, 0)]).toEqual(['33 %', '–']);
  expect([seconds(8.44), seconds(59.99), seconds(125)]).toEqual(['8.4 s', '1 min 00 s', '2 min 05 s']);
});
