import { Box3, Matrix4, Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { CameraHand, type CameraPage } from '../src/camera/camera_hand';
import { jointsOf, kLandmarks, parsePicture, placeInCamera, sideOf, slopeOf, type CameraPicture } from '../src/camera/landmarks';
import { Reach, sightOf, type Sight } from '../src/camera/reach';
import type { HandListener } from '../src/camera/sources';
import { Steady } from '../src/camera/steady';
import { kJoints } from '../src/xr/joints';
import { seenHand, type HandPose } from './browser/seen_hand.mjs';

const kCamera = { width: 640, height: 480, fov: 1.1 };
const pictureOf = (...poses: HandPose[]): CameraPicture =>
  parsePicture(JSON.stringify({ version: 1, ...kCamera, hands: poses.map((pose) => seenHand(pose, kCamera)) }))!;
const along = (x: number, y: number, z: number): Vector3 => new Vector3(x, y, z);

describe('landmarks of a hand', () => {
  it('tell where the hand is before the camera', () => {
    for (const p of [[0, 0, 0.5], [0.15, -0.1, 0.4], [-0.2, 0.12, 0.9]] as [number, number, number][]) {
      const picture = pictureOf({ p, bent: 0.3, turn: 0.4 });
      expect(placeInCamera(picture.hands[0]!, slopeOf(picture))!.distanceTo(along(...p))).toBeLessThan(1e-9);
    }
  });
  it('tell its side, however it is turned, unless its fingers are straight', () => {
    for (const side of ['right', 'left'] as const)
      for (const turn of [-2, -0.5, 0, 1, 3])
        for (const bent of [0.15, 0.6, 1]) {
          const [hand] = pictureOf({ p: [0, 0, 0.5], bent, turn, side }).hands;
          expect(sideOf(hand!.world)).toBe(side);
        }
    expect(sideOf(pictureOf({ p: [0, 0, 0.5], bent: 0 }).hands[0]!.world)).toBeNull();
  });
  it('become the joints of a headset, in their order', () => {
    const [hand] = pictureOf({ p: [0, 0, 0.5], bent: 0.3 }).hands;
    const joints = jointsOf(hand!.world);
    expect(joints).toHaveLength(kJoints.length);
    const at = (name: string) => joints[kJoints.indexOf(name as XRHandJoint)]!;
    expect(at('wrist')).toEqual(hand!.world[0]);
    expect(at('thumb-tip')).toEqual(hand!.world[4]);
    expect(at('index-finger-phalanx-proximal')).toEqual(hand!.world[5]);
    expect(at('pinky-finger-tip')).toEqual(hand!.world[20]);
    const [wrist, knuckle] = [at('wrist'), at('ring-finger-phalanx-proximal')];
    expect(at('ring-finger-metacarpal').distanceTo(wrist)).toBeLessThan(0.5 * knuckle.distanceTo(wrist));
  });
  it('on one ray tell nothing, and what a program sends is read with suspicion', () => {
    const good = { version: 1, ...kCamera, hands: [seenHand({ p: [0, 0, 0.5], bent: 0 }, kCamera)] };
    const flat = { ...good, hands: [{ ...good.hands[0], image: Array.from({ length: kLandmarks }, () => [0.5, 0.5]) }] };
    const seen = parsePicture(JSON.stringify(flat))!;
    expect(placeInCamera(seen.hands[0]!, slopeOf(seen))).toBeNull();
    const hand = good.hands[0]!;
    const bad: unknown[] = [
      null, 7, [], {}, { ...good, version: 2 }, { ...good, width: 0 }, { ...good, fov: 4 }, { ...good, hands: {} },
      { ...good, hands: [null] }, { ...good, hands: Array(5).fill(hand) }, { ...good, hands: [{ ...hand, image: hand.image.slice(1) }] },
      { ...good, hands: [{ ...hand, world: hand.world.map(() => [0, 0, 1e9]) }] },
      { ...good, hands: [{ ...hand, world: hand.world.map(() => ['0', 0, 0]) }] },
    ];
    for (const message of bad) expect(parsePicture(JSON.stringify(message)), JSON.stringify(message)).toBeNull();
    expect(parsePicture('{')).toBeNull();
  });
});

describe('a steady value', () => {
  it('is calm at rest and follows what moves', () => {
    const steady = new Steady({ cutoff: 1.5, perSpeed: 8 });
    const out = Array.from({ length: 300 }, (_, k) => steady.next([0.002 * (k % 2 ? 1 : -1)], k / 30)[0]!);
    expect(Math.max(...out.slice(100).map(Math.abs))).toBeLessThan(0.0008);
    const moved = Array.from({ length: 30 }, (_, k) => steady.next([0.5 * (k / 30)], 10 + k / 30)[0]!);
    expect(0.5 * (29 / 30) - moved[29]!).toBeLessThan(0.03);  // behind by under 60 ms
  });
});

const kMiddle = along(0.3, 1, -0.2);
const kWork = new Box3().setFromCenterAndSize(kMiddle, along(1.6, 0.8, 3));
const sight = (): Sight => sightOf(new Matrix4().makeTranslation(0.3, 1, 1.8), kWork);

describe('the reach of a hand', () => {
  const slope = { across: Math.tan(0.55), down: 0.75 * Math.tan(0.55) };
  it('begins at the work; right is right, up is up, towards the screen is into the picture', () => {
    const reach = new Reach();
    reach.look(sight(), 0, false);
    const middle = along(0.02, 0.03, 0.5);
    expect(reach.place(middle, slope).distanceTo(kMiddle)).toBeLessThan(1e-9);
    // The camera looks at the visitor, whose right is its picture's left.
    const moved = reach.place(middle.clone().add(along(-0.01, -0.02, -0.03)), slope).sub(kMiddle);
    expect(moved.x).toBeGreaterThan(0);
    expect(moved.y / moved.x).toBeCloseTo(2, 9);
    expect(moved.z / moved.x).toBeCloseTo(-3, 9);
    // 18 cm lead past the edge of the work, which is 0.8 m away.
    const edge = reach.place(middle.clone().add(along(-0.18, 0, 0)), slope).sub(kMiddle).x;
    expect(edge).toBeCloseTo(1.3 * 0.8, 6);
  });
  it('stays where it is while something is held, and follows the view then', () => {
    const reach = new Reach();
    const before = sight();
    reach.look(before, 0, false);
    const p = along(0, 0, 0.5);
    reach.place(p, slope);
    const R_WV = new Quaternion().setFromAxisAngle(along(0, 1, 0), 1);
    const after: Sight = { ...before, p_WM: kMiddle.clone().add(along(1, 0, 0)), R_WV };
    reach.look(after, 5, true);
    expect(reach.place(p, slope).distanceTo(kMiddle)).toBeLessThan(1e-9);
    reach.look(after, 5, false);
    expect(reach.place(p, slope).distanceTo(after.p_WM)).toBeLessThan(1e-4);
  });
  it('leaves room on all sides where a hand comes in at the edge', () => {
    const reach = new Reach();
    reach.look(sight(), 0, false);
    const edge = along(slope.across * 0.5, 0, 0.5);
    expect(reach.place(edge, slope).x).toBeLessThan(kMiddle.x - 0.1);
    reach.recenter();
    expect(reach.place(along(0, 0, 0.7), slope).distanceTo(kMiddle)).toBeLessThan(1e-9);
  });
});

describe('a hand before the camera', () => {
  function begin(stays = false) {
    const sent: DataView[] = [];
    const page = { now: 1000, left: 0, holds: false };
    let listener!: HandListener;
    const asked: CameraPage = {
      sight, holds: () => page.holds, send: (bytes) => sent.push(new DataView(bytes)), left: () => ++page.left,
    };
    const hand = new CameraHand((l) => ((listener = l), { end: () => undefined }), asked, stays, () => page.now);
    const show = (...poses: HandPose[]): void => {
      page.now += 33;
      listener.seen(pictureOf(...poses));
    };
    return { sent, page, hand, show, listener };
  }
  const wristOf = (view: DataView, from = 12): Vector3 => new Vector3().fromArray([0, 4, 8].map((k) => view.getFloat32(from + k, true)));

  it('is a whole hand in the world: its true size, the palm as the visitor has it', () => {
    const { sent, show } = begin();
    for (let k = 0; k < 60; ++k) show({ p: [0, 0, 0.5], bent: 0.3 });
    const view = sent.at(-1)!;
    expect([0, 1, 2, 4, 5, 6].map((at) => view.getUint8(at))).toEqual([2, 1, 1, 0, 1, 1]);
    expect(view.getFloat32(8, true)).toBe(-1);
    const joint = (name: string) => wristOf(view, 12 + 12 * kJoints.indexOf(name as XRHandJoint));
    expect(wristOf(view).distanceTo(kMiddle)).toBeLessThan(0.15);
    // Fingers up, the palm towards the camera: into the picture. A right hand's thumb is to the left then.
    expect(joint('middle-finger-phalanx-proximal').y - joint('wrist').y).toBeGreaterThan(0.07);
    expect(joint('thumb-tip').x).toBeLessThan(joint('pinky-finger-tip').x);
    expect(joint('index-finger-tip').z).toBeLessThan(joint('index-finger-phalanx-proximal').z);
  });
  it('keeps its side, and two hands are two', () => {
    const { sent, show } = begin();
    for (let k = 0; k < 10; ++k) show({ p: [-0.12, 0, 0.5], bent: 0.5 }, { p: [0.12, 0, 0.5], bent: 0.5, side: 'left' });
    const view = sent.at(-1)!;
    expect([view.getUint8(2), view.getUint8(4), view.getUint8(4 + 308)]).toEqual([2, 0, 1]);
    show({ p: [0.12, 0, 0.5], bent: 0, side: 'left' });
    expect([sent.at(-1)!.getUint8(2), sent.at(-1)!.getUint8(4)]).toEqual([1, 1]);
  });
  it('goes off when nobody shows a hand for long, unless it is to stay', () => {
    for (const stays of [false, true]) {
      const { hand, page, show, sent } = begin(stays);
      show({ p: [0, 0, 0.5], bent: 0.3 });
      expect(hand.state).toBe('seen');
      page.now += 181_000;
      show();
      expect([hand.state, page.left]).toEqual(['looking', stays ? 0 : 1]);
      hand.end();
      expect(sent.at(-1)!.byteLength).toBe(4);
    }
  });
  it('says what is wrong, and goes on', () => {
    const { hand, listener, show } = begin();
    listener.trouble('noProgram');
    expect(hand.state).toBe('noProgram');
    listener.trouble(null);
    show({ p: [0, 0, 0.5], bent: 0.3 });
    expect(hand.state).toBe('seen');
  });
  it('says where it is seen too seldom', () => {
    const { hand, page, show } = begin();
    for (let k = 0; k < 30; ++k, page.now += 450) show({ p: [0, 0, 0.5], bent: 0.3 });
    expect(hand.state).toBe('slow');
    for (let k = 0; k < 30; ++k) show({ p: [0, 0, 0.5], bent: 0.3 });
    expect(hand.state).toBe('seen');
  });
  it('sends no more than the gateway takes', () => {
    const { sent, page, listener } = begin();
    for (let k = 0; k < 1000; ++k, ++page.now) listener.seen(pictureOf({ p: [0, 0, 0.5], bent: 0.3 }));
    expect(sent.length).toBeGreaterThan(50);
    expect(sent.length).toBeLessThan(90);
  });
});

it('a hand reaches what lies across the view, whichever way that looks', () => {
  const aside = new Matrix4().makeRotationY(Math.PI / 2);
  expect(sightOf(aside, kWork).half_m).toBeCloseTo(1.3 * 1.5, 9);
  expect(sightOf(aside, kWork).p_WM.distanceTo(kMiddle)).toBeLessThan(1e-9);
});
