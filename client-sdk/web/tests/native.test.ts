// The pages compute what the native programs do: tests/golden/browser_test.cpp writes these figures and fails when they change.
import { readFileSync } from 'node:fs';
import { Box3, Matrix4, PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { frameBox, narrowedTo, seenBox, type Camera } from '../src/scene/camera';
import { fingerTip, handDistance, kFlat, kPinching, kPointing, placeHand } from '../src/scene/hand_shape';
import { plantsOf } from '../src/scene/landscape';
import { ShortRandom } from '../src/scene/random';
import { applyEye, eyesOf, forScreen, kMono, kStereos, nearestOf, placesOf, type StereoSetup } from '../src/scene/stereo';
import { soundSources } from '../src/sound/sources';
import type { Frame } from '../src/wire/frame';
import type { KioskState, WorldEvent } from '../src/wire/messages';

interface Row {
  name: string;
  values: number[];
}
const rows: Row[] = readFileSync(new URL('../../../tests/golden/browser.txt', import.meta.url), 'utf8')
  .trim()
  .split('\n')
  .map((line) => {
    const [name, ...values] = line.split(' ');
    return { name: name!, values: values.map(Number) };
  });
const under = (name: string): Row[] => rows.filter((row) => row.name === name || row.name.startsWith(`${name}.`));
const of = (name: string): number[] => under(name)[0]!.values;

function expectNear(now: readonly number[], native: readonly number[], what = ''): void {
  expect(now.length, what).toBe(native.length);
  now.forEach((value, i) => expect(value, `${what}, number ${i}`).toBeCloseTo(native[i]!, 4));
}

it('random numbers are the same', () => {
  const random = new ShortRandom(7, 3, 11);
  expectNear(of('random').map(() => random.unit()), of('random'));
});

describe('a hand', () => {
  const bends = [['flat', kFlat], ['pointing', kPointing], ['pinching', kPinching]] as const;
  it.each(bends)('that is %s has its bones in the same places', (name, bend) => {
    const X = placeHand(bend);
    const places = X.map((x) => new Vector3().setFromMatrixPosition(x).toArray());
    places.forEach((place, s) => expectNear(place, of(`hand.${name}.${s}`), `${name} ${s}`));
    for (let f = 0; f < 5; ++f) expectNear(fingerTip(X, f).toArray(), of(`tip.${name}.${f}`), `${name}, tip ${f}`);
  });

  it('has its skin in the same place', () => {
    expect(under('skin').length).toBeGreaterThan(15);
    for (const { values } of under('skin')) expect(Math.abs(handDistance([values[0]!, values[1]!, values[2]!]))).toBeLessThan(5e-4);
  });
});

describe('a camera', () => {
  const camera: Camera = {
    p: new Vector3(0.3, 1.5, 2), target: new Vector3(0.1, 1.1, -0.2), up: new Vector3(0, 1, 0), fov: 0.8, leastAcross: 0.9, roomBelow: 1.1,
  };
  const box = new Box3(new Vector3(-0.5, 0.8, -0.4), new Vector3(0.6, 1.4, 0.5));
  const nearest = nearestOf(box, camera);
  const known = { screenWidth: 0.6, viewerDistance: 0.7, eyeDistance: 0.06 };
  const cameras: [string, Camera, number, Partial<StereoSetup>][] = [
    ['any_screen', camera, nearest, {}],
    ['narrow_eyes', camera, nearest, { eyeDistance: 0.03 }],
    ['known_screen', camera, nearest, known],
    ['framed', frameBox(box, new Vector3(0.2, 0.3, 1), 0.7), 0, {}],
    ['narrowed', narrowedTo(camera, 0.1, 0.05, 0.2, 1.5, 2), nearest, {}],
  ];
  it.each(cameras)('(%s) shows each eye the same', (name, of_, near, setup) => {
    const shown = forScreen(of_, near, { ...kMono, stereo: 'sbs', ...setup }, 1.5);
    const out = new PerspectiveCamera();
    for (const eye of ['left', 'right'] as const) {
      applyEye(shown, eye, 1.5, out);
      expectNear(out.position.toArray(), of(`camera.${name}.${eye}.at`), `${name} ${eye} at`);
      expectNear(out.projectionMatrix.elements, of(`camera.${name}.${eye}.P`), `${name} ${eye} P`);
      expectNear(new Matrix4().copy(out.matrixWorld).invert().elements, of(`camera.${name}.${eye}.V`), `${name} ${eye} V`);
    }
  });

  it('sees a box in the same place', () => {
    expectNear([nearest], of('camera.nearest'));
    const seen = seenBox(camera, box);
    expectNear([...seen.min.toArray(), ...seen.max.toArray()], of('camera.seen'));
  });
});

it('pictures of two eyes stand in one page as in a window', () => {
  expect(under('stereo').map((row) => row.name.slice('stereo.'.length))).toEqual([...kStereos]);
  for (const stereo of kStereos) {
    const place = placesOf(stereo, 1920, 1081)[0]!;
    expectNear([eyesOf(stereo).length, place.width, place.height, place.seenWidth, place.seenHeight], of(`stereo.${stereo}`), stereo);
  }
});

it('the same plants grow', () => {
  const plants = plantsOf({ middle: new Vector3(1, 0, -2), clearing: 9, seed: 5, waters: [[[10, -60], [60, 40], [30, 60]]] });
  const native = under('plant');
  expect(native.length).toBe(Math.ceil(plants.length / 10));
  native.forEach(({ values }, i) => {
    const { kind, p, height, seed } = plants[10 * i]!;
    const [nativeKind, x, y, z, ...rest] = values;
    expect(['olive', 'cypress', 'brush'][nativeKind!]).toBe(kind);
    expect(p.distanceTo(new Vector3(x, y, z))).toBeLessThan(0.01);
    expectNear([height, seed], rest, `plant ${10 * i}`);
  });
});

it('the same is heard', () => {
  const kinds = ['water', 'splash', 'creak', 'knock', 'rope', 'scrape', 'thud', 'fire', 'steam', 'bow', 'ratchet'];
  const effect = (more: object): object => ({ p: [0, 0, 0], quantity: 0, full: 1, size: 2.5, ...more });
  const effects = [
    ...['water', 'wood', 'rope', 'stone', 'fire', 'steam', 'ratchet'].map((kind) => effect({ name: kind, kind: `sound.${kind}` })),
    effect({ name: 'crank', kind: 'sound.wood', object: 0, quantity: 0xffffffff, p: [0.1, 0, 0], full: 3, size: 0.4 }),
    effect({ name: 'bow', kind: 'sound.bow', object: 0, p: [0, 2, 0] }),
  ];
  const crank = { index: 0, name: 'crank', movable: true, pose: [0, 0, 0, 0, 0, 0, 1] };
  const state = { objects: [crank], presentation: { effects } } as unknown as KioskState;
  const frame = (tick: number, pose: number[]): Frame =>
    ({ tick, quantities: [0.3], objects: [0], poses: Float64Array.from(pose), visible: [1] }) as unknown as Frame;
  const before = frame(1000, [0, 1, 0, 0, 0, 0, 1]);
  const now = frame(1050, [0.01, 1, 0.02, 0, 0, Math.sin(0.01), Math.cos(0.01)]);
  const events = [
    'grasped', 'released', 'placed', 'assembled', 'part_refused', 'pushed', 'pulled', 'lit', 'broke', 'spilled', 'fired',
  ].map((kind): WorldEvent => ({ tick: 1050, kind, subject: '', object: 'crank', value: 0.0005 }));
  const heard = soundSources(state, before, now, events);
  const [native, places] = [under('sound'), under('sound_at')];
  expect(heard.length).toBe(native.length);
  heard.forEach((source, i) => {
    const [kind, ...rest] = native[i]!.values;
    expect(source.kind).toBe(kinds[kind!]);
    expectNear([source.gain, source.pitch, source.near], rest, source.id);
    expectNear(source.p.toArray(), places[i]!.values, source.id);
  });
});
