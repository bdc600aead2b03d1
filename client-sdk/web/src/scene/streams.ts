// Falling water: a tube along its parabola.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, Mesh, type ShaderMaterial, Vector3 } from 'three';
import { breakupTime, flightTime, type Stream } from './effects';
import { streamMaterial } from './materials';

const kGravity = 9.81;
const kRings = 36;
const kSectors = 12;

function emptyTube(): BufferGeometry {
  const out = new BufferGeometry();
  const vertices = (kRings + 1) * (kSectors + 1);
  for (const [name, size] of [['position', 3], ['normal', 3], ['uv', 2]] as const)
    out.setAttribute(name, new BufferAttribute(new Float32Array(size * vertices), size).setUsage(DynamicDrawUsage));
  const indices: number[] = [];
  for (let i = 0; i < kRings; ++i)
    for (let k = 0; k < kSectors; ++k) {
      const a = i * (kSectors + 1) + k;
      const d = a + kSectors + 1;
      indices.push(a, a + 1, d + 1, a, d + 1, d);
    }
  out.setIndex(indices);
  return out;
}

function shape(stream: Stream, out: BufferGeometry): void {
  const position = out.getAttribute('position') as BufferAttribute;
  const normal = out.getAttribute('normal') as BufferAttribute;
  const uv = out.getAttribute('uv') as BufferAttribute;
  const flight = flightTime(stream);
  const across = stream.v.clone().cross(new Vector3(0, 1, 0));
  if (across.length() > 1e-5) across.normalize();
  else across.set(0, 0, 1);
  const start = Math.max(stream.v.length(), 0.3);
  for (let ring = 0; ring <= kRings; ++ring) {
    const t = (flight * ring) / kRings;
    const v = stream.v.clone().setY(stream.v.y - kGravity * t);
    const p = stream.p.clone().addScaledVector(stream.v, t);
    p.y -= 0.5 * kGravity * t * t;
    const speed = v.length();
    const along = speed > 1e-5 ? v.divideScalar(speed) : new Vector3(0, -1, 0);
    const up = across.clone().cross(along);
    // The same amount of water passes each ring, so the section shrinks as the speed grows.
    const halfWidth = 0.5 * stream.width * Math.sqrt(start / Math.max(speed, start));
    const halfDepth = (stream.jet ? 1 : 0.45) * halfWidth;
    for (let k = 0; k <= kSectors; ++k) {
      const a = (2 * Math.PI * k) / kSectors;
      const [c, s] = [Math.cos(a), Math.sin(a)];
      const n = across.clone().multiplyScalar(c * halfDepth).addScaledVector(up, s * halfWidth).normalize();
      const q = p.clone().addScaledVector(across, c * halfWidth).addScaledVector(up, s * halfDepth);
      const i = ring * (kSectors + 1) + k;
      position.setXYZ(i, q.x, q.y, q.z);
      normal.setXYZ(i, n.x, n.y, n.z);
      uv.setXY(i, k / kSectors, t);
    }
  }
  for (const attribute of [position, normal, uv]) attribute.needsUpdate = true;
}

export class Streams {
  readonly group = new Group();

  show(streams: readonly Stream[], time: number): void {
    while (this.group.children.length < streams.length) {
      const mesh = new Mesh(emptyTube(), streamMaterial());
      mesh.frustumCulled = false;
      mesh.renderOrder = 2;
      this.group.add(mesh);
    }
    this.group.children.forEach((child, i) => {
      const mesh = child as Mesh<BufferGeometry, ShaderMaterial>;
      const stream = streams[i];
      mesh.visible = stream !== undefined;
      if (!stream) return;
      shape(stream, mesh.geometry);
      mesh.material.uniforms.time_s!.value = time % 1000;
      mesh.material.uniforms.broken_s!.value = stream.jet ? breakupTime(stream) : 1e6;
      mesh.material.uniforms.lumps_per_s!.value = stream.jet ? Math.min(stream.v.length() / (5 * stream.width), 40) : 8;
    });
  }
}
