// How the pictures of two eyes become one picture, and where each eye's part of it lies: client-sdk/picture/stereo.cpp and camera.cpp.
import { Box3, Matrix4, PerspectiveCamera } from 'three';
import { axesOf, cornersOf, halfTan, kFar, kNear, type Camera } from './camera';

export const kStereos = [
  'mono', 'sbs', 'top-bottom', 'sbs-squeezed', 'top-bottom-squeezed', 'anaglyph', 'rows', 'left', 'right',
] as const;
export type Stereo = (typeof kStereos)[number];
export type Eye = 'middle' | 'left' | 'right';

export interface StereoSetup {
  stereo: Stereo;
  /** Rows: the uppermost one is the right eye's. */
  rightEyeFirst: boolean;
  /** Of the area that one eye's picture fills, metres; 0: not known. */
  screenWidth: number;
  /** From the eyes to the screen, metres; 0: not known. */
  viewerDistance: number;
  /** Between the eyes, metres. */
  eyeDistance: number;
}
export const kMono: StereoSetup = { stereo: 'mono', rightEyeFirst: false, screenWidth: 0, viewerDistance: 0, eyeDistance: 0.064 };

const kMostParallaxBehind = 0.02;
const kMostParallaxBefore = 0.03;
/** Nobody works nearer to the eyes than this, whatever a box says. */
const kArm_m = 0.3;

/** From a page's address: ?stereo=sbs&screen-width=1.2&viewer-distance=2. What it does not understand is as if it were not there. */
export function stereoOf(params: URLSearchParams): StereoSetup {
  const metres = (name: string, most: number, otherwise: number): number => {
    const value = Number(params.get(name) ?? '');
    return value > 0 && value <= most ? value : otherwise;
  };
  return {
    stereo: kStereos.find((one) => one === params.get('stereo')) ?? 'mono',
    rightEyeFirst: params.has('right-eye-first'),
    screenWidth: metres('screen-width', 50, 0),
    viewerDistance: metres('viewer-distance', 50, 0),
    eyeDistance: metres('eye-distance', 0.1, kMono.eyeDistance),
  };
}

export function eyesOf(stereo: Stereo): Eye[] {
  if (stereo === 'mono') return ['middle'];
  return stereo === 'left' || stereo === 'right' ? [stereo] : ['left', 'right'];
}
/** Both eyes' pictures share all pixels. */
export const isMixed = (stereo: Stereo): boolean => stereo === 'anaglyph' || stereo === 'rows';

/** A part of the page, in its pixels, and the pixels in which it is laid out: a 3D screen stretches what is squeezed. */
export interface EyePlace {
  /** Of whom a finger in it takes the view. Where both share the pixels, an eye in the middle stands for both. */
  eye: Eye;
  left: number;
  top: number;
  width: number;
  height: number;
  seenWidth: number;
  seenHeight: number;
}

/** One place for each time that words are written and fingers are looked for. */
export function placesOf(stereo: Stereo, width: number, height: number): EyePlace[] {
  const place = (eye: Eye, left: number, top: number, w: number, h: number): EyePlace => {
    const squeezed = stereo.endsWith('-squeezed');
    return { eye, left, top, width: w, height: h, seenWidth: squeezed ? width : w, seenHeight: squeezed ? height : h };
  };
  if (stereo.startsWith('sbs')) {
    const half = Math.floor(width / 2);
    return [place('left', 0, 0, half, height), place('right', half, 0, half, height)];
  }
  if (stereo.startsWith('top-bottom')) {
    const half = Math.floor(height / 2);
    return [place('left', 0, 0, width, half), place('right', 0, half, width, half)];
  }
  return [place(isMixed(stereo) ? 'middle' : eyesOf(stereo)[0]!, 0, 0, width, height)];
}
/** From the page's pixels to those of the place; beyond its edges it goes on. */
export const inPlace = (place: EyePlace, x: number, y: number): { x: number; y: number } => ({
  x: ((x - place.left) * place.seenWidth) / place.width,
  y: ((y - place.top) * place.seenHeight) / place.height,
});

/** Distance along the axis of the nearest of what visitors look at; 0: not known. */
export function nearestOf(box: Box3, camera: Camera): number {
  if (box.isEmpty()) return 0;
  const ahead = camera.target.clone().sub(camera.p).normalize();
  return Math.max(Math.min(...cornersOf(box).map((p) => ahead.dot(p.sub(camera.p)))), kArm_m);
}

/** A camera for two eyes: distances in metres of W. */
export interface StereoCamera extends Camera {
  eyes: number;
  /** What lies there has no parallax. */
  screen: number;
}

/** Limits the eyes' distance to a comfortable depth, for infinitely far things and for the nearest. */
function comfortableEyes(screen: number, half: number, nearest: number, wanted: number, aspect: number): number {
  const width = 2 * half * screen * aspect;
  let most = kMostParallaxBehind * width;
  if (nearest > 0 && nearest < screen) most = Math.min(most, (kMostParallaxBefore * width * nearest) / (screen - nearest));
  return Math.min(wanted, most);
}

/** The camera for a screen. On one of unknown size only the eyes' distance counts, within what is comfortable. */
export function forScreen(camera: Camera, nearest: number, setup: StereoSetup, aspect: number): StereoCamera {
  const half = halfTan(camera, aspect);
  const distance = camera.target.distanceTo(camera.p);
  if (!(setup.screenWidth > 0 && setup.viewerDistance > 0))
    return { ...camera, screen: distance, eyes: comfortableEyes(distance, half, nearest, setup.eyeDistance, aspect) };
  const scale = (2 * half * distance * aspect) / setup.screenWidth;
  const back = camera.p.clone().sub(camera.target).normalize();
  const screen = scale * setup.viewerDistance;
  const p = camera.target.clone().addScaledVector(back, screen);
  const fov = 2 * Math.atan((half * distance) / screen);
  return { ...camera, p, screen, fov, leastAcross: 0, eyes: scale * setup.eyeDistance };
}

/** One eye's view for three. All frusta meet in the same rectangle, at the screen's distance. */
export function applyEye(camera: StereoCamera, eye: Eye, aspect: number, out: PerspectiveCamera): void {
  const { right, up, back } = axesOf(camera);
  const side = (eye === 'left' ? -0.5 : eye === 'right' ? 0.5 : 0) * camera.eyes;
  out.position.copy(camera.p).addScaledVector(right, side);
  out.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(right, up, back));
  out.updateMatrixWorld(true);
  const half = halfTan(camera, aspect);
  const halfHeight = camera.roomBelow * half * camera.screen;
  const middle = half * camera.screen - halfHeight;
  const halfWidth = halfHeight * aspect;
  const nearer = kNear / Math.max(camera.screen, kNear);
  out.near = kNear;
  out.far = kFar;
  out.projectionMatrix.makePerspective(
    nearer * (-halfWidth - side),
    nearer * (halfWidth - side),
    nearer * (middle + halfHeight),
    nearer * (middle - halfHeight),
    kNear,
    kFar,
  );
  out.projectionMatrixInverse.copy(out.projectionMatrix).invert();
}
