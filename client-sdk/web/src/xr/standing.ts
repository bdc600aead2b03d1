// Where a visitor in a headset stands in the world, which has its true size. R is the headset's space: its floor is y = 0.
import { Box3, Matrix4, Quaternion, Vector3 } from 'three';

/** The work is so far before the eyes: within reach of an arm that is not stretched. */
const kReach_m = 0.45;
/** Eyes above the middle of the work. */
const kLeastAbove_m = 0.2;
const kMostAbove_m = 0.6;
const kHighest_m = 1;
export const kStep_m = 0.05;
export const kStep_rad = Math.PI / 12;

const up = new Vector3(0, 1, 0);
/** Angle about y of a direction; 0 looks along -z. */
const headingOf = (d: Vector3): number => Math.atan2(-d.x, -d.z);

export class Standing {
  /** From R to W. */
  readonly X_WR = new Matrix4();

  /** Before the work, as one who looks at it from `from`. The floor is the world's, unless the work would be out of reach. */
  recenter(work: Box3, from: Vector3, head_R: Vector3, gaze_R: Vector3, ground: number): void {
    const middle = work.isEmpty() ? from.clone().setY(1) : work.getCenter(new Vector3());
    const ahead = middle.clone().sub(from).setY(0);
    if (ahead.length() < 1e-6) ahead.set(0, 0, -1);
    ahead.normalize();
    const size = work.isEmpty() ? new Vector3() : work.getSize(new Vector3());
    const half = Math.min((Math.abs(ahead.x) * size.x + Math.abs(ahead.z) * size.z) / 2, kHighest_m);
    const head = middle.clone().addScaledVector(ahead, -half - kReach_m);
    const eyes = ground + head_R.y;
    head.y = Math.min(Math.max(eyes, middle.y + kLeastAbove_m), middle.y + kMostAbove_m);
    this.put(head, headingOf(ahead) - headingOf(gaze_R), head_R);
  }
  raise(by: number): void {
    this.X_WR.elements[13] += by;
  }
  /** The world turns about the visitor. */
  turn(by: number, head_R: Vector3): void {
    const about = head_R.clone().applyMatrix4(this.X_WR);
    this.X_WR.premultiply(new Matrix4().makeTranslation(-about.x, 0, -about.z));
    this.X_WR.premultiply(new Matrix4().makeRotationY(by));
    this.X_WR.premultiply(new Matrix4().makeTranslation(about.x, 0, about.z));
  }

  private put(head_W: Vector3, turn: number, head_R: Vector3): void {
    const R = new Quaternion().setFromAxisAngle(up, turn);
    this.X_WR.compose(head_W.clone().sub(head_R.clone().applyQuaternion(R)), R, new Vector3(1, 1, 1));
  }
}
