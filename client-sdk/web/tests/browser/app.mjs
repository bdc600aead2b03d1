// app.mjs APP: the built app as one that a tablet installs, in a real browser, against a stand-in of the gateway.
import assert from 'node:assert/strict';
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { openBrowser, until } from './page.mjs';
import { StandIn } from './stand_in.mjs';

const app = process.argv[2];
const gateway = new StandIn(app, 'pulley-crane', 'DRUM');
const origin = await gateway.start();
const { port } = gateway;
const { browser, page, errors } = await openBrowser({ viewport: { width: 240, height: 180 } });
const folder = mkdtempSync(join(tmpdir(), 'mechane-app-'));

const kept = () => page.evaluate(async () => {
  const names = (await caches.keys()).filter((name) => name.startsWith('mechane-shell-'));
  const paths = await Promise.all(names.map(async (name) => (await (await caches.open(name)).keys()).map((r) => r.url)));
  return Object.fromEntries(names.map((name, i) => [name, paths[i]]));
});
async function eventually(what, look, limit_s = 120) {
  const end = Date.now() + 1000 * limit_s;
  for (;;) {
    const seen = await look();
    if (seen) return seen;
    if (Date.now() > end) throw new Error(`not within ${limit_s} s: ${what}`);
    await new Promise((done) => setTimeout(done, 50));
  }
}
/** A browser reports each refused connection, and the answers 401 and 404, as an error; all others are ours. */
const unexpected = () => errors.filter((e) => !/WebSocket|status of 40[14]|ERR_CONNECTION_REFUSED/.test(e));
const controlled = () => page.evaluate(() => navigator.serviceWorker.controller !== null);

const parts = {
  async 'the manifest is one that the browser installs, without a token'() {
    await page.goto(`${origin}/kiosk/k?token=secret`);
    await eventually('the shell is kept', controlled);
    const session = await page.context().newCDPSession(page);
    const { data, errors: faults } = await session.send('Page.getAppManifest');
    assert.deepEqual(faults, []);
    const { installabilityErrors } = await session.send('Page.getInstallabilityErrors');
    // A test's browser runs without a profile of its own, in which nothing is installed.
    assert.deepEqual(installabilityErrors.map((e) => e.errorId).filter((id) => id !== 'in-incognito'), []);
    const manifest = JSON.parse(data);
    assert.deepEqual([manifest.start_url, manifest.display], ['/?kiosk', 'fullscreen']);
    assert.ok(!data.includes('secret'));
    for (const { src, sizes } of manifest.icons) {
      const png = Buffer.from(await (await fetch(origin + src)).arrayBuffer());
      assert.deepEqual([png.toString('latin1', 1, 4), `${png.readUInt32BE(16)}x${png.readUInt32BE(20)}`], ['PNG', sizes]);
    }
  },
  async 'what is kept is the app alone'() {
    await until(page, 'the world is shown', (s) => s.complete && s.sequence > 2, 120);
    const [paths, ...others] = Object.values(await kept());
    assert.deepEqual(others, []);
    const known = new Set(paths.map((url) => new URL(url).pathname));
    assert.ok(known.has('/app/index.html') && [...known].some((p) => /Kiosk-.*\.js$/.test(p)));
    assert.ok(paths.every((url) => url.startsWith(`${origin}/app/`) && !url.includes('?')), String(paths));
  },
  async 'the app begins with its kiosk, without the gateway too, and comes back by itself'() {
    await gateway.stop();
    await page.goto(`${origin}/?kiosk`);
    assert.equal(new URL(page.url()).pathname, '/kiosk/k');
    await page.waitForSelector('.veil >> text=One moment, the exhibit will be back');
    if (process.env.MECHANE_PICTURES) await page.screenshot({ path: join(process.env.MECHANE_PICTURES, 'offline.png') });
    await gateway.start(port);
    await page.waitForSelector('.veil', { state: 'detached', timeout: 120_000 });
    await until(page, 'it is live, and whole', (s) => s.online && s.state.link === 'joined' && s.complete, 120);
    assert.deepEqual(unexpected(), []);
  },
  async 'a new version shows with the next load, and is kept in place of the old one'() {
    cpSync(app, folder, { recursive: true });
    const edit = (file, change) => writeFileSync(join(folder, file), change(readFileSync(join(folder, file), 'utf8')));
    const [before] = Object.keys(await kept());
    edit('index.html', (html) => html.replace('<title>', '<meta name="version" content="next"><title>'));
    edit('sw.js', (code) => code.replace(before.replace('mechane-shell-', ''), '0123456789ab'));
    gateway.app = folder;
    await page.goto(`${origin}/console`);  // a page that draws nothing
    const version = () => page.evaluate(() => document.querySelector('meta[name=version]')?.content ?? null);
    assert.equal(await version(), 'next');
    await eventually('the new one is kept', async () => '0123456789ab' === Object.keys(await kept()).at(-1)?.slice(14) &&
      await page.evaluate(async () => (await navigator.serviceWorker.getRegistration()).installing === null));
    await gateway.stop();
    await page.reload();
    assert.equal(await version(), 'next');
    await gateway.start(port);
  },
  async 'what is no page and no file of the app goes past the service worker'() {
    await page.reload();
    const sw = await page.evaluate(async () => (await Promise.all(
      ['/api/me', '/app/no-such.js'].map((p) => fetch(p)))).map((r) => r.status));
    assert.deepEqual(sw, [401, 404]);
    await gateway.stop();
    const lost = await page.evaluate(() => fetch('/api/me').then(() => 'answered', () => 'lost'));
    assert.equal(lost, 'lost');
  },
};

try {
  for (const [what, part] of Object.entries(parts)) {
    const began = Date.now();
    await part();
    console.log(`ok ${what} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
  }
  // Pages that were left while they loaded had no time for their textures.
  assert.deepEqual(unexpected().filter((e) => !/Couldn't load texture blob/.test(e)), []);
} finally {
  await browser.close();
  await gateway.stop().catch(() => {});
  rmSync(folder, { recursive: true });
}
