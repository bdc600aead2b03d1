import { Box3, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { boardText } from '../src/xr/board';
import { handBytes, kJoints, seenHands } from '../src/xr/joints';
import { Standing } from '../src/xr/standing';
import { Matrix4 } from 'three';
import { wordsIn } from '../src/kiosk/words';

describe('tracked hands as bytes', () => {
  it('have the form of STREAM.md', () => {
    expect(kJoints).toHaveLength(25);
    const joints = Array.from({ length: 75 }, (_, k) => k / 100);
    const view = new DataView(handBytes([
      { side: 'left', tracked: true, closed: null, what: { joints } },
      { side: 'right', tracked: false, closed: 0.5, what: { pose: [1, 2, 3, 0, 0, 0, 1] } },
    ]));
    expect(view.byteLength).toBe(4 + 8 + 300 + 8 + 28);
    expect([0, 1, 2, 4, 5, 6].map((at) => view.getUint8(at))).toEqual([2, 1, 2, 1, 1, 1]);
    expect(view.getFloat32(8, true)).toBe(-1);
    expect(view.getFloat32(12 + 4 * 74, true)).toBeCloseTo(0.74, 6);
    expect([312, 313, 314].map((at) => view.getUint8(at))).toEqual([0, 0, 0]);
    expect(view.getFloat32(316, true)).toBe(0.5);
    expect(view.getFloat32(320, true)).toBe(1);
    expect(handBytes([]).byteLength).toBe(4);
  });

  it('are places in the world, and of a hand with a hidden joint nothing is told', () => {
    let hidden = '';
    const at = { x: 1, y: 0, z: 0, w: 1 };
    const frame = {
      getJointPose: (joint: string) => (joint === hidden ? undefined : { transform: { position: at, orientation: at } }),
    } as unknown as XRFrame;
    const hand = { get: (name: string) => name } as unknown as XRHand;
    const source = { handedness: 'right', hand } as XRInputSource;
    const X_WR = new Matrix4().makeRotationY(Math.PI / 2).setPosition(0, 2, 0);
    const look = () => seenHands(frame, [source, source], {} as XRReferenceSpace, X_WR);
    const [seen, ...others] = look();
    expect(others).toEqual([]);
    expect(seen?.tracked).toBe(true);
    const joints = seen && 'joints' in seen.what ? seen.what.joints : [];
    [0, 2, -1].forEach((value, k) => expect(joints[72 + k]).toBeCloseTo(value, 9));
    hidden = 'thumb-tip';
    expect(look()[0]?.tracked).toBe(false);
  });
});

describe('where a visitor stands', () => {
  const work = new Box3(new Vector3(-0.2, 0.9, -0.3), new Vector3(0.2, 1.1, 0.1));
  const head = new Vector3(0.4, 1.5, -0.2);
  const place = (headNow: Vector3): Standing => {
    const out = new Standing();
    out.recenter(work, new Vector3(0, 1.6, 3), headNow, new Vector3(1, -0.2, 0), 0);
    return out;
  };
  it('is within reach of the work and looks at it, on the floor of the world', () => {
    const { X_WR } = place(head);
    const eyes = head.clone().applyMatrix4(X_WR);
    expect(eyes.distanceTo(new Vector3(0, 1.5, 0.1 + 0.45))).toBeLessThan(1e-9);
    expect(new Vector3(1, 0, 0).transformDirection(X_WR).z).toBeCloseTo(-1, 9);
    expect(new Vector3(0, 0, 0).applyMatrix4(X_WR).y).toBeCloseTo(0, 9);
  });
  it('is raised where the work would be too high for a child', () => {
    const small = new Vector3(0, 1.05, 0);
    expect(small.clone().applyMatrix4(place(small).X_WR).y).toBeCloseTo(1.2, 9);
  });
  it('stays when the world is turned, and moves up by a step', () => {
    const standing = place(head);
    const eyes = head.clone().applyMatrix4(standing.X_WR);
    standing.turn(0.3, head);
    expect(head.clone().applyMatrix4(standing.X_WR).distanceTo(eyes)).toBeLessThan(1e-9);
    standing.raise(0.05);
    expect(head.clone().applyMatrix4(standing.X_WR).y).toBeCloseTo(eyes.y + 0.05, 9);
  });
});

describe('the board', () => {
  it('has what the page has, and the headset\'s own buttons', () => {
    const text = boardText(null, wordsIn('en'), 'All hands are busy');
    expect(text.lines).toEqual(['All hands are busy']);
    expect(text.tools.map((tool) => tool.action)).toContain('xr:leave');
  });
});
