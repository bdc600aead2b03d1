// The haptic devices of a trial: what the gateway tells of them, and where their workspaces lie in the world.
import { deviceOf, fields, list, number, text, type DeviceInfo } from '../../console/api';
import type { Vector } from '../commands';

/** Where a device's workspace lies in the world. Its middle, metres; turned about y, anticlockwise from above; metres of the world for one. */
export interface DevicePlace {
  center_m: Vector;
  turn_rad: number;
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
export type DeviceOrder = { user: number; action: 'test' | 'end-test' | 'calibrate' } | { user: number; action: 'place'; place: DevicePlace };

export const kMostScale = 100;
export const kFarthest_m = 100;

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

/** About the world's y axis, anticlockwise from above. */
const turned = ([x, y, z]: Vector, by_rad: number): Vector => {
  const [c, s] = [Math.cos(by_rad), Math.sin(by_rad)];
  return [x * c + z * s, y, z * c - x * s];
};
const corners = ({ least, greatest }: Box): Vector[] =>
  [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [0, 1, 2].map((axis) => ((i >> axis) & 1 ? greatest : least)[axis]!) as Vector);
export function boxAround(points: Vector[]): Box | null {
  if (points.length === 0) return null;
  const along = (of: (...values: number[]) => number): Vector => [0, 1, 2].map((axis) => of(...points.map((p) => p[axis]!))) as Vector;
  return { least: along(Math.min), greatest: along(Math.max) };
}
export const boxAroundAll = (boxes: Box[]): Box | null => boxAround(boxes.flatMap(({ least, greatest }) => [least, greatest]));

/** The corners of a device's workspace in the world. */
export const reachOf = (workspace: Box, place: DevicePlace): Vector[] =>
  corners(workspace).map((corner) => turned(corner, place.turn_rad).map((v, axis) => place.center_m[axis]! + place.scale * v) as Vector);
export function isWithinReach({ least, greatest }: Box, workspace: Box, place: DevicePlace): boolean {
  return corners({ least, greatest }).every((corner) => {
    const p = turned(corner.map((v, axis) => v - place.center_m[axis]!) as Vector, -place.turn_rad);
    return p.every((v, axis) => v >= place.scale * workspace.least[axis]! - kNear_m && v <= place.scale * workspace.greatest[axis]! + kNear_m);
  });
}
const kNear_m = 1e-6;
/** What fills are rounded to. */
const kGrid_m = 0.005;
const kGridOfScale = 0.1;

/** The place at which the workspace just holds a box, for a device that stands turned so. A known workspace's middle may lie beside its zero. */
export function placeAround(target: Box, workspace: Box | null, turn_rad: number): DevicePlace {
  const middle = (box: Box): Vector => box.least.map((v, axis) => (v + box.greatest[axis]!) / 2) as Vector;
  const to = (v: number): number => Number((Math.round(v / kGrid_m) * kGrid_m).toFixed(3));
  const at = middle(target);
  if (!workspace) return { center_m: at.map(to) as Vector, turn_rad, scale: 1 };
  const seen = boxAround(corners(target).map((corner) => turned(corner, -turn_rad)))!;
  // The corners may move by half a step of the grid.
  const needed = [0, 1, 2].map((axis) => (seen.greatest[axis]! - seen.least[axis]! + 2 * kGrid_m) /
    (workspace.greatest[axis]! - workspace.least[axis]! || 1));
  const scale = Math.min(kMostScale, Math.max(1, Number((Math.ceil(Math.max(...needed) / kGridOfScale) * kGridOfScale).toFixed(1))));
  const beside = turned(middle(workspace), turn_rad);
  return { center_m: at.map((v, axis) => to(v - scale * beside[axis]!)) as Vector, turn_rad, scale };
}

const kDegree = Math.PI / 180;
export const degrees = (rad: number): number => Number((rad / kDegree).toFixed(1));
export const radians = (degree: number): number => degree * kDegree;
/** As the program of a device takes it, on its command line and in the file of its service. */
export const optionsOf = ({ center_m, turn_rad, scale }: DevicePlace): string =>
  `--center ${center_m.map((v) => Number(v.toFixed(4))).join(' ')} --turn ${degrees(turn_rad)} --scale ${Number(scale.toFixed(3))}`;
export const canBePut = ({ center_m, turn_rad, scale }: DevicePlace): boolean =>
  center_m.every((v) => Math.abs(v) <= kFarthest_m) && Math.abs(turn_rad) <= 2 * Math.PI && scale >= 1 && scale <= kMostScale;
