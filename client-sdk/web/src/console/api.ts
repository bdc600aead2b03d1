// The gateway's JSON API, as the console uses it. An error is a sentence: what happened, and what to do.

import { devicesOf, type AskedDevice, type DeviceOrder } from './devices';
import { playbackOf, remarksOf, visitsAddress, visitsOf } from './visits';
import type { PlaybackState, Remark, VisitsFigures, VisitsQuery } from './visits';

export interface User {
  user: string;
  role: string;
  csrf: string;
}
export interface DisplayInfo {
  display: string;
  host: string;
  link: string;
  scenario: string;
  pictures: number;
  width: number;
  height: number;
  missing: string[];
  warning: string;
  uptime: number;
  offscreen: boolean;
  soundProblem: string;
  settings: Record<string, string>;
}
export interface KioskInfo {
  kiosk: string;
  scenario: string;
  address: string;
  displays: DisplayInfo[];
  devices: DeviceInfo[];
}
/** A haptic device at a kiosk. */
export interface DeviceInfo {
  user: number;
  /** Maker and model. */
  name: string;
  state: string;
  /** 'glove' or 'one-point'. */
  kind: string;
  side: string;
}
export interface ServerInfo {
  reached: boolean;
  server: string;
  version: string;
  worlds: number;
  limit: number;
  users: number;
  overruns: number;
  tickUsP99: number;
  wakeUsP99: number;
  lateWakeups: number;
  inputGaps: number;
  inputGapMs: number;
  realtime: boolean;
  recordsOk: boolean;
  overload: string;
  scenarios: string[];
}

export type Fields = Record<string, unknown>;
export const fields = (v: unknown): Fields => (typeof v === 'object' && v !== null ? (v as Fields) : {});
export const list = (v: unknown): unknown[] => (Array.isArray(v) ? v : []);
export const text = (v: unknown): string => (typeof v === 'string' ? v : '');
export const number = (v: unknown): number => (typeof v === 'number' && Number.isFinite(v) ? v : 0);

/** The gateway's words as a sentence. */
export const sentence = (words: string): string =>
  words ? `${words[0]!.toUpperCase()}${words.slice(1)}${/[.!?…]$/.test(words) ? '' : '.'}` : '';

export class ApiError extends Error {
  /** `place`: the file and the line, where the gateway told of one. */
  constructor(
    readonly status: number,
    what: string,
    readonly remedy: string,
    readonly place = '',
  ) {
    super(what);
  }
  /** What happened, where, and what to do. */
  get told(): string {
    return [sentence(this.message), this.place && `Where: ${this.place}.`, sentence(this.remedy)].filter((part) => part !== '').join(' ');
  }
}

export class Api {
  user: User | null = null;

  constructor(private readonly ask: typeof fetch = (...args) => fetch(...args)) {}

  async whoAmI(): Promise<User | null> {
    try {
      this.user = (await this.json('GET', '/api/me')) as User;
    } catch (error) {
      if (!(error instanceof ApiError) || (error.status !== 401 && error.status !== 403)) throw error;
      this.user = null;
    }
    return this.user;
  }
  async signIn(user: string, password: string): Promise<User> {
    this.user = (await this.json('POST', '/api/sign-in', { user, password })) as User;
    return this.user;
  }
  async signOut(): Promise<void> {
    await this.json('POST', '/api/sign-out', {});
    this.user = null;
  }
  async server(): Promise<ServerInfo> {
    return serverOf(fields(await this.json('GET', '/api/server')).server);
  }
  async kiosks(): Promise<KioskInfo[]> {
    return list(fields(await this.json('GET', '/api/kiosks')).kiosks).map(kioskOf);
  }
  /** `end`: see operations.ts. */
  async open(kiosk: string, scenario: string, end: object = {}): Promise<void> {
    await this.json('POST', `/api/kiosks/${encodeURIComponent(kiosk)}/open`, { scenario, ...end });
  }
  async set(kiosk: string, display: string, settings: Record<string, string>, end: object = {}): Promise<void> {
    const said = fields(await this.json('POST', `/api/kiosks/${encodeURIComponent(kiosk)}/settings`, { display, settings, ...end }));
    const refused = list(said.answers).map(fields).find((answer) => text(answer.refusal) !== '');
    if (refused) throw new ApiError(409, `${text(refused.display)}: ${text(refused.refusal)}.`, '');
  }
  async devices(kiosk: string): Promise<AskedDevice[]> {
    return devicesOf(await this.json('GET', `/api/kiosks/${encodeURIComponent(kiosk)}/devices`));
  }
  async askDevice(kiosk: string, order: DeviceOrder): Promise<AskedDevice[]> {
    return devicesOf(await this.json('POST', `/api/kiosks/${encodeURIComponent(kiosk)}/device`, order));
  }
  async picture(kiosk: string, display: string): Promise<Blob> {
    return (await this.send('POST', `/api/kiosks/${encodeURIComponent(kiosk)}/picture`, { display })).blob();
  }
  async visits(query: VisitsQuery): Promise<VisitsFigures> {
    return visitsOf(await this.json('GET', visitsAddress('/api/visits', query)));
  }
  /** All remarks of the visit. `at`: seconds since it began, or null. */
  async remark(visit: string, text: string, at: number | null): Promise<Remark[]> {
    const said = await this.json('POST', `/api/visits/${encodeURIComponent(visit)}/remarks`, at === null ? { text } : { text, at });
    return remarksOf(fields(said).remarks);
  }
  /** Begins to prepare a visit's playback, or tells how far it is. */
  async playback(visit: string, begin: boolean): Promise<PlaybackState> {
    const address = `/api/visits/${encodeURIComponent(visit)}/playback`;
    return playbackOf(await (begin ? this.json('POST', address, {}) : this.json('GET', address)));
  }
  async tape(visit: string): Promise<ArrayBuffer> {
    return (await this.send('GET', `/api/visits/${encodeURIComponent(visit)}/tape`)).arrayBuffer();
  }

  async file(path: string): Promise<Blob> {
    return (await this.send('GET', path)).blob();
  }

  /** A Blob is sent as the bytes that it is. */
  async json(method: string, path: string, body?: object): Promise<unknown> {
    const answer = await this.send(method, path, body);
    return answer.status === 204 ? {} : answer.json();
  }
  private async send(method: string, path: string, body?: object): Promise<Response> {
    const bytes = body instanceof Blob;
    const headers: Record<string, string> = body ? { 'Content-Type': bytes ? 'application/octet-stream' : 'application/json' } : {};
    if (this.user && method === 'POST') headers['X-Mechane-CSRF'] = this.user.csrf;
    let answer: Response;
    try {
      answer = await this.ask(path, { method, headers, ...(body && { body: bytes ? body : JSON.stringify(body) }) });
    } catch {
      throw new ApiError(0, 'The gateway does not answer.', 'Look whether it runs and whether this device has a network.');
    }
    if (answer.ok) return answer;
    const said = fields(await answer.json().catch(() => ({})));
    if (answer.status === 401) this.user = null;
    throw new ApiError(answer.status, text(said.error) || `The gateway answered ${answer.status}.`, text(said.remedy), text(said.place));
  }
}

export function serverOf(v: unknown): ServerInfo {
  const s = fields(v);
  return {
    reached: text(s.server) !== '',
    server: text(s.server),
    version: text(s.version),
    worlds: number(s.worlds),
    limit: number(s.worldsLimit),
    users: number(s.users),
    overruns: number(s.overruns),
    tickUsP99: number(fields(s.tickUs).p99),
    wakeUsP99: number(fields(s.wakeUs).p99),
    lateWakeups: number(s.lateWakeups),
    inputGaps: number(s.inputGaps),
    inputGapMs: number(s.inputGapMs),
    realtime: s.realtime === true,
    recordsOk: s.recordsOk !== false,
    overload: text(s.overload),
    scenarios: list(s.scenarios).map(text).filter((name) => name !== ''),
  };
}

/** The client's link states by number. */
const kLinks = ['searching', 'joined', 'refused', 'lost'];

function displayOf(v: unknown): DisplayInfo {
  const d = fields(v);
  return {
    display: text(d.display),
    host: text(d.host),
    link: kLinks[number(d.link)] ?? '',
    scenario: text(d.scenario),
    pictures: number(d.picturesPerS),
    width: number(d.width),
    height: number(d.height),
    missing: list(d.missing).map(text),
    warning: text(d.refusal) || text(d.lastWarning),
    uptime: number(d.uptime),
    offscreen: d.offscreen === true,
    soundProblem: text(d.soundProblem),
    settings: Object.fromEntries(Object.entries(fields(d.settings)).map(([name, value]) => [name, text(value)])),
  };
}

export function deviceOf(v: unknown): DeviceInfo {
  const d = fields(v);
  return { user: number(d.user), name: text(d.name), state: text(d.state), kind: text(d.kind), side: text(d.side) };
}
export function kioskOf(v: unknown): KioskInfo {
  const k = fields(v);
  return { kiosk: text(k.kiosk), scenario: text(k.scenario), address: text(k.address), displays: list(k.displays).map(displayOf),
    devices: list(k.devices).map(deviceOf) };
}
