import { LostHold } from '../src/studio/preview/lost_hold';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Api, ApiError } from '../src/console/api';
import { Draft } from '../src/studio/draft';
import { wantedIn } from '../src/studio/flow/flow';
import { previewOf } from '../src/studio/preview/preview';
import { PreviewDesk } from '../src/studio/preview/preview_desk.svelte';
import { lineOf, marksIn, shownTicks, since, spanOf } from '../src/studio/preview/preview_plot';
import { Series } from '../src/studio/preview/preview_series';
import { studio } from '../src/studio/requests';
import { viewOf } from '../src/studio/view';

const value = (name: string, value: unknown) => ({ kind: 'value', name, value, line: 1 });
const set = (name: string, ...children: object[]) => ({ kind: 'set', name, line: 1, children });
const rule = (name: string, quantity: string, op: string, wanted: unknown) =>
  set(name, value('quantity', quantity), value('op', op), value('value', wanted));
const view = viewOf({ revision: 3, metadata: set('mechane:scenario', set('activities', set('use', set('steps',
  set('grasp', rule('trigger:1', 'held', '>', 0.5)),
  set('turn', set('trigger:1', value('match', 'any'), rule('rule:1', 'height', '<', '0.25'), rule('rule:2', 'rate', '=', 2)),
    rule('trigger:2', 'height', '>', 'high')))))) });
const one = (v: number): Float32Array => Float32Array.of(v);
const box = { left: 10, top: 0, width: 100, height: 50 };

it('a hand that was torn from what it held is told from one that was opened, and from a step that ends the hold', () => {
  const event = (kind: string, tick = 0) => ({ tick, kind, subject: 'draft/0', object: 'DRUM', value: 0 });
  const after = (...acts: ((hold: LostHold) => void)[]): string => {
    const hold = new LostHold();
    hold.hear(event('grasped', 10), 0);
    for (const act of acts) act(hold);
    return hold.at(9_000);
  };
  const torn = (hold: LostHold): void => hold.hear(event('released', 5_000), 5_000);
  expect(after(torn)).toBe('DRUM');
  expect(after((hold) => hold.letGo(4_900), torn)).toBe('');
  expect(after((hold) => hold.letGo(1_000), torn)).toBe('DRUM');
  expect(after((hold) => hold.hear(event('step_started', 5_000), 4_999), torn)).toBe('');
  expect(after(torn, (hold) => hold.hear(event('step_started', 5_001), 5_002))).toBe('');
  expect(after(torn, (hold) => hold.hear(event('grasped', 5_400), 5_400))).toBe('');
  expect(after(torn, (hold) => hold.forget())).toBe('');
  const early = new LostHold();
  torn(early);
  expect(early.at(5_100)).toBe('');  // the hand goes back for it
});

it('reads what the gateway tells of a preview, whatever is missing', () => {
  for (const nothing of [null, [], 'x', {}, { state: 'else', still: [null, { reasons: 3 }], said: 4 }])
    expect(previewOf(nothing)).toMatchObject({ state: 'none', pace: 1, address: '', said: [] });
  const { pace, still } = previewOf({ state: 'running', pace: 0, still: [{ def: 'LOAD', reasons: [
    { kind: 'off', text: { el: 'κλειστή', en: 'off' }, path: 'activities/use' }] }] });
  expect(pace).toBe(0);
  expect(still).toEqual([{ def: 'LOAD', reasons: [
    { kind: 'off', text: { el: 'κλειστή', en: 'off' }, remedy: {}, path: 'activities/use' }] }]);
});

it('finds what each step waits for in the draft, of each rule', () => {
  expect(wantedIn(view, 'use')).toEqual([
    { step: 'grasp', quantity: 'held', op: '>', value: 0.5 },
    { step: 'turn', quantity: 'height', op: '<', value: 0.25 },
    { step: 'turn', quantity: 'rate', op: '=', value: 2 },
  ]);
  expect(wantedIn(view, 'none')).toEqual([]);
});

it('keeps a long run within bounds: its beginning, and what is new finely', () => {
  const series = new Series(64);
  series.enter('use', 'grasp', ['height']);
  for (let tick = 100; tick < 10_100; ++tick) series.add(tick, one(tick));
  const ticks = series.samples.map((s) => s.tick);
  expect(ticks.length).toBeLessThanOrEqual(64);
  expect([ticks[0], ticks.at(-1)]).toEqual([100, 10_099]);
  expect(ticks.slice(-16)).toEqual(Array.from({ length: 16 }, (_, i) => 10_084 + i));
  expect(ticks).toEqual([...ticks].sort((a, b) => a - b));
});

it('steps are bands, a paused world adds nothing, and a new world begins anew', () => {
  const series = new Series();
  series.enter('use', 'grasp', ['height']);
  for (const tick of [10, 20, 20, 20]) series.add(tick, one(1));
  expect(series.samples.length).toBe(2);
  series.enter('use', 'turn', ['height']);
  series.enter('use', 'turn', ['height']);
  series.add(30, one(2));
  expect(series.bands.map((b) => [b.step, b.from, b.to])).toEqual([['grasp', 10, 20], ['turn', 20, null]]);
  series.add(5, one(0));
  expect(series.bands.map((b) => [b.step, b.from, b.to])).toEqual([['turn', 5, null]]);
  expect(series.samples.length).toBe(1);
  series.enter('use', 'turn', ['height', 'rate']);
  expect(series.samples).toEqual([]);
});

it('the ends of a plot are round, and one value alone has room', () => {
  expect(spanOf([0.186, 1.2, NaN], 3)).toEqual({ least: 0, most: 1.5 });
  expect(marksIn({ least: 0, most: 1.5 }, 3)).toEqual([0, 0.5, 1, 1.5]);
  const { least, most } = spanOf([7, 7], 3);
  expect(least).toBeLessThan(7);
  expect(most).toBeGreaterThan(7);
  for (const values of [[], [NaN], [0], [0, 0], [-3, 1e9], [1e-9, 2e-9], [101325, 101326]]) {
    const span = spanOf(values, 3);
    expect(span.most).toBeGreaterThan(span.least);
    const marks = marksIn(span, 3);
    expect(marks.length).toBeGreaterThan(1);
    expect(marks.length).toBeLessThan(8);
  }
  expect([shownTicks(0, 4_000, 30_000), shownTicks(0, 40_000, 30_000), shownTicks(500, 4_000, 0)]).toEqual(
    [{ least: 0, most: 30_000 }, { least: 10_000, most: 40_000 }, { least: 500, most: 4_000 }]);
});

it('a line comes in from the edge, has gaps where there is no number, and does not draw a pixel twice', () => {
  const samples = [[0, 0], [10, 1], [20, NaN], [30, 1], [40, 0]].map(([tick, v]) => ({ tick: tick!, values: one(v!) }));
  const ticks = { least: 5, most: 45 };
  const unit = { least: 0, most: 1 };
  expect(since(samples, 5).map((s) => s.tick)).toEqual([0, 10, 20, 30, 40]);
  expect(since(samples, 25).map((s) => s.tick)).toEqual([20, 30, 40]);
  expect(since(samples, 99).map((s) => s.tick)).toEqual([40]);
  expect(lineOf(samples, 0, ticks, unit, box)).toBe('M10.0 50.0L22.5 0.0M72.5 0.0L97.5 50.0');
  expect(lineOf(samples, 3, ticks, unit, box)).toBe('');
  const many = Array.from({ length: 5_000 }, (_, tick) => ({ tick, values: one(tick % 2) }));
  const points = lineOf(many, 0, { least: 0, most: 5_000 }, unit, box).split('L').length;
  expect(points).toBeGreaterThan(150);
  expect(points).toBeLessThan(310);
});

let asked: [string, string, unknown][] = [];
let answer: (path: string) => object | Promise<object>;
const desks: PreviewDesk[] = [];
function deskOf(): { desk: PreviewDesk; draft: Draft } {
  const api = new Api();
  api.json = (method, path, body): Promise<unknown> => {
    asked.push([method, path.replace('/api/studio/drafts/crane', ''), body]);
    return Promise.resolve().then(() => answer(path));
  };
  const draft = new Draft({ view: () => Promise.resolve({ ...view, revision: 5 }), send: () => Promise.reject(new Error()), me: () => '' },
    () => undefined);
  desks.push(new PreviewDesk('crane', studio(api), draft));
  return { desk: desks.at(-1)!, draft };
}
beforeEach(() => {
  vi.useFakeTimers();
  asked = [];
  answer = () => ({ state: 'starting', revision: 3 });
  vi.stubGlobal('document', Object.assign(new EventTarget(), { hidden: false }));
});
afterEach(() => {
  desks.splice(0).forEach((desk) => desk.end());
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it('looks once a second while it runs, and lets go of it when nobody sees the page', async () => {
  const { desk } = deskOf();
  desk.begin();
  await vi.advanceTimersByTimeAsync(3_500);
  expect(asked.length).toBe(4);
  Object.assign(document, { hidden: true });
  document.dispatchEvent(new Event('visibilitychange'));
  await vi.advanceTimersByTimeAsync(599_000);
  const before = asked.length;
  expect(before).toBeGreaterThan(500);
  await vi.advanceTimersByTimeAsync(60_000);
  expect(asked.length - before).toBeLessThan(3);
  expect(desk.seen).toBe(false);
  Object.assign(document, { hidden: false });
  document.dispatchEvent(new Event('visibilitychange'));
  await vi.advanceTimersByTimeAsync(0);
  expect(asked.length).toBeGreaterThan(before + 1);
});

it('what is edited meanwhile goes into the world that runs, once for each state of the draft', async () => {
  const { desk, draft } = deskOf();
  const edits = (): unknown[] => asked.filter(([, path]) => path === '/preview/edit').map(([, , body]) => body);
  const looks = async (said: object): Promise<void> => {
    answer = () => ({ state: 'running', pace: 1, ...said });
    await vi.advanceTimersByTimeAsync(2_000);
  };
  await draft.refresh();
  desk.begin();
  await looks({ revision: 5 });
  await looks({ revision: 4, visit: { name: 'shown', state: 'playing' } });
  await looks({ revision: 4, kept: { revision: 5, by: 'body LOAD' } });
  expect(desk.now?.kept).toEqual({ revision: 5, by: 'body', name: 'LOAD' });
  expect(edits()).toEqual([]);
  await looks({ revision: 4, kept: { revision: 4, by: 'start' } });
  expect(edits()).toEqual([{ revision: 5 }]);
  await looks({ revision: 4 });
  expect(edits().length).toBe(1);
});

it('a visit of the draft as it is stored is played once that runs, from its beginning', async () => {
  const { desk, draft } = deskOf();
  let now: object = { revision: 4 };
  let edit: () => void = () => undefined;
  answer = (path) => {
    const said = { state: 'running', pace: 1, ...now };
    return path.endsWith('/edit') ? new Promise((done) => (edit = () => done(said))) : said;
  };
  const orders = (): string[] => asked.filter(([method]) => method === 'POST').map(([, path, body]) => `${path} ${JSON.stringify(body)}`);
  await draft.refresh();
  desk.begin();
  await vi.advanceTimersByTimeAsync(100);
  expect(orders()).toEqual(['/preview/edit {"revision":5}']);
  expect(desk.busy).toBe(false);  // what the page does by itself takes no button away
  desk.playSoon('shown');
  edit();
  await vi.advanceTimersByTimeAsync(1_500);
  expect(orders().length).toBe(1);
  now = { revision: 5 };
  await vi.advanceTimersByTimeAsync(1_000);
  expect([orders()[1], desk.playNext]).toEqual(['/preview/visit {"visit":"shown"}', '']);
  // What cannot be taken over, or began later, starts anew.
  for (const other of [{ revision: 4, kept: { revision: 5, by: 'body LOAD' } }, { revision: 5, begins: 'use/lift' }]) {
    asked = [];
    now = other;
    await vi.advanceTimersByTimeAsync(1_500);
    desk.playSoon('shown');
    now = { state: 'starting', revision: 5 };
    await vi.advanceTimersByTimeAsync(2_500);
    expect(orders()).toEqual(['/preview {"revision":5}']);
    now = { revision: 5 };
    await vi.advanceTimersByTimeAsync(1_500);
    expect(orders().slice(1)).toEqual(['/preview/visit {"visit":"shown"}']);
  }
  // Where that is refused, nothing is played later.
  now = { revision: 4, kept: { revision: 5, by: 'failed' } };
  await vi.advanceTimersByTimeAsync(1_500);
  answer = () => Promise.reject(new ApiError(503, 'the shelf is full', ''));
  desk.playSoon('shown');
  await vi.advanceTimersByTimeAsync(0);
  expect([desk.playNext, desk.trouble]).toEqual(['', 'the shelf is full']);
});

it('another author who was quicker is no trouble', async () => {
  const { desk, draft } = deskOf();
  await draft.refresh();
  answer = (path) => {
    if (path.endsWith('/edit')) throw new ApiError(409, 'the draft was changed meanwhile', '');
    return { state: 'running', revision: 4 };
  };
  desk.begin();
  await vi.advanceTimersByTimeAsync(2_000);
  expect(asked.some(([, path]) => path === '/preview/edit')).toBe(true);
  expect(desk.trouble).toBe('');
});

it('orders are done one after another, and a late answer to an older look changes nothing', async () => {
  const { desk } = deskOf();
  let late = (_: object): void => undefined;
  answer = () => new Promise<object>((done) => (late = done));
  desk.begin();
  await vi.advanceTimersByTimeAsync(0);
  const old = late;
  answer = () => ({ state: 'starting', revision: 3, pace: 0 });
  const orders = [desk.setPace(0), desk.step(10), desk.step(1), desk.step(1), desk.step(100)];
  expect(desk.busy).toBe(true);
  await vi.advanceTimersByTimeAsync(0);
  await Promise.all(orders);
  expect(desk.busy).toBe(false);
  expect(asked.slice(1).map(([, path, body]) => [path, body])).toEqual([
    ['/preview/pace', { pace: 0 }], ['/preview/pace', { ticks: 10 }], ['/preview/pace', { ticks: 1 }], ['/preview/pace', { ticks: 1 }]]);
  old({ state: 'none' });
  await vi.advanceTimersByTimeAsync(0);
  expect(desk.now).toMatchObject({ state: 'starting', pace: 0 });
});

it('a draft that somebody else has changed is shown as it is now; who is signed out is asked to sign in', async () => {
  const { desk, draft } = deskOf();
  answer = () => Promise.reject(new ApiError(409, 'the draft was changed meanwhile', 'look at it'));
  await desk.start(3, '');
  await vi.advanceTimersByTimeAsync(0);
  expect(desk.trouble).toBe('the draft was changed meanwhile; look at it');
  expect(draft.state.view?.revision).toBe(5);
  answer = () => Promise.reject(new ApiError(401, 'nobody is signed in', ''));
  await desk.stop();
  expect(draft.state.signedOut).toBe(true);
});
