// studio_load.mjs ORIGIN USER PASSWORD DRAFT BODY EDITS [PICTURE.png]: how long the studio takes from a browser that knows nothing until
// DRAFT is seen, what a drag of BODY takes from the pointer's event until its picture is submitted, and what EDITS edits leave in the
// page's memory. One JSON object.
import { gzipSync } from 'node:zlib';
import { openBrowser, until } from './page.mjs';

const kMoves = 240;
const [origin, user, password, draft, body, edits, picture] = process.argv.slice(2);
const { browser, page, errors } = await openBrowser({ viewport: { width: 1280, height: 720 }, locale: 'en-GB' });

/** Signed in without the app, so that nothing of it is in the browser's cache. */
async function signIn() {
  const answer = await page.context().request.post(`${origin}/api/sign-in`, { data: { user, password }, headers: { Origin: origin } });
  if (!answer.ok()) throw new Error(`${user} cannot sign in: ${answer.status()} ${await answer.text()}`);
}
async function load() {
  const bodies = [];
  const answers = [];
  page.on('response', (response) => /^\/(app|studio)\b/.test(new URL(response.url()).pathname)
    && answers.push(response.body().then((bytes) => bodies.push(bytes), () => undefined)));
  await page.goto(`${origin}/studio/${draft}`, { waitUntil: 'commit' });
  await page.waitForFunction(() => window.mechane?.look().complete, null, { polling: 'raf', timeout: 120_000 });
  // The next picture begins once the one with everything is on the screen.
  const seen_ms = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => done(performance.now()))));
  await Promise.all(answers);
  const kb = (size) => bodies.reduce((sum, bytes) => sum + size(bytes), 0) / 1024;
  return { load_s: seen_ms / 1000, gzip_kb: kb((bytes) => gzipSync(bytes).length), app_kb: kb((bytes) => bytes.length) };
}
/** The page's listeners run before this one, so that what it asks to be drawn is drawn when this one's turn comes. */
function listen(before) {
  window.drags_ms = [];
  window.addEventListener('pointermove', ({ timeStamp }) =>
    requestAnimationFrame(() => window.drags_ms.push(performance.now() - timeStamp)));
  window.taken = new Promise((done, fail) => window.addEventListener('pointerup', ({ timeStamp }) => {
    setTimeout(() => fail(new Error('the drag has no answer')), 20_000);
    const look = () => (window.mechane.look().revision > before ? done(performance.now() - timeStamp) : requestAnimationFrame(look));
    look();
  }, { once: true }));
}
async function drag() {
  await page.click(`[role=treeitem]:has(.name:text-is("${body}"))`);
  await page.click('.tools button:text-is("Move")');
  const { selectedAt, revision } = await until(page, 'the body is to be seen', (s) => s.outlined && s.selectedAt);
  const { x, y } = await page.locator('canvas').boundingBox();
  const [left, top] = [x + selectedAt.x, y + selectedAt.y];
  await page.mouse.move(left, top);
  await page.mouse.down();
  await page.evaluate(listen, revision);
  for (let k = 1; k <= kMoves; ++k) await page.mouse.move(left + 60 * Math.sin(k / 40), top);
  await page.mouse.up();
  return page.evaluate(async () => ({ drags_ms: window.drags_ms, drop_ms: await window.taken }));
}
async function heap_mib() {
  const session = await page.context().newCDPSession(page);
  await session.send('HeapProfiler.collectGarbage');
  const { usedSize } = await session.send('Runtime.getHeapUsage');
  await session.detach();
  return usedSize / 2 ** 20;
}
async function edit(count) {
  const mass = `[data-field="${body}/mass"] input`;
  for (let k = 0; k < count; ++k) {
    const { revision } = await page.evaluate(() => window.mechane.look());
    await page.fill(mass, String(1 + (k % 7)));
    await page.press(mass, 'Enter');
    await page.waitForFunction((before) => window.mechane.look().revision > before, revision);
  }
}

try {
  await signIn();
  const loaded = await load();
  const dragged = await drag();
  await edit(20);  // what is made once is there then
  const before_mib = await heap_mib();
  await edit(Number(edits));
  const after_mib = await heap_mib();
  if (picture) await page.screenshot({ path: picture });
  if (errors.length > 0) throw new Error(`the page has errors: ${errors.join('; ')}`);
  console.log(JSON.stringify({ ...loaded, ...dragged, before_mib, after_mib }));
} finally {
  await browser.close();
}
