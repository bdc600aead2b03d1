import { PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Camera } from '../src/scene/camera';
import { applyEye, eyesOf, forScreen, inPlace, kMono, placesOf, stereoOf } from '../src/scene/stereo';

const camera: Camera = {
  p: new Vector3(0.3, 1.5, 2), target: new Vector3(0.1, 1.1, -0.2), up: new Vector3(0, 1, 0), fov: 0.8, leastAcross: 0.9, roomBelow: 1.1,
};
const kAspect = 1.5;

describe('two eyes', () => {
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
