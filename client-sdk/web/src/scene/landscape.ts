// Olives, cypresses and brush around a machine: client-sdk/scene/landscape.cpp.
import {
  BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, DataTexture,
  Vector3,
} from 'three';
import { ShortRandom } from './random';
import { kToSun } from './shaders';
import { plain } from './materials';

const kBrushland_m = 40;
const kTreeline_m = 190;
const kLeaves = 420;
const kNear_m = 30;
const kBank_m = 2.5;
const kShadeHeight_m = 0.09;

/** Triangles of water, seen from above: x z of three corners each. */
export type WaterAbove = [number, number][];

export interface LandscapePlan {
  middle: Vector3;
  clearing: number;
  seed: number;
  waters: WaterAbove[];
}

type Kind = 'olive' | 'cypress' | 'brush';
interface Plant {
  kind: Kind;
  p: Vector3;
  height: number;
  seed: number;
}

class Growth {
  private positions: number[] = [];
  private normals: number[] = [];
  private uv: number[] = [];
  private indices: number[] = [];

  quad(p: [Vector3, Vector3, Vector3, Vector3], n: Vector3): void {
    const first = this.positions.length / 3;
    const corners = [0, 0, 1, 0, 1, 1, 0, 1];
    p.forEach((q, k) => {
      this.positions.push(q.x, q.y, q.z);
      this.normals.push(n.x, n.y, n.z);
      this.uv.push(corners[2 * k]!, corners[2 * k + 1]!);
    });
    const along = p[1].clone().sub(p[0]).cross(p[2].clone().sub(p[0])).dot(n) > 0;
    const [b, d] = along ? [1, 3] : [3, 1];
    this.indices.push(first, first + b, first + 2, first, first + 2, first + d);
  }
  limb(from: Vector3, to: Vector3, thick: number, thin: number): void {
    const kSides = 6;
    const along = to.clone().sub(from).normalize();
    const side = new Vector3(Math.abs(along.x) < 0.7 ? 1 : 0, 0, Math.abs(along.x) < 0.7 ? 0 : 1).cross(along).normalize();
    const other = along.clone().cross(side);
    const first = this.positions.length / 3;
    for (let k = 0; k < kSides; ++k) {
      const a = (2 * Math.PI * k) / kSides;
      const out = side.clone().multiplyScalar(Math.cos(a)).addScaledVector(other, Math.sin(a));
      for (const [at, size, v] of [[from, thick, 0], [to, thin, 1]] as const) {
        const q = at.clone().addScaledVector(out, size);
        this.positions.push(q.x, q.y, q.z);
        this.normals.push(out.x, out.y, out.z);
        this.uv.push(k / kSides, v);
      }
      const at = first + 2 * k;
      const next = first + 2 * ((k + 1) % kSides);
      this.indices.push(at, next, at + 1, next, next + 1, at + 1);
    }
  }
  take(): BufferGeometry {
    const out = new BufferGeometry();
    out.setAttribute('position', new BufferAttribute(new Float32Array(this.positions), 3));
    out.setAttribute('normal', new BufferAttribute(new Float32Array(this.normals), 3));
    out.setAttribute('uv', new BufferAttribute(new Float32Array(this.uv), 2));
    out.setIndex(this.indices);
    return out;
  }
}

function direction(random: ShortRandom): Vector3 {
  const y = random.between(-1, 1);
  const a = random.between(0, 2 * Math.PI);
  const r = Math.sqrt(Math.max(1 - y * y, 0));
  return new Vector3(r * Math.cos(a), y, r * Math.sin(a));
}

class Growing {
  readonly bark = new Growth();
  readonly pale = new Growth();
  readonly dark = new Growth();
  readonly cypress = new Growth();
  readonly shade = new Growth();

  private crown(p: Vector3, half: Vector3, leaf: number, leaves: number, bright: Growth, random: ShortRandom): void {
    for (let k = 0; k < leaves; ++k) {
      const out = direction(random);
      const depth = random.between(0.6, 1);
      const at = p.clone().addScaledVector(out.clone().multiply(half), depth);
      const a = direction(random).multiplyScalar(leaf);
      const b = a.clone().cross(direction(random)).normalize().multiplyScalar(0.6 * leaf);
      const light = 0.5 + 0.5 * out.y + 1.2 * (depth - 0.85) + random.between(-0.25, 0.25) > 0.45;
      const n = out.addScaledVector(direction(random), 0.5).add(new Vector3(0, 0.15, 0)).normalize();
      (light ? bright : this.dark).quad([at.clone().sub(a), at.clone().add(b), at.clone().add(a), at.clone().sub(b)], n);
    }
  }
  olive(plant: Plant, coarse: number): void {
    const random = new ShortRandom(plant.seed);
    const h = plant.height;
    const leaf = 0.03 * h * Math.sqrt(coarse);
    const leaves = Math.trunc(kLeaves / coarse / 4);
    const lean = new Vector3(random.between(-0.05, 0.05), random.between(0.25, 0.31), random.between(-0.05, 0.05));
    const fork = plant.p.clone().addScaledVector(lean, h);
    this.bark.limb(plant.p.clone().setY(plant.p.y - 0.2), fork, 0.055 * h, 0.036 * h);
    const turn = random.between(0, 2);
    for (let k = 0; k < 3; ++k) {
      const a = turn + 2.094 * k + random.between(-0.3, 0.3);
      const tip = fork.clone().addScaledVector(new Vector3(0.24 * Math.cos(a), random.between(0.22, 0.32), 0.24 * Math.sin(a)), h);
      this.bark.limb(fork, tip, 0.029 * h, 0.01 * h);
      const r = h * random.between(0.2, 0.26);
      this.crown(tip.setY(tip.y + 0.03 * h), new Vector3(r, 0.78 * r, r), leaf, leaves, this.pale, random);
    }
    const r = 0.28 * h;
    this.crown(fork.clone().setY(fork.y + 0.36 * h), new Vector3(r, 0.8 * r, r), leaf, leaves, this.pale, random);
  }
  cypressTree(plant: Plant, coarse: number): void {
    const random = new ShortRandom(plant.seed);
    const h = plant.height;
    this.bark.limb(plant.p.clone().setY(plant.p.y - 0.2), plant.p.clone().setY(plant.p.y + 0.2 * h), 0.022 * h, 0.018 * h);
    // An opaque core, because a cypress is too dense to be looked through.
    const above = (share: number): Vector3 => plant.p.clone().setY(plant.p.y + share * h);
    this.cypress.limb(above(0.12), above(0.45), 0.045 * h, 0.08 * h);
    this.cypress.limb(above(0.45), above(0.88), 0.08 * h, 0.012 * h);
    const sprays = Math.trunc(300 / coarse);
    for (let k = 0; k < sprays; ++k) {
      const t = random.between(0, 1);
      const r = 0.105 * h * Math.sin(Math.PI * (0.12 + 0.86 * t)) ** 0.8 * (1 - 0.35 * t);
      const a = random.between(0, 2 * Math.PI);
      const outwards = new Vector3(Math.cos(a), 0, Math.sin(a));
      const at = plant.p.clone().addScaledVector(outwards, r);
      at.y += (0.08 + 0.86 * t) * h;
      const wide = 0.017 * h * Math.sqrt(coarse);
      const side = new Vector3(-Math.sin(a), 0, Math.cos(a)).multiplyScalar(wide);
      const foot = at.clone().addScaledVector(outwards, 0.015 * h).setY(at.y - 0.02 * h);
      const n = outwards.clone().add(new Vector3(0, 0.3, 0)).addScaledVector(direction(random), 0.35).normalize();
      this.cypress.quad([at.clone().sub(side), foot, at.clone().add(side), at.clone().setY(at.y + 0.085 * h)], n);
    }
  }
  brush(plant: Plant, coarse: number): void {
    const random = new ShortRandom(plant.seed);
    const h = plant.height;
    for (let k = 0; k < 3; ++k) {
      const r = h * random.between(0.45, 0.75);
      const at = plant.p.clone().add(new Vector3(random.between(-h, h), 0.45 * r, random.between(-h, h)));
      this.crown(at, new Vector3(r, 0.8 * r, r), 0.1 * Math.sqrt(coarse), Math.trunc(48 / coarse), k === 0 ? this.pale : this.dark, random);
    }
  }
  /** The soft shadow of a crown, which is too far away for a shadow map. */
  shadeOf(plant: Plant): void {
    const h = plant.height;
    const tree = plant.kind === 'cypress';
    const wide = tree ? 0.12 * h : plant.kind === 'brush' ? 1.5 * h : 0.52 * h;
    const tall = tree ? 0.95 * h : wide;
    const middle = tree ? 0.5 * h : plant.kind === 'brush' ? 0.4 * h : 0.62 * h;
    const slope = Math.hypot(kToSun.x, kToSun.z) / Math.max(kToSun.y, 0.2);
    const along = new Vector3(kToSun.x, 0, kToSun.z).normalize();
    const across = along.clone().cross(new Vector3(0, 1, 0));
    const p = plant.p.clone().addScaledVector(along, -middle * slope);
    p.y += kShadeHeight_m;
    const a = along.clone().multiplyScalar(tree ? 0.5 * tall * slope + wide : Math.hypot(wide, 0.6 * wide * slope));
    const b = across.multiplyScalar(wide);
    const corner = (i: number, j: number): Vector3 => p.clone().addScaledVector(a, i).addScaledVector(b, j);
    this.shade.quad([corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)], new Vector3(0, 1, 0));
  }
}

function toSegment(p: [number, number], a: [number, number], b: [number, number]): number {
  const [x, y] = [b[0] - a[0], b[1] - a[1]];
  const t = Math.min(Math.max(((p[0] - a[0]) * x + (p[1] - a[1]) * y) / Math.max(x * x + y * y, 1e-12), 0), 1);
  return Math.hypot(p[0] - a[0] - t * x, p[1] - a[1] - t * y);
}

function isWet(plan: LandscapePlan, at: Vector3): boolean {
  const p: [number, number] = [at.x, at.z];
  return plan.waters.some((triangle) => {
    const sides = [0, 1, 2].map((k) => {
      const a = triangle[k]!;
      const b = triangle[(k + 1) % 3]!;
      if (toSegment(p, a, b) < kBank_m) return NaN;
      return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    });
    return sides.some(Number.isNaN) || sides.every((s) => s > 0) || sides.every((s) => s < 0);
  });
}

/** Density of the groves at a place. */
function thickness(plan: LandscapePlan, p: Vector3): number {
  const q = p.clone().sub(plan.middle);
  const phase = (plan.seed % 628) / 100;
  return 0.55 + 0.22 * (Math.sin(0.071 * q.x + phase) + Math.sin(0.058 * q.z - phase) + 0.6 * Math.sin(0.041 * (q.x - q.z) + phase));
}

function scatter(plan: LandscapePlan, kind: Kind, number: number, count: number, reach: number): Plant[] {
  const random = new ShortRandom(plan.seed, 1 + number);
  const turn = random.between(0, 1);
  const out: Plant[] = [];
  for (let tries = 0; out.length < count && tries < 20 * count; ++tries) {
    const away = plan.clearing + reach * random.between(0, 1) ** 1.35;
    const a = 2 * Math.PI * ((0.61803399 * tries + turn + random.between(0, 0.02)) % 1);
    const p = plan.middle.clone().add(new Vector3(away * Math.cos(a), 0, away * Math.sin(a)));
    const size = random.between(0, 1);
    const height = kind === 'olive' ? 3 + 1.4 * size : kind === 'cypress' ? 6.5 + 3 * size : 0.35 + 0.4 * size;
    const wanted = kind === 'olive' ? random.between(0.15, 0.85) : 0;
    if (thickness(plan, p) < wanted || isWet(plan, p)) continue;
    out.push({ kind, p, height, seed: (1000 * plan.seed + tries) >>> 0 });
  }
  return out;
}

/** Dark in the middle, transparent at the rim. */
function shadeMaterial(): MeshBasicMaterial {
  const side = 64;
  const pixels = new Uint8Array(4 * side * side);
  for (let i = 0; i < side * side; ++i) {
    const r = Math.hypot((2 * (i % side) + 1) / side - 1, (2 * Math.floor(i / side) + 1) / side - 1);
    const share = Math.min(Math.max((1 - r) / 0.45, 0), 1);
    pixels[4 * i + 3] = 150 * share * share * (3 - 2 * share);
  }
  const map = new DataTexture(pixels, side, side);
  map.needsUpdate = true;
  return new MeshBasicMaterial({ map, transparent: true, depthWrite: false });
}

function leaf(r: number, g: number, b: number): MeshStandardMaterial {
  const material = plain(r, g, b, 0.9);
  material.side = DoubleSide;
  return material;
}

/** Always the same of the same plan. */
export const plantsOf = (plan: LandscapePlan): Plant[] => [
  ...scatter(plan, 'olive', 0, 140, kTreeline_m),
  ...scatter(plan, 'cypress', 1, 9, kTreeline_m),
  ...scatter(plan, 'brush', 2, 70, kBrushland_m),
];

export function growLandscape(plan: LandscapePlan): Group {
  const growing = new Growing();
  for (const plant of plantsOf(plan)) {
    const coarse = Math.min(Math.max(plant.p.distanceTo(plan.middle) / kNear_m, 1), 6);
    if (plant.kind === 'olive') growing.olive(plant, coarse);
    else if (plant.kind === 'cypress') growing.cypressTree(plant, coarse);
    else growing.brush(plant, coarse);
    growing.shadeOf(plant);
  }
  const group = new Group();
  group.add(
    new Mesh(growing.bark.take(), leaf(0.2, 0.165, 0.125)),
    new Mesh(growing.pale.take(), leaf(0.265, 0.295, 0.165)),
    new Mesh(growing.dark.take(), leaf(0.135, 0.165, 0.078)),
    new Mesh(growing.cypress.take(), leaf(0.055, 0.085, 0.038)),
    new Mesh(growing.shade.take(), shadeMaterial()),
  );
  return group;
}
