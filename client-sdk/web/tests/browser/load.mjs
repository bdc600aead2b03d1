// load.mjs ADDRESS [PICTURE.png]: how long a kiosk's page takes from a browser that knows nothing, and what it fetches. One JSON object.
import { gzipSync } from 'node:zlib';
import { openBrowser } from './page.mjs';

const kLimit_ms = 280_000;
const [address, picture] = process.argv.slice(2);
const { browser, page, errors } = await openBrowser({ viewport: { width: 480, height: 360 } });
try {
  const fetched = { app: [], meshes: [], others: [] };
  const answers = [];
  page.on('response', (response) => {
    const { pathname } = new URL(response.url());
    const kind = pathname.startsWith('/content/') ? 'meshes' : /^\/(app|kiosk)\//.test(pathname) ? 'app' : 'others';
    answers.push(response.body().then((body) => fetched[kind].push(body), () => undefined));
  });
  // Times are the page's own, from the begin of its navigation.
  await page.goto(address, { waitUntil: 'commit' });
  const picture_ms = await page.waitForFunction(() => {
    const seen = window.mechane?.look();
    return seen && seen.complete && seen.sequence > 0 && seen.state.objects.length > 0 && performance.now();
  }, null, { polling: 'raf', timeout: kLimit_ms }).then((value) => value.jsonValue());
  const shell_ms = await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime);
  if (shell_ms === undefined) throw new Error('the browser does not tell when it painted first');
  // The picture that was being made then is seen in the next one.
  const seen_ms = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(performance.now())))));
  await Promise.all(answers);
  if (errors.length > 0) throw new Error(`the page has errors: ${errors.join('; ')}`);
  if (picture) await page.screenshot({ path: picture });
  const kb = (bodies, size) => bodies.reduce((sum, body) => sum + size(body), 0) / 1024;
  console.log(JSON.stringify({
    shell_s: shell_ms / 1000, s: seen_ms / 1000, known_s: picture_ms / 1000,
    gzip_kb: kb(fetched.app, (body) => gzipSync(body).length), app_kb: kb(fetched.app, (body) => body.length),
    meshes_kb: kb(fetched.meshes, (body) => body.length), files: fetched.app.length,
  }));
} finally {
  await browser.close();
}
