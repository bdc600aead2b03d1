// camera_turn.mjs ADDRESS PORT OBJECT GRIP: a visitor's hand before a camera takes a crank, turns it by a quarter and lets go. Where the
// hand is in the world is seen in the page's own frames, as a visitor sees it in the picture; the landmarks follow. GRIP: x,y,z in the
// body's frame; the axle lies along z.
import { Quaternion, Vector3 } from 'three';
import { HandProgram } from './hand_program.mjs';
import { openBrowser, until } from './page.mjs';

const kQuarter = Math.PI / 2;
/** The hand in the picture is late where the processor draws: a person, too, goes a part of the way and looks again. */
const kShare = 0.35;
const [kRests_m, kRests_ms] = [0.004, 1000];
const kLook_ms = 60;
const kAtGrip_m = 0.02;
/** So far the hand leads, radians. */
const kAhead = 0.35;
const [address, port, object, grip] = process.argv.slice(2);
const p_BG = new Vector3(...grip.split(',').map(Number));
const program = new HandProgram();
await program.start(Number(port));
const { browser, page, errors } = await openBrowser({ viewport: { width: 320, height: 240 } });

/** The world as the page shows it: the view, the body, the hand. */
async function seen() {
  const { frame, view, tracked, camera } = await page.evaluate((name) => {
    const { state, view, camera } = window.mechane.look();
    const frame = window.mechane.frame();
    const index = state.objects.find((o) => o.name === name).index;
    const at = Array.from(frame.objects).indexOf(index);
    const hand = frame.hands.find(({ whole }) => whole);
    const pose = Array.from(frame.poses.slice(7 * at, 7 * at + 7));
    const known = hand && { holding: hand.holding, segments: Array.from(hand.segments) };
    return { view, camera, tracked: state.tracked, frame: { pose, hand: known } };
  }, object);
  const [R_WV, R_WB] = [view.pose, frame.pose].map((pose) => new Quaternion(...pose.slice(3)));
  const hand = frame.hand && new Vector3();
  if (hand) for (let s = 0; s < frame.hand.segments.length; s += 7) hand.add(new Vector3().fromArray(frame.hand.segments, s));
  hand?.divideScalar(frame.hand.segments.length / 7);
  return { R_WV, R_WB, p_WB: new Vector3(...frame.pose), hand, holding: frame.hand?.holding ?? false, tracked, camera };
}
/** Moves the visitor's hand towards where the world's hand should be, a part of the way each time that it has come to rest. */
let [rests, restsSince] = [new Vector3(), 0];
function lead({ hand, R_WV }, p_WG) {
  const now = Date.now();
  if (hand.distanceTo(rests) > kRests_m) [rests, restsSince] = [hand, now];
  if (now - restsSince < kRests_ms) return;
  restsSince = now;
  const error = p_WG.clone().sub(hand).applyQuaternion(R_WV.clone().invert()).multiplyScalar(kShare);
  const [x, y, z] = program.pose.p;
  program.goal = [x - error.x, y - error.y, z + error.z];
}
const gripOf = ({ R_WB, p_WB }, ahead = 0) =>
  p_BG.clone().applyAxisAngle(new Vector3(0, 0, 1), ahead).applyQuaternion(R_WB).add(p_WB);
/** Looks again and again, and does, until it is done. */
async function lookUntil(what, doing, limit_s = 90) {
  let now;
  for (const end = Date.now() + 1000 * limit_s; Date.now() < end; ) {
    now = await seen();
    if (now.hand && doing(now)) return now;  // a page that draws slowly may lose it for a moment
    await new Promise((done) => setTimeout(done, kLook_ms));
  }
  const { hand, ...rest } = now;
  throw new Error(`not within ${limit_s} s: ${what}; hand ${hand?.toArray()}, grip ${gripOf(now).toArray()}, ${JSON.stringify(rest)}`);
}

/** Opens the hand, goes to the grip and closes around it. */
async function take() {
  program.pose.bent = 0.3;
  await lookUntil('the hand is at the grip', (now) => lead(now, gripOf(now)) ?? now.hand.distanceTo(gripOf(now)) < kAtGrip_m);
  return lookUntil('the hand holds the crank', (now) => {
    program.pose.bent = Math.min(program.pose.bent + 0.05, 1);
    lead(now, gripOf(now));
    return now.holding;
  });
}

try {
  await page.goto(`${address}&hand=camera`);
  await until(page, 'the exhibit is shown', (s) => s.complete && s.state.link === 'joined' && s.sequence > 0, 120);
  let furthest = 0;
  for (const end = Date.now() + 240_000; furthest < kQuarter; ) {
    if (Date.now() > end) throw new Error(`the crank has gone round by ${furthest.toFixed(2)} rad only`);
    const held = await take();
    // It is not quite at the grip; a hand that came nearer would tear itself loose.
    const beside = held.hand.clone().sub(gripOf(held));
    await lookUntil('the crank goes round by a quarter, or is lost by a page that draws slowly', (now) => {
      lead(now, gripOf(now, kAhead).add(beside));
      furthest = Math.max(furthest, 2 * Math.atan2(now.R_WB.z, now.R_WB.w));  // it begins at 0
      return furthest >= kQuarter || !now.holding;
    });
  }
  program.pose.bent = 0;
  await lookUntil('an open hand lets go', ({ holding }) => !holding);
  if (errors.length > 0) throw new Error(`the page has errors: ${errors.join('; ')}`);
  console.log(JSON.stringify({ turned: furthest }));
} finally {
  await browser.close();
  await program.stop();
}
