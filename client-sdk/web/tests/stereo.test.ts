// The numbers are the native display's own: client-sdk/picture/camera.cpp was asked for them with the same camera, box and point.
import { Box3, PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Camera } from '../src/scene/camera';
import { applyEye, eyesOf, forScreen, inPlace, kMono, nearestOf, placesOf, stereoOf, type StereoSetup } from '../src/scene/stereo';

const camera: Camera = {
  p: new Vector3(0.3, 1.5, 2), target: new Vector3(0.1, 1.1, -0.2), up: new Vector3(0, 1, 0), fov: 0.8, leastAcross: 0.9, roomBelow: 1.1,
};
const box = new Box3(new Vector3(-0.5, 0.8, -0.4), new Vector3(0.6, 1.4, 0.5));
const kAspect = 1.5;
const point = new Vector3(0.2, 1.2, 0.5);

describe('two eyes', () => {
  const native: { setup: Partial<StereoSetup>; eyes: number; screen: number; left: number[]; right: number[]; p: number[] }[] = [
    { setup: {}, eyes: 0.056950105, screen: 2.244994432, left: [0.0423352, 0.0524277], right: [0.0254219, 0.0524277],
      p: [0.2716419, 1.5, 2.002578] },
    { setup: { screenWidth: 0.6, viewerDistance: 0.7, eyeDistance: 0.06 }, eyes: 0.284750527, screen: 3.322089477,
      left: [0.0542689, 0.0574705], right: [0.0046094, 0.0574705], p: [0.2541647, 1.6919105, 3.0683978] },
    { setup: { eyeDistance: 0.03 }, eyes: 0.03, screen: 2.244994432, left: [0.0383333, 0.0524277], right: [0.0294238, 0.0524277],
      p: [0.2850616, 1.5, 2.001358] },
  ];
  it.each(native)('see as the native display has it: %o', ({ setup, eyes, screen, left, right, p }) => {
    const nearest = nearestOf(box, camera);
    expect(nearest).toBeCloseTo(1.461028122, 7);
    const shown = forScreen(camera, nearest, { ...kMono, stereo: 'sbs', ...setup }, kAspect);
    expect(shown.eyes).toBeCloseTo(eyes, 7);
    expect(shown.screen).toBeCloseTo(screen, 7);
    const out = new PerspectiveCamera();
    for (const [eye, at] of [['left', left], ['right', right]] as const) {
      applyEye(shown, eye, kAspect, out);
      if (eye === 'left') out.position.toArray().forEach((value, k) => expect(value).toBeCloseTo(p[k]!, 5));
      const seen = point.clone().project(out);
      expect(seen.x).toBeCloseTo(at[0]!, 5);
      expect(seen.y).toBeCloseTo(at[1]!, 5);
    }
  });

  it('agree at the screen, and part behind it without crossing before it', () => {
    const shown = forScreen(camera, 0, { ...kMono, stereo: 'sbs' }, kAspect);
    const parallax = (depth: number): number => {
      const p = camera.p.clone().addScaledVector(camera.target.clone().sub(camera.p).normalize(), depth);
      const [left, right] = (['left', 'right'] as const).map((eye) => {
        const out = new PerspectiveCamera();
        applyEye(shown, eye, kAspect, out);
        return p.clone().project(out).x;
      });
      return right! - left!;
    };
    expect(parallax(shown.screen)).toBeCloseTo(0, 6);
    expect(parallax(2 * shown.screen)).toBeGreaterThan(0.001);
    expect(parallax(0.5 * shown.screen)).toBeLessThan(-0.001);
  });
});

describe('the parts of a page', () => {
  it('are read from its address, and what is not understood is mono', () => {
    expect(stereoOf(new URLSearchParams('stereo=rows&right-eye-first&screen-width=1.2&viewer-distance=x'))).toEqual({
      stereo: 'rows', rightEyeFirst: true, screenWidth: 1.2, viewerDistance: 0, eyeDistance: 0.064,
    });
    expect(stereoOf(new URLSearchParams('stereo=quad&screen-width=-1'))).toEqual(kMono);
  });
  it('are the native display\'s halves, left and upper for the left eye', () => {
    expect(placesOf('sbs', 1000, 400)).toEqual([
      { eye: 'left', left: 0, top: 0, width: 500, height: 400, seenWidth: 500, seenHeight: 400 },
      { eye: 'right', left: 500, top: 0, width: 500, height: 400, seenWidth: 500, seenHeight: 400 },
    ]);
    const [, lower] = placesOf('top-bottom-squeezed', 1000, 400);
    expect(lower).toEqual({ eye: 'right', left: 0, top: 200, width: 1000, height: 200, seenWidth: 1000, seenHeight: 400 });
    expect(inPlace(lower!, 250, 300)).toEqual({ x: 250, y: 200 });
    expect(placesOf('anaglyph', 10, 10).map((p) => p.eye)).toEqual(['middle']);
    expect(eyesOf('anaglyph')).toEqual(['left', 'right']);
    expect(placesOf('right', 10, 10).map((p) => p.eye)).toEqual(['right']);
  });
});
