// What is wrong now, and what a technician does about it.
import type { DeviceInfo, DisplayInfo, KioskInfo, ServerInfo } from './api';

export interface Fault {
  where: string;
  what: string;
  remedy: string;
}

const kLateWake_us = 300;
const kPause_ms = 30;
const kFewPictures = 20;

class Faults {
  readonly all: Fault[] = [];
  constructor(private readonly where: string) {}
  add(what: string, remedy: string): void {
    this.all.push({ where: this.where, what, remedy });
  }
}

function faultsOfServer(server: ServerInfo): Fault[] {
  const faults = new Faults('Server');
  if (!server.reached) {
    faults.add('No server answers.',
      "Start one in the gateway's DDS domain, and open a kiosk once: the gateway hears a server through a kiosk in use.");
    return faults.all;
  }
  if (server.overload) faults.add(`${server.overload}.`, 'Until then forces come late, and clients lower them.');
  if (!server.recordsOk) faults.add('Visits are not being recorded.', "Make room on the server's disk, and look at its log.");
  if (!server.realtime) faults.add('The loop has no real-time priority.', "Run mechane doctor on the server's machine.");
  if (server.wakeUsP99 > kLateWake_us)
    faults.add(`The loop wakes up late: 1 of 100 times by ${Math.round(server.wakeUsP99)} µs or more.`,
      'Run mechane doctor: it names what disturbs the processor.');
  if (server.inputGapMs > kPause_ms)
    faults.add(`A hand paused for ${Math.round(server.inputGapMs)} ms, so that its force was lowered.`,
      'Check the network between the haptic program and the server.');
  return faults.all;
}

function faultsOfDisplay(kiosk: KioskInfo, display: DisplayInfo): Fault[] {
  const faults = new Faults(`${kiosk.kiosk}, ${display.display}`);
  if (display.link === 'refused') faults.add('The server refuses this display.', display.warning);
  else if (display.link !== 'joined')
    faults.add('The display has lost the server.', 'Check that the server runs, and the network of this machine.');
  if (display.missing.length > 0)
    faults.add(`Files are missing: ${display.missing.join(', ')}.`,
      "Visitors see boxes. Check the display's --assets, and that the files are there.");
  if (display.pictures > 0 && display.pictures < kFewPictures)
    faults.add(`Only ${Math.round(display.pictures)} pictures a second.`, 'Choose a lower quality, or close other programs there.');
  if (display.soundProblem && display.soundProblem !== 'muted' && !display.offscreen)
    faults.add(`Nothing is heard: ${display.soundProblem}.`, 'Check the loudspeaker, then restart the display.');
  if (display.warning && display.link !== 'refused') faults.add(display.warning, 'This is the last warning of its log.');
  return faults.all;
}

/** What a device's state means, and what is done about it; others are well, or nobody holds it. */
const kDeviceFaults: Record<string, [what: string, remedy: string]> = {
  'not-ready': ['The device is not ready.', 'Switch it on, or take it in the hand: the driver does not tell which.'],
  uncalibrated: ['The device is not calibrated.', "Move it into its rest position, as its maker's manual says."],
  warm: ['The device is warm: its force is lowered.', 'It recovers by itself. Where it comes again, lower the force of this kiosk.'],
  hot: ['The device is too hot for any force.', 'Let it cool for some minutes, and look at what visitors do with it.'],
  lost: ['The device is gone or faulty.', 'Check its cable and its power; mechane-devices tries it by hand.'],
};
const deviceName = (device: DeviceInfo): string => device.name || `device ${device.user + 1}`;
function faultsOfDevice(kiosk: KioskInfo, device: DeviceInfo): Fault[] {
  const fault = kDeviceFaults[device.state];
  return fault ? [{ where: `${kiosk.kiosk}, ${deviceName(device)}`, what: fault[0], remedy: fault[1] }] : [];
}
/** In a line: "Falcon: ready"; `health`: as of a display. */
export const deviceLine = (device: DeviceInfo): { name: string; words: string; health: 'good' | 'warn' | 'bad' } => ({
  name: deviceName(device),
  words: `${device.kind === 'glove' ? `${device.side} glove, ` : ''}${device.state.replace('-', ' ')}`,
  health: device.state === 'lost' || device.state === 'hot' ? 'bad' : kDeviceFaults[device.state] ? 'warn' : 'good',
});

export const faultsOf = (server: ServerInfo | null, kiosks: KioskInfo[]): Fault[] => [
  ...(server ? faultsOfServer(server) : []),
  ...kiosks.flatMap((kiosk) => [...kiosk.displays.flatMap((display) => faultsOfDisplay(kiosk, display)),
    ...kiosk.devices.flatMap((device) => faultsOfDevice(kiosk, device))]),
];
