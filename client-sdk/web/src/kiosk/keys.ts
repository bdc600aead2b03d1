// Keys as a hand: Tab goes to a thing (each has a button of its own over the picture), Space takes it, arrows move it.
import { Vector3 } from 'three';
import type { PointerView } from '../wire/messages';
import type { PointerIn } from './pointer';

type Move = 'left' | 'right' | 'up' | 'down' | 'nearer' | 'farther' | 'turnLeft' | 'turnRight';
const kMoves: Record<string, Move> = {
  ArrowLeft: 'left',
  ArrowRight: 'right',
  ArrowUp: 'up',
  ArrowDown: 'down',
  PageUp: 'farther',
  PageDown: 'nearer',
  KeyQ: 'turnLeft',
  KeyE: 'turnRight',
};
/** Of the picture's height, a second. */
const kSpeed = 0.3;
/** A crank's turns a second by an arrow. */
const kTurns = 0.45;
const kNotches = 4;

export interface KeyPage {
  pixelOf(p: Vector3): { x: number; y: number } | null;
  height(): number;
  pointer(): PointerView | null;
}

export class KeyHand {
  private held = new Set<Move>();
  private at: { x: number; y: number } | null = null;
  private taken = false;

  constructor(
    private readonly pointer: PointerIn,
    private readonly page: KeyPage,
  ) {}

  get holds(): boolean {
    return this.taken;
  }
  /** Space on a thing that was seen at this place. */
  toggle(place: { x: number; y: number } | null): void {
    if (this.taken) return this.release();
    if (!place || !this.pointer.press(place.x, place.y)) return;
    this.at = { ...place };
    this.taken = true;
  }
  release(): void {
    if (this.taken && this.at) this.pointer.say('release', this.at.x, this.at.y);
    this.taken = false;
    this.held.clear();
  }
  /** True: the key meant the hand. */
  down(code: string): boolean {
    const move = kMoves[code];
    if (!move || !this.taken) return false;
    this.held.add(move);
    return true;
  }
  up(code: string): void {
    const move = kMoves[code];
    if (move) this.held.delete(move);
  }
  /** Once a picture. */
  pass(seconds: number): void {
    if (!this.taken || !this.at || this.held.size === 0) return;
    const sign = (plus: Move, minus: Move): number => Number(this.held.has(plus)) - Number(this.held.has(minus));
    const dt = Math.min(seconds, 0.1);
    const [x, y] = [sign('right', 'left'), sign('down', 'up')];
    if (x !== 0 || y !== 0) this.move(x, y, dt);
    const deep = sign('farther', 'nearer');
    if (deep !== 0) this.pointer.say('wheel', this.at.x, this.at.y, 0, deep * kNotches * dt);
    const turn = sign('turnRight', 'turnLeft');
    if (turn !== 0) this.pointer.say('turn_wheel', this.at.x, this.at.y, 0, turn * kNotches * dt);
  }

  /** The place on the held thing's circle that is so much further round; null: nothing is being turned. */
  along(turn: number): { x: number; y: number } | null {
    const view = this.page.pointer();
    if (view?.phase !== 'holding' || view.drag !== 'turn' || !view.axle) return null;
    const axle = new Vector3(...view.axle.p);
    const axis = new Vector3(...view.axle.d).normalize();
    return this.page.pixelOf(new Vector3(...view.p).sub(axle).applyAxisAngle(axis, turn).add(axle));
  }

  private move(x: number, y: number, dt: number): void {
    const way = x || -y;
    // A little ahead of the hand, which follows with a delay.
    const round = this.along(way * (2 * Math.PI * kTurns * dt + 0.35));
    const step = kSpeed * this.page.height() * dt;
    this.at = round ?? { x: this.at!.x + x * step, y: this.at!.y + y * step };
    this.pointer.say('move', this.at.x, this.at.y);
  }
}
