// What an effect shows at a moment: client-sdk/scene/effect_builder.cpp, without a renderer.
import { type Matrix4, Vector3 } from 'three';
import type { Frame } from '../wire/frame';
import type { Effect, Presentation, World } from '../wire/messages';
import { isStray } from './hands';

const kGravity = 9.81;
const kLeastWidth_m = 0.004;
const kMostWidth_m = 0.25;
const kFastestJet = 15;
const kFastestRiver = 5;

export type ParticleKind = 'steam' | 'smoke' | 'fire' | 'dust' | 'spray';
export const kParticleKinds: readonly ParticleKind[] = ['steam', 'smoke', 'fire', 'dust', 'spray'];

export interface Stream {
  p: Vector3;
  v: Vector3;
  landing: number;
  width: number;
  jet: boolean;
}
export interface ParticleSource {
  kind: ParticleKind;
  p: Vector3;
  direction: Vector3;
  intensity: number;
  size: number;
  speed: number;
}

const flowScale = (unit: string): number => (unit === 'l/s' || unit === 'kg/s' ? 1e-3 : unit === 'l/min' ? 1e-3 / 60 : 1);

export function levelOf(presentation: Presentation, frame: Frame, node: string): number | null {
  const effect = presentation.effects.find((e) => e.kind === 'level' && e.node === node && e.quantity < frame.quantities.length);
  return effect ? Math.min(Math.max(frame.quantities[effect.quantity]!, 0), 5) : null;
}

/** Horizontal velocity of a river, m/s. */
export function flowOf(presentation: Presentation, node: string): Vector3 {
  const effect = presentation.effects.find((e) => e.kind === 'flow' && e.node === node);
  if (!effect) return new Vector3();
  const level = new Vector3(effect.direction[0], 0, effect.direction[2]);
  if (level.length() < 0.05) return new Vector3();
  return level.normalize().multiplyScalar(Math.min(Math.max(effect.speed, 0), kFastestRiver));
}

/** 0..1 of the effect's full amount. */
export function strengthOf(effect: Effect, frame: Frame): number {
  if (effect.quantity >= frame.quantities.length) return 0;
  return Math.min(Math.max(Math.abs(frame.quantities[effect.quantity]!) / effect.full, 0), 1);
}

function streamOf(effect: Effect, flow: number, X: Matrix4, landing: number): Stream | null {
  const jet = effect.kind === 'jet';
  const speed = jet ? flow / ((Math.PI / 4) * effect.size ** 2) : effect.speed;
  const width = jet ? effect.size : flow > 0 ? Math.sqrt(flow / ((Math.max(speed, 0.05) * 0.45 * Math.PI) / 4)) : 0;
  if (jet ? !(speed >= 0.02) : !(width >= kLeastWidth_m)) return null;
  const p = new Vector3(...effect.p).applyMatrix4(X);
  const v = new Vector3(...effect.direction).transformDirection(X).multiplyScalar(Math.min(speed, kFastestJet));
  return { p, v, landing, width: Math.min(width, kMostWidth_m), jet };
}

export function effectsOf(
  presentation: Presentation,
  world: World,
  frame: Frame,
  poseOf: (object: number | null | undefined) => Matrix4,
  landing: number,
): { streams: Stream[]; particles: ParticleSource[] } {
  const out = { streams: [] as Stream[], particles: [] as ParticleSource[] };
  for (const effect of presentation.effects) {
    const X = poseOf(effect.object);
    if (effect.kind === 'stream' || effect.kind === 'jet') {
      const known = effect.quantity < Math.min(frame.quantities.length, world.quantities.length);
      const flow = known ? flowScale(world.quantities[effect.quantity]!.unit) * frame.quantities[effect.quantity]! : 0;
      const stream = streamOf(effect, flow, X, landing);
      if (stream && !isStray(stream.p)) out.streams.push(stream);
    } else if (kParticleKinds.includes(effect.kind as ParticleKind)) {
      const intensity = strengthOf(effect, frame);
      const p = new Vector3(...effect.p).applyMatrix4(X);
      if (intensity <= 0 || isStray(p)) continue;
      const direction = new Vector3(...effect.direction).transformDirection(X);
      out.particles.push({ kind: effect.kind as ParticleKind, p, direction, intensity, size: effect.size, speed: effect.speed });
    }
  }
  return out;
}

/** How long water falls until it lands. */
export function flightTime(stream: Stream): number {
  const drop = Math.max(stream.p.y - stream.landing, 0.01);
  return (stream.v.y + Math.sqrt(stream.v.y ** 2 + 2 * kGravity * drop)) / kGravity;
}

/** When a jet has broken up into drops. */
export function breakupTime(stream: Stream): number {
  const speed = Math.max(stream.v.length(), 0.1);
  const weber = (998 * speed * speed * stream.width) / 0.0728;
  return (8.51 * stream.width * weber ** 0.31) / speed;
}
