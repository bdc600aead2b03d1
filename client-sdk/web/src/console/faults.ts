// What is wrong now, and what a technician does about it.
import type { KioskInfo, ServerInfo } from './api';

export interface Fault {
  where: string;
  what: string;
  remedy: string;
}

const kLateWake_us = 300;
const kPause_ms = 30;
const kFewPictures = 20;

function faultsOfServer(server: ServerInfo): Fault[] {
  const where = 'Server';
  if (!server.reached)
    return [{ where, what: 'No server answers.', remedy: 'Start one in the gateway\'s DDS domain, and open a kiosk once: the gateway hears a server through a kiosk in use.' }];
  const all: Fault[] = [];
  if (server.overload) all.push({ where, what: `${server.overload}.`, remedy: 'Until then forces come late, and clients lower them.' });
  if (!server.recordsOk) all.push({ where, what: 'Visits are not being recorded.', remedy: 'Make room on the server\'s disk, and look at its log.' });
  if (!server.realtime) all.push({ where, what: 'The loop has no real-time priority.', remedy: 'Run mechane doctor on the server\'s machine.' });
  if (server.wakeUsP99 > kLateWake_us)
    all.push({ where, what: `The loop wakes up late: 1 of 100 times by ${Math.round(server.wakeUsP99)} µs or more.`, remedy: 'Run mechane doctor: it names what disturbs the processor.' });
  if (server.inputGapMs > kPause_ms)
    all.push({ where, what: `A hand paused for ${Math.round(server.inputGapMs)} ms, so that its force was lowered.`, remedy: 'Check the network between the haptic program and the server.' });
  return all;
}

function faultsOfKiosk(kiosk: KioskInfo): Fault[] {
  const all: Fault[] = [];
  for (const display of kiosk.displays) {
    const where = `${kiosk.kiosk}, ${display.display}`;
    if (display.link === 'refused') all.push({ where, what: 'The server refuses this display.', remedy: display.warning });
    else if (display.link !== 'joined') all.push({ where, what: 'The display has lost the server.', remedy: 'Check that the server runs, and the network of this machine.' });
    if (display.missing.length > 0) all.push({ where, what: `Files are missing: ${display.missing.join(', ')}.`, remedy: 'Visitors see boxes. Check the display\'s --assets, and that the files are there.' });
    if (display.pictures > 0 && display.pictures < kFewPictures)
      all.push({ where, what: `Only ${Math.round(display.pictures)} pictures a second.`, remedy: 'Choose a lower quality, or close other programs there.' });
    if (display.soundProblem && display.soundProblem !== 'muted' && !display.offscreen)
      all.push({ where, what: `Nothing is heard: ${display.soundProblem}.`, remedy: 'Check the loudspeaker, then restart the display.' });
    if (display.warning && display.link !== 'refused') all.push({ where, what: display.warning, remedy: 'This is the last warning of its log.' });
  }
  return all;
}

export const faultsOf = (server: ServerInfo | null, kiosks: KioskInfo[]): Fault[] => [
  ...(server ? faultsOfServer(server) : []),
  ...kiosks.flatMap(faultsOfKiosk),
];
