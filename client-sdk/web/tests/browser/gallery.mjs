// gallery.mjs APP FOLDER [again]: pictures of the studio's parts, PART-LANGUAGE-THEME.webp, in Greek and English, light and dark, of the
// built app against a stand-in of the gateway. `again`: only those that are in FOLDER already.
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { openBrowser, until } from './page.mjs';
import { StudioStandIn } from './studio_stand_in.mjs';

const [app, folder, again] = process.argv.slice(2);
const kLocales = { en: 'en-GB', el: 'el-GR' };
const kQuality = 60;
const go = (page, part) => page.click(`nav button[data-part=${part}]`);

/** Each leaves the page as it is to be seen; in this order. */
const kParts = {
  async exhibits(page, origin) {
    await page.goto(`${origin}/studio`);
    await page.waitForSelector('h3');
  },
  async scene(page, origin) {
    await page.goto(`${origin}/studio/my-crane`);
    await until(page, 'the exhibit is drawn', (s) => s.complete, 120);
    await page.click('[role=treeitem]:has(.name:text-is("LOAD"))');
    await page.click('.tools button >> nth=0');
    await until(page, 'it has an outline', (s) => s.outlined);
  },
  async flow(page) {
    await go(page, 'flow');
    await page.click('[role=treeitem]:has(.name:text-is("use"))');
  },
  async words(page) {
    await go(page, 'words');
  },
  async try(page) {
    await go(page, 'try');
    await page.keyboard.press('Control+Enter');
    const isWhole = () => {
      const seen = document.querySelector('iframe')?.contentWindow.mechane?.look();
      return seen?.complete && seen.things.length > 0;
    };
    await page.waitForFunction(isWhole, null, { timeout: 120_000 });
  },
  async help(page) {
    await go(page, 'scene');
    await page.keyboard.press('F1');
    await page.waitForSelector('.beside');
  },
};

mkdirSync(folder, { recursive: true });
for (const [language, locale] of Object.entries(kLocales)) {
  for (const colorScheme of ['light', 'dark']) {
    const fileOf = (part) => join(folder, `${part}-${language}-${colorScheme}.webp`);
    const wanted = Object.keys(kParts).filter((part) => !again || existsSync(fileOf(part)));
    if (wanted.length === 0) continue;
    const gateway = new StudioStandIn(app);
    const origin = await gateway.start();
    const { browser, page } = await openBrowser({ viewport: { width: 1280, height: 720 }, locale, colorScheme });
    const session = await page.context().newCDPSession(page);
    for (const [part, show] of Object.entries(kParts)) {
      if (!wanted.includes(part) && part !== 'scene') continue;
      await show(page, origin);
      await page.mouse.move(640, 700);
      await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
      const { data } = await session.send('Page.captureScreenshot', { format: 'webp', quality: kQuality });
      if (wanted.includes(part)) writeFileSync(fileOf(part), Buffer.from(data, 'base64'));
    }
    await browser.close();
    await gateway.stop();
  }
}
