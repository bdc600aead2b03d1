// The exhibit at rest in the kiosk's own picture, looked at from anywhere; what is selected has an outline and can be moved.
import {
  BackSide, Box3, BoxGeometry, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, Object3D, PerspectiveCamera,
  Quaternion, ShaderMaterial, Spherical, Vector2, Vector3, type BufferGeometry,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { TransformControls } from 'three/addons/controls/TransformControls.js';
import { aboveCaption, cameraAt, vector, viewOf, type Camera } from '../../scene/camera';
import { underFinger } from '../../scene/picking';
import { Picture } from '../../scene/picture';
import type { Frame } from '../../wire/frame';
import { kNothingKnown, type KioskState, type PoseArray, type View } from '../../wire/messages';
import type { Vector } from '../commands';
import type { Box } from '../../console/devices';
import type { JointMark } from './joint';
import { jointShape } from './joint_shape';
import { Ruler, type Measured } from './ruler';

const kClick_px = 5;
const kKeyTurn = Math.PI / 36;
const kKeyShare = 0.08;
const kStill_ms = 16;
const kSnap_m = 0.01;
const kOutline = 0xff8a1f;
const kOutline_px = 2.5;
/** Of a joint's mark: half its length, as a share of half the picture's height. */
const kMarkShare = 0.45;
/** Of the list of exhibits. */
const kSmall = { width: 384, height: 240 };

export type Tool = 'translate' | 'rotate' | null;
export interface ViewportEvents {
  /** `besides`: what is selected stays so. */
  picked(name: string, besides: boolean): void;
  /** A point of a thing, while points are measured. */
  measured(p: Vector): void;
  /** The exhibit as visitors see it, with nothing drawn over it: once for each state that is shown so. */
  pictured(webp: Blob): void;
  /** While they are dragged, and (`done`) when they are let go; the one with the arrows first. */
  moved(bodies: [name: string, pose: PoseArray][], done: boolean): void;
}

/** A rim of even breadth around a mesh: its back, a little larger. */
function rimMaterial(size: Vector2): ShaderMaterial {
  return new ShaderMaterial({
    side: BackSide,
    toneMapped: false,
    fog: false,
    uniforms: { size: { value: size }, breadth: { value: kOutline_px } },
    vertexShader: `uniform vec2 size; uniform float breadth;
      void main() {
        vec4 p = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        vec4 n = projectionMatrix * vec4(normalMatrix * normal, 0.0);
        p.xy += normalize(n.xy + vec2(1e-6)) * breadth * 2.0 / size * p.w;
        gl_Position = p;
      }`,
    fragmentShader: 'void main() { gl_FragColor = vec4(1.0, 0.54, 0.12, 1.0); }',
  });
}

const matrixOf = ([x, y, z, ...q]: PoseArray): Matrix4 =>
  new Matrix4().compose(new Vector3(x, y, z), new Quaternion(...q), new Vector3(1, 1, 1));

export class Viewport {
  readonly picture: Picture;
  private readonly rig = new PerspectiveCamera();
  private readonly orbit: OrbitControls;
  private readonly gizmo: TransformControls;
  private readonly handle = new Object3D();
  private readonly size = new Vector2(1, 1);
  private readonly rim = rimMaterial(this.size);
  private readonly lines = new LineBasicMaterial({ color: kOutline, depthTest: false, transparent: true, opacity: 0.55, toneMapped: false,
    fog: false });
  /** By name, with what they are around. */
  private readonly outlines = new Map<string, { around: unknown; group: Group }>();
  private readonly joint = new Group();
  private marked: JointMark | null = null;
  /** Where the author looks from; null: as visitors do. */
  private own: Camera | null = null;
  private usual: Camera;
  /** The one that was drawn last. */
  private given: Camera | null = null;
  private state: KioskState = kNothingKnown;
  private selected = '';
  private besides: readonly string[] = [];
  private readonly ruler = new Ruler();
  private measures = false;
  private hidden: ReadonlySet<string> = new Set();
  private locked: ReadonlySet<string> = new Set();
  private tool: Tool = null;
  /** The selected body's pose while it is dragged and until the gateway's answer. */
  private held: PoseArray | null = null;
  private asked = false;
  private ended = false;
  /** The last picture has all that there is. */
  private whole = false;
  private pictured = false;
  private drawnAt = -Infinity;
  private clock = 0;
  private downAt: { x: number; y: number } | null = null;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly surface: HTMLElement,
    private readonly events: ViewportEvents,
  ) {
    this.picture = new Picture(canvas, (hash) => `/content/${hash}`);
    this.picture.filesChanged = () => this.renew();
    this.usual = this.picture.world.camera;
    this.gizmo = new TransformControls(this.picture.camera, canvas);
    this.orbit = new OrbitControls(this.rig, canvas);
    this.orbit.enableDamping = false;
    this.orbit.addEventListener('change', this.look);
    this.gizmo.setSize(0.8);
    this.gizmo.addEventListener('change', this.need);
    this.gizmo.addEventListener('dragging-changed', ({ value }) => (this.orbit.enabled = !value));
    this.gizmo.addEventListener('objectChange', () => this.drag(false));
    this.gizmo.addEventListener('mouseUp', () => this.drag(true));
    this.picture.world.scene.add(this.joint, this.handle, this.ruler.group, this.gizmo.getHelper());
    canvas.addEventListener('pointerdown', this.down);
    canvas.addEventListener('pointerup', this.up);
    canvas.addEventListener('webglcontextrestored', this.need);
  }
  end(): void {
    this.ended = true;
    this.orbit.dispose();
    this.gizmo.dispose();
    this.picture.renderer.dispose();
    this.picture.renderer.forceContextLoss();
  }

  show(state: KioskState): void {
    this.state = state;
    this.pictured = false;
    this.picture.set(state);
    this.letGo();
  }
  /** By its DEF, "": nothing; and others that go with it. */
  select(name: string, besides: readonly string[]): void {
    if (name !== this.selected) this.held = null;
    this.selected = name;
    this.besides = besides;
    this.need();
  }
  use(tool: Tool, snap: boolean): void {
    this.tool = tool;
    this.gizmo.setTranslationSnap(snap ? kSnap_m : null);
    this.gizmo.setRotationSnap(snap ? kKeyTurn : null);
    this.need();
  }
  /** Names of what is not drawn here, and of what no click takes. */
  setAside(hidden: ReadonlySet<string>, locked: ReadonlySet<string>): void {
    [this.hidden, this.locked] = [hidden, locked];
    this.renew();
  }
  /** `on`: clicks measure, and select nothing. */
  measure(on: boolean, measured: Measured | null): void {
    this.measures = on;
    this.ruler.show(measured);
    this.need();
  }
  /** The last move is taken, or is not. One that has begun since goes on. */
  letGo(): void {
    if (!this.gizmo.dragging) this.held = null;
    this.renew();
  }
  resize(width: number, height: number): void {
    this.size.set(Math.max(width, 1), Math.max(height, 1));
    this.picture.resize(width, height);
    this.need();
  }
  showAll(): void {
    this.own = null;
    this.need();
  }
  showSelected(): void {
    const box = this.boxAround();
    if (!box) return;
    const now = this.camera();
    const away = box.getSize(new Vector3()).length() / Math.tan(now.fov / 2) + 0.1;
    const target = box.getCenter(new Vector3());
    const p = target.clone().add(now.p.clone().sub(now.target).setLength(away));
    this.own = { ...now, p, target };
    this.need();
  }
  /** Null: no joint is shown. */
  showJoint(mark: JointMark | null): void {
    if (JSON.stringify(mark) === JSON.stringify(this.marked)) return;
    this.marked = mark;
    this.joint.traverse((part) => part instanceof Mesh && (part.geometry as BufferGeometry).dispose());
    this.joint.clear();
    if (mark) this.joint.add(jointShape(mark.kind));
    this.need();
  }
  /** As visitors see it from there. */
  lookFrom(view: Omit<View, 'name'>): void {
    this.own = aboveCaption(cameraAt({ name: '', ...view }, this.picture.world.interest));
    this.need();
  }
  /** The view that shows visitors what the author sees now. */
  looksFrom(): Omit<View, 'name'> {
    return viewOf(this.camera(), this.size.x / this.size.y);
  }
  /** In W; null: the picture does not have it. */
  middleOf(name: string): Vector | null {
    const placed = this.placed(name);
    return placed && placed.model.box.getCenter(new Vector3()).applyMatrix4(placed.group.matrix).toArray();
  }
  /** Around it in W; null: the picture does not have it. */
  boxOf(name: string): Box | null {
    const placed = this.placed(name);
    const box = placed?.model.box.clone().applyMatrix4(placed.group.matrix);
    return box ? { least: box.min.toArray(), greatest: box.max.toArray() } : null;
  }
  /** True: the key was for the view. */
  key(event: KeyboardEvent): boolean {
    const across = { ArrowLeft: -1, ArrowRight: 1 }[event.key] ?? 0;
    const up = { ArrowUp: 1, ArrowDown: -1 }[event.key] ?? 0;
    if (across !== 0 || up !== 0) {
      if (event.shiftKey) this.shift(across, up);
      else this.turn(-across * kKeyTurn, -up * kKeyTurn);
    } else if (event.key === '+' || event.key === '=') this.turn(0, 0, 1 - kKeyShare);
    else if (event.key === '-') this.turn(0, 0, 1 + kKeyShare);
    else return false;
    return true;
  }
  lookAt(): object {
    const { p, target } = this.camera();
    const middle = this.middleOf(this.selected);
    return { complete: this.whole, camera: [...p.toArray(), ...target.toArray()], outlined: this.outlines.has(this.selected),
      selectedAt: middle && this.picture.pixelOf(vector(middle)), joint: this.marked, objects: this.state.objects.map((o) => o.name) };
  }

  private camera(): Camera {
    return this.own ?? this.usual;
  }
  private turn(across: number, up: number, nearer = 1): void {
    const { p, target, ...rest } = this.camera();
    const around = new Spherical().setFromVector3(p.clone().sub(target));
    around.theta += across;
    around.phi += up;
    around.radius *= nearer;
    this.own = { ...rest, target, p: new Vector3().setFromSpherical(around.makeSafe()).add(target) };
    this.need();
  }
  private shift(across: number, up: number): void {
    const { p, target, ...rest } = this.camera();
    const step = kKeyShare * p.distanceTo(target);
    const by = new Vector3(across * step, up * step, 0).applyQuaternion(this.picture.camera.getWorldQuaternion(new Quaternion()));
    this.own = { ...rest, p: p.clone().add(by), target: target.clone().add(by) };
    this.need();
  }
  /** The finger or the mouse has turned the rig. */
  private look = (): void => {
    this.own = { ...this.camera(), p: this.rig.position.clone(), target: this.orbit.target.clone(), up: new Vector3(0, 1, 0) };
    this.need();
  };
  private down = (event: PointerEvent): void => {
    this.downAt = event.isPrimary && event.button === 0 && !this.gizmo.dragging ? { x: event.clientX, y: event.clientY } : null;
    this.surface.focus({ preventScroll: true });
  };
  private up = (event: PointerEvent): void => {
    const from = this.downAt;
    this.downAt = null;
    if (!from || Math.hypot(event.clientX - from.x, event.clientY - from.y) > kClick_px || this.gizmo.axis) return;
    const { left, top } = this.canvas.getBoundingClientRect();
    const scene = this.picture.pickScene();
    const nameOf = (object: number | null): string => this.state.objects.find((o) => o.index === object)?.name ?? '';
    const targets = scene.targets.filter((t) => this.measures || !this.locked.has(nameOf(t.object)));
    const { seen } = underFinger({ ...scene, targets }, event.clientX - left, event.clientY - top);
    if (!this.measures) this.events.picked(nameOf(seen?.object ?? null), event.shiftKey);
    else if (seen) this.events.measured(seen.p.toArray());
  };
  private drag(done: boolean): void {
    const { position: p, quaternion: q } = this.handle;
    const pose: PoseArray = [p.x, p.y, p.z, q.x, q.y, q.z, q.w];
    const before = this.held;
    this.held = pose;
    if (done && !before) return;
    const others = this.besides.flatMap((name): [string, PoseArray][] => {
      const moved = this.along(name);
      return moved ? [[name, moved]] : [];
    });
    this.events.moved([[this.selected, pose], ...others], done);
    if (done) this.renew();
    else this.need();
  }

  private renew(): void {
    this.whole = false;
    this.picture.renewShadows();
    this.need();
  }
  private need = (): void => {
    if (this.asked || this.ended) return;
    this.asked = true;
    requestAnimationFrame(this.pass);
  };
  private pass = (now: number): void => {
    this.asked = false;
    if (this.ended || this.state === kNothingKnown) return;
    // A page that draws on demand is not slow because nothing has happened for a while.
    this.clock += Math.min(now - this.drawnAt, now - this.drawnAt > 4 * kStill_ms ? kStill_ms : Infinity);
    this.drawnAt = now;
    const { world, camera } = this.picture;
    // Another than was given here is the world's own, of a new state.
    if (world.camera !== this.given) this.usual = world.camera;
    this.given = world.camera = this.camera();
    camera.fov = (world.camera.fov * 180) / Math.PI;
    this.rig.position.copy(world.camera.p);
    this.rig.up.copy(new Vector3(0, 1, 0));
    this.orbit.target.copy(world.camera.target);
    this.rig.fov = camera.fov;
    this.rig.lookAt(this.orbit.target);
    world.show(this.frame(), camera);
    this.mark();
    this.ruler.face(camera);
    this.picture.draw(this.frame(), this.clock, false, null);
    this.whole = world.complete;
    const plain = this.selected === '' && !this.own && !this.marked && !this.measures && this.hidden.size === 0;
    if (this.whole && plain && !this.pictured) this.keepPicture();
  };
  /** Of what has just been drawn: the canvas has it until this task ends. */
  private keepPicture(): void {
    const { width, height } = this.canvas;
    if (width === 0 || height === 0) return;  // another part of the page is shown
    this.pictured = true;
    const small = document.createElement('canvas');
    [small.width, small.height] = [kSmall.width, kSmall.height];
    const scale = Math.min(width / small.width, height / small.height);
    const [w, h] = [small.width * scale, small.height * scale];
    small.getContext('2d')!.drawImage(this.canvas, (width - w) / 2, (height - h) / 2, w, h, 0, 0, small.width, small.height);
    small.toBlob((webp) => webp?.type === 'image/webp' && this.events.pictured(webp), 'image/webp', 0.8);
  }

  /** Around what is selected: a body, or a joint's mark. */
  private boxAround(): Box3 | null {
    const placed = this.placed();
    if (placed) return placed.model.box.clone().applyMatrix4(placed.group.matrix);
    return this.marked && new Box3().setFromCenterAndSize(vector(this.marked.at), new Vector3(0.4, 0.4, 0.4));
  }
  private placed(name = this.selected) {
    const object = this.state.objects.find((o) => o.name === name);
    return object ? this.picture.world.placedOf(object.index) : null;
  }
  private frame(): Frame {
    const others = this.state.objects.flatMap(({ name, index, pose }) => {
      const held = name === this.selected ? this.held : this.besides.includes(name) ? this.along(name) : null;
      return held || this.hidden.has(name) ? [{ index, visible: this.hidden.has(name) ? 0 : 1, pose: held ?? pose }] : [];
    });
    return {
      skipped: 0, sequence: 0, tick: 0, age: 0, quantities: new Float32Array(), hands: [], ropes: [],
      objects: Uint32Array.from(others.map((o) => o.index)), visible: Uint8Array.from(others.map((o) => o.visible)),
      poses: Float32Array.from(others.flatMap((o) => o.pose)),
    };
  }
  /** Where a body is that goes with the one that is dragged; null: nothing is. */
  private along(name: string): PoseArray | null {
    const poseOf = (of: string): PoseArray | undefined => this.state.objects.find((o) => o.name === of)?.pose;
    const [from, pose] = [poseOf(this.selected), poseOf(name)];
    if (!this.held || !from || !pose || this.locked.has(name)) return null;
    const moved = matrixOf(this.held).multiply(matrixOf(from).invert()).multiply(matrixOf(pose));
    const [p, q] = [new Vector3(), new Quaternion()];
    moved.decompose(p, q, new Vector3());
    return [p.x, p.y, p.z, q.x, q.y, q.z, q.w];
  }
  private outline(name: string): void {
    const placed = this.hidden.has(name) ? null : this.placed(name);
    const old = this.outlines.get(name);
    if (old && old.around !== placed) this.dropOutline(name);
    if (!placed) return;
    const { group } = this.outlines.get(name) ?? { group: new Group() };
    if (!this.outlines.has(name)) {
      this.outlines.set(name, { around: placed, group });
      group.matrixAutoUpdate = false;
      for (const mesh of placed.group.children) if (mesh instanceof Mesh) group.add(new Mesh(mesh.geometry, this.rim));
      group.add(this.edgesOf(placed.model.box));
      this.picture.world.scene.add(group);
    }
    group.matrix.copy(placed.group.matrix);
    group.matrixWorldNeedsUpdate = true;
  }
  private dropOutline(name: string): void {
    const { group } = this.outlines.get(name)!;
    for (const old of group.children) if (old instanceof LineSegments) old.geometry.dispose();
    this.picture.world.scene.remove(group);
    this.outlines.delete(name);
  }
  /** The outlines and the gizmo of what is selected. */
  private mark(): void {
    const all = [this.selected, ...this.besides];
    for (const name of [...this.outlines.keys()]) if (!all.includes(name)) this.dropOutline(name);
    for (const name of all) this.outline(name);
    const placed = this.outlines.has(this.selected) ? this.placed() : null;
    if (this.marked) {
      const { p, fov } = this.camera();
      this.joint.position.set(...this.marked.at);
      this.joint.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), vector(this.marked.axis).normalize());
      this.joint.scale.setScalar(kMarkShare * Math.tan(fov / 2) * p.distanceTo(this.joint.position));
    }
    const movable = placed && this.tool !== null;
    if (placed && !this.gizmo.dragging) placed.group.matrix.decompose(this.handle.position, this.handle.quaternion, this.handle.scale);
    if (movable && this.gizmo.object !== this.handle) this.gizmo.attach(this.handle);
    else if (!movable && this.gizmo.object) this.gizmo.detach();
    if (movable) this.gizmo.setMode(this.tool!);
  }
  private edgesOf(box: Box3): LineSegments {
    const [size, middle] = [box.getSize(new Vector3()), box.getCenter(new Vector3())];
    const edges = new EdgesGeometry(new BoxGeometry(size.x, size.y, size.z).applyMatrix4(new Matrix4().makeTranslation(middle)));
    const lines = new LineSegments(edges, this.lines);
    lines.renderOrder = 2;
    return lines;
  }
}
