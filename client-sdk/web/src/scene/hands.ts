// Visitors' hands: one skin over the segments' poses, and a linen sleeve.
import {
  Bone,
  Box3,
  BufferAttribute,
  type BufferGeometry,
  type Camera,
  DoubleSide,
  Group,
  LatheGeometry,
  Matrix4,
  Mesh,
  type MeshStandardMaterial,
  Quaternion,
  Skeleton,
  SkinnedMesh,
  Vector2,
  Vector3,
} from 'three';
import { kPose, type Frame, type HandFrame } from '../wire/frame';
import { fingerTip, handDistance, kFlat, kPalmHalf_m, kPinching, kPointing, kSegments, placeHand, skinHold } from './hand_shape';
import { plain } from './materials';
import type { WorkingHand } from './step_view';
import { surfaceNet } from './surface_net';
import { turnTriangles } from './models';

const kCell_m = 0.0036;
const kFinger_m = 0.015;
/** A one-point hand comes from the lower right and points forwards and inwards, as the camera sees it. */
const kReach_C = new Vector3(-0.62, 0.42, -0.66).normalize();
const kBack_C = new Vector3(0.4, 0.85, 0.32);

/** A thing farther away has left its world. */
export const kStray_m = 10_000;
export const isStray = (p: Vector3): boolean => !(Math.max(Math.abs(p.x), Math.abs(p.y), Math.abs(p.z)) <= kStray_m);

let restSkin: BufferGeometry | null = null;

/** The flat right hand, with what each point of its skin follows. */
function skin(): BufferGeometry {
  if (restSkin) return restSkin;
  const box = new Box3(new Vector3(-0.125, -0.07, -0.145), new Vector3(0.235, 0.045, 0.085));
  restSkin = surfaceNet(handDistance, box, kCell_m);
  const position = restSkin.getAttribute('position');
  const index = new Uint16Array(4 * position.count);
  const weight = new Float32Array(4 * position.count);
  for (let v = 0; v < position.count; ++v) {
    const { segments, weights } = skinHold([position.getX(v), position.getY(v), position.getZ(v)]);
    index.set(segments, 4 * v);
    weight.set(weights, 4 * v);
  }
  restSkin.setAttribute('skinIndex', new BufferAttribute(index, 4));
  restSkin.setAttribute('skinWeight', new BufferAttribute(weight, 4));
  return restSkin;
}

/** A left hand is the right one's mirror image, whose triangles are turned round. */
function turned(geometry: BufferGeometry): BufferGeometry {
  const out = geometry.clone();
  turnTriangles(out);
  return out;
}

/** Linen around the wrist, in the palm's frame: a tube with a hem. */
function sleeve(): BufferGeometry {
  const wrist = -kPalmHalf_m;
  const rings: [number, number][] = [
    [0.0235, -0.034],
    [0.0285, -0.03],
    [0.03, -0.027],
    [0.0305, -0.036],
    [0.0285, -0.04],
    [0.0313, -0.08],
    [0.033, -0.11],
    [0.0337, -0.16],
    [0.0345, -0.23],
    [0.0001, -0.232],
  ];
  const out = new LatheGeometry(rings.map(([r, x]) => new Vector2(r, wrist + x)), 28);
  // A lathe turns about y; the arm lies along x and is wider than thick.
  out.rotateZ(-Math.PI / 2);
  out.scale(1, 1, 1.2);
  return out;
}

/** X_WS of all segments of a hand of which only a tip is known. */
export function handAtTip(tip: Vector3, holding: boolean, camera: Camera): Matrix4[] {
  const X_HS = placeHand(holding ? kPinching : kPointing);
  const tip_H = holding ? fingerTip(X_HS, 0).add(fingerTip(X_HS, 1)).divideScalar(2) : fingerTip(X_HS, 1);
  const R_WC = camera.getWorldQuaternion(new Quaternion());
  const x = kReach_C.clone().applyQuaternion(R_WC);
  const back = kBack_C.clone().applyQuaternion(R_WC);
  const y = back.addScaledVector(x, -back.dot(x)).normalize();
  const X_WH = new Matrix4().makeBasis(x, y, x.clone().cross(y));
  X_WH.setPosition(tip.clone().sub(tip_H.applyMatrix4(X_WH)));
  return X_HS.map((X) => X_WH.clone().multiply(X));
}

export function segmentsOf(hand: HandFrame): Matrix4[] {
  const out: Matrix4[] = [];
  const s = hand.segments;
  for (let at = 0; at + kPose <= s.length; at += kPose) {
    const turn = new Quaternion(s[at + 3], s[at + 4], s[at + 5], s[at + 6]).normalize();
    out.push(new Matrix4().compose(new Vector3(s[at], s[at + 1], s[at + 2]), turn, new Vector3(1, 1, 1)));
  }
  return out;
}

/** How much longer than a middle-sized one the hand is, by the distance from palm to the index finger's joint. */
function sizeOf(X: readonly Matrix4[]): number {
  const palm = new Vector3().setFromMatrixPosition(X[0]!);
  const finger = new Vector3().setFromMatrixPosition(X[4]!);
  const rest = placeHand(kFlat);
  const usual = new Vector3().setFromMatrixPosition(rest[0]!).distanceTo(new Vector3().setFromMatrixPosition(rest[4]!));
  return Math.min(Math.max(palm.distanceTo(finger) / usual, 0.5), 1.6);
}

class ShownHand {
  readonly group = new Group();
  private readonly bones: Bone[] = [];
  private readonly meshes: [SkinnedMesh, SkinnedMesh];
  private readonly arm: Mesh;

  constructor(private readonly looks: { skin: MeshStandardMaterial; linen: MeshStandardMaterial; stale: MeshStandardMaterial }) {
    const rest = placeHand(kFlat);
    for (let i = 0; i < kSegments; ++i) {
      const bone = new Bone();
      bone.matrixAutoUpdate = false;
      this.bones.push(bone);
      this.group.add(bone);
    }
    const skeleton = new Skeleton(this.bones, rest.map((X) => X.clone().invert()));
    const mesh = (geometry: BufferGeometry): SkinnedMesh => {
      const out = new SkinnedMesh(geometry, looks.skin);
      out.bind(skeleton, new Matrix4());
      out.frustumCulled = false;
      out.castShadow = true;
      out.receiveShadow = true;
      this.group.add(out);
      return out;
    };
    this.meshes = [mesh(skin()), mesh(turned(skin()))];
    this.arm = new Mesh(sleeve(), looks.linen);
    this.arm.matrixAutoUpdate = false;
    this.arm.castShadow = true;
    this.group.add(this.arm);
  }
  show(X: readonly Matrix4[], stale: boolean): void {
    const inPalm = X[0]!.clone().invert();
    const left = new Vector3().setFromMatrixPosition(inPalm.multiply(X[1]!)).z > 0;
    const size = sizeOf(X);
    const scale = new Matrix4().makeScale(size, size, left ? -size : size);
    this.bones.forEach((bone, i) => bone.matrix.copy(X[i]!).multiply(scale));
    this.arm.matrix.copy(X[0]!).multiply(scale);
    this.meshes[0].visible = !left;
    this.meshes[1].visible = left;
    for (const mesh of this.meshes) mesh.material = stale ? this.looks.stale : this.looks.skin;
    this.arm.material = stale ? this.looks.stale : this.looks.linen;
  }
  dispose(): void {
    this.meshes[1].geometry.dispose();
    this.arm.geometry.dispose();
  }
}

export class Hands {
  readonly group = new Group();
  private shown: ShownHand[] = [];
  private readonly looks = {
    skin: plain(0.58, 0.33, 0.22, 0.5),
    linen: plain(0.36, 0.3, 0.22, 0.95),
    stale: plain(0.42, 0.4, 0.38, 0.7),
  };

  constructor() {
    this.looks.linen.side = DoubleSide;
  }
  /** Shows a frame's hands, and returns where the fresh ones work. */
  show(frame: Frame, camera: Camera): WorkingHand[] {
    const working: WorkingHand[] = [];
    let used = 0;
    for (const hand of frame.hands) {
      const told = segmentsOf(hand);
      if (told.length === 0 || told.some((X) => isStray(new Vector3().setFromMatrixPosition(X)))) continue;
      const whole = hand.whole && told.length === kSegments;
      const X = whole ? told : handAtTip(new Vector3().setFromMatrixPosition(told[0]!), hand.holding, camera);
      const shown = this.shown[used] ?? this.another();
      ++used;
      shown.show(X, hand.stale);
      if (hand.stale) continue;
      const box = new Box3().setFromPoints(X.map((segment) => new Vector3().setFromMatrixPosition(segment)));
      working.push({ box: box.expandByScalar(kFinger_m), holding: hand.holding });
    }
    this.shown.forEach((hand, i) => (hand.group.visible = i < used));
    return working;
  }
  private another(): ShownHand {
    const hand = new ShownHand(this.looks);
    this.shown.push(hand);
    this.group.add(hand.group);
    return hand;
  }
}

/** The place with which a hand touches first. */
export function indexTip(hand: HandFrame): Vector3 | null {
  const X = segmentsOf(hand);
  if (X.length === 0) return null;
  return hand.whole && X.length === kSegments ? fingerTip(X, 1) : new Vector3().setFromMatrixPosition(X[0]!);
}

