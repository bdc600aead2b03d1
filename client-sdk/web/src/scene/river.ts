// A river beyond its modelled piece, over the plain: client-sdk/scene/river_reach.cpp.
import { BufferAttribute, BufferGeometry, type Matrix4, Vector3 } from 'three';

const kReach_m = 240;
const kRows = 64;
/** The modelled water is wider than what is visible between its banks. */
const kSeenShare = 0.86;
const kBend_m = 7;
const kBendLength_m = 27;

function bend(along: number): number {
  const begun = Math.min(along / (2 * kBendLength_m), 1);
  return kBend_m * begun * begun * (Math.sin(along / kBendLength_m) + 0.5 * Math.sin(along / (2.3 * kBendLength_m) + 1));
}

/** Null where the water has no border in this direction. In W. */
export function riverReach(water: BufferGeometry, X: Matrix4, direction: Vector3): { geometry: BufferGeometry; width: number } | null {
  const along = new Vector3(direction.x, 0, direction.z).normalize();
  const across = along.clone().cross(new Vector3(0, 1, 0));
  const position = water.getAttribute('position');
  const points = Array.from({ length: position.count }, (_, i) => new Vector3().fromBufferAttribute(position, i).applyMatrix4(X));
  const reaches = points.map((p) => along.dot(p));
  const last = reaches.reduce((a, b) => Math.max(a, b), -Infinity);
  const first = reaches.reduce((a, b) => Math.min(a, b), Infinity);
  const within = Math.max(0.04 * (last - first), 1e-3);
  const border = points.filter((_, i) => reaches[i]! > last - within);
  if (border.length === 0) return null;
  const sides = border.map((p) => across.dot(p));
  const low = Math.min(...sides);
  const high = Math.max(...sides);
  if (high - low < 0.05) return null;
  const heights = border.map((p) => p.y);
  const height = (Math.min(...heights) + Math.max(...heights)) / 2;
  const begin = Math.min(...border.map((p) => along.dot(p)));
  const width = kSeenShare * (high - low);
  const positions: number[] = [];
  const normals: number[] = [];
  const uv: number[] = [];
  const indices: number[] = [];
  for (let row = 0; row <= kRows; ++row) {
    const away = kReach_m * (row / kRows) ** 2;
    for (const side of [0, 1]) {
      const p = along.clone().multiplyScalar(begin + away).addScaledVector(across, (low + high) / 2 + bend(away) + (side - 0.5) * width);
      positions.push(p.x, height, p.z);
      normals.push(0, 1, 0);
      uv.push(side, away);
    }
    const k = 2 * row;
    if (row > 0) indices.push(k - 2, k - 1, k, k, k - 1, k + 1);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normals), 3));
  geometry.setAttribute('uv', new BufferAttribute(new Float32Array(uv), 2));
  geometry.setIndex(indices);
  return { geometry, width };
}
