// One kiosk in a page: what the gateway says, the picture of it, the hand. Without a document of its own: Kiosk.svelte shows it.
import { Vector3 } from 'three';
import type { CameraHand } from '../camera/camera_hand';
import { sightOf, type Sight } from '../camera/reach';
import { cornersOf } from '../scene/camera';
import { underFinger, placeToTake, type UnderFinger } from '../scene/picking';
import { Picture, type PageBox } from '../scene/picture';
import { inPlace, type StereoSetup } from '../scene/stereo';
import { SoundPlayer } from '../sound/player';
import { soundSources } from '../sound/sources';
import { Connection } from '../wire/connection';
import { decodeFrame, type Frame } from '../wire/frame';
import { FrameHistory, kDelay } from '../wire/history';
import { eventOf, kNothingKnown, parseMessage, reduce, type KioskState, type WorldEvent } from '../wire/messages';
import { drawAid } from './aid';
import { KeyHand } from './keys';
import { PointerIn } from './pointer';
import type { Headset, HeadsetMode } from '../xr/headset';

const kReportEvery_ms = 1_000;
/** Captions need not follow each picture. */
const kSeenEvery_ms = 250;
/** Around what words do not cover. */
const kAround_m = 0.03;
const kHoverEvery_ms = 100;
/** A name still belongs visibly to the pointed place within this share of the picture's height. */
const kReadTogether = 0.14;
/** A world that is joined but sends nothing is not there at the moment. */
const kSilent_ms = 2_000;
/** So many frames in a row, a second of them, that cannot be read: the page and the gateway are of different versions. */
const kUnreadable = 30;

export interface Label {
  text: string;
  left: number;
  top: number;
}
/** A thing that can be taken, for the keyboard and for screen readers. */
export interface Thing {
  object: number;
  name: string;
}
export interface Shown {
  state: KioskState;
  online: boolean;
  /** The gateway was looked for in vain. */
  missed: boolean;
  /** What comes is of another version than this page. */
  outdated: boolean;
  /** The world moves. */
  live: boolean;
  label: Label | null;
  /** What captions do not cover: hands, what they can take, goals; in the pixels of an eye's place. */
  seen: PageBox[];
  things: Thing[];
  hovering: boolean;
  inset: { kind: 'detail' | 'whole'; place: PageBox } | null;
  /** Things are still being fetched. */
  loading: boolean;
  /** A visitor's hand before a camera, while it is used. */
  hand: CameraHand | null;
}

export class KioskSession {
  readonly picture: Picture;
  readonly sound = new SoundPlayer();
  readonly keys: KeyHand;
  private readonly connection: Connection;
  private readonly pointer: PointerIn;
  private readonly history = new FrameHistory();
  private state: KioskState = kNothingKnown;
  private online = false;
  private missed = false;
  frame: Frame | null = null;
  private frameAt = -Infinity;
  private malformed = 0;
  /** Frames in a row that could not be read. */
  private unread = 0;
  private events: WorldEvent[] = [];
  private hover: Vector3 | null = null;
  private hoverObject: number | null = null;
  private hoverAt = 0;
  private focus: { object: number; place: { x: number; y: number } | null; at: number } | null = null;
  private reportAt = 0;
  private seenAt = 0;
  private seen: PageBox[] = [];
  private lastAt = 0;
  private corner: PageBox | null = null;
  /** In a page within another that does not show it now; and before the page has a size. */
  private hidden = true;
  private muted = false;
  private ended = false;
  private headset: Headset | null = null;
  private hand: CameraHand | null = null;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly aid: HTMLCanvasElement,
    surface: HTMLElement,
    kiosk: string,
    private readonly token: string,
    /** In which the page begins; "": the exhibit's own. */
    private language: string,
    stereo: StereoSetup,
    private readonly changed: (shown: Shown) => void,
  ) {
    this.picture = new Picture(canvas, (hash) => this.address(`/content/${hash}`), stereo);
    const page = {
      placeAt: (x: number, y: number): number => {
        const at = this.picture.places.findIndex(({ left, top, width, height }) => x < left + width && y < top + height);
        return at < 0 ? this.picture.places.length - 1 : at;
      },
      inPlace: (place: number, x: number, y: number) => inPlace(this.picture.places[place] ?? this.picture.places[0]!, x, y),
      under: (x: number, y: number, place: number): UnderFinger => underFinger(this.picture.pickScene(place), x, y),
      view: (place: number) => this.picture.view(place),
      size: (): [number, number] => [this.picture.width, this.picture.height],
      send: (message: object) => this.connection.send(message),
    };
    this.pointer = new PointerIn(surface, page, () => this.sound.unlock());
    this.keys = new KeyHand(this.pointer, {
      pixelOf: (p) => this.picture.pixelOf(p),
      height: () => this.picture.height,
      pointer: () => this.state.pointer,
    });
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    this.connection = new Connection(`${scheme}://${location.host}${this.address(`/ws/kiosk/${encodeURIComponent(kiosk)}`)}`, {
      opened: () => this.goOn(true),
      closed: () => {
        this.language ||= this.state.overlay?.language ?? '';  // its visitor goes on reading in it
        this.goOn(false);
      },
      text: (json) => this.hearText(json),
      bytes: (bytes) => this.hearFrame(bytes),
    });
    window.addEventListener('online', this.hurry);
    document.addEventListener('visibilitychange', this.hurry);
    requestAnimationFrame(this.draw);
  }
  end(): void {
    this.ended = true;
    this.headset?.leave();
    this.leaveHand();
    this.connection.end();
    this.pointer.end();
    this.sound.silence();
    window.removeEventListener('online', this.hurry);
    document.removeEventListener('visibilitychange', this.hurry);
  }

  press(action: string): void {
    this.sound.unlock();
    this.connection.send({ type: 'press', action });
  }
  touch(): void {
    this.sound.unlock();
    this.connection.send({ type: 'touch' });
  }
  settings(settings: { largeText?: boolean; highContrast?: boolean }): void {
    this.connection.send({ type: 'settings', ...settings });
  }
  /** From a visitor's touch. Rejects where no headset begins. */
  async enterHeadset(mode: HeadsetMode): Promise<void> {
    this.sound.unlock();
    const { Headset } = await import('../xr/headset');
    this.headset ??= await Headset.enter(mode, {
      picture: this.picture,
      frame: (now) => {
        this.pass(now);
        return this.frame;
      },
      overlay: () => this.state.overlay,
      tracked: () => this.state.tracked,
      press: (action) => this.press(action),
      send: (bytes) => this.connection.sendBytes(bytes),
      ended: () => (this.headset = null),
    });
  }
  /** The visitor's hand before a camera; `stays`: until the page goes. Null: nothing here finds hands. */
  async showHand(stays: boolean): Promise<CameraHand | null> {
    const finders = this.state.cameraHand;
    if (!finders) return null;
    this.sound.unlock();
    const [{ CameraHand }, { fromModel, fromProgram }] = await Promise.all([import('../camera/camera_hand'), import('../camera/sources')]);
    this.hand ??= new CameraHand(
      (listener) => (finders.program > 0 ? fromProgram(finders.program, listener) : fromModel(this.address('/hand-model'), listener)),
      {
        sight: () => this.sight(),
        holds: () => this.state.tracked?.hands.some(({ holding }) => holding) ?? false,
        send: (bytes) => this.connection.sendBytes(bytes),
        left: () => this.leaveHand(),
      },
      stays,
    );
    return this.hand;
  }
  leaveHand(): void {
    this.hand?.end();
    this.hand = null;
  }
  resize(width: number, height: number, corner: PageBox | null): void {
    this.hidden = width === 0 || height === 0;
    if (this.hidden) return;
    this.picture.resize(width, height);
    this.corner = corner;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.aid.width = width * ratio;
    this.aid.height = height * ratio;
    this.aid.getContext('2d')?.setTransform(ratio, 0, 0, ratio, 0, 0);
  }
  mute(muted: boolean): void {
    this.muted = muted;
    this.sound.volume = muted ? 0 : this.state.volume;
    this.sound.unlock();
  }
  /** A thing has the keyboard's focus; null: none. */
  setFocus(object: number | null): void {
    this.focus = object === null ? null : { object, place: this.placeOf(object), at: 0 };
  }
  /** Space. */
  toggleTake(): void {
    this.sound.unlock();
    this.keys.toggle(this.focus ? this.placeOf(this.focus.object) : null);
  }
  /** Where a held thing's place will be when it has turned by so much more, in pixels. */
  ahead(turn: number): { x: number; y: number } | null {
    return this.keys.along(turn);
  }
  /** What the page knows and draws. */
  look(): object {
    const { state, online, malformed, frame, picture } = this;
    const complete = picture.world.complete;
    const view = picture.view();
    return { state, online, malformed, sequence: frame?.sequence ?? 0, complete, view, things: this.things(), seen: this.seen,
      headset: this.headset?.look() ?? null, camera: this.hand?.look() ?? null, ...picture.report() };
  }
  /** Where to take a thing, in pixels; null: it is not to be seen. */
  placeOf(object: number): { x: number; y: number } | null {
    return placeToTake(this.picture.pickScene(), object, this.axleOf(object));
  }

  /** What a hand before a camera reaches. */
  private sight(): Sight {
    return sightOf(this.picture.camera.matrixWorld, this.picture.world.stepWork());
  }
  private axleOf(object: number): { p: Vector3; d: Vector3 } | null {
    const joint = this.state.presentation?.affordances.find(
      (a) => a.kind === 'turns' && a.object === object && (a.agent === '' || this.state.world?.agents.includes(a.agent)),
    );
    if (!joint) return null;
    const base = joint.base == null ? null : this.picture.world.placedOf(joint.base);
    const X = this.picture.world.jointAt(joint.AJ, base);
    return { p: new Vector3().setFromMatrixPosition(X), d: new Vector3(0, 0, 1).transformDirection(X) };
  }

  private address(path: string): string {
    return this.token ? `${path}?token=${encodeURIComponent(this.token)}` : path;
  }
  private hurry = (): void => {
    if (!document.hidden) this.connection.hurry();
  };
  private goOn(online: boolean): void {
    this.online = online;
    this.unread = 0;
    if (!online) {
      this.missed = true;
      this.state = { ...this.state, pointer: null, tracked: null };
      this.keys.release();
    }
  }
  private hearText(json: string): void {
    const message = parseMessage(json);
    if (!message) {
      ++this.malformed;
      return;
    }
    if (message.type === 'event') {
      this.events.push(eventOf(message));
      if (this.events.length > 200) this.events.shift();
      return;
    }
    const before = this.state;
    this.state = reduce(before, message);
    if (message.type === 'overlay') this.chooseLanguage();
    if (before.world?.world !== this.state.world?.world) {
      this.history.clear();
      this.frame = null;
    }
    this.picture.set(this.state);
    this.sound.volume = this.muted ? 0 : this.state.volume;
  }
  private chooseLanguage(): void {
    const { language, languages } = this.state.overlay!;
    if (this.language === '' || languages.length === 0) return;
    if (this.language !== language && languages.includes(this.language)) this.connection.send({ type: 'language', code: this.language });
    this.language = '';
  }
  private hearFrame(bytes: ArrayBuffer): void {
    const frame = decodeFrame(bytes);
    if (!frame) {
      ++this.malformed;
      ++this.unread;
      return;
    }
    this.unread = 0;
    const now = performance.now();
    this.frameAt = now;
    // A restarted server counts from the beginning.
    if (frame.sequence < (this.history.newest()?.sequence ?? 0)) this.history.clear();
    this.history.add(frame, now - 1000 * frame.age);
  }

  private draw = (now: number): void => {
    if (this.ended) return;
    requestAnimationFrame(this.draw);
    if (this.headset) return;
    this.pass(now);
    if (this.hidden) return;
    const hands = this.state.pointer ? [this.state.pointer, ...this.state.pointer.others] : [];
    const dragging = this.pointer.isDown || this.keys.holds || hands.some((h) => h.phase === 'holding' || h.phase === 'reaching');
    this.picture.draw(this.frame, now, dragging, this.corner);
    this.findHover(now);
    this.drawAid();
  };
  /** Once a picture, of the page or of a headset. */
  private pass(now: number): void {
    const before = this.frame;
    this.frame = this.history.at(now - kDelay) ?? this.frame;
    this.keys.pass((now - this.lastAt) / 1000);
    this.lastAt = now;
    this.hearSounds(before);
    this.tell(now);
  }

  private findHover(now: number): void {
    const at = this.pointer.hover;
    if (!at || this.pointer.isDown) {
      this.hover = null;
      this.hoverObject = null;
      return;
    }
    if (now - this.hoverAt < kHoverEvery_ms) return;
    this.hoverAt = now;
    const { seen, takeable } = underFinger(this.picture.pickScene(this.pointer.place), at.x, at.y);
    this.hover = takeable?.p ?? null;
    this.hoverObject = (takeable ?? seen)?.object ?? null;
  }
  private drawAid(): void {
    const context = this.aid.getContext('2d');
    if (!context) return;
    const { width, height, places } = this.picture;
    context.clearRect(0, 0, this.aid.width, this.aid.height);
    if (!this.state.mayPoint || this.state.overlay?.panel) return;
    const focus = this.focus && !this.keys.holds ? this.focus.place : null;
    places.forEach((place, k) => {
      context.save();
      context.beginPath();
      context.rect(place.left, place.top, place.width, place.height);
      context.clip();
      context.translate(place.left, place.top);
      context.scale(place.width / width, place.height / height);
      const pixel = (p: Vector3): { x: number; y: number } | null => this.picture.pixelOf(p, k);
      drawAid(context, { pointer: this.state.pointer, hover: this.hover, focus, finger: this.pointer.hover, pixelOf: pixel, height });
      context.restore();
    });
  }
  private hearSounds(before: Frame | null): void {
    const { state, frame } = this;
    if (frame && this.isLive()) this.sound.hear(this.picture.camera, soundSources(state, before, frame, this.events));
    this.events = [];
    const { world, overlay } = state;
    if (!world || !overlay || !this.isLive()) return;
    const file = world.audio[overlay.language];
    if (!file) return;
    const id = `${world.world} ${world.activity} ${world.step} ${overlay.language}`;
    this.sound.say(id, this.address(`/exhibit/${encodeURIComponent(world.scenario)}/${file}`));
  }
  private isLive(): boolean {
    return this.online && this.state.link === 'joined' && performance.now() - this.frameAt < kSilent_ms;
  }
  private things(): Thing[] {
    const { takeable } = this.picture.pickScene();
    const names = new Map(this.picture.world.namedThings(this.state.overlay?.language ?? 'en').map((t) => [t.object, t.name]));
    return this.state.objects
      .filter((o) => takeable(o.index))
      .map((o) => ({ object: o.index, name: names.get(o.index) ?? '' }));
  }

  /** Where the name of a thing stands, above it. */
  private label(): Label | null {
    const near = this.picture.world.nearHand;
    const object = this.hoverObject ?? near?.object;
    const thing = this.picture.world.namedThings(this.state.overlay?.language ?? 'en').find((t) => t.object === object);
    if (!thing || this.state.overlay?.panel) return null;
    const middle = this.hoverObject !== null && this.pointer.hover ? this.pointer.hover : near && this.picture.pixelOf(near.p);
    if (!middle) return null;
    const reach = kReadTogether * this.picture.height;
    let top = Infinity;
    for (const corner of cornersOf(thing.box)) top = Math.min(top, this.picture.pixelOf(corner.applyMatrix4(thing.X))?.y ?? Infinity);
    return { text: thing.name, left: middle.x, top: Math.max(top, middle.y - reach) };
  }

  private tell(now: number): void {
    if (this.focus && now - this.focus.at > 500) this.focus = { ...this.focus, at: now, place: this.placeOf(this.focus.object) };
    if (now - this.reportAt > kReportEvery_ms) {
      this.reportAt = now;
      this.connection.send({ type: 'status', ...this.picture.report() });
    }
    if (now - this.seenAt > kSeenEvery_ms) {
      this.seenAt = now;
      this.seen = this.picture.world.seen.flatMap((box) => this.picture.rectangleOf(box.clone().expandByScalar(kAround_m)) ?? []);
    }
    this.changed({
      state: this.state,
      online: this.online,
      missed: this.missed,
      outdated: this.unread >= kUnreadable,
      live: this.isLive(),
      label: this.label(),
      seen: this.seen,
      things: this.things(),
      hovering: this.hover !== null,
      inset: this.picture.inset,
      loading: !this.picture.world.complete,
      hand: this.hand,
    });
  }
}
