// exhibits.mjs ADDRESS PASSWORD FILE [FOLDER]: an operator with a phone changes exhibits at a real gateway. FILE is the X3D file of the
// screw, home, in which a visit is in progress; the odometer can be loaded. With FOLDER, pictures are written there.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { openBrowser } from './page.mjs';

const [address, password, file, folder] = process.argv.slice(2);
const { browser, page, errors } = await openBrowser({ viewport: { width: 390, height: 844 } });
const good = readFileSync(file, 'utf8');
const title = /title\.en' value='"([^"]+)"/.exec(good)[1];
const row = (name) => page.locator(`li[aria-label="${name}"]`);
const said = (name, words) => row(name).locator('[role=status]', { hasText: words }).waitFor({ timeout: 120_000 });

async function assertAccessible(what) {
  await page.evaluate(readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8'));
  const { violations } = await page.evaluate(() => window.axe.run({ resultTypes: ['violations'] }));
  const serious = violations.filter((v) => v.impact === 'serious' || v.impact === 'critical');
  assert.deepEqual(serious.map((v) => `${v.id}: ${v.help}; ${v.nodes[0].html.slice(0, 120)}`), [], what);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), `${what}: nothing is cut off`);
}
async function picture(name) {
  await assertAccessible(name);
  if (!folder) return;
  for (const colorScheme of ['dark', 'light']) {
    await page.emulateMedia({ colorScheme });
    await page.screenshot({ path: `${folder}/${name}-${colorScheme}.png`, fullPage: true });
  }
  await page.setViewportSize({ width: 1200, height: 800 });
  await page.screenshot({ path: `${folder}/${name}-wide.png`, fullPage: true });
  await page.setViewportSize({ width: 390, height: 844 });
}
/** The gateway's answer with this in it, until what it returns is called. */
async function told(more) {
  const answer = await page.evaluate(async () => (await fetch('/api/exhibits')).json());
  await page.route('**/api/exhibits', (route) => route.fulfill({ json: { ...answer, ...more } }));
  return () => page.unroute('**/api/exhibits');
}

try {
  await page.goto(`${address}/console`);
  await page.fill('input[autocomplete=username]', 'operator');
  await page.fill('input[type=password]', password);
  await page.click('form button');
  await page.click('nav button:text-is("Exhibits")');
  await row(title).locator('text=home, 2 worlds open').waitFor();
  await row('odometer').locator('text=Load').waitFor();
  assert.equal(await row(title).locator('text=Retire').count(), 0, 'home stays');
  await picture('exhibits');

  // A bad file is refused with its line, and what to do.
  writeFileSync(file, good.replace(`bodies' value='"INNER"'`, `bodies' value='"INER"'`));
  await row(title).getByRole('button', { name: `Replace ${title}`, exact: true }).click();
  await said(title, /INER.*Where: .*archimedes-screw\.x3d:\d+.*\. .+/s);
  await picture('refused');

  // A visit in progress keeps the former one, until its operator answers a second question.
  const next = 'A screw once more';
  writeFileSync(file, good.replaceAll(title, next));
  await row(title).getByRole('button', { name: `Replace ${title}`, exact: true }).click();
  await said(next, 'The new form is in use. Visits in progress finish on the former one.');
  const former = row(next).locator('text=1 world with a visit that finishes on its former form');
  await former.waitFor();
  const replaceNow = row(next).locator('text=Replace now …');
  await replaceNow.click();
  await page.waitForSelector('dialog[open]');
  await picture('asked');
  await page.keyboard.press('Escape');
  await page.waitForSelector('dialog[open]', { state: 'detached' });
  await former.waitFor();
  await replaceNow.click();
  await page.click('dialog >> text="Replace now"');
  await said(next, 'Its file has not changed: it stays as it is. Visits on a former form end.');
  await former.waitFor({ state: 'detached' });

  await row('odometer').locator('text=Load').click();
  const odometer = page.locator('li', { hasText: 'odometer, not open' });
  await odometer.locator('[role=status]', { hasText: 'kiosks can open it' }).waitFor({ timeout: 120_000 });
  await odometer.locator('text=Retire …').click();
  await page.click('dialog >> text="Retire now"');
  await said('odometer', 'It is retired.');

  const live = await told({ preparing: 'odometer' });
  await row('odometer').locator('progress').waitFor();
  await picture('preparing');
  await live();
  await told({ changeable: false, remedy: 'start the gateway with --exhibit-key FILE' });
  await page.waitForSelector('section:has-text("cannot be changed from here") >> text=--exhibit-key');
  assert.equal(await page.locator('li button').count(), 0, 'nothing to press that would be refused');
  await picture('without-key');
  assert.deepEqual(errors.filter((e) => !/status of (401|404|409)/.test(e)), []);  // not signed in; no records; the bad file
  console.log('ok');
} finally {
  await browser.close();
}
