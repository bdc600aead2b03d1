// What a finger points at: client-sdk/pointer/pointer_pick.cpp. A finger is broad, so things that can be taken come first.
import { type Intersection, Mesh, type Object3D, type PerspectiveCamera, Raycaster, Vector2, Vector3 } from 'three';
import type { Presentation } from '../wire/messages';
import { isEnabled } from './step_view';

// Shares of the picture's height: 7 mm on a screen 30 cm high.
const kFingertip = [0.006, 0.012, 0.018, 0.024];
const kRound = 12;
const kTries = 28;

export interface Pick {
  object: number;
  p: Vector3;
  n: Vector3;
}
export interface Target {
  group: Object3D;
  object: number | null;
}
export interface PickScene {
  targets: Target[];
  takeable: (object: number) => boolean;
  camera: PerspectiveCamera;
  width: number;
  height: number;
}

export function isTakeable(presentation: Presentation | null, agents: readonly string[], object: number, movable: boolean): boolean {
  if (!movable || !presentation) return false;
  if (presentation.affordances.length === 0) return true;
  return presentation.affordances.some((a) => a.kind === 'taken' && a.object === object && isEnabled(a, agents));
}

const isSolid = (o: Object3D): boolean => o instanceof Mesh && o.visible && o.renderOrder === 0;

/** Nearest thing under a pixel, or null. */
function hitAt(scene: PickScene, targets: readonly Target[], x: number, y: number): { target: Target; hit: Intersection } | null {
  const caster = new Raycaster();
  caster.setFromCamera(new Vector2((2 * x) / scene.width - 1, 1 - (2 * y) / scene.height), scene.camera);
  let nearest: { target: Target; hit: Intersection } | null = null;
  for (const target of targets) {
    const [hit] = caster.intersectObjects(target.group.children.filter(isSolid), false);
    if (hit && (!nearest || hit.distance < nearest.hit.distance)) nearest = { target, hit };
  }
  return nearest;
}

function pickOf(found: { target: Target; hit: Intersection } | null): Pick | null {
  if (!found || found.target.object === null) return null;
  const { hit } = found;
  const n = (hit.face?.normal.clone() ?? new Vector3(0, 1, 0)).transformDirection(hit.object.matrixWorld);
  return { object: found.target.object, p: hit.point, n };
}

export interface UnderFinger {
  seen: Pick | null;
  takeable: Pick | null;
}

export function underFinger(scene: PickScene, x: number, y: number): UnderFinger {
  const seen = pickOf(hitAt(scene, scene.targets, x, y));
  if (seen && scene.takeable(seen.object)) return { seen, takeable: seen };
  const these = scene.targets.filter((t) => t.object !== null && scene.takeable(t.object));
  if (these.length === 0) return { seen, takeable: null };
  for (const share of kFingertip) {
    for (let k = 0; k < kRound; ++k) {
      const angle = (2 * Math.PI * k) / kRound;
      const [u, v] = [x + share * scene.height * Math.cos(angle), y + share * scene.height * Math.sin(angle)];
      const one = pickOf(hitAt(scene, these, u, v));
      if (one && pickOf(hitAt(scene, scene.targets, u, v))?.object === one.object) return { seen, takeable: one };
    }
  }
  return { seen, takeable: null };
}

/** In pixels; null: behind the eye. */
export function pixelOf(camera: PerspectiveCamera, width: number, height: number, p: Vector3): { x: number; y: number } | null {
  const q = p.clone().applyMatrix4(camera.matrixWorldInverse);
  if (q.z > -1e-3) return null;
  q.applyMatrix4(camera.projectionMatrix);
  return { x: ((1 + q.x) / 2) * width, y: ((1 - q.y) / 2) * height };
}

/** Where to take a thing: a crank by its far end, another by its middle. Null: it is not in the picture, or hidden. */
export function placeToTake(scene: PickScene, object: number, axle: { p: Vector3; d: Vector3 } | null): { x: number; y: number } | null {
  const target = scene.targets.find((t) => t.object === object);
  if (!target) return null;
  const seen: { p: Vector3; x: number; y: number }[] = [];
  for (const mesh of target.group.children.filter(isSolid) as Mesh[]) {
    const position = mesh.geometry.getAttribute('position');
    const index = mesh.geometry.index!;
    const triangles = index.count / 3;
    const tries = Math.min(kTries, triangles);
    for (let k = 0; k < tries; ++k) {
      const first = 3 * Math.floor((k * triangles) / tries);
      const p = new Vector3();
      for (let i = 0; i < 3; ++i) p.add(new Vector3().fromBufferAttribute(position, index.getX(first + i)));
      p.divideScalar(3).applyMatrix4(mesh.matrixWorld);
      const at = pixelOf(scene.camera, scene.width, scene.height, p);
      if (!at || at.x < 0 || at.y < 0 || at.x >= scene.width || at.y >= scene.height) continue;
      if (pickOf(hitAt(scene, scene.targets, at.x, at.y))?.object === object) seen.push({ p, ...at });
    }
  }
  if (seen.length === 0) return null;
  const mean = seen.reduce((sum, s) => sum.add(s.p), new Vector3()).divideScalar(seen.length);
  const worth = (p: Vector3): number => (axle ? p.clone().sub(axle.p).cross(axle.d).length() : -p.distanceTo(mean));
  return seen.reduce((best, s) => (worth(s.p) > worth(best.p) ? s : best));
}
