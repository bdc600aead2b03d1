import { expect, it, vi } from 'vitest';
import { Api, ApiError, kioskOf, serverOf } from '../src/console/api';

const answer = (status: number, body: unknown): Response => new Response(JSON.stringify(body), { status });

it('sends the key of its session with each change, and never a password twice', async () => {
  const ask = vi.fn<typeof fetch>();
  ask.mockResolvedValueOnce(answer(200, { user: 'eleni', role: 'operator', csrf: 'k' }));
  ask.mockResolvedValueOnce(answer(200, { world: 'w' }));
  const api = new Api(ask);
  await api.signIn('eleni', 'secret');
  await api.open('kiosk-1', 'odometer');
  const [path, options] = ask.mock.calls[1]!;
  expect(path).toBe('/api/kiosks/kiosk-1/open');
  expect(options!.headers).toMatchObject({ 'X-Mechane-CSRF': 'k' });
  expect(options!.body).toBe('{"scenario":"odometer"}');
});

it('an error says what happened and what to do', async () => {
  const api = new Api(async () => answer(409, { error: 'no', remedy: 'wait' }));
  await expect(api.open('k', '')).rejects.toMatchObject({ status: 409, message: 'no', remedy: 'wait' });
  const offline = new Api(async () => Promise.reject(new TypeError('failed')));
  await expect(offline.server()).rejects.toBeInstanceOf(ApiError);
  const broken = new Api(async () => new Response('<html>', { status: 502 }));
  await expect(broken.open('k', '')).rejects.toMatchObject({ message: 'The gateway answered 502.' });
});

it('a display that refuses a setting is an error, though others took it', async () => {
  const api = new Api(async () => answer(200, { answers: [{ display: 'a', refusal: '' }, { display: 'b', refusal: 'no such value' }] }));
  await expect(api.set('k', '', { volume: '9' })).rejects.toMatchObject({ message: 'b: no such value.' });
});

it('nobody is signed in until the gateway says so', async () => {
  expect(await new Api(async () => answer(401, { error: 'sign in' })).whoAmI()).toBeNull();
});

it('reads kiosks and the server, whatever is missing', () => {
  const kiosk = kioskOf({ kiosk: 'k', displays: [{ display: 'd', link: 1, picturesPerS: 30, settings: { volume: '0.5' } }] });
  expect(kiosk.displays[0]).toMatchObject({ display: 'd', link: 'joined', pictures: 30, settings: { volume: '0.5' } });
  expect(serverOf(null).reached).toBe(false);
  expect(serverOf({ server: 's', tickUs: { p99: 120 }, scenarios: ['village'] })).toMatchObject({ reached: true, tickUsP99: 120 });
  expect(() => [kioskOf(3), serverOf([])]).not.toThrow();
});
