// The scene of a world, as the native display builds it (client-sdk/scene/scene_builder.cpp): what stands, moves, flows and burns.
import {
  Box3,
  CircleGeometry,
  DirectionalLight,
  Fog,
  Group,
  type Material,
  Matrix4,
  Mesh,
  type MeshStandardMaterial,
  type Object3D,
  type PerspectiveCamera,
  PointLight,
  Quaternion,
  Scene,
  SphereGeometry,
  Vector2,
  Vector3,
} from 'three';
import { kPose, type Frame } from '../wire/frame';
import { textIn, type KioskState, type PoseArray, type Presentation, type SceneObject } from '../wire/messages';
import { aboveCaption, cameraAt, frameBox, lookOver, rigid, type Camera } from './camera';
import { effectsOf, flowOf, levelOf } from './effects';
import { Hands, indexTip, isStray } from './hands';
import { growLandscape, type WaterAbove } from './landscape';
import { landMaterial, skyMaterial, waterMaterial } from './materials';
import type { Model, ModelStore, Part } from './models';
import { appendDrops, appendParticles, appendSplash, Particles, type Particle } from './particles';
import { riverReach } from './river';
import { Ropes } from './ropes';
import { kHaze, kSunColour, kSunIrradiance, kToSun } from './shaders';
import { workplace, type Standing } from './step_view';
import { Streams } from './streams';

const kLeastLevel_m = 0.002;
const kLandscape_m = 40;
const kClearing_m = 13;
const kLeastClearing_m = 20;
const kMostClearing_m = 120;
const kSharpReach_m = 2.5;
/** A name appears when a free hand's finger comes so near to a thing. */
const kHandsBreadth_m = 0.1;
const kPlain_m = 1200;

/** A thing of the manifest, or scenery beside it. */
interface Placed {
  object: SceneObject | null;
  node: string;
  X: Matrix4;
  model: Model;
  group: Group;
}

export interface NamedThing {
  object: number;
  name: string;
  X: Matrix4;
  box: Box3;
}

function surfaceOf(part: Part, material: Material): Mesh {
  const mesh = new Mesh(part.geometry, material);
  // Land casts no shadow: its rim would shade the land itself, although the plain continues there.
  mesh.castShadow = !part.water && !part.land;
  mesh.receiveShadow = !part.water;
  mesh.renderOrder = part.water ? 1 : 0;
  return mesh;
}

export class WorldScene {
  readonly scene = new Scene();
  readonly sun = new DirectionalLight(kSunColour, kSunIrradiance);
  /** The usual view of this world. */
  camera: Camera = frameBox(new Box3(), new Vector3(0.2, 0.27, 1), (40 * Math.PI) / 180);
  /** Where hands work; empty: nowhere. */
  work = new Box3();
  /** What words do not cover. */
  seen: Box3[] = [];
  /** The thing that a free hand is about to touch, and where. */
  nearHand: { object: number; p: Vector3 } | null = null;
  complete = false;

  private readonly hands = new Hands();
  private readonly ropes = new Ropes();
  private readonly streams = new Streams();
  private readonly particles = new Particles();
  private readonly fires = [0, 1].map(() => new PointLight(0xff7021, 0, 6, 2));
  private readonly things = new Group();
  private readonly sky: Mesh;
  private readonly plain: Mesh;
  private readonly plainHeight = { value: 0 };
  private readonly waterTime = { value: 0 };
  private land: MeshStandardMaterial | null = null;
  private landscape: Group | null = null;
  private grownAbout = '';
  private placed: Placed[] = [];
  private box = new Box3();
  /** What visitors touch and look at. */
  interest = new Box3();
  private ground: number | null = null;
  private waterHeight: number | null = null;
  private backdrop = true;
  private state: KioskState | null = null;

  constructor(private readonly models: ModelStore) {
    this.sky = new Mesh(new SphereGeometry(300, 48, 32), skyMaterial(true));
    this.sky.frustumCulled = false;
    this.sky.renderOrder = -1;
    this.plain = new Mesh(new CircleGeometry(kPlain_m, 96).rotateX(-Math.PI / 2), landMaterial(null, null, this.plainHeight));
    this.plain.receiveShadow = true;
    this.plain.visible = false;
    this.sun.castShadow = true;
    this.scene.fog = new Fog(kHaze, 1, 1000);
    this.scene.add(this.sky, this.plain, this.sun, this.sun.target, this.things, ...this.fires);
    this.scene.add(this.hands.group, this.ropes.group, this.streams.group, this.particles.mesh);
  }

  /** Sky, plain and trees; without them a visitor sees the room behind the things. */
  showBackdrop(shown: boolean): void {
    this.backdrop = shown;
    this.sky.visible = shown;
    this.plain.visible = shown && this.ground !== null;
    if (this.landscape) this.landscape.visible = shown;
  }
  /** Height of what visitors stand on. */
  get floor(): number {
    return this.ground ?? 0;
  }

  /** Takes what is known of the world, and which mesh files are there. */
  set(state: KioskState): void {
    const before = this.state;
    this.state = state;
    if (before?.objects === state.objects && before?.presentation === state.presentation && this.complete) return;
    this.place();
  }

  /** Everything anew: it happens when a world begins and when a file has come. */
  private place(): void {
    const { objects, presentation } = this.state!;
    this.things.clear();
    this.placed = [];
    this.land = null;
    this.complete = true;
    const files = new Map<string, string>();
    const named = new Set(objects.map((o) => `${o.hash}#${o.node}`));
    for (const object of objects) {
      if (object.uri === '' && object.hash === '') continue;
      files.set(object.hash, object.uri);
      const model = this.models.model(object.hash, object.uri, object.node);
      if (model) this.add(object, object.node, rigid(object.pose), model);
      else this.complete = false;
    }
    for (const [hash, uri] of files) {
      const file = named.has(`${hash}#`) ? null : this.models.file(hash);
      for (const { node, X } of file ? this.models.scenery(file) : []) {
        const model = named.has(`${hash}#${node}`) ? null : this.models.model(hash, uri, node);
        if (model) this.add(null, node, X, model);
      }
    }
    this.measure(presentation);
    this.dress(presentation);
    this.grow();
  }

  private add(object: SceneObject | null, node: string, X: Matrix4, model: Model): void {
    const group = new Group();
    group.matrixAutoUpdate = false;
    group.matrix.copy(X);
    this.things.add(group);
    this.placed.push({ object, node, X, model, group });
  }

  private rises(placed: Placed, presentation: Presentation | null): boolean {
    return presentation?.effects.some((e) => e.kind === 'level' && e.node === placed.node) ?? false;
  }

  private measure(presentation: Presentation | null): void {
    this.box.makeEmpty();
    this.interest.makeEmpty();
    this.waterHeight = null;
    for (const placed of this.placed) {
      if (isStray(new Vector3().setFromMatrixPosition(placed.X))) continue;
      const box = placed.model.box.clone().applyMatrix4(placed.X);
      this.box.union(box);
      const rises = this.rises(placed, presentation);
      if (rises) this.waterHeight = box.min.y;
      if (placed.object?.movable || rises) this.interest.union(box);
    }
    if (this.interest.isEmpty()) this.interest.copy(this.box);
    // Some air above and in front of what moves.
    if (!this.interest.isEmpty()) this.interest.expandByPoint(this.interest.max.clone().add(new Vector3(0, 0.1, 0.15)));
    const scenery = this.placed.some((p) => !p.object);
    this.ground = this.box.isEmpty() ? null : scenery ? -0.06 : Math.min(this.box.min.y, 0);
    if (!scenery && presentation && presentation.activities.length === 0) this.ground = null;
    if (this.bringsLandscape()) this.ground = this.box.min.y;
    this.camera = this.standpoint(presentation);
    this.plain.visible = this.backdrop && this.ground !== null;
    this.plainHeight.value = this.ground ?? 0;
    this.plain.position.y = this.ground ?? 0;
    this.placeSun();
  }

  private bringsLandscape(): boolean {
    const size = this.box.getSize(new Vector3());
    return !this.box.isEmpty() && Math.max(size.x, size.y, size.z) >= kLandscape_m;
  }

  private standpoint(presentation: Presentation | null): Camera {
    const view = presentation?.views[0];
    if (view && !isStray(new Vector3(view.pose[0], view.pose[1], view.pose[2]))) return aboveCaption(cameraAt(view, this.interest));
    return this.bringsLandscape() ? lookOver(this.interest) : frameBox(this.interest, new Vector3(0.2, 0.27, 1), (40 * Math.PI) / 180);
  }

  /** One shadow map, over what visitors touch and look at. */
  private placeSun(): void {
    const middle = this.interest.isEmpty() ? new Vector3() : this.interest.getCenter(new Vector3());
    const shown = this.box.isEmpty() ? kSharpReach_m : this.box.getSize(new Vector3()).length() / 2;
    const reach = Math.min(Math.max(shown, kSharpReach_m), this.bringsLandscape() ? 16 : 7);
    this.sun.target.position.copy(middle);
    this.sun.position.copy(middle).addScaledVector(kToSun, 40);
    const camera = this.sun.shadow.camera;
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 1, far: 90 });
    camera.updateProjectionMatrix();
    this.sun.shadow.normalBias = 0.012;
    this.sun.shadow.bias = -0.0003;
    this.sun.shadow.needsUpdate = true;
  }

  /** Gives all parts their surfaces. */
  private dress(presentation: Presentation | null): void {
    for (const placed of this.placed) {
      const flow = presentation ? flowOf(presentation, placed.node) : new Vector3();
      const rises = this.rises(placed, presentation);
      for (const part of placed.model.parts) {
        placed.group.add(surfaceOf(part, this.materialOf(part, rises, flow)));
        if (part.water && flow.length() > 0) this.addReaches(part, placed.X, flow);
      }
    }
  }

  private materialOf(part: Part, rises: boolean, flow: Vector3): Material {
    if (part.water) {
      const look = rises ? { clearness: 0.55, ripple: 0.6 } : { clearness: 0.12, ripple: 1 };
      return waterMaterial({ ...look, flow: new Vector2(flow.x, flow.z), width: 0 }, this.waterTime);
    }
    if (!part.land) return part.material;
    if (!this.land) {
      const from = part.material as MeshStandardMaterial;
      this.land = landMaterial(from.map, from.normalMap, this.plainHeight);
      (this.plain.material as Material).dispose();
      this.plain.material = this.land;
    }
    return this.land;
  }

  private addReaches(part: Part, X: Matrix4, flow: Vector3): void {
    for (const sign of [-1, 1]) {
      const reach = riverReach(part.geometry, X, flow.clone().multiplyScalar(sign));
      if (!reach) continue;
      const look = { clearness: 0.12, ripple: 1, flow: new Vector2(flow.x, flow.z), width: reach.width };
      const mesh = new Mesh(reach.geometry, waterMaterial(look, this.waterTime));
      mesh.renderOrder = 1;
      this.things.add(mesh);
    }
  }

  /** Trees around scenery that stands on earth. They depend on scenery and viewpoint alone. */
  private grow(): void {
    const scenery = new Box3();
    const waters: WaterAbove[] = [];
    let earth = false;
    for (const placed of this.placed.filter((p) => !p.object)) {
      scenery.union(placed.model.box.clone().applyMatrix4(placed.X));
      earth ||= placed.model.parts.some((part) => part.land);
    }
    for (const mesh of this.things.children) {
      if (!(mesh instanceof Mesh)) continue;
      const p = mesh.geometry.getAttribute('position');
      const index = mesh.geometry.index!;
      for (let i = 0; i + 2 < index.count; i += 3)
        waters.push([0, 1, 2].map((k) => [p.getX(index.getX(i + k)), p.getZ(index.getX(i + k))]));
    }
    if (this.state!.presentation?.views.length) scenery.expandByPoint(this.camera.p);
    const about = earth && this.complete && this.ground !== null ? JSON.stringify(scenery) : '';
    if (about === this.grownAbout) return;
    this.grownAbout = about;
    if (this.landscape) this.scene.remove(this.landscape);
    this.landscape = null;
    const size = scenery.getSize(new Vector3());
    const clearing = Math.max(Math.hypot(size.x, size.z) / 2 + kClearing_m, kLeastClearing_m);
    if (about === '' || clearing >= kMostClearing_m || this.bringsLandscape()) return;
    const middle = scenery.getCenter(new Vector3()).setY(this.ground!);
    this.landscape = growLandscape({ middle, clearing, seed: Math.trunc(100 * size.length()), waters });
    this.landscape.visible = this.backdrop;
    this.scene.add(this.landscape);
  }

  /** Puts everything where it is in a frame. `eye`: with which the last picture was drawn. */
  show(frame: Frame, eye: PerspectiveCamera): void {
    const { presentation, world } = this.state!;
    const time = (frame.tick % 3_600_000) / 1000;
    this.waterTime.value = time % 1000;
    this.move(frame, presentation);
    this.ropes.show(frame.ropes);
    const working = this.hands.show(frame, eye);
    this.nearHand = this.named(frame);
    this.work = new Box3();
    this.seen = working.map((hand) => hand.box);
    if (!presentation || !world) return;
    if (!world.done) ({ seen: this.seen, work: this.work } = workplace(working, presentation.affordances, world.agents, this.standing));
    let landing = this.ground ?? 0;
    const level = presentation.effects.find((e) => e.kind === 'level');
    if (level && this.waterHeight !== null) landing = this.waterHeight + (levelOf(presentation, frame, level.node) ?? 0);
    const X = (object: number | null | undefined): Matrix4 =>
      (object == null ? new Matrix4() : (this.placedOf(object)?.group.matrix ?? new Matrix4()));
    const { streams, particles } = effectsOf(presentation, world, frame, X, landing);
    this.streams.show(streams, time);
    const all: Particle[] = [];
    particles.forEach((source, i) => appendParticles(source, i, time, all));
    streams.forEach((stream, i) => {
      appendDrops(stream, time, all);
      appendSplash(stream, i, time, all);
    });
    this.particles.show(all, eye.getWorldPosition(new Vector3()));
    this.light(particles.filter((p) => p.kind === 'fire'), time);
  }

  private light(fires: { p: Vector3; size: number; intensity: number }[], time: number): void {
    this.fires.forEach((light, i) => {
      const fire = fires[i];
      light.visible = fire !== undefined;
      if (!fire) return;
      const flicker = 1 + 0.1 * Math.sin(11.3 * time) + 0.07 * Math.sin(23.7 * time + 1.3);
      light.position.copy(fire.p).setY(fire.p.y + 1.2 * fire.size);
      light.intensity = 18 * fire.size ** 2 * Math.min(fire.intensity, 1) * flicker;
    });
  }

  private move(frame: Frame, presentation: Presentation | null): void {
    const told = new Map<number, number>();
    frame.objects.forEach((object, i) => told.set(object, i));
    const one = new Vector3(1, 1, 1);
    for (const placed of this.placed) {
      const i = placed.object ? told.get(placed.object.index) : undefined;
      placed.group.visible = i === undefined || frame.visible[i] !== 0;
      if (i !== undefined) {
        const q = frame.poses.subarray(kPose * i, kPose * (i + 1));
        const p = new Vector3(q[0], q[1], q[2]);
        if (isStray(p)) placed.group.visible = false;
        placed.group.matrix.compose(p, new Quaternion(q[3], q[4], q[5], q[6]).normalize(), one);
      } else {
        placed.group.matrix.copy(placed.X);
      }
      const level = presentation ? levelOf(presentation, frame, placed.node) : null;
      if (level !== null) {
        placed.group.matrix.elements[13]! += level;
        for (const child of placed.group.children) child.visible = child.renderOrder !== 1 || level >= kLeastLevel_m;
      }
      placed.group.matrixWorldNeedsUpdate = true;
    }
  }

  private named(frame: Frame): { object: number; p: Vector3 } | null {
    let nearest: { object: number; p: Vector3 } | null = null;
    let least = kHandsBreadth_m;
    const things = this.namedThings('en');
    for (const hand of frame.hands) {
      const tip = hand.stale || hand.holding ? null : indexTip(hand);
      if (!tip || isStray(tip)) continue;
      for (const thing of things) {
        const away = thing.box.distanceToPoint(tip.clone().applyMatrix4(thing.X.clone().invert()));
        if (away >= least) continue;
        least = away;
        nearest = { object: thing.object, p: tip };
      }
    }
    return nearest;
  }

  /** Things with a name for visitors, where they are now. */
  namedThings(language: string): NamedThing[] {
    return this.placed
      .filter((p) => p.object && p.group.visible && Object.keys(p.object.title).length > 0)
      .map((p) => ({ object: p.object!.index, name: textIn(p.object!.title, language), X: p.group.matrix, box: p.model.box }));
  }

  /** What can be worked on in this step, wherever hands are. */
  stepWork(): Box3 {
    const { presentation, world } = this.state ?? {};
    const { work } = workplace([], presentation?.affordances ?? [], world?.agents ?? [], this.standing);
    return work.isEmpty() ? this.interest : work;
  }
  private standing = (object: number): Standing | null => {
    const placed = this.placedOf(object);
    return placed ? { X: placed.group.matrix, box: placed.model.box } : null;
  };
  placedOf(object: number): Placed | null {
    return this.placed.find((p) => p.object?.index === object) ?? null;
  }
  /** X_WJ of a joint on a base; null: the base is the world. */
  jointAt(AJ: PoseArray, base: Placed | null): Matrix4 {
    return (base?.group.matrix.clone() ?? new Matrix4()).multiply(rigid(AJ));
  }
  isMovable(object: number): boolean {
    return this.placedOf(object)?.object?.movable ?? false;
  }
  /** What a ray can hit: all things, with the object that each belongs to. */
  targets(): { group: Object3D; object: number | null }[] {
    return this.placed.filter((p) => p.group.visible).map((p) => ({ group: p.group, object: p.object?.index ?? null }));
  }
  /** The author's view of a step's detail. */
  detail(): Camera | null {
    const name = this.state?.world?.detail;
    const view = name ? this.state?.presentation?.views.find((v) => v.name === name) : undefined;
    return view ? cameraAt(view, this.interest) : null;
  }
}
