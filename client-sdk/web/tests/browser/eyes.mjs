// eyes.mjs APP: two eyes and a headset in a real browser, against a stand-in of the gateway.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { enter, wearHeadset } from './headset.mjs';
import { Finger, openBrowser, placeToTake, until } from './page.mjs';
import { StandIn } from './stand_in.mjs';

const gateway = new StandIn(process.argv[2], 'pulley-crane', 'DRUM');
const origin = await gateway.start();
const drum = gateway.things.findIndex((t) => t.name === 'DRUM');
// Small: the processor draws.
const { browser, page, errors } = await openBrowser({ viewport: { width: 480, height: 360 } });
const heard = (type, from = 0) => gateway.heard.slice(from).filter((m) => m.type === type);
const events = (from) => heard('pointer', from).flatMap((m) => m.events);

async function eventually(what, condition, limit_s = 20) {
  const end = Date.now() + 1000 * limit_s;
  while (!(await condition())) {
    if (Date.now() > end) throw new Error(`not within ${limit_s} s: ${what}`);
    await new Promise((done) => setTimeout(done, 30));
  }
}

/** axe-core's serious findings; its own script is put in past the page's policy by the browser's protocol. */
async function assertAccessible(what) {
  const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run({ resultTypes: ['violations'] }));
  const serious = violations.filter((v) => v.impact === 'serious' || v.impact === 'critical');
  assert.deepEqual(serious.map((v) => `${v.id}: ${v.help}; ${v.nodes[0].html.slice(0, 120)}`), [], what);
}

/** By how many pixels the right half shows the rows from `from` to `to`, shares of the height, farther to the right than the left half. */
async function parallax(png, from, to) {
  return page.evaluate(async ([bytes, above, below]) => {
    const picture = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    const context = canvas.getContext('2d');
    context.drawImage(picture, 0, 0);
    const half = picture.width / 2;
    const [top, high] = [Math.round(above * picture.height), Math.round((below - above) * picture.height)];
    const [left, right] = [0, half].map((x) => context.getImageData(x, top, half, high).data);
    const apart = (shift) => {
      let [sum, count] = [0, 0];
      for (let y = 0; y < high; ++y)
        for (let x = 12; x < half - 12; ++x) {
          for (let c = 0; c < 3; ++c) sum += Math.abs(left[4 * (y * half + x) + c] - right[4 * (y * half + x + shift) + c]);
          ++count;
        }
      return sum / count;
    };
    const shifts = Array.from({ length: 21 }, (_, k) => k - 10);
    return shifts.reduce((best, shift) => (apart(shift) < apart(best) ? shift : best), 0);
  }, [[...png], from, to]);
}

const parts = {
  async 'two eyes see what is near more apart, and words and fingers are in both halves'() {
    await page.goto(`${origin}/kiosk/k?token=t&stereo=sbs`);
    await until(page, 'all is there', (s) => s.complete && s.sequence > 2 && s.things.length > 0, 60);
    assert.equal(await page.locator('.eye').count(), 2);
    assert.deepEqual(await page.locator('h1').allTextContents(), ['The crane', 'The crane']);
    await assertAccessible('two eyes');
    const png = await page.screenshot({ style: '.eye, .aid { visibility: hidden }' });
    const [far, near] = [await parallax(png, 0.05, 0.2), await parallax(png, 0.8, 0.95)];
    assert.ok(near < 0 && near < far, `what is near is before the screen: ${near} px, what is far: ${far} px`);
    const place = await placeToTake(page);
    const from = gateway.heard.length;
    const finger = await Finger.on(page);
    await finger.press({ x: place.x + 240, y: place.y });
    await finger.lift();
    await eventually('a press in the right half', () => events(from).some((e) => e.kind === 'press'));
    const [{ picture, camera, events: [press] }] = heard('pointer', from);
    assert.deepEqual([picture, press.pick?.object], [[240, 360], drum]);
    assert.ok(Math.abs(press.x - place.x) < 1.5 && camera.offset[0] < 0, 'it is the right eye that looks');
  },
  async 'a headset shows the world and sends the joints of both hands until it is taken off'() {
    await wearHeadset(page);
    await page.goto(`${origin}/kiosk/k?token=t`);
    await until(page, 'all is there', (s) => s.complete && s.sequence > 2 && s.things.length > 0, 60);
    await enter(page);
    await page.evaluate(() => (window.headset.primaryInputMode = 'hand'));
    const whole = 4 + 2 * (8 + 12 * 25);
    await eventually('both hands', () => gateway.hands.at(-1)?.length === whole);
    const bytes = gateway.hands.at(-1);
    assert.deepEqual([...bytes.subarray(0, 3)], [2, 1, 2]);
    assert.deepEqual([bytes[4], bytes[4 + 308]].sort(), [0, 1], 'a right and a left one');
    const { X_WR, pictures } = (await until(page, 'it is drawn', (s) => s.headset?.pictures > 2)).headset;
    assert.ok(pictures > 2);
    // The wrist is before the visitor's body, in the world.
    const wrist = [0, 1, 2].map((k) => bytes.readFloatLE(12 + 4 * k) - X_WR[12 + k]);
    assert.ok(Math.hypot(...wrist) < 2 && wrist[1] > 0.5, String(wrist));
    await page.evaluate(() => window.headset.activeSession.end());
    await eventually('a farewell without hands', () => gateway.hands.at(-1).length === 4);
    await until(page, 'the page draws again', (s) => s.headset === null);
  },
};

try {
  for (const [what, part] of Object.entries(parts)) {
    const began = Date.now();
    await part();
    console.log(`ok ${what} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
  }
  // A browser reports each refused connection and the answer 401 as an error; all others are ours.
  assert.deepEqual(errors.filter((e) => !/WebSocket|status of 401/.test(e)), []);
} finally {
  await browser.close();
  await gateway.stop();
}
