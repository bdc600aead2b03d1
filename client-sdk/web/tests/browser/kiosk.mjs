// kiosk.mjs APP: the built app in a real browser, against a stand-in of the gateway. Each part says what was wrong, if it was.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { Finger, kPhone, openBrowser, placeToTake, until } from './page.mjs';
import { kQuestion, StandIn } from './stand_in.mjs';

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

const parts = {
  async 'the world is shown from one file, with the words of the gateway'() {
    await page.goto(`${origin}/kiosk/k?token=t&language=el`);
    const seen = await until(page, 'all is there', (s) => s.complete && s.sequence > 2 && s.things.length > 0, 60);
    assert.deepEqual(gateway.fetched, ['pulley-crane']);
    assert.deepEqual([seen.missing, seen.malformed], [[], 0]);
    assert.deepEqual(seen.things.map((t) => t.name), ['DRUM']);
    assert.equal(await page.textContent('h1'), 'The crane');
    assert.deepEqual(heard('language').map((m) => m.code), ['el'], 'asked for once, as the address says');
    await assertAccessible('the kiosk');
  },
  async 'a finger presses with what its ray hits, in the view as it is drawn'() {
    const place = await placeToTake(page);
    const from = gateway.heard.length;
    const finger = await Finger.on(page);
    await finger.press(place);
    await finger.move({ x: place.x + 30, y: place.y - 20 });
    await finger.lift();
    await eventually('press, move and release', () => events(from).some((e) => e.kind === 'release'));
    const [message] = heard('pointer', from);
    const [press] = message.events;
    assert.deepEqual([press.kind, press.pick.object, press.finger > 0], ['press', drum, true]);
    assert.deepEqual(message.picture, [480, 360]);
    assert.ok(Math.abs(message.camera.aspect - 480 / 360) < 1e-6);
    assert.ok(Math.hypot(press.x - place.x, press.y - place.y) < 1.5);
    assert.ok(events(from).some((e) => e.kind === 'move'));
  },
  async 'keys take a thing and move it, and let go when they leave it'() {
    const from = gateway.heard.length;
    await page.focus('nav button.thing');
    await page.keyboard.press('Space');
    await page.keyboard.down('ArrowRight');
    await eventually('a press and a move to the right', () => {
      const all = events(from);
      const press = all.find((e) => e.kind === 'press');
      return press?.pick?.object === drum && all.some((e) => e.kind === 'move' && e.x > press.x);
    });
    await page.keyboard.up('ArrowRight');
    await page.focus('footer button');
    await eventually('a release', () => events(from).some((e) => e.kind === 'release'));
  },
  async 'a question is answered by its button'() {
    gateway.say(kQuestion);
    await page.waitForSelector('[role=dialog]');
    await assertAccessible('a question');
    const from = gateway.heard.length;
    await page.click('text=The rope');
    await eventually('the answer', () => heard('press', from).some((m) => m.action === 'answer:rope'));
    gateway.say(gateway.messages.at(-1));
    await page.waitForSelector('[role=dialog]', { state: 'detached' });
  },
  async 'words give way to what can be taken, and long ones turn to their end and back'() {
    const apart = (a, b) =>
      a.left + a.width <= b.left || b.left + b.width <= a.left || a.top + a.height <= b.top || b.top + b.height <= a.top;
    gateway.say({ ...gateway.messages.at(-1), subtitle: 'Of wood.', caption: 'Take hold of the crank and turn it. '.repeat(5) });
    await eventually('the note lies over nothing that matters', async () => {
      const { seen, note, moved } = await page.evaluate(() => {
        const words = document.querySelector('.top');
        const { left, top, width, height } = words.getBoundingClientRect();
        return { seen: window.mechane.look().seen, note: { left, top, width, height }, moved: words.style.translate };
      });
      return seen.length > 0 && moved !== '0px' && seen.every((one) => apart(one, note));
    });
    const scrolled = (far) => page.waitForFunction((yes) => (document.querySelector('.caption').scrollTop > 10) === yes, far);
    await scrolled(true);
    await scrolled(false);
    gateway.say(gateway.messages.at(-1));
  },
  async 'bytes that are no frame are counted, and change nothing'() {
    gateway.say(Buffer.from([1, 1, 0, 0, 7]));
    gateway.say('{"type":');
    await until(page, 'two are counted', (s) => s.malformed === 2);
  },
  async 'a page that can read no frame says so, until it can'() {
    const { frame } = gateway;
    gateway.frame = () => Buffer.from([2, 1, 0, 0]);
    await page.waitForSelector('.veil:has-text("Load it again")');
    gateway.frame = frame;
    await page.waitForSelector('.veil', { state: 'detached' });
  },
  async 'a gateway that is gone leaves a calm picture, and the page comes back by itself'() {
    const { port } = gateway;
    await gateway.stop();
    await page.waitForSelector('.veil');
    await gateway.start(port);
    await page.waitForSelector('.veil', { state: 'detached', timeout: 20_000 });
    await until(page, 'it is live again', (s) => s.online && s.state.link === 'joined');
  },
  async 'the console asks who one is, on a phone too'() {
    await page.setViewportSize(kPhone);
    await page.goto(`${origin}/console`);
    await page.waitForSelector('form');
    await assertAccessible('the sign-in');
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), 'nothing is cut off');
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
