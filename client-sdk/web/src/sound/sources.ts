// What is heard in a frame: client-sdk/sound/sound_scene.cpp. Gains and places depend on the frame, knocks on events.
import { Quaternion, Vector3 } from 'three';
import { kPose, type Frame } from '../wire/frame';
import type { Effect, KioskState, WorldEvent } from '../wire/messages';

export type SoundKind = 'water' | 'creak' | 'rope' | 'scrape' | 'fire' | 'steam' | 'ratchet' | 'knock' | 'thud' | 'splash' | 'bow';
export interface SoundSource {
  id: string;
  kind: SoundKind;
  p: Vector3;
  gain: number;
  pitch: number;
  near: number;
  looped: boolean;
}

const kLeastGain = 0.01;
const kNearest_m = 1.5;
/** No speeds from frames farther apart: the page was held up. */
const kLongestStep_s = 0.5;

const kEffects: Record<string, [SoundKind, number, number]> = {
  'sound.water': ['water', 0.85, 1.15],
  'sound.wood': ['creak', 0.7, 1.5],
  'sound.rope': ['rope', 0.8, 1.4],
  'sound.stone': ['scrape', 0.7, 1.2],
  'sound.fire': ['fire', 0.9, 1.1],
  'sound.steam': ['steam', 0.75, 1.2],
  'sound.ratchet': ['ratchet', 0.5, 2],
};
const kEvents: Record<string, [SoundKind, number, number]> = {
  grasped: ['knock', 0.25, 1.3],
  released: ['knock', 0.18, 1.1],
  placed: ['knock', 0.8, 1],
  assembled: ['thud', 0.8, 1.1],
  part_refused: ['knock', 0.5, 0.7],
  pushed: ['scrape', 0.4, 0.9],
  pulled: ['rope', 0.4, 1],
  lit: ['fire', 0.7, 1.2],
  broke: ['knock', 1, 0.55],
  spilled: ['splash', 1, 1],
  fired: ['bow', 1, 1],
};

interface Placed {
  p: Vector3;
  q: Quaternion;
}

function poseOf(state: KioskState, frame: Frame, object: number): Placed | null {
  const i = frame.objects.indexOf(object);
  const known = state.objects.find((o) => o.index === object);
  const x = i >= 0 ? [...frame.poses.subarray(kPose * i, kPose * (i + 1))] : known?.pose;
  if (!x || (i >= 0 && frame.visible[i] === 0)) return null;
  return { p: new Vector3(x[0], x[1], x[2]), q: new Quaternion(x[3], x[4], x[5], x[6]) };
}

function placeOf(state: KioskState, frame: Frame, effect: Effect): Vector3 | null {
  const p = new Vector3(...effect.p);
  if (effect.object == null) return p;
  const X = poseOf(state, frame, effect.object);
  return X && p.applyQuaternion(X.q).add(X.p);
}

/** Of the effect's point, or of the rim of a turning thing, m/s. */
function speedOf(state: KioskState, before: Frame | null, now: Frame, effect: Effect): number {
  if (!before || effect.object == null || now.tick <= before.tick) return 0;
  const step = (now.tick - before.tick) / 1000;
  const was = poseOf(state, before, effect.object);
  const is = poseOf(state, now, effect.object);
  if (!was || !is || step > kLongestStep_s) return 0;
  const p = new Vector3(...effect.p);
  const moved = p.clone().applyQuaternion(was.q).add(was.p).distanceTo(p.applyQuaternion(is.q).add(is.p));
  return Math.max(moved, was.q.angleTo(is.q) * effect.size) / step;
}

/** At its object; or else a spill where water sounds, and all others where something moves. A bowstring is where its effect says. */
function placeOfEvent(state: KioskState, frame: Frame, event: WorldEvent): Vector3 | null {
  const named = event.object === '' ? undefined : state.objects.find((o) => o.name === event.object);
  const effects = state.presentation?.effects ?? [];
  const bow = event.kind === 'fired' &&
    effects.find((e) => e.kind === 'sound.bow' && (e.object == null || !named || e.object === named.index));
  if (bow) return placeOf(state, frame, bow);
  const water = !named && event.kind === 'spilled' && effects.find((e) => e.kind === 'sound.water');
  if (water) return placeOf(state, frame, water);
  const object = named ?? state.objects.find((o) => o.movable);
  return object ? (poseOf(state, frame, object.index)?.p ?? null) : null;
}

export function soundSources(state: KioskState, before: Frame | null, now: Frame, events: readonly WorldEvent[]): SoundSource[] {
  const out: SoundSource[] = [];
  const effects = state.presentation?.effects ?? [];
  for (const effect of effects) {
    const sound = kEffects[effect.kind];
    if (!sound) continue;
    const known = effect.quantity < now.quantities.length;
    const amount = known ? now.quantities[effect.quantity]! : speedOf(state, before, now, effect);
    const gain = Number.isFinite(amount) ? Math.min(Math.abs(amount) / effect.full, 1) : 0;
    const p = placeOf(state, now, effect);
    if (gain < kLeastGain || !p) continue;
    const [kind, none, full] = sound;
    const pitch = none + (full - none) * gain;
    out.push({ id: `effect ${effect.name}`, kind, p, gain, pitch, near: Math.max(effect.size, kNearest_m), looped: true });
  }
  events.forEach((event, number) => {
    const sound = kEvents[event.kind];
    const p = placeOfEvent(state, now, event);
    if (!sound || !p || (event.kind === 'spilled' && !(event.value > 0))) return;
    const gain = sound[1] * (event.kind === 'spilled' ? Math.min(Math.sqrt(event.value / 0.002), 1) : 1);
    const id = `event ${event.tick} ${event.kind} ${event.object} ${number}`;
    out.push({ id, kind: sound[0], p, gain, pitch: sound[2], near: kNearest_m, looped: false });
  });
  return out;
}
