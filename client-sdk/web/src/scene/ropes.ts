// Ropes as tubes of laid hemp through their points.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, Mesh, MeshStandardMaterial, Quaternion, Vector3 } from 'three';
import type { RopeFrame } from '../wire/frame';
import { isStray } from './hands';
import { kNoise } from './shaders';

const kSides = 10;
/** The most that a rope's direction turns from one ring to the next. */
const kTurn_rad = 0.2;
/** How far before and after a point its corner is rounded, in radii. */
const kRounded = 4;

interface Ring {
  p: Vector3;
  along: Vector3;
}

function addCorner(p: Vector3, from: Vector3, to: Vector3, reach: number, rings: Ring[]): void {
  const axis = from.clone().cross(to);
  const angle = Math.atan2(axis.length(), from.dot(to));
  if (angle < 0.5 * kTurn_rad) {
    rings.push({ p, along: from.clone().add(to).normalize() });
    return;
  }
  if (axis.length() < 1e-5) axis.set(from.y, -from.x, 0).add(new Vector3(0, 0, 1e-6));
  axis.normalize();
  const steps = Math.ceil(angle / kTurn_rad);
  for (let step = 0; step <= steps; ++step) {
    const turned = (angle * step) / steps;
    const t = step === 0 ? 0 : step === steps ? 1 : Math.sin(turned) / (Math.sin(turned) + Math.sin(angle - turned));
    const place = p.clone().addScaledVector(from, -(1 - t) * (1 - t) * reach).addScaledVector(to, t * t * reach);
    rings.push({ p: place, along: from.clone().applyAxisAngle(axis, turned) });
  }
}

/** From the tied end, so that the twist does not move while a drum winds up the other end. */
export function ropeRings(rope: RopeFrame): Ring[] {
  const radius = rope.diameter / 2;
  const points: Vector3[] = [];
  for (let i = rope.points.length / 3 - 1; i >= 0; --i) {
    const p = new Vector3(rope.points[3 * i], rope.points[3 * i + 1], rope.points[3 * i + 2]);
    const last = points.at(-1);
    if (!isStray(p) && (!last || last.distanceTo(p) > 0.1 * radius)) points.push(p);
  }
  if (points.length < 2 || !(radius > 0)) return [];
  const direction = (i: number): Vector3 => points[i + 1]!.clone().sub(points[i]!).normalize();
  const rings: Ring[] = [{ p: points[0]!, along: direction(0) }];
  for (let i = 1; i + 1 < points.length; ++i) {
    const room = 0.5 * Math.min(points[i + 1]!.distanceTo(points[i]!), points[i]!.distanceTo(points[i - 1]!));
    addCorner(points[i]!, direction(i - 1), direction(i), Math.min(room, kRounded * radius), rings);
  }
  rings.push({ p: points.at(-1)!, along: direction(points.length - 2) });
  return rings;
}

function hemp(): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ roughness: 0.92, metalness: 0 });
  (material as MeshStandardMaterial & { defines: Record<string, string> }).defines = { STANDARD: '', USE_UV: '' };
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace('#include <common>', `#include <common>\n${kNoise}`).replace(
      '#include <map_fragment>',
      /* glsl */ `
  float lay = vUv.x + vUv.y / 7.0;
  float across = fract(3.0 * lay) - 0.5;
  float strand = mod(floor(3.0 * lay), 3.0);
  float detail = 1.0 - smoothstep(0.30, 0.80, length(vec2(dFdx(lay), dFdy(lay))) * 3.0);
  float groove = mix(0.78, mix(0.30, 1.0, smoothstep(0.50, 0.24, abs(across))), detail);
  float fibre = value_noise(vec2(across * 9.0 + strand * 17.0, vUv.y * 0.9)) * 0.6
    + value_noise(vec2(across * 23.0 + strand * 31.0, vUv.y * 2.3)) * 0.4;
  diffuseColor.rgb = mix(vec3(0.30, 0.205, 0.10), vec3(0.52, 0.385, 0.205), mix(0.5, fibre, detail)) * groove;`,
    );
  };
  return material;
}

/** One rope's tube, whose buffers grow as they must. */
class Tube {
  readonly mesh: Mesh;
  private rings = 0;

  constructor(material: MeshStandardMaterial) {
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
  }
  show(rings: readonly Ring[], radius: number): void {
    this.reserve(rings.length);
    const geometry = this.mesh.geometry;
    const position = geometry.getAttribute('position') as BufferAttribute;
    const normal = geometry.getAttribute('normal') as BufferAttribute;
    const uv = geometry.getAttribute('uv') as BufferAttribute;
    const side = new Vector3(1, 0.29, 0.73).cross(rings[0]!.along).normalize();
    let length = 0;
    rings.forEach((ring, i) => {
      const before = rings[i - 1];
      if (before) {
        length += ring.p.distanceTo(before.p);
        side.applyQuaternion(new Quaternion().setFromUnitVectors(before.along, ring.along));
      }
      side.addScaledVector(ring.along, -ring.along.dot(side)).normalize();
      const up = ring.along.clone().cross(side);
      for (let k = 0; k <= kSides; ++k) {
        const a = (2 * Math.PI * k) / kSides;
        const n = side.clone().multiplyScalar(Math.cos(a)).addScaledVector(up, Math.sin(a));
        const v = i * (kSides + 1) + k;
        position.setXYZ(v, ring.p.x + radius * n.x, ring.p.y + radius * n.y, ring.p.z + radius * n.z);
        normal.setXYZ(v, n.x, n.y, n.z);
        uv.setXY(v, k / kSides, length / radius);
      }
    });
    for (const attribute of [position, normal, uv]) attribute.needsUpdate = true;
    geometry.setDrawRange(0, 6 * kSides * (rings.length - 1));
  }
  private reserve(rings: number): void {
    if (rings <= this.rings) return;
    this.rings = 2 * rings;
    const vertices = this.rings * (kSides + 1);
    const geometry = new BufferGeometry();
    for (const [name, size] of [['position', 3], ['normal', 3], ['uv', 2]] as const)
      geometry.setAttribute(name, new BufferAttribute(new Float32Array(size * vertices), size).setUsage(DynamicDrawUsage));
    const indices: number[] = [];
    for (let i = 0; i + 1 < this.rings; ++i)
      for (let k = 0; k < kSides; ++k) {
        const a = i * (kSides + 1) + k;
        const d = a + kSides + 1;
        indices.push(a, a + 1, d + 1, a, d + 1, d);
      }
    geometry.setIndex(indices);
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
  }
}

export class Ropes {
  readonly group = new Group();
  private tubes: Tube[] = [];
  private readonly material = hemp();

  show(ropes: readonly RopeFrame[]): void {
    let used = 0;
    for (const rope of ropes) {
      const rings = ropeRings(rope);
      if (rings.length < 2) continue;
      let tube = this.tubes[used];
      if (!tube) {
        tube = new Tube(this.material);
        this.tubes.push(tube);
        this.group.add(tube.mesh);
      }
      tube.mesh.visible = true;
      tube.show(rings, rope.diameter / 2);
      ++used;
    }
    for (const tube of this.tubes.slice(used)) tube.mesh.visible = false;
  }
}
