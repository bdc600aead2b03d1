import { Box3, BoxGeometry, Group, Matrix4, Mesh, PerspectiveCamera, Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { applyTo, aboveCaption, cameraAt, frameBox, halfTan, narrowedTo, seenBox, viewOf } from '../src/scene/camera';
import { effectsOf, flowOf, levelOf } from '../src/scene/effects';
import { fingerTip, handDistance, kPinching, kPointing, placeHand } from '../src/scene/hand_shape';
import { isTakeable, pixelOf, placeToTake, underFinger, type PickScene } from '../src/scene/picking';
import { QualityGovernor } from '../src/scene/quality';
import { ropeRings } from '../src/scene/ropes';
import { StepView, workplace } from '../src/scene/step_view';
import { decodeFrame } from '../src/wire/frame';
import type { Affordance, Effect, PoseArray, Presentation, World } from '../src/wire/messages';
import { frameBytes } from './bytes';

const kStill: [number, number, number, number, number, number, number] = [0, 0, 0, 0, 0, 0, 1];
const box = new Box3(new Vector3(-1, 0, -1), new Vector3(1, 1, 1));

describe('a camera', () => {
  it('shows the whole box that it frames, whatever the picture has for a shape', () => {
    for (const aspect of [0.5, 1, 16 / 9]) {
      const camera = frameBox(box, new Vector3(0.2, 0.3, 1), 0.7);
      const drawn = new PerspectiveCamera();
      applyTo(camera, aspect, drawn);
      for (let corner = 0; corner < 8; ++corner) {
        const p = new Vector3(corner & 1 ? 1 : -1, corner & 2 ? 1 : 0, corner & 4 ? 1 : -1).project(drawn);
        expect(Math.max(Math.abs(p.x), Math.abs(p.y))).toBeLessThanOrEqual(1);
      }
    }
  });

  it('above a caption keeps its upper edge and shows an eighth more below', () => {
    const usual = cameraAt({ name: '', pose: [0, 1, 4, 0, 0, 0, 1], fov: 0.8 }, box);
    const wide = aboveCaption(usual);
    const at = (camera: typeof usual, p: Vector3): number => {
      const drawn = new PerspectiveCamera();
      applyTo(camera, 2, drawn);
      return p.clone().project(drawn).y;
    };
    const top = new Vector3(0, 1 + 3 * Math.tan(0.4), 1);
    expect(at(usual, top)).toBeCloseTo(1, 5);
    expect(at(wide, top)).toBeCloseTo(1, 1);
    expect(at(wide, new Vector3(0, 1 - 3 * Math.tan(0.4), 1))).toBeGreaterThan(-0.8);
  });

  it('is kept as the view that shows just the same above a caption', () => {
    for (const pose of [[0, 1, 4, 0, 0, 0, 1], [2, 1.5, 3, -0.12, 0.28, 0.035, 0.95]] as PoseArray[]) {
      const shown = aboveCaption(cameraAt({ name: '', pose, fov: 0.8 }, box));
      const kept = viewOf(shown, 1.6);
      expect(kept.fov).toBeCloseTo(0.8, 9);
      const turn = new Quaternion(...kept.pose.slice(3)).angleTo(new Quaternion(...pose.slice(3)).normalize());
      expect(turn).toBeLessThan(1e-6);
      expect(kept.pose.slice(0, 3)).toEqual(pose.slice(0, 3));
    }
  });

  it('narrowed to a window shows just that window', () => {
    const usual = cameraAt({ name: '', pose: [0, 1, 4, 0, 0, 0, 1], fov: 0.8 }, box);
    const half = 0.5 * halfTan(usual, 1.5);
    const seen = seenBox(narrowedTo(usual, 0.1, 0.05, half, 1.5, 3), 
      new Box3().setFromCenterAndSize(new Vector3(0.3, 1.15, 1), new Vector3()));
    expect(seen.min.x).toBeCloseTo(0, 5);
    expect(seen.min.y).toBeCloseTo(0, 5);
  });

  it('follows where hands work, and shows all again when they have gone', () => {
    const usual = cameraAt({ name: '', pose: [0, 1, 4, 0, 0, 0, 1], fov: 0.8 }, box);
    const view = new StepView();
    const work = new Box3().setFromCenterAndSize(new Vector3(0.5, 0.8, 0), new Vector3(0.2, 0.2, 0.2));
    view.follow(work, usual, 1.5, 0);
    expect(view.isNarrow).toBe(true);
    for (let t = 0.02; t < 20; t += 0.02) view.follow(new Box3(), usual, 1.5, t);
    expect(view.shown(usual, 1.5)).toBe(usual);
  });
});

describe('where hands work', () => {
  const affordances: Affordance[] = [
    { kind: 'taken', agent: 'A', object: 1, base: null, AJ: kStill, BJ: kStill },
    { kind: 'placed', agent: 'A', object: 1, base: null, AJ: [5, 0, 0, 0, 0, 0, 1], BJ: kStill },
  ];
  const standing = (): { X: Matrix4; box: Box3 } => ({ X: new Matrix4().makeTranslation(0, 1, 0), box });

  it('is what can be taken and where it belongs, while no hand is there', () => {
    const seen = workplace([], affordances, ['A'], standing).work;
    expect([seen.min.x, seen.max.x, seen.max.y]).toEqual([-1, 5.06, 2]);
  });
  it('is nowhere when nothing can be taken', () => {
    const hand = { box: new Box3(new Vector3(), new Vector3(1, 1, 1)), holding: false };
    const { seen, work } = workplace([hand], affordances, [], standing);
    expect(work.isEmpty()).toBe(true);
    expect(seen).toEqual([hand.box]);  // hands stay visible
  });
  it('is the hand and the nearest place of the thing', () => {
    const hand = { box: new Box3().setFromCenterAndSize(new Vector3(3, 1, 0), new Vector3()), holding: false };
    const { seen, work } = workplace([hand], affordances, ['A'], standing);
    expect(seen[0]).toBe(hand.box);
    expect([work.min.x, work.max.x]).toEqual([1, 3]);
  });
});

describe('a pick', () => {
  const things = new Group();
  const thing = (x: number, z: number, size: number): Group => {
    const group = new Group();
    group.add(new Mesh(new BoxGeometry(size, size, size)));
    group.position.set(x, 0, z);
    things.add(group);
    return group;
  };
  const [near, far] = [thing(0, 0, 1), thing(1.2, 0, 0.08)];
  things.updateMatrixWorld(true);
  const camera = new PerspectiveCamera(50, 1, 0.1, 100);
  camera.position.set(0, 0, 6);
  camera.updateMatrixWorld(true);
  const scene = (takeable: number[]): PickScene => ({
    targets: [{ group: near, object: 1 }, { group: far, object: 2 }],
    takeable: (object) => takeable.includes(object),
    camera,
    width: 600,
    height: 600,
  });

  it('has the place and the normal of the surface', () => {
    const { seen } = underFinger(scene([]), 300, 300);
    expect(seen!.object).toBe(1);
    expect(seen!.p.z).toBeCloseTo(0.5, 5);
    expect(seen!.n.z).toBeCloseTo(1, 5);
  });
  it('takes a small thing beside the finger, but not one that is not to be taken', () => {
    const at = pixelOf(camera, 600, 600, new Vector3(1.2, 0, 0))!;
    expect(underFinger(scene([2]), at.x + 9, at.y).takeable?.object).toBe(2);
    expect(underFinger(scene([]), at.x + 9, at.y).takeable).toBeNull();
    expect(underFinger(scene([2]), at.x + 40, at.y).takeable).toBeNull();
  });
  it('finds where a thing can be taken: a crank by its far end', () => {
    const middle = placeToTake(scene([1]), 1, null)!;
    expect(Math.hypot(middle.x - 300, middle.y - 300)).toBeLessThan(60);
    const end = placeToTake(scene([1]), 1, { p: new Vector3(-0.5, 0, 0), d: new Vector3(0, 1, 0) })!;
    expect(end.x).toBeGreaterThan(300);
  });
  it('is of what the step lets be taken', () => {
    const affordances = [{ kind: 'taken', agent: 'A', object: 1, base: null, AJ: kStill, BJ: kStill }] as Affordance[];
    const presentation = { affordances } as unknown as Presentation;
    expect(isTakeable(presentation, ['A'], 1, true)).toBe(true);
    expect(isTakeable(presentation, [], 1, true)).toBe(false);
    expect(isTakeable(presentation, ['A'], 1, false)).toBe(false);
    expect(isTakeable(presentation, ['A'], 2, true)).toBe(false);
  });
});

describe('effects', () => {
  const effect = (more: Partial<Effect>): Effect => ({
    name: 'e', kind: 'stream', object: null, node: '', p: [0, 2, 0], direction: [1, 0, 0], quantity: 0, full: 1,
    size: 0.05, speed: 0.5, ...more,
  });
  const world = { quantities: [{ name: 'q', unit: 'l/s' }] } as unknown as World;
  const frame = decodeFrame(frameBytes({ quantities: [0.5] }))!;
  const none = decodeFrame(frameBytes({ quantities: [0] }))!;
  const presentation = (...effects: Effect[]): Presentation => ({ effects }) as unknown as Presentation;
  const still = (): Matrix4 => new Matrix4();

  it('a stream is as wide as its flow needs, and none without a flow', () => {
    const [stream] = effectsOf(presentation(effect({})), world, frame, still, 0).streams;
    expect((Math.PI / 4) * stream!.width * 0.45 * stream!.width * 0.5).toBeCloseTo(0.5e-3, 8);
    expect(effectsOf(presentation(effect({})), world, none, still, 0).streams).toEqual([]);
  });
  it('water rises with its quantity, and rivers flow level', () => {
    expect(levelOf(presentation(effect({ kind: 'level', node: 'W' })), frame, 'W')).toBe(0.5);
    expect(levelOf(presentation(effect({ kind: 'level', node: 'W' })), frame, 'V')).toBeNull();
    expect(flowOf(presentation(effect({ kind: 'flow', node: 'W', direction: [3, 4, 0], speed: 2 })), 'W').toArray()).toEqual([2, 0, 0]);
  });
  it('steam is as strong as its quantity', () => {
    const { particles } = effectsOf(presentation(effect({ kind: 'steam', full: 2 })), world, frame, still, 0);
    expect(particles.map((p) => p.intensity)).toEqual([0.25]);
  });
});

it('a rope has rings from its tied end, rounded at its corners, none for nonsense', () => {
  const rings = ropeRings({ diameter: 0.02, points: new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0]) });
  expect(rings[0]!.p.toArray()).toEqual([1, 1, 0]);
  expect(rings.at(-1)!.p.toArray()).toEqual([0, 0, 0]);
  expect(rings.length).toBeGreaterThan(5);
  expect(ropeRings({ diameter: 0.02, points: new Float32Array([NaN, 0, 0, 1, 0, 0]) })).toEqual([]);
});

it('the fingers of a pinching hand meet, and skin lies on the bones', () => {
  const pinch = placeHand(kPinching);
  expect(fingerTip(pinch, 0).distanceTo(fingerTip(pinch, 1))).toBeLessThan(0.03);
  expect(fingerTip(placeHand(kPointing), 1).x).toBeGreaterThan(0.17);
  expect(handDistance([0.05, 0, 0])).toBeLessThan(0);
  expect(handDistance([0.05, 0.05, 0])).toBeGreaterThan(0.02);
});

describe('quality', () => {
  const run = (governor: QualityGovernor, interval: number, seconds: number, from = 0): number => {
    let now = from;
    for (; now < from + 1000 * seconds; now += interval) governor.drawn(interval, now);
    return now;
  };
  it('steps down when pictures take too long, and up again when there is time for long', () => {
    const governor = new QualityGovernor('a card');
    let now = run(governor, 60, 6);
    expect(governor.quality.name).not.toBe('high');
    const low = governor.quality.name;
    now = run(governor, 16, 10, now);
    expect(governor.quality.name).toBe(low);
    run(governor, 16, 300, now);
    expect(governor.quality.name).toBe('high');
  });
  it('begins at the least without a graphics card', () => {
    expect(new QualityGovernor('ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device))').quality.name).toBe('least');
  });
  it('takes a pause for what it is', () => {
    const governor = new QualityGovernor('a card');
    for (let i = 0; i < 200; ++i) governor.drawn(5_000, 5_000 * i);
    expect(governor.quality.name).toBe('high');
  });
});
