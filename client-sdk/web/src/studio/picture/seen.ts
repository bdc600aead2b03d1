// What visitors see from where they begin: an exhibit's first view, on a screen of 16 to 9.
import { Quaternion, Vector3 } from 'three';
import type { PoseArray } from '../../wire/messages';
import type { Vector } from '../commands';
import { outlineAt, type View } from '../view';

/** Of X3D, where none is written. */
export const kUsualView_rad = 0.7854;
const kAspect = 16 / 9;

/** Whether a point of W lies in the picture of a view. */
export function isInPicture([x, y, z, ...turn]: PoseArray, fov: number, at: Vector): boolean {
  const to = new Vector3(...at).sub(new Vector3(x, y, z)).applyQuaternion(new Quaternion(...turn).normalize().invert());
  const half = -to.z * Math.tan(fov / 2);
  return half > 0 && Math.abs(to.y) <= half && Math.abs(to.x) <= half * kAspect;
}

/** The view that visitors begin with, where a point is not in its picture; "": it is, or there is no view. */
export function unseenFrom(view: View, at: Vector | null): string {
  const first = view.views[0];
  const pose = first && outlineAt(view, first.def)?.pose;
  if (!at || !pose) return '';
  return isInPicture(pose, Number(first.fields.fieldOfView ?? kUsualView_rad), at) ? '' : first.def;
}
