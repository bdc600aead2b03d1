// crane.mjs ORIGIN PASSWORD NAME [FOLDER]: an author makes a crane at a real gateway by the studio's page alone, from an empty exhibit:
// parts, a joint, a rope, a quantity, words, a rule, a scripted visit. The draft is tried, its crank is turned with a finger until the step
// is over, and it is published. With FOLDER, pictures are written there.
import assert from 'node:assert/strict';
import { Finger, openBrowser, take, until } from './page.mjs';

const [origin, password, name, folder] = process.argv.slice(2);
const { browser, page, errors } = await openBrowser({ viewport: { width: 1100, height: 620 }, locale: 'en-GB' });
page.setDefaultTimeout(60_000);

const field = (id) => page.locator(`[data-field="${id}"]`);
const saved = () => page.waitForSelector('.saved:text-is("Saved")');
const go = (part) => page.click(`nav button:has-text("${part}")`);
const picture = (what) => folder && page.screenshot({ path: `${folder}/crane-${what}.png` });

/** Opens the group of the contents that it is in, where that is closed. */
async function choose(row) {
  await page.fill('input[type=search]', row);
  await page.click(`[role=treeitem]:not(.group):has(.name:text-is("${row}"))`);
  await page.fill('input[type=search]', '');
}
async function type(id, ...texts) {
  const cells = field(id).locator('input');
  for (const [i, text] of texts.entries()) await cells.nth(i).fill(String(text));
  await cells.nth(texts.length - 1).press('Enter');
  await saved();
}
/** Properties that are not written yet are added by the list under their form. */
async function add(id) {
  const at = id.lastIndexOf('/');
  await page.selectOption(`:is(.form, .forms):has(> [data-field^="${id.slice(0, at)}/"]) > select.adds`, id.slice(at + 1));
  await field(id).waitFor();
}
async function fill(id, ...texts) {
  if ((await field(id).count()) === 0) await add(id);
  await type(id, ...texts);
}
async function tick(id) {
  if ((await field(id).count()) === 0) await add(id);
  await field(id).locator('input[type=checkbox]').check();
  await saved();
}
async function pick(id, ...options) {
  if ((await field(id).count()) === 0) await add(id);
  for (const [i, option] of options.entries()) {
    await field(id).locator('select').nth(i).selectOption(option);
    await saved();
  }
}
async function insert(part, ...place) {
  await page.selectOption('select[aria-label="Insert a part"]', part);
  await page.click('.insert button');
  await until(page, `${part} is selected`, (s) => s.selection === `node:${part.toUpperCase()}`);
  await type(`${part.toUpperCase()}/position`, ...place);
}
async function addThing(kind, thing, what) {
  await page.click('button[aria-label="Add to the exhibit"]');
  await page.selectOption('dialog select >> nth=0', { label: kind });
  if (kind === 'Quantities') await page.fill('dialog input >> nth=0', what);
  else await page.selectOption('dialog select >> nth=1', what);
  await page.fill('dialog input >> nth=-1', thing);
  await page.click('dialog button.main');
  await page.waitForSelector('dialog', { state: 'detached' });
  await saved();
}

const parts = {
  async 'an author begins with nothing'() {
    await page.goto(`${origin}/studio`);
    await page.fill('input[autocomplete=username]', 'operator');
    await page.fill('input[type=password]', password);
    await page.click('form button');
    await page.selectOption('form.card select', 'template:empty');
    await page.fill('form.card input >> nth=0', 'The crane');
    await page.getByLabel('Its name').fill(name);
    await page.click('form.card button.main');
    await until(page, 'the exhibit is drawn', (s) => s.complete, 60);
  },
  async 'parts stand where they belong'() {
    await insert('post', 0.25, 1.25, -0.2);
    await insert('crank', 0.25, 1.15, 0);
    await insert('cylinder', -0.2, 1.6, -0.1);  // the pulley
    await type('CYLINDER/orientation', 90, 0, 0);
    await tick('CYLINDER/fixed');
    await insert('box', -0.26, 0.81, -0.1);
    await choose('BALL');
    await page.click('.inspector button:text-is("Delete")');
    await page.click('dialog button.main');
    await saved();
    await picture('parts');
  },
  async 'the crank turns at the post, and winds a rope over the pulley'() {
    await choose('CRANK');
    await page.click('.tools button:text-is("New joint")');
    await choose('POST');
    await page.fill('.inspector .wide input', '0.25 1.15 0');
    await page.fill('.inspector form label:has-text("Its name") input', 'AXLE');
    await page.click('.inspector button.main');
    await until(page, 'the joint is selected', (s) => s.selection === 'node:AXLE');
    await addThing('Agents', 'ROPE', 'geometry.rope');
    await pick('agents/ROPE/drum', 'AXLE');
    await fill('agents/ROPE/drumRadius', 0.06);
    await pick('agents/ROPE/bodies', 'CYLINDER', 'BOX');
    await fill('agents/ROPE/points', '0 0 0  0 0.06 0');
    await fill('agents/ROPE/radii', '0.06 0');
    await addThing('Agents', 'RATCHET', 'geometry.ratchet');
    await pick('agents/RATCHET/joint', 'AXLE');
    await fill('agents/RATCHET/teeth', 16);
    await picture('rope');
  },
  async 'a step waits until the load has been lifted, and says so in two languages'() {
    await addThing('Quantities', 'height', 'BOX.position.y');
    await choose('first');
    const trigger = 'activities/try/steps/first/trigger:1';
    await pick(`${trigger}/quantity`, 'height');
    await fill(`${trigger}/value`, 0.95);
    await go('Words');
    for (const [code, words] of [['el', 'Πιάστε τη λαβή και γυρίστε τη μανιβέλα.'], ['en', 'Take the handle and turn the crank.']]) {
      const caption = field(`activities/try/steps/first/text/caption.${code}`);
      await caption.fill(words);
      await caption.blur();
      await saved();
    }
    await go('Scene');
  },
  async 'a scripted visitor takes the crank and turns it'() {
    await choose('trying');
    await pick('visits/trying/move:1/body', 'CRANK');
    await fill('visits/trying/move:1/grip', '0 0.25 0.09');
    await pick('visits/trying/move:2/body', 'CRANK');
    await page.locator('.inspector select.adds', { has: page.locator('option[value="move:3"]') }).first().selectOption('move:3');
    await field('visits/trying/move:3/kind').waitFor();
    await pick('visits/trying/move:3/kind', 'turn');
    await pick('visits/trying/move:3/joint', 'AXLE');
    await fill('visits/trying/move:3/turns', 1.5);
    await page.waitForSelector('button:text-is("No problems")');
    await picture('visit');
  },
  async 'the crank is turned by a finger until the step is over'() {
    await page.setViewportSize({ width: 900, height: 480 });  // the processor draws
    await page.focus('.bar button:text-is("Commands")');
    await page.keyboard.press('Control+Enter');
    const kiosk = await (await page.waitForSelector('iframe', { timeout: 120_000 })).contentFrame();
    const isDone = () => kiosk.evaluate(() => window.mechane.look().state.world.done);
    await until(kiosk, 'the crane is to be seen', (s) => s.complete && s.state.link === 'joined' && s.things.length > 0, 120);
    assert.ok(!(await isDone()));
    const { x, y } = await page.locator('iframe').boundingBox();
    const finger = await Finger.on(page, { x, y });
    await take(kiosk, finger);
    await picture('tried');
    for (const end = Date.now() + 180_000; Date.now() < end && !(await isDone()); ) {
      const { to, phase } = await kiosk.evaluate(() => ({ to: window.mechane.ahead(1), phase: window.mechane.look().state.pointer?.phase }));
      if (to) await finger.move(to);
      else if (phase === 'resting') await finger.lift().then(() => take(kiosk, finger));  // a slow machine's finger lost it
    }
    assert.ok(await isDone(), 'the load was lifted');
    await finger.lift();
    await picture('lifted');
  },
  async 'what the author did is kept as a visit, and a visitor does it again'() {
    await page.click('aside nav button:text-is("Visits")');
    assert.match(await page.locator('.visits ol').innerText(), /take CRANK[^]*turn AXLE by [\d.]+ turns/);
    await page.check('.visits .tick input');
    await picture('shown');
    await page.click('.visits button:text-is("Keep it as a visit")');
    await page.waitForSelector('.visits p:has-text("has the visit shown")');
    await page.click('.visits button:text-is("Let a visitor do it")');
    await page.waitForSelector('.visits :text("It is being played")', { timeout: 120_000 });
    await page.waitForSelector('.visits :text("The visitor has")', { timeout: 240_000 });
    await picture('played');
    assert.match(await page.locator('.visits').innerText(), /shown: The visitor has done it/);
    await page.click('button:text-is("Stop it")');
  },
  async 'it is published'() {
    await page.click('.bar button:text-is("Publish")');
    await page.click('dialog .actions button.main');
    await page.waitForSelector('dialog p:has-text("It is published")');
  },
};

try {
  for (const [what, part] of Object.entries(parts)) {
    const began = Date.now();
    await part();
    console.log(`ok ${what} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
  }
  assert.deepEqual(errors.filter((e) => !/status of (401|404|409|422|503)/.test(e)), []);  // not signed in; half made; no server
} catch (error) {
  await picture('failed');
  console.error(await page.locator('body').innerText().catch(String));
  throw error;
} finally {
  await browser.close();
}
