// Mouse, fingers and keys as messages to the gateway, which moves the hand by the rules of the native display.
import type { Pick, UnderFinger } from '../scene/picking';

export interface View {
  pose: number[];
  fov: number;
  aspect: number;
  offset: [number, number];
}
export interface PointerEventMessage {
  kind: 'press' | 'release' | 'move' | 'turn_press' | 'turn_release' | 'wheel' | 'turn_wheel' | 'left' | 'gone';
  x: number;
  y: number;
  amount: number;
  finger: number;
  pick?: { object: number; p: number[]; n: number[] };
}
/** What the pointer asks of the page. */
export interface PointerPage {
  /** In which of the page's places a pixel of the page lies; with two eyes' pictures there are two. */
  placeAt(x: number, y: number): number;
  /** From pixels of the page to those of a place. */
  inPlace(place: number, x: number, y: number): { x: number; y: number };
  under(x: number, y: number, place: number): UnderFinger;
  view(place: number): View;
  size(): [number, number];
  send(message: object): void;
}

const kMouse = 0;
/** Messages at most so often; moves of one finger in between are one. */
const kPace_ms = 25;
const kMostEvents = 60;
/** A press that ends so near to its begin was a click. */
const kClick_px = 12;
const kWheelNotch_px = 100;

const picked = (pick: Pick): { object: number; p: number[]; n: number[] } => ({
  object: pick.object,
  p: pick.p.toArray(),
  n: pick.n.toArray(),
});

/** Collects events and sends them at a pace; presses and releases keep their order. */
export class PointerOut {
  private events: PointerEventMessage[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  private place = 0;

  constructor(private readonly page: PointerPage) {}

  /** Events from now on are in this place. */
  goTo(place: number): void {
    if (place === this.place) return;
    this.flush();
    this.place = place;
  }

  say(event: PointerEventMessage): void {
    const last = this.events.at(-1);
    if (event.kind === 'move' && last?.kind === 'move' && last.finger === event.finger) this.events[this.events.length - 1] = event;
    else this.events.push(event);
    if (this.events.length >= kMostEvents) this.flush();
    this.timer ??= setTimeout(() => this.flush(), kPace_ms);
  }
  flush(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    if (this.events.length === 0) return;
    const { pose, fov, aspect, offset } = this.page.view(this.place);
    this.page.send({ type: 'pointer', events: this.events, picture: this.page.size(), camera: { pose, fov, aspect, offset } });
    this.events = [];
  }
}

/** Listens on the picture. */
export class PointerIn {
  /** Where the mouse rests; null: it is elsewhere, or fingers touch. */
  hover: { x: number; y: number } | null = null;
  private fingers = new Map<number, { number: number; x: number; y: number; object: number | null }>();
  private lastFinger = kMouse;
  /** A finger stays in the place where it came down. */
  private in = 0;
  private readonly out: PointerOut;

  constructor(
    private readonly element: HTMLElement,
    private readonly page: PointerPage,
    private readonly touched: () => void,
  ) {
    this.out = new PointerOut(page);
    element.addEventListener('pointerdown', this.down);
    element.addEventListener('pointermove', this.move);
    element.addEventListener('pointerup', this.up);
    element.addEventListener('pointercancel', this.up);
    element.addEventListener('pointerleave', this.leave);
    element.addEventListener('wheel', this.wheel, { passive: false });
    element.addEventListener('contextmenu', (event) => event.preventDefault());
    window.addEventListener('blur', this.gone);
    document.addEventListener('visibilitychange', this.hidden);
  }
  end(): void {
    window.removeEventListener('blur', this.gone);
    document.removeEventListener('visibilitychange', this.hidden);
  }
  get isDown(): boolean {
    return this.fingers.size > 0;
  }

  /** From the keyboard: a press at a place of the picture. */
  press(x: number, y: number): boolean {
    this.goTo(0);
    const { takeable } = this.page.under(x, y, this.in);
    if (!takeable) return false;
    this.say('press', x, y, kMouse, 0, takeable);
    return true;
  }
  say(kind: PointerEventMessage['kind'], x: number, y: number, finger = kMouse, amount = 0, pick: Pick | null = null): void {
    this.out.say({ kind, x, y, amount, finger, ...(pick && { pick: picked(pick) }) });
  }

  /** Where the mouse rests, and fingers are: an index of the page's places. */
  get place(): number {
    return this.in;
  }
  private goTo(place: number): void {
    this.in = place;
    this.out.goTo(place);
  }
  private at(event: MouseEvent): { x: number; y: number } {
    const box = this.element.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    if (this.fingers.size === 0) this.goTo(this.page.placeAt(x, y));
    return this.page.inPlace(this.in, x, y);
  }
  private down = (event: PointerEvent): void => {
    this.touched();
    const { x, y } = this.at(event);
    const mouse = event.pointerType === 'mouse';
    if (mouse && event.button === 2) return this.say('turn_press', x, y);
    if (mouse && event.button !== 0) return;
    // A page that a finger came down on gets all of that finger, wherever it goes.
    this.element.setPointerCapture(event.pointerId);
    const number = mouse ? kMouse : ++this.lastFinger;
    if (!mouse) this.hover = null;
    const { seen, takeable } = this.page.under(x, y, this.in);
    this.fingers.set(event.pointerId, { number, x, y, object: takeable ? null : (seen?.object ?? null) });
    this.say('press', x, y, number, 0, takeable);
    this.out.flush();
  };
  private move = (event: PointerEvent): void => {
    const { x, y } = this.at(event);
    if (event.pointerType === 'mouse') this.hover = { x, y };
    const finger = this.fingers.get(event.pointerId);
    if (finger) this.say('move', x, y, finger.number);
  };
  private up = (event: PointerEvent): void => {
    const { x, y } = this.at(event);
    if (event.pointerType === 'mouse' && event.button === 2) return this.say('turn_release', x, y);
    const finger = this.fingers.get(event.pointerId);
    if (!finger) return;
    this.fingers.delete(event.pointerId);
    this.say('release', x, y, finger.number);
    this.out.flush();
    const still = event.type === 'pointerup' && Math.hypot(x - finger.x, y - finger.y) < kClick_px;
    if (still && finger.object !== null) this.page.send({ type: 'click', object: finger.object });
  };
  private leave = (event: PointerEvent): void => {
    if (event.pointerType !== 'mouse') return;
    this.hover = null;
    if (!this.fingers.has(event.pointerId)) this.say('left', 0, 0);
  };
  private wheel = (event: WheelEvent): void => {
    event.preventDefault();
    const { x, y } = this.at(event);
    const rolled = event.shiftKey && event.deltaY === 0 ? event.deltaX : event.deltaY;
    const scale = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? kWheelNotch_px : 3;
    this.say(event.shiftKey ? 'turn_wheel' : 'wheel', x, y, kMouse, -rolled / scale);
  };
  /** A page without focus hears no release. */
  private gone = (): void => {
    if (this.fingers.size === 0) return;
    this.fingers.clear();
    this.say('gone', 0, 0);
    this.out.flush();
  };
  private hidden = (): void => {
    if (document.hidden) this.gone();
  };
}
