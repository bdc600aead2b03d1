// finger.mjs ADDRESS [WIDTHxHEIGHT]: a page of a kiosk, and a finger on its glass, for a program that says what to do. One JSON object a
// line comes in ({do: "press", at: {x, y}}, "move", "lift", "button", "look", "picture"), one goes out for each.
import { createInterface } from 'node:readline';
import { Finger, look, openBrowser, until } from './page.mjs';

const [address, size = '480x360'] = process.argv.slice(2);
const [width, height] = size.split('x').map(Number);
const { browser, page, errors } = await openBrowser({ viewport: { width, height } });
const doings = {
  press: ({ at }) => finger.press(at),
  move: ({ at }) => finger.move(at),
  lift: () => finger.lift(),
  /** Presses a button of the page by its words, if it is there. */
  async button({ text }) {
    const found = page.getByRole('button', { name: text, exact: true });
    const there = (await found.count()) > 0;
    if (there) await found.first().click();
    return { there };
  },
  async look() {
    const { state, view, complete, online, picturesPerS, missing } = await look(page);
    return { view, complete, online, picturesPerS, missing, pointer: state.pointer, panel: state.overlay?.panel ?? null, errors };
  },
  picture: ({ file }) => page.screenshot({ path: file }),
};
let finger;
try {
  await page.goto(address);
  await until(page, 'the exhibit is shown', (s) => s.complete && s.online && s.state.link === 'joined' && s.sequence > 0, 120);
  finger = await Finger.on(page);
  console.log('{"ready":true}');
  for await (const line of createInterface({ input: process.stdin })) {
    const message = JSON.parse(line);
    const answer = await doings[message.do](message);
    console.log(JSON.stringify(message.do === 'look' || message.do === 'button' ? answer : {}));
  }
} finally {
  await browser.close();
}
