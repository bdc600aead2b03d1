// A hand as a camera would see it, of our own making: no hand of a person was recorded. C: x right, y down, z ahead; metres.

/** Of a right hand whose palm is towards the camera, fingers up: to the camera's right is the visitor's left. Lengths of bones. */
const kFingers = [
  { root: [0.028, -0.09], bones: [0.04, 0.025, 0.02] },   // index: on the thumb's side
  { root: [0.008, -0.095], bones: [0.045, 0.028, 0.02] },
  { root: [-0.012, -0.088], bones: [0.04, 0.026, 0.02] },
  { root: [-0.03, -0.078], bones: [0.032, 0.02, 0.018] },
];
const kThumb = [[0.02, -0.02, -0.005], [0.045, -0.045, -0.012], [0.06, -0.07, -0.02], [0.065, -0.09, -0.03]];

/** The 21 landmarks around their own middle. `bent`: 0 straight, 1 a fist; `turn`: about the camera's line of sight. */
function landmarks({ bent, turn = 0, side = 'right' }) {
  const points = [[0, 0, 0], ...kThumb];
  for (const { root, bones } of kFingers) {
    let [x, y, z, down] = [...root, 0, 0];
    points.push([x, y, z]);
    bones.forEach((bone, k) => {
      down += bent * [1.2, 1.4, 0.8][k];
      [y, z] = [y - bone * Math.cos(down), z - bone * Math.sin(down)];  // towards the camera
      points.push([x, y, z]);
    });
  }
  const middle = [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  return points.map((p) => {
    const [x, y, z] = p.map((value, k) => value - middle[k]);
    const across = side === 'right' ? x : -x;
    return [c * across - s * y, s * across + c * y, z];
  });
}

/** A hand of a program's message. `p`: where its middle is in C. */
export function seenHand(pose, { width, height, fov }) {
  const world = landmarks(pose);
  const focal = width / 2 / Math.tan(fov / 2);
  const image = world.map((m) => {
    const [x, y, z] = m.map((value, k) => value + pose.p[k]);
    return [0.5 + (focal * x) / z / width, 0.5 + (focal * y) / z / height];
  });
  return { image, world };
}
