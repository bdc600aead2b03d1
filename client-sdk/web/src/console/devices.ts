// Haptic devices as staff see them, and what is asked of them.
import type { Vector } from '../studio/commands';
import { deviceOf, fields, list, number, text, type DeviceInfo } from './api';

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
export interface AskedDevice extends DeviceInfo {
  /** Null: its program has not opened it yet. */
  details: DeviceDetails | null;
  /** Of its program, to the last thing that it was asked. */
  request: (typeof kAnswers)[number];
  refusal: string;
}
export type DeviceOrder = { user: number } & ({ action: 'test' | 'end-test' | 'calibrate' } | { action: 'place'; place: DevicePlace });

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

export function askedDeviceOf(v: unknown): AskedDevice {
  const d = fields(v);
  return { ...deviceOf(v), details: d.details ? detailsOf(d.details) : null, request: kAnswers.find((one) => one === d.request) ?? 'none',
    refusal: text(d.refusal) };
}
/** An answer of `/api/kiosks/NAME/devices`. */
export const devicesOf = (v: unknown): AskedDevice[] => list(fields(v).devices).map(askedDeviceOf);
