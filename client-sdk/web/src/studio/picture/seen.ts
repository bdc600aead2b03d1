// What visitors see from where they begin: an exhibit's first view, on a screen of 16 to 9.
import { rigid, vector } from '../../scene/camera';
import type { PoseArray } from '../../wire/messages';
import type { Vector } from '../commands';
import { outlineAt, type View } from '../view';

/** X3D's own, where a Viewpoint does not say. */
export const kUsualView_rad = 0.7854;
const kAspect = 16 / 9;

/** Whether a point of W lies in the picture of a view. */
export function isInPicture(pose: PoseArray, fov: number, at: Vector): boolean {
  const to = vector(at).applyMatrix4(rigid(pose).invert());
  const half = -to.z * Math.tan(fov / 2);
  return half > 0 && Math.abs(to.y) <= half && Math.abs(to.x) <= half * kAspect;
}

/** The DEF of the exhibit's first view if the point lies outside its picture. Otherwise, and without any view, "". */
export function unseenFrom(view: View, at: Vector | null): string {
  const first = view.views[0];
  const pose = first && outlineAt(view, first.def)?.pose;
  if (!at || !pose) return '';
  return isInPicture(pose, Number(first.fields.fieldOfView ?? kUsualView_rad), at) ? '' : first.def;
}
