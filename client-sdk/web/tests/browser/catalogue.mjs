// catalogue.mjs ORIGIN PASSWORD MESH [FOLDER]: at a real gateway with the drafts "first" and "second", a mesh is brought into the first and
// told of, found from the second by Greek words and by a tag, and taken; and it is not deleted while the second names it. With FOLDER,
// pictures are written there.
import assert from 'node:assert/strict';
import { barriers, openBrowser } from './page.mjs';

const [origin, password, mesh, folder] = process.argv.slice(2);
const { browser, page, errors } = await openBrowser({ viewport: { width: 1100, height: 760 }, locale: 'el-GR' });
page.setDefaultTimeout(60_000);

const card = (name) => `[data-item="${name}"]`;
const shown = () => page.$$eval('[data-item]', (items) => items.map((item) => item.dataset.item));
const search = (text) => page.fill('.catalogue input[type=search]', text);
const choose = (filter, value) => page.selectOption(`.catalogue label:has-text("${filter}") select`, value);
const only = (...names) => page.waitForFunction((wanted) => JSON.stringify([...document.querySelectorAll('[data-item]')]
  .map((item) => item.dataset.item)) === wanted, JSON.stringify(names));
async function look(what) {
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme });
    assert.deepEqual(await barriers(page), [], `${what}, ${colorScheme}`);
    if (folder) await page.screenshot({ path: `${folder}/catalogue-${what}-${colorScheme}.png` });
  }
}
async function openFiles(name) {
  await page.goto(`${origin}/studio/${name}`);
  await page.click('nav button[data-part=files]');
}

const parts = {
  async 'a mesh is brought in and told of'() {
    await page.goto(`${origin}/studio/first`);
    await page.fill('input[autocomplete=username]', 'operator');
    await page.fill('input[type=password]', password);
    await page.click('form button');
    await page.click('nav button[data-part=files]');
    await page.setInputFiles('input[type=file]', mesh);
    await page.waitForSelector('li:has-text("gear.obj")');
    await page.click('button:text-is("Από τον κατάλογο")');
    await page.click(`${card('first/files/gear.obj')} button:has-text("Τι είναι")`);
    await page.fill('dialog textarea', 'Ένα ξύλινο γρανάζι από τον Ἥρωνα');
    await page.fill('dialog label:has-text("Άδεια") input', 'CC-BY-4.0');
    await page.fill('dialog label:has-text("Ετικέτες") input', 'ξύλο,  gear , ξύλο');
    await look('about');
    await page.keyboard.press('Enter');
    await page.waitForSelector(`${card('first/files/gear.obj')}:has-text("CC-BY-4.0"):has-text("gear")`);
  },
  async 'another draft finds it by Greek words and by its tag, and takes it'() {
    await openFiles('second');
    await page.click('button:text-is("Από τον κατάλογο")');
    await page.waitForSelector(card('first/files/gear.obj'));
    assert.ok((await shown()).includes('crank'), 'the library is in it');
    await search('ΗΡΩΝΑ γραναζι');
    await only('first/files/gear.obj');
    await search('καμία τέτοια λέξη');
    await page.waitForSelector('.none');
    await look('nothing');
    await page.click('button:text-is("Εμφάνιση όλων")');
    assert.equal(await page.evaluate(() => document.activeElement.type), 'search');
    await page.waitForSelector(card('crank'));
    await choose('Ετικέτα', 'ξύλο');
    await only('first/files/gear.obj');
    await page.click(`${card('first/files/gear.obj')} summary`);
    await page.waitForSelector(`${card('first/files/gear.obj')} li:has-text("second (σχέδιο)")`);
    await look('found');
    await page.focus(`${card('first/files/gear.obj')} button.main`);
    await page.keyboard.press('Enter');
    await only('first/files/gear.obj', 'second/files/gear.obj');
    await choose('Άδεια', '-');
    await page.waitForSelector('.none');
    await page.click('button:has-text("Αρχεία αυτού του σχεδίου")');
    await page.waitForSelector('li:has-text("gear.obj")');
  },
  async 'it is not deleted while another exhibit names it, and who does is said'() {
    await openFiles('first');
    await page.selectOption('header select', 'en');
    await page.click('button[aria-label="Delete: gear.obj"]');
    await page.waitForSelector('dialog:has-text("gear.obj is used") li:has-text("second (draft): ")');
    assert.match(await page.textContent('dialog li'), /line \d+/);
    await look('used');
    await page.keyboard.press('Escape');
  },
  async 'the first page has the catalogue, on a phone, too'() {
    await page.goto(`${origin}/studio`);
    await page.waitForSelector('h3');
    await look('exhibits');
    await page.click('nav a[href="#catalogue"]');
    await page.selectOption('header select', 'en');
    await page.waitForSelector(card('first/files/gear.obj'));
    await look('english');
    await choose('Kind', 'draft');
    await only('first/first.x3d', 'second/second.x3d');
    await page.click(`${card('first/first.x3d')} button:has-text("What it is")`);
    await page.fill('dialog label:has-text("Licence") input', 'CC0-1.0');
    await page.click('dialog button.main');
    await page.waitForSelector(`${card('first/first.x3d')}:has-text("CC0-1.0")`);
    await page.setViewportSize({ width: 390, height: 800 });
    await choose('Kind', '');
    await page.waitForSelector(card('first/files/gear.obj'));
    await look('phone');
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing is beside the phone');
    await page.keyboard.press('F1');
    await page.waitForSelector('.beside h2:has-text("Catalogue"), .beside :text-is("Catalogue")');
    await page.keyboard.press('F1');
    await choose('Kind', 'template');
    await page.click('button[aria-label="Begin from it: crank-and-rope"]');
    assert.equal(await page.inputValue('form.card select'), 'template:crank-and-rope');
  },
};

try {
  for (const [what, part] of Object.entries(parts)) {
    await part().catch((error) => {
      throw new Error(what, { cause: error });
    });
    console.log(`ok ${what}`);
  }
  // The sign-in is asked for; and nobody can draw a draft whose mesh is not there yet.
  assert.deepEqual(errors.filter((e) => !/status of 4(01|22)/.test(e)), []);
} finally {
  if (folder) await page.screenshot({ path: `${folder}/catalogue-last.png` });
  await browser.close();
}
