// How a hand has worked a hinge: turned it this way and that, or swung it to and fro.
export interface AngleSample {
  at_s: number;
  /** Within half a turn; NaN: not seen. */
  angle: number;
}
export type Work = { kind: 'turn'; turns: number; rpm: number } | { kind: 'swing'; angle: number; cycles: number; perMinute: number };
interface Stretch {
  from: number;
  to: number;
  begin_s: number;
  end_s: number;
}

const kTurn_rad = 2 * Math.PI;
/** A hand that goes back by less than this only settles. */
const kReversal_rad = 0.26;
const kLeast_rad = 0.1;
/** Slower than this it rests: the author looked, or thought. */
const kRests_radPerS = 0.15;
/** As fast as a scripted hand can follow a crank. */
const kRpm = [4, 40] as const;

/** Over whole turns. */
export function unwrapped(angles: readonly number[]): number[] {
  let [turns, last] = [0, angles[0] ?? 0];
  return angles.map((angle) => {
    if (angle - last > Math.PI) turns -= 1;
    if (angle - last < -Math.PI) turns += 1;
    last = angle;
    return angle + turns * kTurn_rad;
  });
}

/** Stretches in one direction, from one turning point to the next. */
function stretchesOf(times: readonly number[], angles: readonly number[]): Stretch[] {
  const ends = [0];
  let way = 0;
  let far = 0;  // the farthest in this direction
  for (let i = 1; i < angles.length; ++i) {
    const by = angles[i]! - angles[far]!;
    if (way === 0 ? Math.abs(angles[i]! - angles[0]!) > kLeast_rad : by * way > 0) {
      if (way === 0) way = Math.sign(angles[i]! - angles[0]!);
      far = i;
    } else if (way !== 0 && -by * way > kReversal_rad) {
      ends.push(far);
      way = -way;
      far = i;
    }
  }
  if (way !== 0) ends.push(far);
  return ends.slice(1).map((end, i) => ({ from: angles[ends[i]!]!, to: angles[end]!, begin_s: times[ends[i]!]!, end_s: times[end]! }));
}

/** The time in which it moved. */
function worked_s(times: readonly number[], angles: readonly number[], { begin_s, end_s }: Stretch): number {
  let sum = 0;
  for (let i = 1; i < times.length; ++i) {
    const dt = times[i]! - times[i - 1]!;
    if (times[i]! <= begin_s || times[i]! > end_s || dt <= 0) continue;
    if (Math.abs(angles[i]! - angles[i - 1]!) / dt > kRests_radPerS) sum += dt;
  }
  return Math.max(sum, 0.1);
}
const wayOf = (s: Stretch): number => Math.abs(s.to - s.from);
const digits = (x: number, n: number): number => Number(x.toFixed(n));

/** As often to and fro as a scripted swing is: about the joint's 0, by about the same angle each time. */
function swingOf(stretches: readonly Stretch[]): Work | null {
  const inner = stretches.slice(1, -1);
  if (inner.length < 2) return null;
  const ways = inner.map(wayOf);
  const half = ways.reduce((sum, way) => sum + way, 0) / ways.length / 2;
  const middle = inner.reduce((sum, s) => sum + (s.from + s.to) / 2, 0) / inner.length;
  if (half > 3 || Math.min(...ways) < 0.5 * Math.max(...ways) || Math.abs(middle) > 0.4 * half) return null;
  const lasted = inner.at(-1)!.end_s - inner[0]!.begin_s;
  const perMinute = Math.min(Math.max(60 * inner.length / 2 / Math.max(lasted, 0.1), 4), 120);
  const first = Math.sign(stretches[0]!.to - stretches[0]!.from);
  return { kind: 'swing', angle: digits(first * half, 3), cycles: digits(Math.max(stretches.length / 2, 0.5), 1),
    perMinute: digits(perMinute, 1) };
}

export function workedAngles(samples: readonly AngleSample[]): { work: Work[]; way_rad: number } {
  const seen = samples.filter((s) => Number.isFinite(s.angle));
  const times = seen.map((s) => s.at_s);
  const angles = unwrapped(seen.map((s) => s.angle));
  const stretches = stretchesOf(times, angles).filter((s) => wayOf(s) >= kLeast_rad);
  const way_rad = stretches.reduce((sum, s) => sum + wayOf(s), 0);
  const swing = swingOf(stretches);
  if (swing) return { work: [swing], way_rad };
  const work = stretches.map((s): Work => {
    const turns = (s.to - s.from) / kTurn_rad;
    const rpm = Math.abs(turns) / (worked_s(times, angles, s) / 60);
    return { kind: 'turn', turns: digits(turns, 3), rpm: digits(Math.min(Math.max(rpm, kRpm[0]), kRpm[1]), 1) };
  });
  return { work, way_rad };
}
