export interface HandPose {
  p: [number, number, number];
  bent: number;
  turn?: number;
  side?: 'right' | 'left';
}
export function seenHand(pose: HandPose, camera: { width: number; height: number; fov: number }): {
  image: [number, number][];
  world: [number, number, number][];
};
