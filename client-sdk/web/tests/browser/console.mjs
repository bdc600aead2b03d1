// console.mjs ADDRESS PASSWORD SCENARIO [FOLDER]: an operator with a phone, at a real gateway: signs in, sends a message, opens an exhibit.
// With FOLDER, pictures of each part, light and dark, are written there. Says what was wrong, if it was.
import assert from 'node:assert/strict';
import { barriers, openBrowser } from './page.mjs';

const [address, password, scenario, folder] = process.argv.slice(2);
const { browser, page, errors } = await openBrowser({ viewport: { width: 390, height: 844 } });

async function assertAccessible(what) {
  assert.deepEqual(await barriers(page), [], what);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), `${what}: nothing is cut off`);
}

async function part(name, there) {
  await page.click(`nav button:text-is("${name}")`);
  await page.waitForSelector(there);
  await assertAccessible(name);
  if (!folder) return;
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme });
    await page.screenshot({ path: `${folder}/${name.toLowerCase()}-${colorScheme}.png`, fullPage: true });
  }
  await page.setViewportSize({ width: 1200, height: 800 });
  await page.screenshot({ path: `${folder}/${name.toLowerCase()}-wide.png`, fullPage: true });
  await page.setViewportSize({ width: 390, height: 844 });
}

try {
  await page.goto(`${address}/console`);
  await page.fill('input[autocomplete=username]', 'operator');
  await page.fill('input[type=password]', password);
  await page.click('form button');
  await page.waitForSelector('article');

  await part('Messages', 'h2:text("Message to visitors")');
  await page.fill('input[lang=en]', 'The museum closes at six.');
  await page.click('button:text-is("Send")');
  await page.waitForSelector('section:has-text("Shown now") >> text=The museum closes at six.');

  await part('Kiosks', 'article');
  await page.selectOption('article form select', scenario);
  await page.click('article form button.main');
  await page.waitForSelector('[role=status]:has-text("is open.")', { timeout: 30_000 });
  await page.click('summary:text-is("Haptic devices")');
  await page.click('button:text-is("Test it")', { timeout: 30_000 });
  await page.waitForSelector('text=Being tested');
  await assertAccessible('a device in its test');
  if (folder) await page.screenshot({ path: `${folder}/device.png`, fullPage: true });
  await page.click('button:text-is("End the test")');
  await page.waitForSelector('button:text-is("Test it")');
  await page.click('summary:text-is("More")');
  await page.selectOption('label:has-text("Drawn hand") select', 'glove');
  await page.waitForSelector('[role=status]:has-text("hand is now glove.")');
  await page.waitForFunction(
    () => [...document.querySelectorAll('label')].find((l) => l.textContent.startsWith('Drawn hand')).control.value === 'glove');
  await part('Exhibits', 'section:has-text("cannot be changed from here") >> text=--exhibit-key');
  await part('Hours', 'h2:text("Opening hours")');
  await page.uncheck('text=always open');
  await assertAccessible('the week');
  if (folder) {
    await part('Accounts', 'h2:text("Accounts")');
    await page.click('nav button:text-is("Hours")');
    await page.uncheck('text=always open');
    await page.screenshot({ path: `${folder}/week.png`, fullPage: true });
  }
  await part('Log', 'li:has-text("/api/messages")');
  assert.deepEqual(errors.filter((e) => !/status of 40[14]/.test(e)), []);  // not signed in; a gateway without records
  console.log('ok');
} finally {
  await browser.close();
}
