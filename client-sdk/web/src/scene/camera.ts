// Cameras of the native display (client-sdk/picture/camera.cpp): C looks along -z, y up.
import { Box2, Box3, Matrix4, PerspectiveCamera, Quaternion, Vector2, Vector3 } from 'three';
import type { PoseArray, View } from '../wire/messages';

export interface Camera {
  p: Vector3;
  target: Vector3;
  up: Vector3;
  /** Vertical, radians. */
  fov: number;
  /** Narrow pictures widen until they show this much across. */
  leastAcross: number;
  /** The picture shows this factor more, below and to the sides, while its upper edge stays. */
  roomBelow: number;
}

export const kNear = 0.05;
export const kFar = 400;

export const vector = (p: readonly number[]): Vector3 => new Vector3(p[0], p[1], p[2]);
export const quaternion = (x: PoseArray): Quaternion => new Quaternion(x[3], x[4], x[5], x[6]).normalize();
export const rigid = (x: PoseArray): Matrix4 => new Matrix4().compose(vector(x), quaternion(x), new Vector3(1, 1, 1));

export function cornersOf({ min, max }: Box3): Vector3[] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z));
}

/** Right, up and back, in W. */
export function axesOf(camera: Camera): { right: Vector3; up: Vector3; back: Vector3 } {
  const back = camera.p.clone().sub(camera.target).normalize();
  const right = camera.up.clone().cross(back);
  if (right.length() < 1e-9) right.set(1, 0, 0);
  right.normalize();
  return { right, up: back.clone().cross(right), back };
}

/** Half the picture's height at one metre. */
export function halfTan(camera: Camera, aspect: number): number {
  return Math.max(Math.tan(camera.fov / 2), Math.tan(Math.min(camera.leastAcross, 3) / 2) / aspect);
}

/** The same camera for three. */
export function applyTo(camera: Camera, aspect: number, out: PerspectiveCamera): void {
  const { right, up, back } = axesOf(camera);
  out.position.copy(camera.p);
  out.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(right, up, back));
  out.updateMatrixWorld(true);
  const half = halfTan(camera, aspect);
  const halfHeight = camera.roomBelow * half;
  const middle = half - halfHeight;
  out.near = kNear;
  out.far = kFar;
  out.projectionMatrix.makePerspective(
    -kNear * halfHeight * aspect,
    kNear * halfHeight * aspect,
    kNear * (middle + halfHeight),
    kNear * (middle - halfHeight),
    kNear,
    kFar,
  );
  out.projectionMatrixInverse.copy(out.projectionMatrix).invert();
}

/** A camera that sees the whole box from a direction, with a little room below for captions. */
export function frameBox(box: Box3, from: Vector3, fov: number): Camera {
  const middle = box.isEmpty() ? new Vector3() : box.getCenter(new Vector3());
  const extent = box.isEmpty() ? new Vector3(1, 1, 1) : box.getSize(new Vector3());
  const kDrop = 0.12;
  const kMost = 0.98;
  const ahead = from.clone().normalize();
  const camera: Camera = { p: middle.clone().add(ahead), target: middle, up: new Vector3(0, 1, 0), fov, leastAcross: 0, roomBelow: 1 };
  const { right, up, back } = axesOf(camera);
  const t = Math.tan(fov / 2);
  const across = 1.45 * t;
  let distance = 0.3;
  for (const q of cornersOf(new Box3().setFromCenterAndSize(new Vector3(), extent))) {
    const [x, y, z] = [q.dot(right), q.dot(up), q.dot(back)];
    distance = Math.max(distance, (Math.abs(y) / t + kMost * z) / (kMost - kDrop), z + Math.abs(x) / (kMost * across));
  }
  camera.target = middle.clone().addScaledVector(up, -kDrop * distance * t);
  camera.p = camera.target.clone().addScaledVector(ahead, distance);
  camera.leastAcross = 2 * Math.atan(across);
  return camera;
}

/** In front of the touchable things, at an adult's height. */
export function lookOver(interest: Box3): Camera {
  const p = new Vector3(interest.getCenter(new Vector3()).x, 1.6, interest.max.z + 1.2);
  const target = p.clone().add(new Vector3(0, -0.26, -1));
  return { p, target, up: new Vector3(0, 1, 0), fov: (54 * Math.PI) / 180, leastAcross: Math.PI / 3, roomBelow: 1 };
}

/** At the author's view. */
export function cameraAt(view: View, interest: Box3): Camera {
  const p = vector(view.pose);
  const turn = quaternion(view.pose);
  const ahead = new Vector3(0, 0, -1).applyQuaternion(turn);
  const away = interest.isEmpty() ? 1.5 : ahead.dot(interest.getCenter(new Vector3()).sub(p));
  const target = p.clone().addScaledVector(ahead, Math.min(Math.max(away, 0.5), 5));
  return { p, target, up: new Vector3(0, 1, 0).applyQuaternion(turn), fov: view.fov, leastAcross: view.fov, roomBelow: 1 };
}

/** The caption's share of the picture's half. */
const kCaption = 0.12;
/** Widens the view downwards by the caption's height. */
export function aboveCaption(camera: Camera): Camera {
  const half = Math.tan(camera.fov / 2);
  const wider = half / (1 - kCaption);
  const ahead = camera.target.clone().sub(camera.p);
  const up = camera.up.clone().addScaledVector(ahead, -camera.up.dot(ahead) / ahead.lengthSq()).normalize();
  return { ...camera, fov: 2 * Math.atan(wider), target: camera.target.clone().addScaledVector(up, -ahead.length() * (wider - half)) };
}

/** The author's view that shows, above the caption, what this camera shows in a picture wider than high. */
export function viewOf(camera: Camera, aspect: number): Omit<View, 'name'> {
  const wider = halfTan(camera, aspect);
  const { right, up, back } = axesOf(camera);
  const turn = new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(right, up, back));
  turn.premultiply(new Quaternion().setFromAxisAngle(right, Math.atan(kCaption * wider)));
  const { p } = camera;
  return { pose: [p.x, p.y, p.z, turn.x, turn.y, turn.z, turn.w], fov: 2 * Math.atan(wider * (1 - kCaption)) };
}

/** Where a box appears in the plane one metre ahead; empty: it is, or some of it is behind the camera. */
export function seenBox(camera: Camera, box: Box3): Box2 {
  const seen = new Box2();
  if (box.isEmpty()) return seen;
  const { right, up, back } = axesOf(camera);
  for (const corner of cornersOf(box)) {
    const q = corner.sub(camera.p);
    const depth = -q.dot(back);
    if (depth < kNear) return new Box2();
    seen.expandByPoint(new Vector2(q.dot(right) / depth, q.dot(up) / depth));
  }
  return seen;
}

/** In the same place, turned and narrowed to a window of what it shows. */
export function narrowedTo(camera: Camera, x: number, y: number, halfHeight: number, aspect: number, depth: number): Camera {
  const { right, up, back } = axesOf(camera);
  const norm = Math.hypot(x, y, 1);
  const share = halfHeight / halfTan(camera, aspect);
  return {
    ...camera,
    target: camera.p.clone().addScaledVector(right, depth * x).addScaledVector(up, depth * y).addScaledVector(back, -depth),
    fov: 2 * Math.atan(halfHeight / norm),
    leastAcross: 2 * Math.atan((share * Math.tan(camera.leastAcross / 2)) / norm),
  };
}
