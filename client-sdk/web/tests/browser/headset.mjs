// A headset for a page: the emulation of iwer, which knows sessions, views, controllers and hands. Its hands are of its own making: no
// hand of a person was recorded.
import { createRequire } from 'node:module';

const kIwer = createRequire(import.meta.url).resolve('iwer/build/iwer.min.js');

/** Before the page is opened. */
export async function wearHeadset(page) {
  await page.addInitScript({ path: kIwer });
  await page.addInitScript(() => {
    const device = new window.IWER.XRDevice(window.IWER.metaQuest3);
    // Chromium has a WebXR of its own, without any headset.
    device.installRuntime({ forceInstall: true });
    device.position.set(0, 1.6, 0);
    device.stereoEnabled = true;
    window.headset = device;
  });
}

/** Presses the page's button, and waits until the world is placed. */
export async function enter(page) {
  await page.click('text=Enter headset');
  await page.waitForFunction(() => window.mechane.look().headset?.placed, undefined, { timeout: 60_000 });
}
