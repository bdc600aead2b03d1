// eyes.mjs APP: two eyes and a headset in a real browser, against a stand-in of the gateway. The world is three boxes before a black wall,
// so that pixels say where each eye sees them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { boxesFile } from './boxes.mjs';
import { enter, wearHeadset } from './headset.mjs';
import { Finger, openBrowser, placeToTake, until } from './page.mjs';
import { StandIn } from './stand_in.mjs';

// From the top of the picture down: beyond the screen, at its depth, before it. Small: the processor draws.
const kFront = { FAR: -15.9, AT: 0.1, NEAR: 1.25 };
const kSize = { width: 480, height: 360 };
const kEyes_m = 0.064;
/** Where the middle of what can be taken is: the screen's depth. It counts some air before it, see WorldScene.interest. */
const kScreen_m = 0.075;
const gateway = new StandIn(process.argv[2], 'boxes', 'AT', boxesFile([
  { name: 'FAR', p: [0, 4.4, kFront.FAR - 0.1], half: [0.9, 0.9, 0.1], grey: 1 },
  { name: 'AT', p: [0, 1.4, kFront.AT - 0.1], half: [0.15, 0.15, 0.1], grey: 1 },
  { name: 'NEAR', p: [0, 0.8, kFront.NEAR - 0.05], half: [0.12, 0.12, 0.05], grey: 1 },
  { name: 'WALL', p: [0, 0, -20], half: [60, 60, 0.1], grey: 0 },
]));
const of = (type) => gateway.messages.find((message) => message.type === type);
of('world').done = true;  // the usual view: none that goes to the work
of('presentation').activities = [];  // no ground
Object.assign(of('overlay'), { gauges: [], buttons: [], caption: '' });  // half a small page has no room for them
for (const object of of('scene').objects) object.movable = object.name === 'AT';
const origin = await gateway.start();
const at = gateway.things.findIndex((t) => t.name === 'AT');
const { browser, page, errors } = await openBrowser({ viewport: kSize });
await wearHeadset(page);
const events = (from) => gateway.heard.slice(from).filter((m) => m.type === 'pointer').flatMap((m) => m.events);

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

/** A page's picture without its words. */
async function pictureAlone() {
  const show = (visibility) => page.evaluate((v) => {
    for (const words of document.querySelectorAll('.eye, .aid')) words.style.visibility = v;
  }, visibility);
  await show('hidden');
  const png = await page.screenshot();
  await show('');
  return png;
}

/** What is bright in each eye's picture, from the top down: how many rows, and its middle across, in pixels from that picture's left. */
async function seenByEyes(png, stereo) {
  return page.evaluate(async ([bytes, mode]) => {
    const picture = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
    const { width, height } = picture;
    const context = new OffscreenCanvas(width, height).getContext('2d');
    context.drawImage(picture, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const channel = (x, y, c) => data[4 * (y * width + x) + c];
    const [across, down] = [mode === 'sbs' ? width / 2 : width, mode === 'rows' ? height / 2 : height];
    const light = (eye, x, y) =>
      mode === 'sbs' ? channel(x + eye * across, y, 1)
      : mode === 'anaglyph' ? channel(x, y, eye)  // red is the left eye's, green the right one's
      : channel(x, 2 * y + 1 - eye, 1);  // the uppermost row is the right eye's
    return [0, 1].map((eye) => {
      const runs = [];
      let open = null;
      for (let y = 0; y < down; ++y) {
        let [sum, count] = [0, 0];
        for (let x = 0; x < across; ++x) if (light(eye, x, y) > 128) [sum, count] = [sum + x, count + 1];
        if (count > 0) open ??= (runs.push({ rows: 0, sum: 0, count: 0 }), runs.at(-1));
        else open = null;
        if (open) Object.assign(open, { rows: open.rows + 1, sum: open.sum + sum, count: open.count + count });
      }
      return runs.map(({ rows, sum, count }) => ({ rows, middle: sum / count }));
    });
  }, [[...png], stereo]);
}

/** A box at a distance d from the eyes is farther to the right for the right eye by e (1 - s / d), as a share of a screen that is one metre
 * wide, where s is the screen's distance and e that between the eyes. */
async function assertDepth(stereo, more = '') {
  await page.goto(`${origin}/kiosk/k?token=t&stereo=${stereo}&screen-width=1&viewer-distance=1${more}`);
  await until(page, `${stereo}: all is there`, (s) => s.complete && s.sequence > 2 && s.things.length > 0, 120);
  const [left, right] = await seenByEyes(await pictureAlone(), stereo);
  assert.deepEqual([left.length, right.length], [3, 3], `${stereo}: three boxes for each eye`);
  const eye = (await page.evaluate(() => window.mechane.look())).view.pose[2];
  const across = stereo === 'sbs' ? kSize.width / 2 : kSize.width;
  Object.values(kFront).forEach((front, k) => {
    const wanted = kEyes_m * (1 - (eye - kScreen_m) / (eye - front)) * across;
    const seen = right[k].middle - left[k].middle;
    assert.ok(Math.abs(seen - wanted) < 2, `${stereo}, ${Object.keys(kFront)[k]}: ${seen.toFixed(1)} px, and not ${wanted.toFixed(1)}`);
  });
}

const parts = {
  async 'side by side, depth is true, and words and fingers are in both halves'() {
    await assertDepth('sbs');
    assert.equal(await page.locator('.eye').count(), 2);
    assert.deepEqual(await page.locator('h1').allTextContents(), ['The crane', 'The crane']);
    await assertAccessible('two eyes');
    const place = await placeToTake(page);
    const from = gateway.heard.length;
    const finger = await Finger.on(page);
    await finger.press({ x: place.x + kSize.width / 2, y: place.y });
    await finger.lift();
    await eventually('a press in the right half', () => events(from).some((e) => e.kind === 'press'));
    const { picture, camera, events: [press] } = gateway.heard.slice(from).find((m) => m.type === 'pointer');
    assert.deepEqual([picture, press.pick?.object], [[kSize.width / 2, kSize.height], at]);
    assert.ok(Math.abs(press.x - place.x) < 1.5 && camera.offset[0] < 0, 'it is the right eye that looks');
  },
  'through coloured glasses, depth is true': () => assertDepth('anaglyph'),
  'in every second row, depth is true': () => assertDepth('rows', '&right-eye-first'),
  async 'a headset shows the world to both eyes, and sends the joints of both hands until it is taken off'() {
    await enter(page);
    await page.evaluate(() => (window.headset.primaryInputMode = 'hand'));
    const whole = 4 + 2 * (8 + 12 * 25);
    await eventually('both hands', () => gateway.hands.at(-1)?.length === whole);
    const bytes = gateway.hands.at(-1);
    assert.deepEqual([...bytes.subarray(0, 3)], [2, 1, 2]);
    assert.deepEqual([bytes[4], bytes[4 + 308]].sort(), [0, 1], 'a right and a left one');
    const { X_WR } = (await until(page, 'it is drawn', (s) => s.headset?.pictures > 2)).headset;
    // The wrist is before the visitor's body, in the world.
    const wrist = [0, 1, 2].map((k) => bytes.readFloatLE(12 + 4 * k) - X_WR[12 + k]);
    assert.ok(Math.hypot(...wrist) < 2 && wrist[1] > 0.5, String(wrist));
    const [left, right] = await seenByEyes(await page.screenshot(), 'sbs');
    const work = (seen) => seen.reduce((most, one) => (one.rows > most.rows ? one : most)).middle;
    assert.ok(work(right) < work(left) - 8, `the work is within reach: ${work(right) - work(left)} px`);
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
