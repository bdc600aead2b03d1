// A measure between two points of the picture.
import { BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, SphereGeometry, Vector3,
  type Camera } from 'three';
import type { Vector } from '../commands';

const kColour = 0x0b5c7a;
/** Of a point's mark: its radius, as a share of its distance from the eye. */
const kDotShare = 0.006;

export interface Measured {
  from: Vector;
  /** Null: its other end is not chosen yet. */
  to: Vector | null;
}

/** "0.532 m (x 0.5, y -0.1, z 0.02)": along the world's axes. */
export function measuredText({ from, to }: Measured): string {
  if (!to) return '';
  const by = to.map((x, i) => x - from[i]!);
  const axes = ['x', 'y', 'z'].map((axis, i) => `${axis} ${Number(by[i]!.toFixed(3)) + 0}`);
  return `${Math.hypot(...by).toFixed(3)} m  (${axes.join(', ')})`;
}

export class Ruler {
  readonly group = new Group();
  private readonly dot = new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ color: kColour, depthTest: false, fog: false,
    toneMapped: false, transparent: true }));
  private readonly other = this.dot.clone();
  private readonly line = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: kColour, depthTest: false, fog: false,
    toneMapped: false, transparent: true }));

  constructor() {
    this.group.visible = false;
    this.group.add(this.dot, this.other, this.line);
    for (const part of this.group.children) part.renderOrder = 3;
  }
  /** Null: nothing is measured. */
  show(measured: Measured | null): void {
    this.group.visible = measured !== null;
    if (!measured) return;
    const [from, to] = [new Vector3(...measured.from), new Vector3(...(measured.to ?? measured.from))];
    this.dot.position.copy(from);
    this.other.position.copy(to);
    this.line.geometry.setFromPoints([from, to]);
  }
  /** Its ends are as large wherever the eye is. */
  face(camera: Camera): void {
    for (const dot of [this.dot, this.other]) dot.scale.setScalar(kDotShare * camera.position.distanceTo(dot.position));
  }
}
