// Where a device's workspace lies in the world, and what the gateway tells of devices.
import { describe, expect, it } from 'vitest';
import {
  boxAround, canBePut, isWithinReach, optionsOf, placeAround, reachOf,
} from '../src/studio/preview/devices';
import { askedDeviceOf, type Box } from '../src/console/devices';

const kWorkspace: Box = { least: [-0.1, -0.05, -0.2], greatest: [0.1, 0.05, 0.2] };

describe('the place of a device', () => {
  it('is turned anticlockwise from above, and scaled about its middle', () => {
    const reach = boxAround(reachOf(kWorkspace, { center_m: [1, 2, 3], turn_rad: Math.PI / 2, scale: 2 }))!;
    [0.6, 1.9, 2.8].forEach((v, axis) => expect(reach.least[axis]).toBeCloseTo(v, 9));
    [1.4, 2.1, 3.2].forEach((v, axis) => expect(reach.greatest[axis]).toBeCloseTo(v, 9));
    // The device's x axis points along -z of the world then.
    const [tip] = reachOf({ least: [0.1, 0, 0], greatest: [0.1, 0, 0] }, { center_m: [0, 0, 0], turn_rad: Math.PI / 2, scale: 1 });
    expect(tip![2]).toBeCloseTo(-0.1, 9);
  });
  it('around something holds all of it, whatever the turn, and no more than it must', () => {
    const beside: Box = { least: [-0.1, 0, -0.2], greatest: [0.1, 0.1, 0.2] };
    for (const workspace of [kWorkspace, beside])
      for (const turn of [0, 0.3, Math.PI / 2, -2]) {
        const target: Box = { least: [0.512, 0.101, -0.333], greatest: [1.207, 0.4, 0.251] };
        const place = placeAround(target, workspace, turn);
        expect(isWithinReach(target, workspace, place)).toBe(true);
        expect(isWithinReach(target, workspace, { ...place, scale: place.scale - 0.3 })).toBe(false);
        expect(canBePut(place)).toBe(true);
      }
  });
  it('is never smaller than the device, and of one whose reach is not known only the middle is chosen', () => {
    const small: Box = { least: [1, 1, 1], greatest: [1.01, 1.01, 1.01] };
    expect(placeAround(small, kWorkspace, 0).scale).toBe(1);
    expect(placeAround({ least: [0, 0, 0], greatest: [2, 4, 6] }, null, 0.5)).toEqual({ center_m: [1, 2, 3], turn_rad: 0.5, scale: 1 });
  });
  it('is said as programs take it', () => {
    expect(optionsOf({ center_m: [0.1, 0.72, -1 / 3], turn_rad: Math.PI / 4, scale: 1.5 }))
      .toBe('--center 0.1 0.72 -0.3333 --turn 45 --scale 1.5');
    expect(canBePut({ center_m: [NaN, 0, 0], turn_rad: 0, scale: 1 })).toBe(false);
    expect(canBePut({ center_m: [0, 0, 0], turn_rad: 0, scale: 0.5 })).toBe(false);
  });
});

describe('what is told of a device', () => {
  it('is read, whatever is missing', () => {
    expect(askedDeviceOf({ user: 1, name: 'Touch' }))
      .toMatchObject({ user: 1, name: 'Touch', details: null, request: 'none', refusal: '' });
    const told = askedDeviceOf({ request: 'burnt', details: { temperature: 0.5, place: { center_m: [1] } } });
    expect(told.request).toBe('none');
    expect(told.details).toMatchObject({ temperature: 0.5, workspace_m: null, place: { center_m: [1, 0, 0], turn_rad: 0, scale: 1 } });
  });
});
