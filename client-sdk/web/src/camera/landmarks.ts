// A hand as hand finders see it: 21 landmarks in a camera's picture and in space, and what follows from them. C is the camera: x to the
// right in its picture, y down, z ahead; metres.
import { Vector3 } from 'three';

/** In the order of MediaPipe: the wrist, then thumb, index, middle, ring and little finger, four each from the palm outwards. */
export const kLandmarks = 21;
const kWrist = 0;
const kThumb = 1;
/** Where the fingers begin; the next three are further out on the same finger. */
const kFingers = [5, 9, 13, 17] as const;
/** A finger's metacarpal begins beside the wrist: so much of the way to the knuckle. No landmark is there. */
const kMetacarpal = 0.25;
/** Fingers must be bent so much of the palm's length, on average, for a hand to tell its side. */
const kBent = 0.12;

export type Side = 'right' | 'left';
export interface SeenLandmarks {
  /** Shares of the picture's width and height from its upper left; as the camera took it, not mirrored. */
  image: [number, number][];
  /** From a point within the hand, along the axes of C. */
  world: Vector3[];
}
export interface CameraPicture {
  width: number;
  height: number;
  /** Across the picture, radians. */
  fov: number;
  hands: SeenLandmarks[];
}

/** Most webcams see 55 to 75 degrees across. Another value moves the hand nearer or farther, by the same factor everywhere. */
export const kUsualFov = 1.1;
const kMostHands = 4;

function pointsOf(v: unknown, dimensions: number): number[][] | null {
  if (!Array.isArray(v) || v.length !== kLandmarks) return null;
  const fits = v.every((p) => Array.isArray(p) && p.length === dimensions && p.every((x) => Number.isFinite(x) && Math.abs(x) < 100));
  return fits ? (v as number[][]) : null;
}

/** A message of a program beside the browser (client-sdk/web/CAMERA.md); null: it cannot be read. */
export function parsePicture(json: string): CameraPicture | null {
  let message: Record<string, unknown>;
  try {
    message = Object(JSON.parse(json)) as Record<string, unknown>;
  } catch {
    return null;
  }
  const { version, width, height, fov = kUsualFov, hands } = message;
  const within = (v: unknown, low: number, high: number): v is number => typeof v === 'number' && v >= low && v <= high;
  if (version !== 1 || !within(width, 16, 10_000) || !within(height, 16, 10_000) || !within(fov, 0.2, 3)) return null;
  if (!Array.isArray(hands) || hands.length > kMostHands) return null;
  const out: SeenLandmarks[] = [];
  for (const hand of hands as unknown[]) {
    const { image, world } = Object(hand) as Record<string, unknown>;
    const [flat, deep] = [pointsOf(image, 2), pointsOf(world, 3)];
    if (!flat || !deep) return null;
    out.push({ image: flat as [number, number][], world: deep.map(([x, y, z]) => new Vector3(x, y, z)) });
  }
  return { width, height, fov, hands: out };
}

/** Half the picture, across and down, at one metre. */
export interface Slope {
  across: number;
  down: number;
}
export function slopeOf({ width, height, fov }: CameraPicture): Slope {
  const across = Math.tan(fov / 2);
  return { across, down: (across * height) / width };
}

/** Where in C the point is from which `world` counts, by least squares: the rays of `image` go through the landmarks there. Null: all lie
 * on one ray, or behind the camera. */
export function placeInCamera({ image, world }: SeenLandmarks, { across, down }: Slope): Vector3 | null {
  let [u1, v1, square, a1, b1, both] = [0, 0, 0, 0, 0, 0];
  image.forEach(([x, y], k) => {
    const [u, v, m] = [(2 * x - 1) * across, (2 * y - 1) * down, world[k]!];
    const [a, b] = [u * m.z - m.x, v * m.z - m.y];  // x - u z = a, y - v z = b
    u1 += u;
    v1 += v;
    square += u * u + v * v;
    a1 += a;
    b1 += b;
    both += u * a + v * b;
  });
  const spread = square - (u1 * u1 + v1 * v1) / kLandmarks;
  if (!(spread > 1e-9)) return null;
  const z = ((u1 * a1 + v1 * b1) / kLandmarks - both) / spread;
  return z > 0 ? new Vector3((a1 + u1 * z) / kLandmarks, (b1 + v1 * z) / kLandmarks, z) : null;
}

/** The 25 joints of WebXR Hand Input. */
export function jointsOf(points: readonly Vector3[]): Vector3[] {
  const wrist = points[kWrist]!;
  return [
    wrist, ...points.slice(kThumb, kThumb + 4),
    ...kFingers.flatMap((first) => [wrist.clone().lerp(points[first]!, kMetacarpal), ...points.slice(first, first + 4)]),
  ];
}

/** How far the fingers are bent towards the palm of a right hand, as a share of the palm's length; below 0: it is a left hand's palm.
 * Models take the one side for the other in mirrored pictures; this cannot, for fingers do not bend backwards. */
function bentAsRight(points: readonly Vector3[]): number {
  const wrist = points[kWrist]!;
  const [index, little] = [points[kFingers[0]]!.clone().sub(wrist), points[kFingers[3]]!.clone().sub(wrist)];
  const palm = index.clone().cross(little).normalize();  // out of the palm of a right hand
  const bent = kFingers.reduce((sum, first) => sum + points[first + 3]!.clone().sub(points[first]!).dot(palm), 0);
  return bent / kFingers.length / Math.max(index.length(), 1e-6);
}

/** Null: its fingers are too straight to tell. */
export function sideOf(points: readonly Vector3[]): Side | null {
  const bent = bentAsRight(points);
  return Math.abs(bent) < kBent ? null : bent > 0 ? 'right' : 'left';
}
