import { openBrowser, until } from './page.mjs';
import { existsSync } from 'node:fs';
const [origin, password, state, ...names] = process.argv.slice(2);
const { browser, page } = await openBrowser({ viewport: { width: 1500, height: 800 }, locale: 'en-GB' });
await page.goto(`${origin}/studio`);
await page.fill('input[autocomplete=username]', 'operator');
await page.fill('input[type=password]', password);
await page.click('form button');
await page.waitForSelector('h3');
for (const name of names) {
  const [draft, from] = name.split('=');
  const said = await page.evaluate(async ([draft, from]) => {
    const me = await (await fetch('/api/me')).json();
    const r = await fetch('/api/studio/drafts', { method: 'POST', headers: { 'content-type': 'application/json', 'x-csrf-token': me.csrf, 'x-mechane-csrf': me.csrf }, body: JSON.stringify({ name: draft, from }) });
    return [r.status, (await r.text()).slice(0, 200)];
  }, [draft, from]);
  if (said[0] !== 200) console.log(draft, said);
  const began = Date.now();
  await page.goto(`${origin}/studio/${draft}`);
  await until(page, 'drawn', (s) => s.complete, 300);
  const file = `${state}/studio/${draft}/picture.webp`;
  for (let i = 0; i < 100 && !existsSync(file); ++i) await page.waitForTimeout(200);
  console.log(draft, existsSync(file), Date.now() - began);
}
await browser.close();
