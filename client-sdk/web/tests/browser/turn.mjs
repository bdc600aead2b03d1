// turn.mjs ADDRESS: takes a crank with a finger, reloads the page in mid-grasp, takes it again and turns it by a quarter.
import { Finger, look, openBrowser, take, until } from './page.mjs';

const kQuarter = Math.PI / 2;
const [address] = process.argv.slice(2);
// Small: the processor draws.
const { browser, page, errors } = await openBrowser({ viewport: { width: 480, height: 360 } });
try {
  await page.goto(address);
  let finger = await Finger.on(page);
  const first = (await until(page, 'a world', (s) => s.state.world)).state.world.step;
  await take(page, finger);
  await page.reload();
  finger = await Finger.on(page);
  await until(page, 'the hand has let go', (s) => s.online && (s.state.pointer?.phase ?? 'resting') === 'resting');
  const held = await take(page, finger);
  // The finger goes round ahead of the hand. One question a move: a page that draws slowly answers slowly.
  let [turned, before] = [0, null];
  for (const end = Date.now() + 150_000; turned < kQuarter && Date.now() < end; ) {
    const { to, pointer } = await page.evaluate(() => ({ to: window.mechane.ahead(1.0), pointer: window.mechane.look().state.pointer }));
    if (!to) continue;
    await finger.move(to);
    const angle = Math.atan2(pointer.p[1] - pointer.axle.p[1], pointer.p[0] - pointer.axle.p[0]);  // these axles lie along z
    const by = before === null ? 0 : angle - before;
    turned += by - 2 * Math.PI * Math.round(by / (2 * Math.PI));
    before = angle;
  }
  if (turned < kQuarter) throw new Error(`the crank went round by ${turned.toFixed(1)} rad only`);
  await finger.lift();
  await until(page, 'the hand has let go', (s) => s.state.pointer.phase === 'resting');
  const { malformed, sequence } = await look(page);
  if (malformed > 0 || sequence === 0) throw new Error(`the page cannot read the gateway: ${malformed} malformed, frame ${sequence}`);
  if (errors.length > 0) throw new Error(`the page has errors: ${errors.join('; ')}`);
  console.log(JSON.stringify({ first, step: held.state.world.step, turned, renderer: held.renderer }));
} finally {
  await browser.close();
}
