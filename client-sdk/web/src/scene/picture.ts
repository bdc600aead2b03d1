// Draws the world on a canvas: the step's view, the close-up in a corner, a quality that the machine can afford.
import {
  ACESFilmicToneMapping, PCFShadowMap, PerspectiveCamera, PMREMGenerator, Quaternion, Scene, Mesh, SphereGeometry,
  Vector3, WebGLRenderer,
} from 'three';
import type { Frame } from '../wire/frame';
import type { KioskState } from '../wire/messages';
import { applyTo, type Camera } from './camera';
import { skyMaterial } from './materials';
import { ModelStore } from './models';
import { isTakeable, pixelOf, type PickScene } from './picking';
import { isSoftware, QualityGovernor } from './quality';
import { kExposure, useNativeAir } from './shaders';
import { StepView } from './step_view';
import { WorldScene } from './world_scene';

/** Pixels of the page, from its upper left corner. */
export interface InsetPlace {
  left: number;
  top: number;
  width: number;
  height: number;
}
export interface PictureReport {
  picturesPerS: number;
  width: number;
  height: number;
  pictureMsMedian: number;
  pictureMsP99: number;
  missing: string[];
  /** What draws, and how well. */
  renderer: string;
}

/** What draws in this browser, asked of a context of its own, which ends at once. */
function rendererName(): string {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : 'WebGL';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return name;
}

export class Picture {
  readonly world: WorldScene;
  readonly models: ModelStore;
  readonly camera = new PerspectiveCamera();
  /** What the corner shows now. */
  inset: { kind: 'detail' | 'whole'; place: InsetPlace } | null = null;
  width = 1;
  height = 1;
  private readonly renderer: WebGLRenderer;
  private readonly governor: QualityGovernor;
  private readonly insetCamera = new PerspectiveCamera();
  private readonly stepView = new StepView();
  private readonly rendererName: string;
  private state: KioskState | null = null;
  private lost = false;
  private pictures = 0;
  private last = 0;
  private intervals: number[] = [];
  private draws: number[] = [];

  constructor(
    readonly canvas: HTMLCanvasElement,
    address: (hash: string) => string,
  ) {
    useNativeAir();
    this.rendererName = rendererName();
    // Without a graphics card, several samples a pixel cost as much as several pixels.
    const antialias = !isSoftware(this.rendererName);
    this.renderer = new WebGLRenderer({ canvas, antialias, powerPreference: 'high-performance' });
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = kExposure;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.autoClear = false;
    this.governor = new QualityGovernor(this.rendererName);
    this.models = new ModelStore(address, () => this.state && this.world.set(this.state));
    this.world = new WorldScene(this.models);
    this.lightUp();
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.lost = true;
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.lost = false;
      this.lightUp();
      this.world.sun.shadow.needsUpdate = true;
    });
    this.applyQuality();
  }

  set(state: KioskState): void {
    this.state = state;
    this.world.set(state);
  }
  resize(width: number, height: number): void {
    this.width = Math.max(width, 1);
    this.height = Math.max(height, 1);
    this.applyQuality();
  }
  get isLost(): boolean {
    return this.lost;
  }

  /** Once a picture; milliseconds. `dragging`: what a pointer holds must stay under it. `corner`: where a close-up may be. */
  draw(frame: Frame | null, now: number, dragging: boolean, corner: InsetPlace | null): void {
    const interval = now - this.last;
    if (this.last > 0) this.intervals.push(interval);
    if (this.intervals.length > 120) this.intervals.shift();
    this.last = now;
    if (this.lost) return;
    if (frame) this.world.show(frame, this.camera);
    const aspect = this.width / this.height;
    const usual = this.world.camera;
    if (dragging) this.stepView.hold(now / 1000);
    else this.stepView.follow(this.world.work, usual, aspect, now / 1000);
    applyTo(this.stepView.shown(usual, aspect), aspect, this.camera);
    const began = performance.now();
    const every = this.governor.quality.shadowEvery;
    this.renderer.shadowMap.needsUpdate = this.pictures % every === 0;
    this.render(this.camera, null);
    this.drawInset(usual, corner);
    ++this.pictures;
    this.draws.push(performance.now() - began);
    if (this.draws.length > 120) this.draws.shift();
    if (this.world.complete && this.governor.drawn(interval, now)) this.applyQuality();
  }

  /** From pixels of the page to things. */
  pickScene(): PickScene {
    const agents = this.state?.world?.agents ?? [];
    const takeable = (object: number): boolean =>
      isTakeable(this.state?.presentation ?? null, agents, object, this.world.isMovable(object));
    return { targets: this.world.targets(), takeable, camera: this.camera, width: this.width, height: this.height };
  }
  pixelOf(p: Vector3): { x: number; y: number } | null {
    return pixelOf(this.camera, this.width, this.height, p);
  }
  /** The view as the gateway must know it to place a hand. */
  view(): { pose: number[]; fov: number; aspect: number; offset: [number, number] } {
    const e = this.camera.projectionMatrix.elements;
    const p = this.camera.position;
    const q = this.camera.getWorldQuaternion(new Quaternion());
    return { pose: [p.x, p.y, p.z, q.x, q.y, q.z, q.w], fov: 2 * Math.atan(1 / e[5]!), aspect: e[5]! / e[0]!, offset: [e[8]!, e[9]!] };
  }
  report(): PictureReport {
    const sorted = (times: number[]): number[] => [...times].sort((a, b) => a - b);
    const intervals = sorted(this.intervals);
    const draws = sorted(this.draws);
    const at = (list: number[], share: number): number => list[Math.floor(share * (list.length - 1))] ?? 0;
    const median = at(intervals, 0.5);
    return {
      picturesPerS: median > 0 ? 1000 / median : 0,
      width: this.width,
      height: this.height,
      pictureMsMedian: at(draws, 0.5),
      pictureMsP99: at(draws, 0.99),
      missing: [...this.models.missing].slice(0, 8),
      renderer: `${this.rendererName.slice(0, 120)}, quality ${this.governor.quality.name}`,
    };
  }

  private render(camera: PerspectiveCamera, place: InsetPlace | null): void {
    const { renderer } = this;
    if (place) {
      const bottom = this.height - place.top - place.height;
      renderer.setViewport(place.left, bottom, place.width, place.height);
      renderer.setScissor(place.left, bottom, place.width, place.height);
      renderer.setScissorTest(true);
    } else {
      renderer.setScissorTest(false);
      renderer.setViewport(0, 0, this.width, this.height);
    }
    renderer.clear();
    renderer.render(this.world.scene, camera);
    renderer.setScissorTest(false);
  }

  private drawInset(usual: Camera, corner: InsetPlace | null): void {
    const detail = this.world.detail();
    // Where every pixel costs, the whole machine is not drawn a second time.
    const affords = this.governor.quality.name !== 'least';
    const kind = detail ? 'detail' : this.stepView.isNarrow && affords ? 'whole' : null;
    this.inset = kind && corner ? { kind, place: corner } : null;
    if (!this.inset) return;
    applyTo(detail ?? usual, corner!.width / corner!.height, this.insetCamera);
    this.renderer.shadowMap.needsUpdate = false;
    this.render(this.insetCamera, corner);
  }

  private applyQuality(): void {
    const { ratio, shadowSize } = this.governor.quality;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, ratio));
    this.renderer.setSize(this.width, this.height, false);
    const { shadow } = this.world.sun;
    if (shadow.mapSize.x !== shadowSize) {
      shadow.mapSize.set(shadowSize, shadowSize);
      shadow.map?.dispose();
      shadow.map = null;
    }
  }

  /** The sky's light, from the sky itself. */
  private lightUp(): void {
    const sky = new Scene();
    sky.add(new Mesh(new SphereGeometry(10, 48, 32), skyMaterial(false)));
    const generator = new PMREMGenerator(this.renderer);
    this.world.scene.environment = generator.fromScene(sky, 0.02, 0.1, 100).texture;
    generator.dispose();
  }
}
