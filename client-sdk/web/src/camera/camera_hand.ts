// A visitor's hands before a camera as hands in the world: they go to the gateway as a headset's do (client-sdk/gateway/STREAM.md). This
// part of the app is fetched when a visitor asks for it.
import { Vector3 } from 'three';
import { handBytes, type SeenHand } from '../xr/joints';
import { jointsOf, placeInCamera, sideOf, slopeOf, type CameraPicture, type SeenLandmarks, type Side } from './landmarks';
import { Reach, type Sight } from './reach';
import type { HandListener, HandSource, Trouble } from './sources';
import { Steady } from './steady';

/** What the camera hand asks of the page. */
export interface CameraPage {
  sight(): Sight;
  holds(): boolean;
  send(bytes: ArrayBuffer): void;
  /** Nobody has shown a hand for long: the camera goes off. */
  left(): void;
}
export type CameraState = 'starting' | 'looking' | 'seen' | 'slow' | Trouble;

/** Distances are what a single camera sees worst. */
const kPlaceSteady = { cutoff: 1.5, perSpeed: 8 };
const kShapeSteady = { cutoff: 3, perSpeed: 20 };
/** A hand that was away for longer begins anew. */
const kAway_ms = 600;
/** The gateway takes 90 messages a second; cameras are slower, programs may not be. */
const kSendEvery_ms = 1000 / 60;
const kLeft_ms = 180_000;
/** The gateway takes a hand that it has not heard of for 500 ms for gone. */
const kSlow_ms = 400;
const kMean = 0.15;

/** One hand over time. */
class FollowedHand {
  /** Of the visitor. Until its fingers tell: by the half of the picture that it is in. */
  side: Side;
  told = false;
  at = 0;
  p_C = new Vector3();
  private readonly place = new Steady(kPlaceSteady);
  private readonly shape = new Steady(kShapeSteady);

  constructor(first: Vector3) {
    this.side = first.x < 0 ? 'right' : 'left';
  }
  /** Its landmarks from its place, along the axes of C. */
  see(p_C: Vector3, { world }: SeenLandmarks, now: number): Vector3[] {
    this.at = now;
    this.p_C.fromArray(this.place.next(p_C.toArray(), now / 1000));
    const flat = this.shape.next(world.flatMap((p) => p.toArray()), now / 1000);
    const points = world.map((_, k) => new Vector3().fromArray(flat, 3 * k));
    const side = sideOf(points);
    if (side && !this.told) [this.side, this.told] = [side, true];
    return points;
  }
}

export class CameraHand implements HandListener {
  state: CameraState = 'starting';
  /** Why, in a library's words, for technicians. */
  detail = '';
  /** What was seen last. */
  picture: CameraPicture | null = null;
  private readonly reach = new Reach();
  private readonly source: HandSource;
  private followed: FollowedHand[] = [];
  private at: number;
  private seenAt: number;
  private sent = 0;
  /** Between pictures, on average. */
  private every_ms = 0;

  /** `stays`: it waits for hands as long as the page is there. */
  constructor(
    open: (listener: HandListener) => HandSource,
    private readonly page: CameraPage,
    private readonly stays: boolean,
    private readonly clock: () => number = () => performance.now(),
  ) {
    this.at = this.seenAt = clock();
    this.source = open(this);
  }
  end(): void {
    this.source.end();
    this.page.send(handBytes([]));
  }
  /** The hand that is seen next is at the middle of the work. */
  recenter(): void {
    this.reach.recenter();
  }
  /** For technicians and tests. */
  look(): object {
    return { state: this.state, detail: this.detail, sent: this.sent, every_ms: this.every_ms,
      hands: this.followed.map(({ side, p_C }) => ({ side, p_C: p_C.toArray() })) };
  }

  trouble(what: Trouble | null, detail = ''): void {
    this.state = what ?? 'looking';
    this.detail = detail;
  }
  seen(picture: CameraPicture): void {
    const now = this.clock();
    if (now - this.at < kSendEvery_ms) return;
    this.every_ms += kMean * (Math.min(now - this.at, 1000) - this.every_ms);
    this.reach.look(this.page.sight(), (now - this.at) / 1000, this.page.holds());
    this.at = now;
    this.picture = picture;
    const hands = this.follow(picture, now);
    this.state = hands.length === 0 ? 'looking' : this.every_ms > kSlow_ms ? 'slow' : 'seen';
    if (hands.length > 0) {
      this.seenAt = now;
      this.page.send(handBytes(hands));
      ++this.sent;
    } else if (!this.stays && now - this.seenAt > kLeft_ms) {
      this.page.left();
    }
  }

  private follow(picture: CameraPicture, now: number): SeenHand[] {
    const slope = slopeOf(picture);
    this.followed = this.followed.filter((hand) => now - hand.at < kAway_ms);
    const free = new Set(this.followed);
    const out: SeenHand[] = [];
    for (const landmarks of picture.hands) {
      const p_C = placeInCamera(landmarks, slope);
      if (!p_C) continue;
      const hand = nearest(free, p_C) ?? this.meet(p_C);
      if (!hand) continue;
      free.delete(hand);
      const points = hand.see(p_C, landmarks, now);
      if (out.some(({ side }) => side === hand.side)) continue;
      const p_W = this.reach.place(hand.p_C, slope);
      const { R_WC } = this.reach;
      const joints = jointsOf(points.map((p) => p.applyQuaternion(R_WC).add(p_W)));
      out.push({ side: hand.side, tracked: true, closed: null, what: { joints: joints.flatMap((p) => p.toArray()) } });
    }
    return out;
  }
  private meet(p_C: Vector3): FollowedHand | null {
    if (this.followed.length >= 2) return null;
    const hand = new FollowedHand(p_C);
    const other = this.followed[0];
    if (other) hand.side = other.side === 'right' ? 'left' : 'right';
    this.followed.push(hand);
    return hand;
  }
}

function nearest(hands: Iterable<FollowedHand>, p_C: Vector3): FollowedHand | null {
  const kSame_m = 0.25;
  let best: FollowedHand | null = null;
  for (const hand of hands)
    if (hand.p_C.distanceTo(p_C) < Math.min(kSame_m, best?.p_C.distanceTo(p_C) ?? Infinity)) best = hand;
  return best;
}
