// A hand's bones and flesh: server/hand/hand_skeleton.cpp, client-sdk/scene/hand_shape.cpp and hand_skin.cpp. Frame H: origin at
// the wrist, x towards the fingers, y out of the back of the hand.
import { Matrix4, Quaternion, Vector3 } from 'three';

export const kSegments = 16;
export const kPalmHalf_m = 0.05;

interface Finger {
  p: Vector3;
  stand: Quaternion;
  lengths: [number, number, number];
  radii: [number, number, number];
}

function thumbStand(): Quaternion {
  const x = new Vector3(0.62, -0.3, -0.72).normalize();
  const palm = new Vector3(0.25, -0.75, 0.6);
  const y = palm.addScaledVector(x, -palm.dot(x)).normalize().negate();
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(x, y, x.clone().cross(y)));
}

const flat = new Quaternion();
export const kFingers: Finger[] = [
  { p: new Vector3(0.03, -0.006, -0.04), stand: thumbStand(), lengths: [0.046, 0.034, 0.028], radii: [0.0115, 0.0105, 0.0095] },
  { p: new Vector3(0.098, 0, -0.031), stand: flat, lengths: [0.045, 0.026, 0.02], radii: [0.0095, 0.0085, 0.0075] },
  { p: new Vector3(0.102, 0, -0.01), stand: flat, lengths: [0.05, 0.03, 0.021], radii: [0.0095, 0.0085, 0.0075] },
  { p: new Vector3(0.099, 0, 0.011), stand: flat, lengths: [0.046, 0.029, 0.021], radii: [0.009, 0.008, 0.0072] },
  { p: new Vector3(0.091, 0, 0.031), stand: flat, lengths: [0.037, 0.021, 0.019], radii: [0.0085, 0.0075, 0.0065] },
];

/** Degrees: three flexions and the finger's spread. */
export type Bend = [number, number, number, number];
export const kFlat: Bend[] = [[0, 0, 0, 14], [0, 0, 0, 9], [0, 0, 0, 2], [0, 0, 0, -5], [0, 0, 0, -13]];
export const kPointing: Bend[] = [[28, 30, 35, 0], [8, 10, 6, 0], [72, 88, 40, 0], [76, 90, 42, 0], [78, 88, 42, 0]];
export const kPinching: Bend[] = [[18, 40, 30, -8], [64, 44, 24, 0], [66, 52, 28, 0], [69, 56, 30, 0], [72, 57, 30, 0]];

/** X_HS of all segments: the palm, then three of each finger from the palm outwards. */
export function placeHand(bends: readonly Bend[]): Matrix4[] {
  const out = [new Matrix4().makeTranslation(kPalmHalf_m, 0, 0)];
  const degree = Math.PI / 180;
  kFingers.forEach((finger, f) => {
    const bend = bends[f]!;
    const turn = finger.stand.clone().multiply(new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), bend[3] * degree));
    const at = finger.p.clone();
    finger.lengths.forEach((length, k) => {
      turn.multiply(new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), -bend[k]! * degree));
      const half = new Vector3(length / 2, 0, 0).applyQuaternion(turn);
      out.push(new Matrix4().compose(at.clone().add(half), turn, new Vector3(1, 1, 1)));
      at.addScaledVector(half, 2);
    });
  });
  return out;
}

export function fingerTip(X: readonly Matrix4[], f: number): Vector3 {
  const finger = kFingers[f]!;
  return new Vector3(finger.lengths[2] / 2 - 0.6 * finger.radii[2], 0, 0).applyMatrix4(X[3 + 3 * f]!);
}

/** Inigo Quilez' smooth minimum: two shapes within k of each other blend. */
function smoothMin(a: number, b: number, k: number): number {
  const h = Math.max(k - Math.abs(a - b), 0) / k;
  return Math.min(a, b) - h * h * k * 0.25;
}

type P = readonly [number, number, number];

/** Distance to the line from a to b, and the nearest point's share of it. */
function fromLine(p: P, a: P, b: P): [number, number] {
  const [x, y, z] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [u, v, w] = [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
  const t = Math.min(Math.max((u * x + v * y + w * z) / (x * x + y * y + z * z), 0), 1);
  return [Math.hypot(u - t * x, v - t * y, w - t * z), t];
}

function fromEllipsoid(p: P, middle: P, half: P): number {
  const [x, y, z] = [p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]];
  const k0 = Math.hypot(x / half[0], y / half[1], z / half[2]);
  const k1 = Math.hypot(x / half[0] ** 2, y / half[1] ** 2, z / half[2] ** 2);
  return k1 > 1e-6 ? (k0 * (k0 - 1)) / k1 : -Math.min(...half);
}

interface Bone {
  a: P;
  b: P;
  radiusA: number;
  radiusB: number;
}
const rest = placeHand(kFlat);
const tuple = (v: Vector3): P => [v.x, v.y, v.z];
const kBones: Bone[] = kFingers.flatMap((finger, f) =>
  finger.lengths.map((length, k) => {
    const X = rest[1 + 3 * f + k]!;
    const half = length / 2;
    const last = k === 2;
    const radius = finger.radii[k]!;
    return {
      a: tuple(new Vector3(-half, 0, 0).applyMatrix4(X)),
      b: tuple(new Vector3(last ? half - 0.55 * radius : half, 0, 0).applyMatrix4(X)),
      radiusA: radius,
      radiusB: last ? 0.88 * radius : finger.radii[k + 1]!,
    };
  }),
);

function fingerDistance(p: P, f: number): number {
  let d = 1;
  for (let k = 0; k < 3; ++k) {
    const bone = kBones[3 * f + k]!;
    const [away, t] = fromLine(p, bone.a, bone.b);
    d = smoothMin(d, away - (bone.radiusA + t * (bone.radiusB - bone.radiusA)), 0.003);
  }
  return d;
}

/** Palm, ball of the thumb, heel, wrist and the beginning of the arm. */
function palmDistance(p: P): number {
  let d = 1;
  for (let f = 1; f < 5; ++f) {
    const to = kFingers[f]!.p;
    const [away, t] = fromLine(p, [0.008, 0.001, 0.45 * to.z], tuple(to));
    d = smoothMin(d, away - (0.015 - 0.0042 * t), 0.016);
  }
  d = smoothMin(d, fromEllipsoid(p, [0.04, -0.009, -0.024], [0.036, 0.013, 0.017]), 0.014);
  d = smoothMin(d, fromEllipsoid(p, [0.038, -0.008, 0.022], [0.036, 0.012, 0.014]), 0.014);
  const [away, t] = fromLine([p[0], 1.35 * p[1], p[2]], [-0.085, 0, 0], [0.012, 0, 0]);
  return smoothMin(d, (away - (0.03 - 0.004 * t)) * 0.85, 0.022);
}

/** Of the flat hand's skin, in H. */
export function handDistance(p: P): number {
  const palm = palmDistance(p);
  let d = palm;
  for (let f = 0; f < 5; ++f) d = Math.min(d, smoothMin(palm, fingerDistance(p, f), f === 0 ? 0.02 : 0.01));
  return d;
}

/** The three segments that a point of the skin follows most, with their shares. */
export function skinHold(p: P): { segments: number[]; weights: number[] } {
  let of = 1;
  for (let f = 0; f < 5; ++f) if (fingerDistance(p, f) < fingerDistance(p, of)) of = f;
  const pulls: [number, number][] = [[Math.max(Math.max(palmDistance(p), 0) + 0.009, 1e-4) ** -6, 0]];
  for (let k = 0; k < 3; ++k) {
    const bone = kBones[3 * of + k]!;
    pulls.push([Math.max(fromLine(p, bone.a, bone.b)[0], 1e-4) ** -6, 1 + 3 * of + k]);
  }
  pulls.sort((a, b) => b[0] - a[0]);
  const most = pulls.slice(0, 3);
  const sum = most.reduce((s, [weight]) => s + weight, 0);
  return { segments: most.map(([, segment]) => segment), weights: most.map(([weight]) => weight / sum) };
}
