// Where a hand before the camera is in the world. The camera stands at the screen and looks at the visitor, so a hand that goes to the
// visitor's right goes to the right in the picture, and one that goes towards the screen goes into it. V is the picture's view: right,
// up, back.
import { Box3, Matrix4, Quaternion, Vector3 } from 'three';
import type { Slope } from './landmarks';

/** A hand that moves so far from its middle is past the edge of the work. */
const kReach_m = 0.18;
/** What a hand reaches is so much wider than the work. */
const kAround = 1.3;
/** Small work does not make hands slower than they are. */
const kLeastGain = 1;
/** The middle lies at least so far within the camera's picture, as a share of it, so that there is room on all sides. */
const kRoom = 0.3;
const [kNearest_m, kFarthest_m] = [0.25, 1.5];
/** How soon the hand follows a view that moves, seconds. */
const kFollow_s = 0.4;

/** How the picture looks at the work. */
export interface Sight {
  /** Turns V to W. */
  R_WV: Quaternion;
  /** The middle of the work. */
  p_WM: Vector3;
  /** Half of what a hand reaches, across or up. */
  half_m: number;
}

export class Reach {
  private middle_C: Vector3 | null = null;
  private sight: Sight | null = null;

  /** The next hand that is seen is at the middle of the work. */
  recenter(): void {
    this.middle_C = null;
  }
  /** The world's own turns of points around a hand's place. */
  get R_WC(): Quaternion {
    // C's x is to the visitor's left and its y is down; its z, away from the camera, is the view's back.
    return this.sight!.R_WV.clone().multiply(new Quaternion(0, 0, 1, 0));
  }
  /** Follows the view, unless a hand holds something: that must not move by itself. */
  look(now: Sight, dt: number, holds: boolean): void {
    if (!this.sight) this.sight = { ...now, R_WV: now.R_WV.clone(), p_WM: now.p_WM.clone() };
    if (holds) return;
    const share = 1 - Math.exp(-dt / kFollow_s);
    this.sight.R_WV.slerp(now.R_WV, share);
    this.sight.p_WM.lerp(now.p_WM, share);
    this.sight.half_m += share * (now.half_m - this.sight.half_m);
  }
  /** From C to W. `slope`: of the camera. Call look() before. */
  place(p_C: Vector3, slope: Slope): Vector3 {
    this.middle_C ??= middleFor(p_C, slope);
    const gain = Math.max(this.sight!.half_m / kReach_m, kLeastGain);
    return p_C.clone().sub(this.middle_C).multiplyScalar(gain).applyQuaternion(this.R_WC).add(this.sight!.p_WM);
  }
}

function middleFor(p_C: Vector3, slope: Slope): Vector3 {
  const z = Math.min(Math.max(p_C.z, kNearest_m), kFarthest_m);
  const within = (x: number, half: number): number => Math.min(Math.max(x, -half), half);
  const [x, y] = [slope.across * z * (1 - 2 * kRoom), slope.down * z * (1 - 2 * kRoom)];
  return new Vector3(within(p_C.x, x), within(p_C.y, y), z);
}

/** By the view of a camera of three. `work` must not depend on where hands are: a picture that follows a hand would lead it on and on. */
export function sightOf(matrixWorld: Matrix4, work: Box3): Sight {
  const R_WV = new Quaternion();
  matrixWorld.decompose(new Vector3(), R_WV, new Vector3());
  const R_VW = new Matrix4().makeRotationFromQuaternion(R_WV.clone().invert());
  const seen = work.clone().applyMatrix4(R_VW).getSize(new Vector3());
  return { R_WV, p_WM: work.getCenter(new Vector3()), half_m: (kAround * Math.max(seen.x, seen.y)) / 2 };
}
