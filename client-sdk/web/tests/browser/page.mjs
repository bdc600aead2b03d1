// A real headless Chromium at a kiosk's address, and a finger on its glass. Used by the scripts beside this file.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { chromium } from 'playwright-core';

const kFlags = ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  '--use-fake-device-for-media-stream', '--use-fake-ui-for-media-stream'];  // a camera that sees no hand
export const kTablet = { width: 800, height: 600 };
export const kPhone = { width: 390, height: 780 };

/** `more`: what playwright knows of a context. Errors of the page's own scripts are collected in `errors`. */
export async function openBrowser(more = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.MECHANE_CHROMIUM ?? '/usr/bin/chromium', headless: true, args: kFlags,
  });
  const context = await browser.newContext({
    viewport: kTablet, hasTouch: true, ignoreHTTPSErrors: true, reducedMotion: 'reduce', ...more,
  });
  const page = await context.newPage();
  const errors = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  return { browser, page, errors };
}

/** What axe finds on the page that keeps people out. */
export async function barriers(page) {
  await page.evaluate(readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8'));
  const { violations } = await page.evaluate(() => window.axe.run({ resultTypes: ['violations'] }));
  const serious = violations.filter((v) => v.impact === 'serious' || v.impact === 'critical');
  return serious.map((v) => `${v.id}: ${v.help}; ${v.nodes[0].html.slice(0, 120)}`);
}

export const look = (page) => page.evaluate(() => window.mechane?.look());

/** Waits until what the page knows is as wanted; returns it. */
export async function until(page, what, wanted, limit_s = 30) {
  const end = Date.now() + 1000 * limit_s;
  let seen;
  while (Date.now() < end) {
    seen = await look(page);
    if (seen && wanted(seen)) return seen;
    await new Promise((done) => setTimeout(done, 100));
  }
  const { state, ...rest } = seen ?? {};
  const told = { ...rest, link: state?.link, step: state?.world?.step, pointer: state?.pointer };
  throw new Error(`not within ${limit_s} s: ${what}; ${JSON.stringify(told)}`);
}

/** One finger, by Chromium's own input: the page cannot tell it from a real one. */
export class Finger {
  constructor(session, corner) {
    this.session = session;
    this.corner = corner;
  }
  /** `corner`: of the frame whose pixels are meant, in the page. */
  static async on(page, corner = { x: 0, y: 0 }) {
    return new Finger(await page.context().newCDPSession(page), corner);
  }
  async say(type, points) {
    const touchPoints = points.map(({ x, y }) => ({ x: x + this.corner.x, y: y + this.corner.y }));
    await this.session.send('Input.dispatchTouchEvent', { type, touchPoints });
  }
  async press(at) {
    this.at = at;
    await this.say('touchStart', [at]);
  }
  async move(at) {
    this.at = at;
    await this.say('touchMove', [at]);
  }
  async lift() {
    await this.say('touchEnd', []);
  }
}

/** The first thing that can be taken, where a finger takes it. */
export async function placeToTake(page) {
  const { things } = await until(page, 'something can be taken', (s) => s.complete && s.state.link === 'joined' && s.things.length > 0, 60);
  const place = await page.evaluate((object) => window.mechane.placeOf(object), things[0].object);
  if (!place) throw new Error(`${things[0].name} is not to be seen`);
  return place;
}

/** Presses on it, and again, as a person does who sees that a hand has closed beside a thing that had moved. */
export async function take(page, finger, again = 2) {
  await finger.press(await placeToTake(page));
  const held = until(page, 'the hand holds it', (s) => s.state.pointer?.phase === 'holding', again > 0 ? 10 : 30);
  if (again === 0) return held;
  return held.catch(async () => {
    await finger.lift();
    await until(page, 'the hand has let go', (s) => (s.state.pointer?.phase ?? 'resting') === 'resting');
    return take(page, finger, again - 1);
  });
}
