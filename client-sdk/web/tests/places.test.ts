// The page sees things where the native display does: tests/golden/places_test.cpp writes where, and fails when it changes.
import { readdirSync, readFileSync } from 'node:fs';
import { Box2, PerspectiveCamera, Vector2 } from 'three';
import { describe, expect, it, vi } from 'vitest';
import { applyTo, cornersOf, rigid } from '../src/scene/camera';
import { ModelStore } from '../src/scene/models';
import { WorldScene } from '../src/scene/world_scene';
import { kNothingKnown, type PoseArray, type SceneObject } from '../src/wire/messages';

const kRoot = new URL('../../../', import.meta.url);
const kAspect = 16 / 9;
/** A ten-thousandth of the picture's width, which is 2 here. */
const kMost = 2e-4;
const kPose = 7;
const kBox = 4;

interface Row {
  words: string[];
  values: number[];
}
const rows: Row[] = readFileSync(new URL('tests/golden/places.txt', kRoot), 'utf8').trim().split('\n').map((line) => {
  const [name, ...values] = line.split(' ');
  return { words: name!.split('|'), values: values.map(Number) };
});
const poseAt = (values: number[], at: number): PoseArray => values.slice(at, at + kPose) as PoseArray;

/** The place as a page has it when all mesh files have come; files are asked for by their places. */
async function sceneOf(place: string, objects: SceneObject[], views: Row[], levels: Row[]): Promise<WorldScene> {
  const models = new ModelStore((uri) => `http://gateway/${uri}`, () => undefined);
  const scene = new WorldScene(models);
  const effect = { name: '', kind: 'level', p: [0, 0, 0], direction: [0, 0, 1], quantity: 0 };
  const presentation = {
    world: '', activities: [{ name: 'use' }], affordances: [],
    views: views.map(({ words, values }) => ({ name: words[2]!, pose: poseAt(values, 0), fov: values[kPose]! })),
    effects: levels.map(({ words }) => ({ ...effect, node: words[2]! })),
  };
  vi.stubGlobal('self', globalThis);  // three looks there for what it decodes pictures with, which Node lacks: things are seen without
  vi.stubGlobal('fetch', (url: string) =>
    Promise.resolve(new Response(readFileSync(new URL(`scenarios/${place}/${url.replace('http://gateway/', '')}`, kRoot)))));
  await vi.waitFor(() => {
    scene.set({ ...kNothingKnown, objects, presentation: presentation as never });
    expect(scene.complete).toBe(true);
  }, { timeout: 20_000 });
  expect([...models.missing]).toEqual([]);
  return scene;
}

describe.each(readdirSync(new URL('tests/golden/scenes', kRoot)).map((file) => file.replace('.frames', '')))('%s', (place) => {
  it('has its movable things where the native display has them', async () => {
    const own = rows.filter(({ words }) => words[0] === place);
    const of = (kind: string): Row[] => own.filter(({ words }) => words[1] === kind && words.length === 3);
    const things = own.filter(({ words }) => words.length === 4);
    const objects = things.map(({ words: [, name, uri, node], values }, index) => ({
      index, name: name!, uri: uri!, hash: uri!, node: node!, pose: poseAt(values, 0), movable: values.length > kPose, title: {} }));
    const scene = await sceneOf(place, objects, of('view'), of('level'));
    const drawn = new PerspectiveCamera();
    applyTo(scene.camera, kAspect, drawn);
    drawn.updateMatrixWorld(true);
    for (const [index, { words, values }] of things.entries()) {
      if (!objects[index]!.movable) continue;
      const seen = new Box2();
      for (const p of cornersOf(scene.placedOf(index)!.model.box)) {
        const at = p.applyMatrix4(rigid(poseAt(values, kPose))).project(drawn);
        seen.expandByPoint(new Vector2(at.x, at.y));
      }
      const now = [seen.min.x, seen.min.y, seen.max.x, seen.max.y];
      values.slice(-kBox).forEach((edge, k) => expect(Math.abs(now[k]! - edge), `${words[1]}: ${now} for ${edge}`).toBeLessThan(kMost));
    }
  });
});
