// The surface where a distance is zero, as triangles (client-sdk/scene/surface_net.cpp).
import { BufferAttribute, BufferGeometry, Vector3, type Box3 } from 'three';

type Distance = (p: [number, number, number]) => number;

export function surfaceNet(distance: Distance, box: Box3, cell: number): BufferGeometry {
  const size = box.getSize(new Vector3());
  const count = [size.x, size.y, size.z].map((s) => 2 + Math.ceil(s / cell)) as [number, number, number];
  const [nx, ny, nz] = count;
  const at = (x: number, y: number, z: number): number => (z * ny + y) * nx + x;
  const place = (x: number, y: number, z: number): [number, number, number] => [
    box.min.x + cell * x,
    box.min.y + cell * y,
    box.min.z + cell * z,
  ];
  const values = new Float32Array(nx * ny * nz);
  for (let z = 0; z < nz; ++z)
    for (let y = 0; y < ny; ++y)
      for (let x = 0; x < nx; ++x) values[at(x, y, z)] = distance(place(x, y, z));

  const positions: number[] = [];
  const vertexOf = new Int32Array(values.length).fill(-1);
  const crossing = (c: [number, number, number]): [number, number, number] | null => {
    const sum: [number, number, number] = [0, 0, 0];
    let crossings = 0;
    const corner = (i: number): [number, number, number] => [c[0] + (i & 1), c[1] + ((i >> 1) & 1), c[2] + ((i >> 2) & 1)];
    for (let a = 0; a < 8; ++a) {
      for (let axis = 0; axis < 3; ++axis) {
        if ((a >> axis) & 1) continue;
        const p = corner(a);
        const q = corner(a | (1 << axis));
        const dp = values[at(...p)]!;
        const dq = values[at(...q)]!;
        if (dp < 0 === dq < 0) continue;
        const from = place(...p);
        const to = place(...q);
        for (let k = 0; k < 3; ++k) sum[k] = sum[k]! + from[k]! + (dp / (dp - dq)) * (to[k]! - from[k]!);
        ++crossings;
      }
    }
    return crossings === 0 ? null : (sum.map((s) => s / crossings) as [number, number, number]);
  };
  for (let z = 0; z + 1 < nz; ++z)
    for (let y = 0; y + 1 < ny; ++y)
      for (let x = 0; x + 1 < nx; ++x) {
        const p = crossing([x, y, z]);
        if (!p) continue;
        vertexOf[at(x, y, z)] = positions.length / 3;
        positions.push(...p);
      }

  const indices: number[] = [];
  const step = [1, nx, nx * ny];
  for (let z = 1; z + 1 < nz; ++z)
    for (let y = 1; y + 1 < ny; ++y)
      for (let x = 1; x + 1 < nx; ++x) {
        const here = at(x, y, z);
        for (let axis = 0; axis < 3; ++axis) {
          const inside = values[here]! < 0;
          if (inside === values[here + step[axis]!]! < 0) continue;
          const u = step[(axis + 1) % 3]!;
          const v = step[(axis + 2) % 3]!;
          const [a, b, c, d] = [vertexOf[here - u - v]!, vertexOf[here - v]!, vertexOf[here]!, vertexOf[here - u]!];
          if (inside) indices.push(a, b, c, a, c, d);
          else indices.push(a, c, b, a, d, c);
        }
      }
  const out = new BufferGeometry();
  out.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  out.setIndex(indices);
  out.computeVertexNormals();
  return out;
}
