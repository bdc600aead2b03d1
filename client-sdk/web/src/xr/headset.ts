// A visitor in a headset: the world at its true size, the visitor's hands to the gateway, and the hands as the server has them. This part
// of the app is fetched where a browser knows of a headset.
import {
  Group, Mesh, MeshBasicMaterial, PerspectiveCamera, Quaternion, Raycaster, SphereGeometry, Vector3, type Intersection,
} from 'three';
import type { Picture } from '../scene/picture';
import type { Frame } from '../wire/frame';
import type { Overlay, TrackedState } from '../wire/messages';
import { wordsIn } from '../kiosk/words';
import { Board, boardText } from './board';
import { handBytes, seenHands } from './joints';
import { kStep_m, kStep_rad, Standing } from './standing';

export type HeadsetMode = 'immersive-vr' | 'immersive-ar';
/** What the headset asks of the page. */
export interface HeadsetPage {
  picture: Picture;
  /** Once a picture; milliseconds. The world as it is to be shown now. */
  frame(now: number): Frame | null;
  overlay(): Overlay | null;
  tracked(): TrackedState | null;
  press(action: string): void;
  send(bytes: ArrayBuffer): void;
  ended(): void;
}

/** The gateway takes 100 messages a second. */
const kSendEvery_ms = 1000 / 90;

export class Headset {
  private readonly rig = new Group();
  private readonly camera = new PerspectiveCamera(70, 1, 0.05, 400);
  private readonly board = new Board();
  private readonly dot = new Mesh(new SphereGeometry(0.006), new MeshBasicMaterial({ color: 0xf3c95a, fog: false }));
  private readonly standing = new Standing();
  private readonly caster = new Raycaster();
  private placed = false;
  private sendAt = 0;
  private sent = 0;
  private pictures = 0;
  private pointed: string | null = null;

  private constructor(
    private readonly session: XRSession,
    private readonly page: HeadsetPage,
    mode: HeadsetMode,
  ) {
    this.rig.matrixAutoUpdate = false;
    this.rig.add(this.camera, this.board.mesh, this.dot);
    this.dot.visible = false;
    page.picture.world.scene.add(this.rig);
    page.picture.world.showBackdrop(mode === 'immersive-vr');
    session.addEventListener('select', (event) => this.select(event));
    session.addEventListener('end', () => this.end());
  }

  /** After a visitor's touch, as browsers demand. Rejects where the visitor or the browser refuses. */
  static async enter(mode: HeadsetMode, page: HeadsetPage): Promise<Headset> {
    const session = await navigator.xr!.requestSession(mode, { requiredFeatures: ['local-floor'], optionalFeatures: ['hand-tracking'] });
    const headset = new Headset(session, page, mode);
    const { xr } = page.picture.renderer;
    xr.enabled = true;
    xr.setReferenceSpaceType('local-floor');
    await xr.setSession(session);
    page.picture.renderer.setAnimationLoop((now, frame) => headset.draw(now, frame));
    return headset;
  }
  leave(): void {
    void this.session.end();
  }
  /** For technicians and tests. */
  look(): object {
    return { placed: this.placed, sent: this.sent, pictures: this.pictures, X_WR: this.standing.X_WR.toArray() };
  }

  private draw(now: number, frame: XRFrame | undefined): void {
    const { picture } = this.page;
    const space = picture.renderer.xr.getReferenceSpace();
    if (!frame || !space) return;
    if (!this.placed) this.recenter(frame, space);
    this.rig.matrix.copy(this.standing.X_WR);
    this.rig.matrixWorldNeedsUpdate = true;
    this.sendHands(now, frame, space);
    this.point(frame, space);
    const overlay = this.page.overlay();
    const words = wordsIn(overlay?.language ?? 'en');
    const busy = this.page.tracked()?.hands.some((hand) => hand.link === 'refused') ?? false;
    this.board.show(boardText(overlay, words, busy ? words.busy : ''), this.pointed);
    picture.drawHeadset(this.page.frame(now), this.camera);
    ++this.pictures;
  }

  private sendHands(now: number, frame: XRFrame, space: XRReferenceSpace): void {
    if (now < this.sendAt) return;
    this.sendAt = Math.max(this.sendAt + kSendEvery_ms, now);
    const hands = seenHands(frame, this.session.inputSources, space, this.standing.X_WR);
    if (hands.length === 0) return;
    this.page.send(handBytes(hands));
    ++this.sent;
  }

  /** Where the visitor is; the board stands beyond the work, a little higher. */
  private recenter(frame: XRFrame, space: XRReferenceSpace): void {
    const pose = frame.getViewerPose(space);
    const { world } = this.page.picture;
    if (!pose || !world.complete) return;
    const head = headOf(pose);
    const work = world.work.isEmpty() ? world.interest : world.work;
    this.standing.recenter(work, world.camera.p, head.p, head.ahead, world.floor);
    const ahead = head.ahead.clone().setY(0).normalize();
    this.board.mesh.position.copy(head.p).addScaledVector(ahead, 1).add(new Vector3(0, 0.12, 0));
    this.board.mesh.rotation.set(0, Math.atan2(-ahead.x, -ahead.z), 0);
    this.placed = true;
  }

  private hit(frame: XRFrame, source: XRInputSource, space: XRReferenceSpace): Intersection | null {
    const pose = frame.getPose(source.targetRaySpace, space);
    if (!pose) return null;
    const { position: p, orientation: q } = pose.transform;
    const ahead = new Vector3(0, 0, -1).applyQuaternion(new Quaternion(q.x, q.y, q.z, q.w));
    this.caster.ray.origin.set(p.x, p.y, p.z).applyMatrix4(this.standing.X_WR);
    this.caster.ray.direction.copy(ahead).transformDirection(this.standing.X_WR);
    return this.caster.intersectObject(this.board.mesh, false)[0] ?? null;
  }
  private point(frame: XRFrame, space: XRReferenceSpace): void {
    this.pointed = null;
    this.dot.visible = false;
    this.rig.updateMatrixWorld(true);
    for (const source of this.session.inputSources) {
      const hit = this.hit(frame, source, space);
      if (!hit) continue;
      this.pointed = this.board.buttonAt(hit.uv);
      this.dot.visible = true;
      this.dot.position.copy(this.rig.worldToLocal(hit.point.clone()));
    }
  }
  private select(event: XRInputSourceEvent): void {
    const space = this.page.picture.renderer.xr.getReferenceSpace();
    const action = space && this.board.buttonAt(this.hit(event.frame, event.inputSource, space)?.uv);
    if (!action || !space) return;
    const pose = event.frame.getViewerPose(space);
    const head = pose ? headOf(pose).p : new Vector3();
    const own: Record<string, () => void> = {
      'xr:recenter': () => (this.placed = false),
      'xr:higher': () => this.standing.raise(kStep_m),
      'xr:lower': () => this.standing.raise(-kStep_m),
      'xr:left': () => this.standing.turn(kStep_rad, head),
      'xr:right': () => this.standing.turn(-kStep_rad, head),
      'xr:leave': () => this.leave(),
    };
    (own[action] ?? (() => this.page.press(action)))();
  }

  private end(): void {
    const { picture } = this.page;
    this.page.send(handBytes([]));
    picture.renderer.setAnimationLoop(null);
    picture.renderer.xr.enabled = false;
    picture.world.scene.remove(this.rig);
    picture.world.showBackdrop(true);
    this.board.dispose();
    this.page.ended();
  }
}

function headOf(pose: XRViewerPose): { p: Vector3; ahead: Vector3 } {
  const { position: p, orientation: q } = pose.transform;
  return { p: new Vector3(p.x, p.y, p.z), ahead: new Vector3(0, 0, -1).applyQuaternion(new Quaternion(q.x, q.y, q.z, q.w)) };
}
