// camera.mjs APP: a visitor's hand before a camera, in a real browser, against a stand-in of the gateway. The program that sees hands is
// ours; so are the hands. The browser's camera is Chromium's own test picture.
import assert from 'node:assert/strict';
import { boxesFile } from './boxes.mjs';
import { HandProgram } from './hand_program.mjs';
import { barriers, openBrowser, until } from './page.mjs';
import { StandIn } from './stand_in.mjs';

const gateway = new StandIn(process.argv[2], 'boxes', 'BOX', boxesFile([
  { name: 'BOX', p: [0, 1.2, 0], half: [0.15, 0.15, 0.15], grey: 0.7 },
  { name: 'WALL', p: [0, 0, -3], half: [6, 6, 0.1], grey: 0.2 },
]));
gateway.messages.find(({ type }) => type === 'presentation').activities = [];  // no ground
const hello = gateway.messages.find(({ type }) => type === 'hello');
const origin = await gateway.start();
const { browser, page, errors } = await openBrowser();

const program = new HandProgram();
const port = await program.start();

async function open(finders, query = '') {
  hello.cameraHand = finders;
  gateway.hands = [];
  await page.goto(`${origin}/kiosk/k?token=t${query}`);
  return until(page, 'the kiosk is there', (s) => s.complete && s.state.link === 'joined');
}
const camera = (what, wanted) => until(page, what, (s) => s.camera && wanted(s.camera)).then((s) => s.camera);
/** Where the last hand's wrist is in W. */
const wrist = () => [12, 16, 20].map((at) => gateway.hands.at(-1).readFloatLE(at));
async function picture(name) {
  if (process.env.MECHANE_PICTURES) await page.screenshot({ path: `${process.env.MECHANE_PICTURES}/${name}.png` });
}

const parts = {
  async 'without a model and a program it is off, and says so to whom asks for it'() {
    await open({ model: false, program: 0 });
    assert.equal(await page.getByText('Use your own hand').count(), 0);
    await open({ model: false, program: 0 }, '&hand=camera');
    await page.getByText('The camera hand is off here').waitFor();
  },
  async 'a program beside the browser sees a hand: it is in the world, follows, and is gone at the end'() {
    await open({ model: true, program: port });
    await page.getByText('Use your own hand').click();
    await camera('a hand is seen', (c) => c.state === 'seen' && c.sent > 20);
    const bytes = gateway.hands.at(-1);
    assert.deepEqual([...bytes.subarray(0, 7)], [2, 1, 1, 0, 0, 1, 1], 'a right, whole, tracked hand');
    assert.equal(bytes.length, 4 + 8 + 12 * 25);
    assert.deepEqual(await barriers(page), []);
    await picture('camera-hand');
    const before = wrist();
    assert.ok(Math.hypot(before[0], before[1] - 1.2, before[2]) < 0.3, `at the work: ${before}`);
    program.pose = { p: [-0.08, 0, 0.5], bent: 0.3 };
    const count = gateway.hands.length;
    await until(page, 'it goes on', (s) => s.camera.sent > count + 30);
    assert.ok(wrist()[0] > before[0] + 0.05, 'the visitor’s right is the right of the picture');
    await page.getByText('My hand is at the machine').click();
    await until(page, 'it is at the machine again', () => Math.abs(wrist()[0] - before[0]) < 0.02);
    await page.getByText('Stop').click();
    await until(page, 'it is gone', (s) => s.camera === null);
    assert.equal(gateway.hands.at(-1).length, 4, 'a farewell without hands');
  },
  async 'a program that is gone is said, and looked for; what cannot be read, too'() {
    await open({ model: false, program: port }, '&hand=camera');
    await camera('it began by itself', (c) => c.state === 'seen');
    await program.stop();
    await page.getByText('does not answer').waitFor();
    await picture('camera-no-program');
    program.message = () => '{"version":2}';
    await program.start(port);
    await page.getByText('Compare their versions').waitFor();
    delete program.message;
    await camera('it is read again', (c) => c.state === 'seen');
    program.message = () => Buffer.from([1, 2, 3]);
    await page.getByText('Compare their versions').waitFor();
    delete program.message;
    await camera('texts are read after bytes', (c) => c.state === 'seen');
    program.pose = null;
    await page.getByText('Show your hand to the camera').waitFor();
    await picture('camera-looking');
  },
  async 'a model that is missing, or is none, is said in Greek too; the camera is off again'() {
    await open({ model: true, program: 0 });
    await page.evaluate(() => {
      const ask = navigator.mediaDevices.getUserMedia.bind(navigator.mediaDevices);
      navigator.mediaDevices.getUserMedia = async (wanted) => (window.camera = await ask(wanted));
    });
    const isOff = () => page.evaluate(() => window.camera.getTracks().every((track) => track.readyState === 'ended'));
    await page.getByText('Use your own hand').click();
    await page.getByText('The gateway gives no model of hands').waitFor();
    assert.ok(await isOff());
    await page.getByText('Stop').click();
    gateway.handModel = Buffer.from('PK\x03\x04 this is no model');
    await page.getByText('Use your own hand').click();
    await page.getByText('does not work in this browser').waitFor({ timeout: 60_000 });
    assert.ok(await isOff());
    await picture('camera-bad-model');
    gateway.say({ ...gateway.messages.find(({ type }) => type === 'overlay'), language: 'el' });
    await page.getByText('δεν λειτουργεί σε αυτόν').waitFor();
  },
};

try {
  for (const [what, part] of Object.entries(parts)) {
    const began = Date.now();
    await part();
    console.log(`ok ${what} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
  }
  // Browsers report refused connections and the answers 401 and 404; the finder writes what it does as errors.
  assert.deepEqual(errors.filter((e) => !/WebSocket|status of 40[14]|^[IWE]\d{4} |TensorFlow|hand_landmarker|MediaPipe/.test(e)), []);
} finally {
  await browser.close();
  await gateway.stop();
  await program.stop();
}
