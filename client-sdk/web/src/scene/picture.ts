// Draws the world on a canvas: the step's view, the close-up in a corner, a quality that the machine can afford.
import {
  ACESFilmicToneMapping, Box2, PCFShadowMap, PerspectiveCamera, PMREMGenerator, Quaternion, Scene, Mesh, SphereGeometry,
  Vector2, Vector3, WebGLRenderer, type Box3,
} from 'three';
import type { Frame } from '../wire/frame';
import type { KioskState } from '../wire/messages';
import { applyTo, cornersOf, type Camera } from './camera';
import { EyeMixer } from './eye_mixer';
import { skyMaterial } from './materials';
import { ModelStore } from './models';
import { isTakeable, pixelOf, type PickScene } from './picking';
import { isSoftware, QualityGovernor } from './quality';
import { kExposure, useNativeAir } from './shaders';
import { StepView } from './step_view';
import { applyEye, eyesOf, forScreen, isMixed, kMono, nearestOf, placesOf, type Eye, type EyePlace, type StereoSetup } from './stereo';
import { WorldScene } from './world_scene';

/** Of the sky's light: how soft, rad; a side of its cube. So soft a light gains nothing by more pixels, for which a first picture
 * without a graphics card would wait for seconds. */
const kSkyBlur = 0.02;
const kSkyLight_px = 64;

/** Pixels of the page, from its upper left corner. */
export interface PageBox {
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
  /** Between the eyes. */
  readonly camera = new PerspectiveCamera();
  /** What the corner shows now. */
  inset: { kind: 'detail' | 'whole'; place: PageBox } | null = null;
  /** Where words are written and fingers are looked for: one place, or one for each eye. */
  places: EyePlace[];
  /** A mesh file has come, or did not: for a page that draws only when something has changed. */
  filesChanged: () => void = () => undefined;
  /** Of a place, in which all is laid out. */
  width = 1;
  height = 1;
  /** The page's. */
  private size = { width: 1, height: 1 };
  private readonly mixer: EyeMixer | null;
  private readonly eyeCameras: Record<Eye, PerspectiveCamera>;
  readonly renderer: WebGLRenderer;
  private readonly governor: QualityGovernor;
  private readonly insetCameras: Record<Eye, PerspectiveCamera> = {
    middle: new PerspectiveCamera(), left: new PerspectiveCamera(), right: new PerspectiveCamera(),
  };
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
    private readonly setup: StereoSetup = kMono,
  ) {
    this.places = placesOf(setup.stereo, 1, 1);
    this.eyeCameras = { middle: this.camera, left: new PerspectiveCamera(), right: new PerspectiveCamera() };
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
    this.mixer = isMixed(setup.stereo) ? new EyeMixer(setup.stereo === 'rows', setup.rightEyeFirst, antialias ? 4 : 0) : null;
    this.governor = new QualityGovernor(this.rendererName);
    this.models = new ModelStore(address, () => {
      if (this.state) this.world.set(this.state);
      this.filesChanged();
    });
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
    this.size = { width: Math.max(width, 1), height: Math.max(height, 1) };
    this.places = placesOf(this.setup.stereo, this.size.width, this.size.height);
    [this.width, this.height] = [Math.max(this.places[0]!.seenWidth, 1), Math.max(this.places[0]!.seenHeight, 1)];
    this.applyQuality();
  }
  /** The next picture draws its shadows: for a page that draws only when something has changed. */
  renewShadows(): void {
    this.pictures = 0;
  }
  get isLost(): boolean {
    return this.lost;
  }

  /** Once a picture; milliseconds. `dragging`: what a pointer holds must stay under it. `corner`: where a close-up may be. */
  draw(frame: Frame | null, now: number, dragging: boolean, corner: PageBox | null): void {
    const interval = now - this.last;
    if (this.last > 0) this.intervals.push(interval);
    if (this.intervals.length > 120) this.intervals.shift();
    this.last = now;
    if (this.lost || this.renderer.xr.isPresenting) return;
    if (frame) this.world.show(frame, this.camera);
    const aspect = this.width / this.height;
    const usual = this.world.camera;
    if (dragging) this.stepView.hold(now / 1000);
    else this.stepView.follow(this.world.work, usual, aspect, now / 1000);
    this.inset = this.insetFor(corner);
    const began = performance.now();
    const every = this.governor.quality.shadowEvery;
    this.renderer.shadowMap.needsUpdate = this.pictures % every === 0;
    this.drawEyes(this.stepView.shown(usual, aspect), aspect);
    ++this.pictures;
    this.draws.push(performance.now() - began);
    if (this.draws.length > 120) this.draws.shift();
    if (this.world.complete && this.governor.drawn(interval, now)) this.applyQuality();
  }

  /** In place of draw() while a headset shows the world. */
  drawHeadset(frame: Frame | null, camera: PerspectiveCamera): void {
    if (this.lost) return;
    if (frame) this.world.show(frame, camera);
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.setClearAlpha(0);
    this.renderer.clear();
    this.renderer.render(this.world.scene, camera);
    this.renderer.setClearAlpha(1);
    // Where the visitor hears from.
    camera.matrixWorld.decompose(this.camera.position, this.camera.quaternion, new Vector3());
    this.camera.updateMatrixWorld(true);
    ++this.pictures;
  }

  /** From pixels of a place to things. */
  pickScene(place = 0): PickScene {
    const agents = this.state?.world?.agents ?? [];
    const takeable = (object: number): boolean =>
      isTakeable(this.state?.presentation ?? null, agents, object, this.world.isMovable(object));
    return { targets: this.world.targets(), takeable, camera: this.cameraOf(place), width: this.width, height: this.height };
  }
  pixelOf(p: Vector3, place = 0): { x: number; y: number } | null {
    return pixelOf(this.cameraOf(place), this.width, this.height, p);
  }
  /** Where a box is seen, by either eye, in the pixels of a place; null: it is behind the camera. */
  rectangleOf(box: Box3): PageBox | null {
    const seen = new Box2();
    for (let place = 0; place < this.places.length; ++place) {
      for (const p of cornersOf(box)) {
        const at = this.pixelOf(p, place);
        if (at) seen.expandByPoint(new Vector2(at.x, at.y));
      }
    }
    if (seen.isEmpty()) return null;
    const [width, height] = seen.getSize(new Vector2()).toArray();
    return { left: seen.min.x, top: seen.min.y, width, height };
  }
  /** The view as the gateway must know it to place a hand. */
  view(place = 0): { pose: number[]; fov: number; aspect: number; offset: [number, number] } {
    const camera = this.cameraOf(place);
    const e = camera.projectionMatrix.elements;
    const p = camera.position;
    const q = camera.getWorldQuaternion(new Quaternion());
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
      width: this.size.width,
      height: this.size.height,
      pictureMsMedian: at(draws, 0.5),
      pictureMsP99: at(draws, 0.99),
      missing: [...this.models.missing].slice(0, 8),
      renderer: `${this.rendererName.slice(0, 120)}, quality ${this.governor.quality.name}`,
    };
  }

  private cameraOf(place: number): PerspectiveCamera {
    return this.eyeCameras[this.places[place]?.eye ?? 'middle'];
  }

  /** `whole`: the view of which the camera shows a part; depth is made comfortable for all of that. */
  private aim(camera: Camera, whole: Camera, aspect: number, cameras: Record<Eye, PerspectiveCamera>): void {
    if (this.setup.stereo === 'mono') return applyTo(camera, aspect, cameras.middle);
    const eyes = forScreen(camera, nearestOf(this.world.interest, whole), this.setup, aspect);
    for (const eye of ['middle', 'left', 'right'] as const) applyEye(eyes, eye, aspect, cameras[eye]);
  }

  private drawEyes(shown: Camera, aspect: number): void {
    this.aim(shown, this.world.camera, aspect, this.eyeCameras);
    const { inset } = this;
    const close = this.world.detail() ?? this.world.camera;
    if (inset) this.aim(close, close, inset.place.width / inset.place.height, this.insetCameras);
    eyesOf(this.setup.stereo).forEach((eye, k) => {
      if (this.mixer) this.renderer.setRenderTarget(this.mixer.target(k));
      const within = this.places[this.mixer ? 0 : k]!;
      this.render(this.eyeCameras[eye], within, null);
      this.renderer.shadowMap.needsUpdate = false;
      if (inset) this.render(this.insetCameras[eye], within, inset.place);
    });
    this.mixer?.mix(this.renderer);
  }

  /** In a part of the page, or in a corner of that part. */
  private render(camera: PerspectiveCamera, within: EyePlace, inset: PageBox | null): void {
    const { renderer } = this;
    const [across, down] = [within.width / within.seenWidth, within.height / within.seenHeight];
    const part = inset ?? { left: 0, top: 0, width: within.seenWidth, height: within.seenHeight };
    const left = within.left + across * part.left;
    const bottom = this.size.height - within.top - down * (part.top + part.height);
    const target = renderer.getRenderTarget();
    if (target) {
      const scale = target.width / this.size.width;
      const area = [scale * left, scale * bottom, scale * across * part.width, scale * down * part.height] as const;
      target.viewport.set(...area);
      target.scissor.set(...area);
      target.scissorTest = true;
      renderer.setRenderTarget(target);
    } else {
      renderer.setViewport(left, bottom, across * part.width, down * part.height);
      renderer.setScissor(left, bottom, across * part.width, down * part.height);
      renderer.setScissorTest(true);
    }
    renderer.clear();
    renderer.render(this.world.scene, camera);
    renderer.setViewport(0, 0, this.size.width, this.size.height);
    renderer.setScissorTest(false);
  }

  private insetFor(corner: PageBox | null): Picture['inset'] {
    // Where every pixel costs, the whole machine is not drawn a second time.
    const affords = this.governor.quality.name !== 'least';
    const kind = this.world.detail() ? 'detail' : this.stepView.isNarrow && affords ? 'whole' : null;
    return kind && corner ? { kind, place: corner } : null;
  }

  private applyQuality(): void {
    const { ratio, shadowSize } = this.governor.quality;
    if (this.renderer.xr.isPresenting) return;
    const screen = window.devicePixelRatio || 1;
    // Rows of a screen are those of its own pixels, whatever the eyes' pictures have.
    this.renderer.setPixelRatio(this.mixer ? screen : Math.min(screen, ratio));
    this.renderer.setSize(this.size.width, this.size.height, false);
    this.mixer?.resize(Math.min(screen, ratio) * this.size.width, Math.min(screen, ratio) * this.size.height);
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
    this.world.scene.environment = generator.fromScene(sky, kSkyBlur, 0.1, 100, { size: kSkyLight_px }).texture;
    generator.dispose();
  }
}
