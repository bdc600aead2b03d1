// Steam, smoke, fire, dust and drops: where each is depends on the world's time alone (client-sdk/draw/passes/particles.cpp).
import {
  DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, BufferAttribute, ShaderMaterial, Vector3,
  CustomBlending, OneFactor, OneMinusSrcAlphaFactor,
} from 'three';
import { breakupTime, flightTime, type ParticleKind, type ParticleSource, type Stream } from './effects';
import { ShortRandom } from './random';
import { kNoise, kSky, kSunLight, kToSun } from './shaders';

const kGravity = 9.81;
const kGolden = 0.6180339887498949;
const kMost = 2048;
const kWind = new Vector3(0.32, 0, 0.1);

type Shape = 0 | 1 | 2; // puff, drop, flame
interface Habit {
  count: number;
  life: number;
  slowing: number;
  rise: number;
  risePerSize: number;
  weight: number;
  wind: number;
  spread: number;
  source: number;
  start: number;
  growth: number;
  opacity: number;
  swirl: number;
  young: [number, number, number];
  old: [number, number, number];
  shape: Shape;
}

const kHabits: Record<ParticleKind, Habit> = {
  steam: { count: 72, life: 1.7, slowing: 0.3, rise: 0.32, risePerSize: 0, weight: 0, wind: 0.55, spread: 0.13, source: 0.35, start: 0.75,
    growth: 9, opacity: 0.42, swirl: 0.35, young: [0.95, 0.96, 0.97], old: [0.9, 0.92, 0.94], shape: 0 },
  smoke: { count: 72, life: 4.6, slowing: 0.6, rise: 0.55, risePerSize: 0.8, weight: 0, wind: 1, spread: 0.16, source: 0.5, start: 0.7,
    growth: 5, opacity: 0.4, swirl: 0.45, young: [0.07, 0.065, 0.06], old: [0.3, 0.3, 0.31], shape: 0 },
  fire: { count: 56, life: 0.85, slowing: 0.5, rise: 0.15, risePerSize: 3.4, weight: 0, wind: 0.35, spread: 0.1, source: 0.62, start: 0.62,
    growth: 0.28, opacity: 0.62, swirl: 0.18, young: [4.6, 1.75, 0.36], old: [3, 0.55, 0.05], shape: 2 },
  dust: { count: 48, life: 2.4, slowing: 0.28, rise: 0.06, risePerSize: 0, weight: 0, wind: 0.5, spread: 0.75, source: 0.6, start: 0.6,
    growth: 4, opacity: 0.3, swirl: 0.3, young: [0.44, 0.35, 0.24], old: [0.44, 0.36, 0.26], shape: 0 },
  spray: { count: 220, life: 0.75, slowing: 0, rise: 0, risePerSize: 0, weight: 1, wind: 0, spread: 0.24, source: 0.4, start: 0.15,
    growth: 1, opacity: 0.85, swirl: 0, young: [0.85, 0.9, 0.95], old: [0.85, 0.9, 0.95], shape: 1 },
};

export interface Particle {
  p: Vector3;
  radius: number;
  colour: [number, number, number];
  opacity: number;
  spin: number;
  seed: number;
  shape: Shape;
}

/** A point of the unit disc across a direction. */
function onDisc(along: Vector3, random: ShortRandom): Vector3 {
  const u = (Math.abs(along.x) > Math.abs(along.z) ? new Vector3(-along.y, along.x, 0) : new Vector3(0, -along.z, along.y)).normalize();
  const r = Math.sqrt(random.unit());
  const a = 2 * Math.PI * random.unit();
  return u.clone().multiplyScalar(r * Math.cos(a)).addScaledVector(along.clone().cross(u), r * Math.sin(a));
}

function smooth(from: number, to: number, x: number): number {
  const t = Math.min(Math.max((x - from) / (to - from), 0), 1);
  return t * t * (3 - 2 * t);
}

function ageOf(particle: number, time: number, life: number): { life: number; share: number } {
  const lives = time / life + kGolden * (particle + 1);
  const whole = Math.floor(lives);
  return { life: whole >>> 0, share: lives - whole };
}

function placeOf(effect: ParticleSource, habit: Habit, t: number, radius: number, random: ShortRandom): Vector3 {
  const p = effect.p.clone().addScaledVector(onDisc(effect.direction, random), habit.source * effect.size);
  const speed = effect.speed * (0.75 + 0.5 * random.unit());
  const v = effect.direction.clone().addScaledVector(onDisc(effect.direction, random), habit.spread).multiplyScalar(speed);
  const brake = habit.slowing;
  p.addScaledVector(v, brake > 0 ? brake * (1 - Math.exp(-t / brake)) : t);
  const carried = brake > 0 ? (t * t) / (t + brake) : t;
  const rise = (habit.rise + habit.risePerSize * effect.size) * (0.7 + 0.6 * random.unit());
  p.addScaledVector(kWind, habit.wind * carried);
  p.y += rise * carried - 0.5 * habit.weight * kGravity * t * t;
  const phase = 2 * Math.PI * random.unit();
  const turns = 2 * Math.PI * (0.35 + 0.5 * random.unit());
  return p.add(new Vector3(Math.sin(turns * t + phase), 0, Math.cos(1.3 * turns * t + phase)).multiplyScalar(habit.swirl * radius));
}

export function appendParticles(effect: ParticleSource, number: number, time: number, out: Particle[]): void {
  const habit = kHabits[effect.kind];
  const alive = Math.min(effect.intensity, 1) * habit.count;
  for (let i = 0; i < alive; ++i) {
    const age = ageOf(i, time, habit.life);
    const random = new ShortRandom(number, i, age.life);
    const seed = random.unit();
    const spin = 2 * Math.PI * random.unit() + (random.unit() - 0.5) * 1.5 * age.share;
    const grown = 1 + (habit.growth - 1) * (habit.growth > 1 ? Math.sqrt(age.share) : age.share);
    let radius = habit.start * effect.size * (0.7 + 0.6 * random.unit()) * grown;
    const p = placeOf(effect, habit, age.share * habit.life, radius, random);
    const share = Math.sqrt(age.share);
    const colour = habit.young.map((c, k) => c + (habit.old[k]! - c) * share) as [number, number, number];
    let opacity = habit.opacity * Math.min(alive - i, 1) * smooth(0, 0.08, age.share) * (1 - age.share) ** 1.4;
    let shape = habit.shape;
    // Mist between the drops, too fine for single drops.
    if (shape === 1 && i % 4 === 3) {
      shape = 0;
      radius *= 9 + 14 * age.share;
      opacity *= 0.07;
    }
    out.push({ p, radius, colour, opacity, spin, seed, shape });
  }
}

export function appendDrops(jet: Stream, time: number, out: Particle[]): void {
  const flight = flightTime(jet);
  const speed = jet.v.length();
  if (!jet.jet || !(flight > 0) || !(speed > 0)) return;
  const broken = breakupTime(jet);
  const along = jet.v.clone().divideScalar(speed);
  for (let i = 0; i < 260; ++i) {
    const age = ageOf(i, time, flight);
    const random = new ShortRandom(0x1e7, i, age.life);
    const t = age.share * flight;
    const fine = i % 4 === 0;
    const apart = (fine ? 0.35 : 0.75) * broken * (0.85 + 0.3 * random.unit());
    if (t < apart) continue;
    const seed = random.unit();
    const radius = 0.5 * jet.width * (fine ? 0.25 + 0.2 * random.unit() : 0.35 + 0.55 * random.unit());
    const p = jet.p.clone().addScaledVector(onDisc(along, random), (fine ? 0.055 : 0.03) * speed * (t - apart));
    p.addScaledVector(jet.v, t * (1 + 0.03 * (random.unit() - 0.5)));
    p.y -= 0.5 * kGravity * t * t;
    if (p.y <= jet.landing) continue;
    out.push({ p, radius, colour: [0.85, 0.9, 0.95], opacity: 0.8 * smooth(apart, 1.25 * apart, t), spin: 0, seed, shape: 1 });
  }
}

export function appendSplash(stream: Stream, number: number, time: number, out: Particle[]): void {
  const life = 0.42;
  const flight = flightTime(stream);
  const speed = Math.min(Math.hypot(stream.v.x, stream.v.y - kGravity * flight, stream.v.z), 6);
  const place = stream.p.clone().addScaledVector(stream.v, flight).setY(stream.landing);
  const up = new Vector3(0, 1, 0);
  const drops = Math.round(110 * Math.min(Math.max(stream.width / 0.04, 0), 1));
  for (let i = 0; i < drops; ++i) {
    const age = ageOf(i, time, life);
    const random = new ShortRandom(0x5b1a5 + number, i, age.life);
    const t = age.share * life;
    const seed = random.unit();
    const spin = 2 * Math.PI * random.unit();
    const from = place.clone().addScaledVector(onDisc(up, random), 0.6 * stream.width);
    const thrown = onDisc(up, random).multiplyScalar(0.2).setY(0.1 + 0.24 * random.unit()).multiplyScalar(speed);
    const colour: [number, number, number] = [0.88, 0.92, 0.95];
    if (i % 3 === 0) {
      const p = from.clone().add(new Vector3(thrown.x, 0, thrown.z).multiplyScalar(0.5 * t)).setY(place.y + 0.15 * stream.width);
      const radius = stream.width * (0.35 + 0.9 * age.share);
      out.push({ p, radius, colour, opacity: 0.34 * smooth(0, 0.15, age.share) * (1 - age.share), spin, seed, shape: 0 });
    } else {
      const p = from.addScaledVector(thrown, t);
      p.y -= 0.5 * kGravity * t * t;
      const radius = 0.05 * stream.width * (0.6 + 1.4 * random.unit());
      if (p.y >= place.y) out.push({ p, radius, colour, opacity: 0.8 * (1 - smooth(0.7, 1, age.share)), spin, seed, shape: 1 });
    }
  }
}

const kVertex = /* glsl */ `
attribute vec4 middle;  // w: radius
attribute vec4 tint_in;
attribute vec3 look_in;  // spin, seed, shape: 0 puff, 1 drop, 2 flame
varying vec2 place;
varying vec2 turned;
varying vec3 p_W;
varying vec4 tint;
varying vec3 look;
void main() {
  place = position.xy;
  float s = sin(look_in.x);
  float c = cos(look_in.x);
  turned = mat2(c, s, -s, c) * place;
  vec2 size = look_in.z > 1.5 ? vec2(0.85, 1.6) : vec2(1.0);
  p_W = middle.xyz;
  tint = tint_in;
  look = look_in;
  gl_Position = projectionMatrix * (viewMatrix * vec4(middle.xyz, 1.0) + vec4(place * size * middle.w, 0.0, 0.0));
}`;
const kFragment = /* glsl */ `
varying vec2 place;
varying vec2 turned;
varying vec3 p_W;
varying vec4 tint;
varying vec3 look;
uniform vec3 sun_light;
${kNoise}${kSky}
void main() {
  float r = length(place);
  if (r > 1.0) discard;
  float body;
  if (look.z > 0.5 && look.z < 1.5) {
    body = smoothstep(1.0, 0.55, r);
  } else {
    vec2 q = turned * 1.9 + look.y * vec2(61.0, 37.0);
    float lumps = value_noise(q) * 0.62 + value_noise(q * 2.6 + 11.0) * 0.38;
    body = smoothstep(1.0, 0.10, r + (0.5 - lumps) * 0.75) * smoothstep(1.0, 0.8, r);
  }
  float opacity = tint.a * body;
  vec3 light;
  if (look.z > 1.5) {
    light = tint.rgb * opacity * body;
    opacity = 0.0;
  } else {
    vec3 n = transpose(mat3(viewMatrix)) * vec3(place, sqrt(max(1.0 - r * r, 0.0)));
    float round = 0.45 + 0.55 * (0.5 + 0.5 * dot(n, to_sun));
    light = vec3(0.42, 0.48, 0.56) + sun_light * round * 0.5 / 3.14159265;
    if (look.z > 0.5) light = light * 0.55 + sky_radiance(reflect(normalize(p_W - cameraPosition), n)) * 0.45;
    light *= tint.rgb * opacity;
  }
  // Tone mapping is not linear: a puff's colour is mapped before it is weighted.
  gl_FragColor = vec4(opacity > 0.0 ? light / opacity : light, 1.0);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
  gl_FragColor = opacity > 0.0 ? vec4(gl_FragColor.rgb * opacity, opacity) : vec4(gl_FragColor.rgb, 0.0);
}`;

export class Particles {
  readonly mesh: Mesh;
  private readonly middle = new InstancedBufferAttribute(new Float32Array(4 * kMost), 4).setUsage(DynamicDrawUsage);
  private readonly tint = new InstancedBufferAttribute(new Float32Array(4 * kMost), 4).setUsage(DynamicDrawUsage);
  private readonly look = new InstancedBufferAttribute(new Float32Array(3 * kMost), 3).setUsage(DynamicDrawUsage);

  constructor() {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    geometry.setAttribute('middle', this.middle);
    geometry.setAttribute('tint_in', this.tint);
    geometry.setAttribute('look_in', this.look);
    const material = new ShaderMaterial({
      uniforms: { to_sun: { value: kToSun }, sun_light: { value: kSunLight } },
      vertexShader: kVertex,
      fragmentShader: kFragment,
      transparent: true,
      depthWrite: false,
      blending: CustomBlending,
      blendSrc: OneFactor,
      blendDst: OneMinusSrcAlphaFactor,
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 3;
  }
  show(particles: Particle[], eye: Vector3): void {
    particles.sort((a, b) => b.p.distanceToSquared(eye) - a.p.distanceToSquared(eye));
    const count = Math.min(particles.length, kMost);
    for (let i = 0; i < count; ++i) {
      const q = particles[i]!;
      this.middle.setXYZW(i, q.p.x, q.p.y, q.p.z, q.radius);
      this.tint.setXYZW(i, q.colour[0], q.colour[1], q.colour[2], q.opacity);
      this.look.setXYZ(i, q.spin, q.seed, q.shape);
    }
    for (const attribute of [this.middle, this.tint, this.look]) attribute.needsUpdate = true;
    (this.mesh.geometry as InstancedBufferGeometry).instanceCount = count;
    this.mesh.visible = count > 0;
  }
}
