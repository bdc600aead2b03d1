// A draft that runs in a world of its own: what the gateway tells of it, read from its JSON, whatever is missing.
import { fields, list, number, text } from '../../console/api';
import type { Texts } from '../../wire/messages';
import { textsOf } from '../view';
import { askedDeviceOf, type AskedDevice } from '../../console/devices';

export type PreviewState = 'none' | 'starting' | 'running' | 'failed';
export interface StillReason {
  kind: string;
  text: Texts;
  remedy: Texts;
  /** Of the field that decides it; "": there is none. */
  path: string;
}
/** A body that does not move now, and why. */
export interface Still {
  def: string;
  reasons: StillReason[];
}
/** A scripted visitor in the world that runs. */
export interface Played {
  /** "": there was none. */
  name: string;
  state: 'playing' | 'done' | 'incomplete' | 'failed';
  moves: { name: string; ok: boolean; reason: string }[];
  /** Why it is not done; or, where it has failed, the last lines that it said. */
  reason: string;
}
export interface Kept {
  /** -1: nothing does. */
  revision: number;
  by: KeptBy;
  /** Of the step or the body; "": several. */
  name: string;
}
export type KeptBy = (typeof kKeptBy)[number];
export interface Preview {
  state: PreviewState;
  /** Of the draft, as it runs. */
  revision: number;
  /** What keeps the world from going on as a newer draft. */
  kept: Kept;
  /** The step that it began at, "use/lift"; "": where the exhibit begins. */
  begins: string;
  /** World time by real time: 0 is paused, 1 is real time. */
  pace: number;
  /** The kiosk's page, and its socket. */
  address: string;
  socket: string;
  /** The last lines of its log. */
  said: string[];
  activity: string;
  step: string;
  still: Still[];
  /** Of its kiosk: haptic ones, and what starts another one there. */
  devices: AskedDevice[];
  kiosk: string;
  domain: number;
  visit: Played;
}
/** What is asked of one that runs: how fast, or, while it is paused, so many ticks of 1 ms. */
export type Pacing = { pace: number } | { ticks: number };

const kKeptBy = ['steps', 'bodies', 'body', 'start', 'failed'] as const;
const kStates: readonly string[] = ['starting', 'running', 'failed'];
const stillOf = (v: unknown): Still => {
  const s = fields(v);
  const reasons = list(s.reasons).map(fields).map((r) => (
    { kind: text(r.kind), text: textsOf(r.text), remedy: textsOf(r.remedy), path: text(r.path) }));
  return { def: text(s.def), reasons };
};

const kPlayed: readonly string[] = ['playing', 'done', 'incomplete'];
function playedOf(v: unknown): Played {
  const p = fields(v);
  return {
    name: text(p.name),
    state: kPlayed.includes(text(p.state)) ? (p.state as Played['state']) : 'failed',
    moves: list(p.moves).map(fields).map((m) => ({ name: text(m.name), ok: m.ok === true, reason: text(m.reason) })),
    reason: text(p.reason),
  };
}

function keptOf(v: unknown): Kept {
  const k = fields(v);
  const [kind = '', ...name] = text(k.by).split(' ');
  return { revision: typeof k.revision === 'number' ? k.revision : -1, by: kKeptBy.find((by) => by === kind) ?? 'failed', name: name.join(' ') };
}

export function previewOf(v: unknown): Preview {
  const p = fields(v);
  return {
    state: kStates.includes(text(p.state)) ? (p.state as PreviewState) : 'none',
    revision: number(p.revision),
    kept: keptOf(p.kept),
    begins: text(p.begins),
    pace: typeof p.pace === 'number' ? number(p.pace) : 1,
    address: text(p.address),
    socket: text(p.socket),
    said: list(p.said).map(text),
    activity: text(p.activity),
    step: text(p.step),
    still: list(p.still).map(stillOf),
    devices: list(p.devices).map(askedDeviceOf),
    kiosk: text(p.kiosk),
    domain: number(p.domain),
    visit: playedOf(p.visit),
  };
}
