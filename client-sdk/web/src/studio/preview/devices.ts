// The haptic devices of a trial: what the gateway tells of them, and where their workspaces lie in the world.
import { Box3, Matrix4, Quaternion, Vector3 } from 'three';
import { deviceOf, fields, list, number, text, type DeviceInfo } from '../../console/api';
import { vector } from '../../scene/camera';
import type { Vector } from '../commands';

/** Where a device's workspace lies in the world. */
export interface DevicePlace {
  /** Its middle. */
  center_m: Vector;
  /** Of the device about the world's y axis, anticlockwise from above. */
  turn_rad: number;
  /** Metres of the world for one of the device's. */
  scale: number;
}
export interface Box {
  least: Vector;
  greatest: Vector;
}
export interface DeviceDetails {
  wanted_hz: number;
  peak_force_n: number;
  continuous_force_n: number;
  peak_finger_force_n: number;
  place: DevicePlace;
  /** In the device's frame; null: not known. */
  workspace_m: Box | null;
  rate_hz: number;
  late_us: number;
  hand_m: Vector;
  force_n: number;
  /** Of its motors, 0 cold to 1 too hot; null: not known. */
  temperature: number | null;
  testing: boolean;
  test_force_n: number;
  test_energy_j: number;
}
export const kAnswers = ['none', 'waiting', 'done', 'refused', 'silent'] as const;
export interface TrialDevice extends DeviceInfo {
  /** Null: its program has not opened it yet. */
  details: DeviceDetails | null;
  /** Of its program, to the last thing that it was asked. */
  request: (typeof kAnswers)[number];
  refusal: string;
}
/** A body that a hand can work, and the box around it in the world, where it begins. */
export interface Workable extends Box {
  def: string;
}
export type DeviceOrder = { user: number } & ({ action: 'test' | 'end-test' | 'calibrate' } | { action: 'place'; place: DevicePlace });

const kMostScale = 100;
const kFarthest_m = 100;

const vectorOf = (v: unknown): Vector => {
  const [x, y, z] = list(v).map(number);
  return [x ?? 0, y ?? 0, z ?? 0];
};
const boxOf = (v: unknown): Box => ({ least: vectorOf(fields(v).least), greatest: vectorOf(fields(v).greatest) });

function detailsOf(v: unknown): DeviceDetails {
  const d = fields(v);
  const place = fields(d.place);
  return {
    wanted_hz: number(d.wanted_hz),
    peak_force_n: number(d.peak_force_n),
    continuous_force_n: number(d.continuous_force_n),
    peak_finger_force_n: number(d.peak_finger_force_n),
    place: { center_m: vectorOf(place.center_m), turn_rad: number(place.turn_rad), scale: Math.max(1, number(place.scale)) },
    workspace_m: d.workspace_m ? boxOf(d.workspace_m) : null,
    rate_hz: number(d.rate_hz),
    late_us: number(d.late_us),
    hand_m: vectorOf(d.hand_m),
    force_n: number(d.force_n),
    temperature: typeof d.temperature === 'number' ? d.temperature : null,
    testing: d.testing === true,
    test_force_n: number(d.test_force_n),
    test_energy_j: number(d.test_energy_j),
  };
}

export function trialDeviceOf(v: unknown): TrialDevice {
  const d = fields(v);
  return { ...deviceOf(v), details: d.details ? detailsOf(d.details) : null, request: kAnswers.find((one) => one === d.request) ?? 'none',
    refusal: text(d.refusal) };
}

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
