import { expect, it, vi } from 'vitest';
import { Api, kioskOf, serverOf } from '../src/console/api';
import { ExhibitDesk } from '../src/console/exhibit_desk.svelte';
import { exhibitsOf, lasting, otherTitles, titleOf, worldsOf } from '../src/console/exhibits';
import { deviceLine, faultsOf } from '../src/console/faults';
import { bytesOf, hoursFrom, operationsOf, orders } from '../src/console/operations';

const answer = (status: number, body: unknown): Response => new Response(JSON.stringify(body), { status });

it('a fault has its place and a remedy, and a healthy museum has none', () => {
  const healthy = serverOf({ server: 's', realtime: true, recordsOk: true, wakeUs: { p99: 40 } });
  const display = { display: 'wall', link: 1, picturesPerS: 30, settings: {} };
  expect(faultsOf(healthy, [kioskOf({ kiosk: 'k', displays: [display] })])).toEqual([]);
  const ill = serverOf({
    server: 's', realtime: false, recordsOk: false, overload: 'too many worlds', wakeUs: { p99: 900 }, inputGapMs: 60,
  });
  const lost = kioskOf({ kiosk: 'k', displays: [{ ...display, link: 3, picturesPerS: 5, missing: ['a.glb'], lastWarning: 'disk' }] });
  const faults = faultsOf(ill, [lost]);
  expect(faults.map((f) => f.where)).toEqual([...Array<string>(5).fill('Server'), ...Array<string>(4).fill('k, wall')]);
  expect(faults.every((f) => f.remedy !== '')).toBe(true);
  expect(faultsOf(serverOf(null), []).length).toBe(1);
});

it('a haptic device that is ill is a fault, and one that rests is none', () => {
  const states = ['preparing', 'ready', 'let-go', 'not-ready', 'uncalibrated', 'warm', 'hot', 'lost', 'of a later version'];
  const devices = states.map((state, user) => ({ user, name: user === 3 ? '' : 'Falcon', state, kind: 'one-point' }));
  const kiosk = kioskOf({ kiosk: 'k', displays: [], devices });
  const faults = faultsOf(null, [kiosk]);
  expect(faults.map((f) => f.where)).toEqual(['k, device 4', ...Array<string>(4).fill('k, Falcon')]);
  expect(kiosk.devices.map((device) => deviceLine(device).health).join()).toBe('good,good,good,warn,warn,warn,bad,bad,good');
  expect(deviceLine({ user: 0, name: 'CyberGrasp', state: 'let-go', kind: 'glove', side: 'left' }).words).toBe('left glove, let go');
  expect(kioskOf({}).devices).toEqual([]);
});

it('hours are sent as they are written, without blanks', () => {
  expect(hoursFrom(' 09:00 – 13:00, 17:00-24:00 ,')).toEqual(['09:00-13:00', '17:00-24:00']);
  expect(hoursFrom('')).toEqual([]);
  expect(bytesOf('Γειά')).toBe(8);
});

it('reads what is ordered, whatever is missing', () => {
  const read = operationsOf({ zone: 'EET', hours: { museum: { week: { monday: ['10:00-18:00'] } }, wake: { k: 'm' } },
    maintenance: { k: null, j: 5 } });
  expect(read.hours.museum?.week.monday).toEqual(['10:00-18:00']);
  expect(read.hours.museum?.week.sunday).toEqual([]);
  expect(read.maintenance).toEqual({ k: null, j: 5 });
  expect(() => [operationsOf(null), operationsOf({ messages: [3], changes: 'x', kiosks: {} })]).not.toThrow();
});

it('says until when, and is content with a gateway without records', async () => {
  const ask = vi.fn<typeof fetch>(async () => answer(200, {}));
  await orders(new Api(ask)).maintain('kiosk-1', true, { minutes: 15 });
  expect(ask.mock.calls[0]![0]).toBe('/api/kiosks/kiosk-1/maintenance');
  expect(ask.mock.calls[0]![1]!.body).toBe('{"on":true,"minutes":15}');
  expect(await orders(new Api(async () => answer(404, { error: 'no records' }))).visitsOfADay()).toBeNull();
});

it('reads exhibits, whatever is missing, and tells of their worlds', () => {
  const told = exhibitsOf({ server: 's', exhibits: [
    { id: 'screw', title: { el: 'Κοχλίας', en: 'Screw' }, worlds: 2, formerWorlds: 1 },
    { id: 'crane', title: {} }, { title: { en: 'no id' } },
  ] });
  const [screw, crane] = told.exhibits;
  expect(told.exhibits.map(titleOf)).toEqual(['Screw', 'crane']);
  expect(otherTitles(screw!)).toEqual([['el', 'Κοχλίας']]);
  expect(worldsOf(screw!)).toBe('2 worlds open, 1 world with a visit that finishes on its former form');
  expect(worldsOf(crane!)).toBe('not open');
  expect(() => [exhibitsOf(null), exhibitsOf({ exhibits: [3], loadable: 'x' })]).not.toThrow();
  expect([lasting(42.9), lasting(185)]).toEqual(['42 s', '3 min 5 s']);
});

it('an order says whether the file was another one, and a refusal where it is wrong', async () => {
  let hash = 'a';
  const exhibits = (): object => ({ server: 's', exhibits: [{ id: 'screw', contentHash: hash }], loadable: ['crane'] });
  const posted: unknown[] = [];
  const desk = new ExhibitDesk(new Api(async (path, init) => {
    if (init?.method !== 'POST') return answer(200, exhibits());
    posted.push([path, init.body]);
    if (!String(path).endsWith('/load')) return answer(200, {});
    return answer(409, { error: 'no body "X"', place: 'crane.x3d:7', remedy: 'name one' });
  }));
  await desk.look();
  await desk.order('screw', 'replace');
  expect(desk.actions.screw!.said).toMatch(/has not changed/);
  hash = 'b';
  await desk.order('screw', 'replace', true);
  expect(desk.actions.screw!.said).toMatch(/new form is in use/);
  await desk.order('crane', 'load');
  expect([desk.actions.crane!.trouble, desk.actions.crane!.said]).toEqual([true, 'No body "X". Where: crane.x3d:7. Name one.']);
  expect(posted).toEqual([
    ['/api/exhibits/screw/replace', '{"now":false}'], ['/api/exhibits/screw/replace', '{"now":true}'],
    ['/api/exhibits/crane/load', '{"now":false}'],
  ]);
  await desk.order('gone', 'retire');
  expect(desk.others()).toEqual(['crane', 'gone']);
});
