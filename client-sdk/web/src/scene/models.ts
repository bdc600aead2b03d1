// Mesh files by content: each is fetched once; a node of one becomes a few meshes, one for each material.
import {
  Box3, BoxGeometry, BufferAttribute, BufferGeometry, type Material, Matrix4, Mesh, type MeshStandardMaterial,
  type Object3D,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import { plain } from './materials';

const kBoxHalf_m = 0.12;
const kLandMaterial = 'earth';
const kWater = 'WATER_';
/** A file that did not come is asked for again. */
const kAgain_ms = [2_000, 5_000, 15_000];

export interface Part {
  geometry: BufferGeometry;
  material: Material;
  water: boolean;
  land: boolean;
}
export interface Model {
  parts: Part[];
  /** In the node's frame. */
  box: Box3;
  missing: boolean;
}
export interface ModelFile {
  scene: Object3D;
  models: Map<string, Model>;
}

const nameOf = (object: Object3D): string => String(object.userData.name ?? object.name);

function isUnder(object: Object3D, test: (o: Object3D) => boolean): boolean {
  for (let at: Object3D | null = object; at; at = at.parent) if (test(at)) return true;
  return false;
}

/** With exactly position, normal, uv and an index, so that all can be merged. */
function plainGeometry(mesh: Mesh, X: Matrix4): BufferGeometry {
  const from = mesh.geometry as BufferGeometry;
  const out = new BufferGeometry();
  const position = from.getAttribute('position') as BufferAttribute;
  out.setAttribute('position', position.clone());
  if (from.getAttribute('normal')) out.setAttribute('normal', (from.getAttribute('normal') as BufferAttribute).clone());
  const uv = from.getAttribute('uv') as BufferAttribute | undefined;
  out.setAttribute('uv', uv ? uv.clone() : new BufferAttribute(new Float32Array(2 * position.count), 2));
  out.setIndex(from.index ? from.index.clone() : [...Array(position.count).keys()]);
  if (!from.getAttribute('normal')) out.computeVertexNormals();
  out.applyMatrix4(X);
  if (X.determinant() < 0) turnTriangles(out);
  return out;
}

/** Turns all triangles round: what was their back is their front. */
export function turnTriangles(geometry: BufferGeometry): void {
  const index = geometry.index!;
  for (let i = 0; i + 2 < index.count; i += 3) {
    const b = index.getX(i + 1);
    index.setX(i + 1, index.getX(i + 2));
    index.setX(i + 2, b);
  }
}

/** Drawn in place of a model that cannot be. */
function boxInPlace(): Model {
  const geometry = new BoxGeometry(2 * kBoxHalf_m, 2 * kBoxHalf_m, 2 * kBoxHalf_m);
  geometry.computeBoundingBox();
  const part = { geometry, material: plain(0.62, 0.55, 0.44, 0.9), water: false, land: false };
  return { parts: [part], box: geometry.boundingBox!.clone(), missing: true };
}

/** All that lies at or below a node, in the node's frame; an empty name: the whole file. */
function modelOf(file: ModelFile, node: string): Model {
  let top: Object3D | undefined = node === '' ? file.scene : undefined;
  file.scene.traverse((o) => {
    if (!top && nameOf(o) === node) top = o;
  });
  if (!top) return boxInPlace();
  const back = top.matrixWorld.clone().invert();
  const groups = new Map<string, { material: Material; water: boolean; geometries: BufferGeometry[] }>();
  top.traverse((o) => {
    if (!(o instanceof Mesh)) return;
    const water = isUnder(o, (above) => nameOf(above).startsWith(kWater));
    const material = o.material as Material;
    const key = water ? 'water' : material.uuid;
    const group = groups.get(key) ?? { material, water, geometries: [] };
    group.geometries.push(plainGeometry(o, back.clone().multiply(o.matrixWorld)));
    groups.set(key, group);
  });
  const model: Model = { parts: [], box: new Box3(), missing: false };
  for (const { material, water, geometries } of groups.values()) {
    const geometry = mergeGeometries(geometries);
    geometry.computeBoundingBox();
    model.box.union(geometry.boundingBox!);
    model.parts.push({ geometry, material, water, land: !water && material.name.startsWith(kLandMaterial) });
  }
  return model.parts.length > 0 ? model : boxInPlace();
}

export class ModelStore {
  private files = new Map<string, ModelFile | 'coming' | 'missing'>();
  private loader = new GLTFLoader();
  /** For the technician: what is shown as a box. */
  readonly missing = new Set<string>();

  /** `address`: of a file by its hash. `changed`: a file has come, or did not. */
  constructor(
    private readonly address: (hash: string) => string,
    private readonly changed: () => void,
  ) {}

  /** The file, if it is there; else it is fetched. */
  file(hash: string): ModelFile | null {
    const known = this.files.get(hash);
    if (known === undefined) void this.fetch(hash, 0);
    return typeof known === 'object' ? known : null;
  }
  isComing(hash: string): boolean {
    return this.files.get(hash) === 'coming';
  }
  /** Null while it is coming; a box where it cannot be had. */
  model(hash: string, uri: string, node: string): Model | null {
    const file = this.file(hash);
    if (!file) return this.isComing(hash) ? null : boxInPlace();
    let model = file.models.get(node);
    if (!model) {
      model = modelOf(file, node);
      if (model.missing) this.missing.add(`${uri}#${node}`);
      file.models.set(node, model);
    }
    return model;
  }
  /** Names of scenery that stands in a file beside its objects: SCENE and WATER_... */
  scenery(file: ModelFile): { node: string; X: Matrix4 }[] {
    const out: { node: string; X: Matrix4 }[] = [];
    file.scene.traverse((o) => {
      const name = nameOf(o);
      if (name === 'SCENE' || (name.startsWith(kWater) && !isUnder(o.parent ?? file.scene, (p) => nameOf(p).startsWith(kWater))))
        out.push({ node: name, X: o.matrixWorld.clone() });
    });
    return out;
  }

  private async fetch(hash: string, tries: number): Promise<void> {
    this.files.set(hash, 'coming');
    try {
      const answer = await fetch(this.address(hash));
      if (!answer.ok) throw new Error(`the gateway answered ${answer.status}`);
      const gltf = await this.loader.parseAsync(await answer.arrayBuffer(), '');
      gltf.scene.updateMatrixWorld(true);
      this.soften(gltf.scene);
      this.files.set(hash, { scene: gltf.scene, models: new Map() });
      this.missing.delete(hash);
    } catch (error) {
      console.warn(`mesh file ${hash}: ${String(error)}; a plain box is shown in its place`);
      this.files.set(hash, 'missing');
      this.missing.add(hash);
      const wait = kAgain_ms[tries];
      if (wait !== undefined) setTimeout(() => void this.fetch(hash, tries + 1), wait);
    }
    this.changed();
  }
  /** Textures are seen at a grazing angle. */
  private soften(scene: Object3D): void {
    scene.traverse((o) => {
      if (!(o instanceof Mesh)) return;
      const material = o.material as MeshStandardMaterial;
      for (const image of [material.map, material.normalMap, material.roughnessMap]) if (image) image.anisotropy = 4;
    });
  }
}
