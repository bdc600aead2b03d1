// What a joint looks like in the picture: an axis along y of length 2, with an arrow that says how it moves to positive positions.
import {
  ConeGeometry, CylinderGeometry, Group, Matrix4, Mesh, MeshBasicMaterial, SphereGeometry, TorusGeometry, type BufferGeometry,
} from 'three';
import type { JointKind } from '../commands';

const kThin = 0.022;
const kRing = 0.42;
const kRingArc = 1.6 * Math.PI;
/** How far the pale rim stands out. */
const kRim = 0.016;

/** Over all that is before it, as a drawing on glass. */
const glass = { depthTest: false, transparent: true, toneMapped: false, fog: false };
const ink = new MeshBasicMaterial({ ...glass, color: 0x0a6fd6 });
const rim = new MeshBasicMaterial({ ...glass, color: 0xffffff });

const turned = (geometry: BufferGeometry, x: number): BufferGeometry => geometry.applyMatrix4(new Matrix4().makeRotationX(x));
const shifted = (geometry: BufferGeometry, x: number, y: number): BufferGeometry =>
  geometry.applyMatrix4(new Matrix4().makeTranslation(x, y, 0));

/** Each grown by `more` to all sides. */
function geometriesOf(kind: JointKind, more: number): BufferGeometry[] {
  const rod = (length: number): BufferGeometry => new CylinderGeometry(kThin + more, kThin + more, length + 2 * more, 12);
  const tip = (): BufferGeometry => new ConeGeometry(0.085 + 1.6 * more, 0.22 + 3 * more, 16);
  const ball = (radius: number): BufferGeometry => new SphereGeometry(radius + more, 20, 14);
  const ring = (arc: number): BufferGeometry => new TorusGeometry(kRing, kThin + more, 10, 48, arc);
  switch (kind) {
    case 'hinge': {
      const head = shifted(tip(), kRing, 0).applyMatrix4(new Matrix4().makeRotationZ(kRingArc));
      // Seen from the axis' tip, it goes anticlockwise.
      return [rod(2), ball(0.06), turned(ring(kRingArc), -Math.PI / 2), turned(head, -Math.PI / 2)];
    }
    case 'slider':
      return [rod(1.8), ball(0.06), shifted(tip(), 0, 0.95)];
    case 'ball':
      return [ball(0.11), ring(2 * Math.PI), turned(ring(2 * Math.PI), -Math.PI / 2)];
  }
}

export function jointShape(kind: JointKind): Group {
  const group = new Group();
  for (const [material, more, order] of [[rim, kRim, 3], [ink, 0, 4]] as const) {
    for (const geometry of geometriesOf(kind, more)) {
      const mesh = new Mesh(geometry, material);
      mesh.renderOrder = order;
      group.add(mesh);
    }
  }
  return group;
}
