// What a headset sees of the visitor's hands, as the gateway reads it: client-sdk/gateway/STREAM.md.
import { Matrix4, Quaternion, Vector3 } from 'three';

/** In the order of WebXR Hand Input, which is that of the message. */
const kFingers = ['index', 'middle', 'ring', 'pinky'] as const;
export const kJoints = [
  'wrist', 'thumb-metacarpal', 'thumb-phalanx-proximal', 'thumb-phalanx-distal', 'thumb-tip',
  ...kFingers.flatMap((f) =>
    ['metacarpal', 'phalanx-proximal', 'phalanx-intermediate', 'phalanx-distal', 'tip'].map((j) => `${f}-finger-${j}`)),
] as XRHandJoint[];

export interface SeenHand {
  side: 'right' | 'left';
  tracked: boolean;
  /** 0 open .. 1 closed: a controller's trigger; null: the gateway finds it. */
  closed: number | null;
  /** All joints of a hand, or a controller's place and turn (x y z, then a quaternion): in W. */
  what: { joints: number[] } | { pose: number[] };
}

const kHead = 8;

export function handBytes(hands: readonly SeenHand[]): ArrayBuffer {
  const numbers = hands.map(({ what }) => ('joints' in what ? what.joints : what.pose));
  const out = new DataView(new ArrayBuffer(4 + numbers.reduce((sum, list) => sum + kHead + 4 * list.length, 0)));
  out.setUint8(0, 2);
  out.setUint8(1, 1);
  out.setUint8(2, hands.length);
  let at = 4;
  hands.forEach((hand, i) => {
    out.setUint8(at, hand.side === 'left' ? 1 : 0);
    out.setUint8(at + 1, 'joints' in hand.what ? 1 : 0);
    out.setUint8(at + 2, hand.tracked ? 1 : 0);
    out.setFloat32(at + 4, hand.closed ?? -1, true);
    at += kHead;
    for (const value of numbers[i]!) {
      out.setFloat32(at, value, true);
      at += 4;
    }
  });
  return out.buffer as ArrayBuffer;
}

const vectorOf = (p: DOMPointReadOnly): Vector3 => new Vector3(p.x, p.y, p.z);

function jointsOf(frame: XRFrame, hand: XRHand, space: XRReferenceSpace, X_WR: Matrix4): number[] | null {
  const out: number[] = [];
  for (const name of kJoints) {
    const joint = hand.get(name);
    const pose = joint && frame.getJointPose?.(joint, space);
    if (!pose) return null;
    out.push(...vectorOf(pose.transform.position).applyMatrix4(X_WR).toArray());
  }
  return out;
}

function poseOf(frame: XRFrame, grip: XRSpace, space: XRReferenceSpace, X_WR: Matrix4): number[] | null {
  const pose = frame.getPose(grip, space);
  if (!pose || pose.emulatedPosition) return null;
  const { position, orientation: q } = pose.transform;
  const turn = new Quaternion().setFromRotationMatrix(X_WR).multiply(new Quaternion(q.x, q.y, q.z, q.w)).normalize();
  return [...vectorOf(position).applyMatrix4(X_WR).toArray(), ...turn.toArray()];
}

/** Hands of this moment. `X_WR`: from the headset's space to the world. */
export function seenHands(frame: XRFrame, sources: Iterable<XRInputSource>, space: XRReferenceSpace, X_WR: Matrix4): SeenHand[] {
  const out: SeenHand[] = [];
  for (const source of sources) {
    const side = source.handedness;
    if (side === 'none' || out.some((hand) => hand.side === side)) continue;
    if (source.hand) {
      const joints = jointsOf(frame, source.hand, space, X_WR);
      out.push({ side, tracked: joints !== null, closed: null, what: { joints: joints ?? new Array<number>(3 * kJoints.length).fill(0) } });
    } else if (source.gripSpace) {
      const pose = poseOf(frame, source.gripSpace, space, X_WR);
      const closed = source.gamepad?.buttons[0]?.value ?? 0;
      out.push({ side, tracked: pose !== null, closed, what: { pose: pose ?? [0, 0, 0, 0, 0, 0, 1] } });
    }
  }
  return out;
}
