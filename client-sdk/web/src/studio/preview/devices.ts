// Where the workspaces of a trial's devices lie in the world.
import { Box3, Matrix4, Quaternion, Vector3 } from 'three';
import type { Box, DevicePlace } from '../../console/devices';
import { vector } from '../../scene/camera';
import type { Vector } from '../commands';

/** A body that a hand can work, and the box around it in the world, where it begins. */
export interface Workable extends Box {
  def: string;
}

const kMostScale = 100;
const kFarthest_m = 100;

const kUp = new Vector3(0, 1, 0);
const box3 = ({ least, greatest }: Box): Box3 => new Box3(vector(least), vector(greatest));
/** Of points in the device's frame, into the world. */
const matrixOf = ({ center_m, turn_rad, scale }: DevicePlace): Matrix4 =>
  new Matrix4().compose(vector(center_m), new Quaternion().setFromAxisAngle(kUp, turn_rad), new Vector3(scale, scale, scale));
const corners = ({ least, greatest }: Box): Vector[] =>
  [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [0, 1, 2].map((axis) => ((i >> axis) & 1 ? greatest : least)[axis]!) as Vector);
export function boxAround(points: Vector[]): Box | null {
  const { min, max } = new Box3().setFromPoints(points.map(vector));
  return points.length > 0 ? { least: min.toArray(), greatest: max.toArray() } : null;
}
export const boxAroundAll = (boxes: Box[]): Box | null => boxAround(boxes.flatMap(({ least, greatest }) => [least, greatest]));

const kNear_m = 1e-6;
/** The corners of a device's workspace in the world. */
export const reachOf = (workspace: Box, place: DevicePlace): Vector[] =>
  corners(workspace).map((corner) => vector(corner).applyMatrix4(matrixOf(place)).toArray());
export const isWithinReach = (box: Box, workspace: Box, place: DevicePlace): boolean =>
  box3(workspace).expandByScalar(kNear_m / place.scale).containsBox(box3(box).applyMatrix4(matrixOf(place).invert()));

/** What fills are rounded to. */
const kGrid_m = 0.005;
const kGridOfScale = 0.1;

/** The place at which the workspace just holds a box, for a device that is turned so. The workspace's middle may lie beside its zero. */
export function placeAround(target: Box, workspace: Box | null, turn_rad: number): DevicePlace {
  const toGrid = (p: Vector3): Vector => p.toArray().map((v) => Number((Math.round(v / kGrid_m) * kGrid_m).toFixed(3))) as Vector;
  const at = box3(target).getCenter(new Vector3());
  if (!workspace) return { center_m: toGrid(at), turn_rad, scale: 1 };
  // The corners may move by half a step of the grid.
  const needs = box3(target).applyMatrix4(new Matrix4().makeRotationY(-turn_rad)).getSize(new Vector3()).addScalar(2 * kGrid_m).toArray();
  const has = box3(workspace).getSize(new Vector3()).toArray();
  const most = Math.max(...needs.map((v, axis) => v / (has[axis]! || 1)));
  const scale = Math.min(kMostScale, Math.max(1, Number((Math.ceil(most / kGridOfScale) * kGridOfScale).toFixed(1))));
  const beside = box3(workspace).getCenter(new Vector3()).applyMatrix4(matrixOf({ center_m: [0, 0, 0], turn_rad, scale }));
  return { center_m: toGrid(at.sub(beside)), turn_rad, scale };
}

const kDegree = Math.PI / 180;
export const degrees = (rad: number): number => Number((rad / kDegree).toFixed(1));
export const radians = (degree: number): number => degree * kDegree;
/** As the program of a device takes it, on its command line and in the file of its service. */
export const optionsOf = ({ center_m, turn_rad, scale }: DevicePlace): string =>
  `--center ${center_m.map((v) => Number(v.toFixed(4))).join(' ')} --turn ${degrees(turn_rad)} --scale ${Number(scale.toFixed(3))}`;
export const canBePut = ({ center_m, turn_rad, scale }: DevicePlace): boolean =>
  center_m.every((v) => Math.abs(v) <= kFarthest_m) && Math.abs(turn_rad) <= 2 * Math.PI && scale >= 1 && scale <= kMostScale;
