// The gateway's text messages: checked, then kept in one state. The gateway sends each in full whenever it changes.

/** px py pz qx qy qz qw in W. */
export type PoseArray = [number, number, number, number, number, number, number];
export type Point = [number, number, number];
/** By language code. */
export type Texts = Record<string, string>;

export type LinkState = 'searching' | 'joined' | 'refused' | 'lost';

export interface Quantity {
  name: string;
  unit: string;
}
export interface World {
  world: string;
  scenario: string;
  activity: string;
  step: string;
  done: boolean;
  agents: string[];
  quantities: Quantity[];
  narration: Texts;
  audio: Texts;
  detail: string;
}
export interface SceneObject {
  index: number;
  name: string;
  uri: string;
  hash: string;
  node: string;
  pose: PoseArray;
  movable: boolean;
  title: Texts;
}
export interface View {
  name: string;
  pose: PoseArray;
  fov: number;
}
export interface Effect {
  name: string;
  kind: string;
  object?: number | null;
  node: string;
  p: Point;
  direction: Point;
  quantity: number;
  full: number;
  size: number;
  speed: number;
}
export interface Affordance {
  kind: 'taken' | 'turns' | 'slides' | 'placed' | 'brought';
  agent: string;
  object: number;
  base?: number | null;
  AJ: PoseArray;
  BJ: PoseArray;
}
export interface Presentation {
  world: string;
  activities: { name: string }[];
  views: View[];
  effects: Effect[];
  affordances: Affordance[];
}
export interface Button {
  action: string;
  text: string;
}
export interface Gauge {
  label: string;
  value: string;
  unit: string;
  fraction: number;
  begin: string;
  end: string;
  goal?: number | null;
}
export interface Notice {
  sign: 'take' | 'wear' | 'wait' | 'target' | 'warm' | 'unplugged';
  text: string;
  more: string;
}
export interface Panel {
  title: string;
  goal: string;
  text: string;
  more: string;
  answers: Button[];
  scale: boolean;
  low: string;
  high: string;
  leave: Button | null;
  asked: number;
  questions: number;
}
export interface HandPose {
  text: string;
  more: string;
  again: string;
  held: number;
  done: number;
  total: number;
  drawing: { from: [number, number]; to: [number, number]; radius: number; part: number }[];
}
export interface Overlay {
  language: string;
  languages: string[];
  title: string;
  caption: string;
  subtitle: string;
  hint: string;
  note: string;
  /** The museum's words to visitors. */
  message: string;
  goal: string;
  notice: Notice | null;
  steps: { done: number; total: number };
  gauges: Gauge[];
  buttons: Button[];
  panel: Panel | null;
  pose: HandPose | null;
  largeText: boolean;
  highContrast: boolean;
}
export interface PointerView {
  phase: 'resting' | 'reaching' | 'holding' | 'leaving';
  drag: 'carry' | 'turn' | 'slide';
  object: number;
  p: Point;
  goal?: Point | null;
  axle?: { p: Point; d: Point } | null;
  radius: number;
  link: 'none' | 'waiting' | 'joined' | 'refused';
  /** Further hands of this page, which work at the same time. */
  others: PointerView[];
}
/** What finds hands in a camera's pictures: a model that the gateway has, a program at this port of this machine (0: none). */
export interface HandFinders {
  model: boolean;
  program: number;
}
/** This page's hands in a headset or before a camera: right, left. */
export interface TrackedState {
  hands: { link: PointerView['link']; holding: boolean }[];
}
export interface WorldEvent {
  tick: number;
  kind: string;
  subject: string;
  object: string;
  value: number;
}

export interface KioskState {
  mayPoint: boolean;
  display: string;
  link: LinkState;
  refusal: string;
  world: World | null;
  objects: SceneObject[];
  presentation: Presentation | null;
  overlay: Overlay | null;
  pointer: PointerView | null;
  tracked: TrackedState | null;
  /** Null: the camera hand is off. */
  cameraHand: HandFinders | null;
  /** What a technician has set for this page, 0..1; 0: mute. */
  volume: number;
  /** Why the gateway ended the connection, with what to do. */
  bye: { reason: string; remedy: string } | null;
}

export const kNothingKnown: KioskState = {
  mayPoint: false,
  display: '',
  link: 'searching',
  refusal: '',
  world: null,
  objects: [],
  presentation: null,
  overlay: null,
  pointer: null,
  tracked: null,
  cameraHand: null,
  volume: 0.8,
  bye: null,
};

type Fields = Record<string, unknown>;

const isFields = (v: unknown): v is Fields => typeof v === 'object' && v !== null && !Array.isArray(v);
const text = (v: unknown): string => (typeof v === 'string' ? v : '');
const number = (v: unknown): number => (typeof v === 'number' && Number.isFinite(v) ? v : 0);
const list = (v: unknown): unknown[] => (Array.isArray(v) ? v : []);
const fields = (v: unknown): Fields => (isFields(v) ? v : {});
const texts = (v: unknown): Texts => Object.fromEntries(Object.entries(fields(v)).map(([k, t]) => [k, text(t)]));
const numbers = (v: unknown, count: number): number[] | null =>
  Array.isArray(v) && v.length === count && v.every((x) => typeof x === 'number' && Number.isFinite(x)) ? v : null;

const poseOf = (v: unknown): PoseArray => (numbers(v, 7) ?? [0, 0, 0, 0, 0, 0, 1]) as PoseArray;
const pointOf = (v: unknown): Point => (numbers(v, 3) ?? [0, 0, 0]) as Point;
const indexOf = (v: unknown): number | null => (typeof v === 'number' && Number.isInteger(v) && v >= 0 ? v : null);
const buttonOf = (v: unknown): Button => ({ action: text(fields(v).action), text: text(fields(v).text) });
const buttons = (v: unknown): Button[] => list(v).map(buttonOf).filter((b) => b.action !== '');

function worldOf(m: Fields): World {
  return {
    world: text(m.world),
    scenario: text(m.scenario),
    activity: text(m.activity),
    step: text(m.step),
    done: m.done === true,
    agents: list(m.agents).map(text),
    quantities: list(m.quantities).map((q) => ({ name: text(fields(q).name), unit: text(fields(q).unit) })),
    narration: texts(m.narration),
    audio: texts(m.audio),
    detail: text(m.detail),
  };
}

function objectOf(v: unknown): SceneObject {
  const o = fields(v);
  return {
    index: number(o.index),
    name: text(o.name),
    uri: text(o.uri),
    hash: text(o.hash),
    node: text(o.node),
    pose: poseOf(o.pose),
    movable: o.movable === true,
    title: texts(o.title),
  };
}

const kKinds = ['taken', 'turns', 'slides', 'placed', 'brought'];

function presentationOf(m: Fields): Presentation {
  return {
    world: text(m.world),
    activities: list(m.activities).map((a) => ({ name: text(fields(a).name) })),
    views: list(m.views).map(fields).map((v) => ({ name: text(v.name), pose: poseOf(v.pose), fov: number(v.fov) || Math.PI / 4 })),
    effects: list(m.effects).map(fields).map((e) => ({
      name: text(e.name),
      kind: text(e.kind),
      object: indexOf(e.object),
      node: text(e.node),
      p: pointOf(e.p),
      direction: pointOf(e.direction),
      quantity: indexOf(e.quantity) ?? Number.MAX_SAFE_INTEGER,
      full: number(e.full) || 1,
      size: number(e.size),
      speed: number(e.speed),
    })),
    affordances: list(m.affordances).map(fields).filter((a) => kKinds.includes(text(a.kind))).map((a) => ({
      kind: text(a.kind) as Affordance['kind'],
      agent: text(a.agent),
      object: number(a.object),
      base: indexOf(a.base),
      AJ: poseOf(a.AJ),
      BJ: poseOf(a.BJ),
    })),
  };
}

function panelOf(v: unknown): Panel | null {
  if (!isFields(v)) return null;
  return {
    title: text(v.title),
    goal: text(v.goal),
    text: text(v.text),
    more: text(v.more),
    answers: buttons(v.answers),
    scale: v.scale === true,
    low: text(v.low),
    high: text(v.high),
    leave: isFields(v.leave) ? buttonOf(v.leave) : null,
    asked: number(v.asked),
    questions: number(v.questions),
  };
}

function handPoseOf(v: unknown): HandPose | null {
  if (!isFields(v)) return null;
  const pair = (p: unknown): [number, number] => (numbers(p, 2) ?? [0, 0]) as [number, number];
  return {
    text: text(v.text),
    more: text(v.more),
    again: text(v.again),
    held: number(v.held),
    done: number(v.done),
    total: number(v.total),
    drawing: list(v.drawing).map(fields).map((s) => ({
      from: pair(s.from),
      to: pair(s.to),
      radius: number(s.radius),
      part: number(s.part),
    })),
  };
}

function gaugeOf(v: unknown): Gauge {
  const g = fields(v);
  return {
    label: text(g.label),
    value: text(g.value),
    unit: text(g.unit),
    fraction: Math.min(Math.max(number(g.fraction), 0), 1),
    begin: text(g.begin) || '0',
    end: text(g.end),
    goal: typeof g.goal === 'number' ? Math.min(Math.max(number(g.goal), 0), 1) : null,
  };
}

function overlayOf(m: Fields): Overlay {
  const notice = isFields(m.notice) ? m.notice : null;
  return {
    language: text(m.language) || 'en',
    languages: list(m.languages).map(text),
    title: text(m.title),
    caption: text(m.caption),
    subtitle: text(m.subtitle),
    hint: text(m.hint),
    note: text(m.note),
    message: text(m.message),
    goal: text(m.goal),
    notice: notice && { sign: text(notice.sign) as Notice['sign'], text: text(notice.text), more: text(notice.more) },
    steps: { done: number(fields(m.steps).done), total: number(fields(m.steps).total) },
    gauges: list(m.gauges).map(gaugeOf),
    buttons: buttons(m.buttons),
    panel: panelOf(m.panel),
    pose: handPoseOf(m.pose),
    largeText: m.largeText === true,
    highContrast: m.highContrast === true,
  };
}

function pointerOf(m: Fields): PointerView {
  const axle = isFields(m.axle) ? { p: pointOf(m.axle.p), d: pointOf(m.axle.d) } : null;
  return {
    phase: text(m.phase) as PointerView['phase'],
    drag: text(m.drag) as PointerView['drag'],
    object: number(m.object),
    p: pointOf(m.p),
    goal: numbers(m.goal, 3) as Point | null,
    axle,
    radius: number(m.radius),
    link: text(m.link) as PointerView['link'],
    others: list(m.others).filter(isFields).map(pointerOf),
  };
}

function findersOf(m: Fields): HandFinders | null {
  const found = { model: m.model === true, program: indexOf(m.program) ?? 0 };
  return found.model || found.program > 0 ? found : null;
}

function trackedOf(m: Fields): TrackedState {
  return { hands: list(m.hands).map(fields).map((h) => ({ link: text(h.link) as PointerView['link'], holding: h.holding === true })) };
}

/** A message as an object with a type; null: it is not one. */
export function parseMessage(json: string): (Fields & { type: string }) | null {
  try {
    const value: unknown = JSON.parse(json);
    return isFields(value) && typeof value.type === 'string' ? (value as Fields & { type: string }) : null;
  } catch {
    return null;
  }
}

export function eventOf(m: Fields): WorldEvent {
  return {
    tick: number(m.tick),
    kind: text(m.kind),
    subject: text(m.subject),
    object: text(m.object),
    value: number(m.value),
  };
}

/** What is known after a message. One of an unknown type changes nothing: a newer gateway may say more. */
export function reduce(state: KioskState, m: Fields & { type: string }): KioskState {
  switch (m.type) {
    case 'hello':
      return { ...state, mayPoint: m.mayPoint === true, display: text(m.display), cameraHand: findersOf(fields(m.cameraHand)), bye: null };
    case 'link': {
      const known = ['searching', 'joined', 'refused', 'lost'].includes(text(m.state));
      return known ? { ...state, link: text(m.state) as LinkState, refusal: text(m.refusal) } : state;
    }
    case 'world': {
      const world = worldOf(m);
      // Another world has other things in it: theirs follow.
      if (state.world && state.world.world !== world.world)
        return { ...state, world, pointer: null, presentation: state.presentation?.world === world.world ? state.presentation : null };
      return { ...state, world };
    }
    case 'scene':
      return { ...state, objects: list(m.objects).map(objectOf) };
    case 'presentation':
      return { ...state, presentation: presentationOf(m) };
    case 'overlay':
      return { ...state, overlay: overlayOf(m) };
    case 'tracked':
      return { ...state, tracked: trackedOf(m) };
    case 'pointer':
      return { ...state, pointer: pointerOf(m) };
    case 'settings':
      return { ...state, volume: m.mute === true ? 0 : Math.min(Math.max(number(m.volume), 0), 1) };
    case 'bye':
      return { ...state, bye: { reason: text(m.reason), remedy: text(m.remedy) } };
    default:
      return state;
  }
}

/** A text in a language, else in English, else in any. */
export function textIn(all: Texts, language: string): string {
  return all[language] ?? all.en ?? Object.values(all)[0] ?? '';
}
