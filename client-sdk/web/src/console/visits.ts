// What the gateway tells of visits, as the console uses it; and what its plots show, as plain numbers.

export interface TimeSpread {
  count: number;
  medianS: number;
  p90S: number;
}
export interface StepFigures {
  step: string;
  visits: number;
  done: number;
  timedOut: number;
  skipped: number;
  left: number;
  hints: number;
  time: TimeSpread;
}
export interface QuestionFigures {
  question: string;
  asked: string;
  answers: number;
  /** Scale: how many gave each mark, 1 first. Choice: empty. */
  atMark: number[];
  mean: number;
  satisfied: number;
  chose: Record<string, number>;
  judged: number;
  right: number;
}
export interface ActivityFigures {
  scenario: string;
  activity: string;
  visits: number;
  done: number;
  doneAlone: number;
  left: number;
  cut: number;
  running: number;
  mistakesAVisit: number;
  hints: number;
  time: TimeSpread;
  steps: StepFigures[];
  questions: QuestionFigures[];
}
export interface CountFigures {
  name: string;
  visits: number;
  done: number;
  doneAlone: number;
  left: number;
}
export interface DayFigures {
  day: string;
  visits: number;
  done: number;
}
export interface Remark {
  when: string;
  author: string;
  text: string;
  at: number | null;
}
export interface Visit {
  visit: string;
  began: string;
  kiosk: string;
  scenario: string;
  activity: string;
  language: string;
  ending: string;
  doneAlone: boolean;
  durationS: number;
  steps: { step: string; durationS: number; ending: string; hint: boolean }[];
  remarks: Remark[];
}
export interface VisitsFigures {
  days: number;
  visits: number;
  cut: boolean;
  exhibitNames: string[];
  languageNames: string[];
  satisfaction: { marks: number; satisfied: number };
  exhibits: CountFigures[];
  languages: CountFigures[];
  perDay: DayFigures[];
  activities: ActivityFigures[];
  recent: Visit[];
}
export interface PlaybackState {
  state: 'preparing' | 'ready' | 'failed';
  /** 0 to 1. */
  share: number;
  trouble: string;
  visit: Visit;
}
export interface VisitsQuery {
  days: number;
  exhibit: string;
  language: string;
}

type Fields = Record<string, unknown>;
const fields = (v: unknown): Fields => (typeof v === 'object' && v !== null ? (v as Fields) : {});
const list = (v: unknown): unknown[] => (Array.isArray(v) ? v : []);
const text = (v: unknown): string => (typeof v === 'string' ? v : '');
const number = (v: unknown): number => (typeof v === 'number' && Number.isFinite(v) ? v : 0);

function spreadOf(v: unknown): TimeSpread {
  const t = fields(v);
  return { count: number(t.count), medianS: number(t.medianS), p90S: number(t.p90S) };
}
function stepOf(v: unknown): StepFigures {
  const s = fields(v);
  return {
    step: text(s.step), visits: number(s.visits), done: number(s.done), timedOut: number(s.timedOut), skipped: number(s.skipped),
    left: number(s.left), hints: number(s.hints), time: spreadOf(s.time),
  };
}
function questionOf(v: unknown): QuestionFigures {
  const q = fields(v);
  return {
    question: text(q.question), asked: text(q.asked), answers: number(q.answers), atMark: list(q.atMark).map(number), mean: number(q.mean),
    satisfied: number(q.satisfied),
    chose: Object.fromEntries(Object.entries(fields(q.chose)).map(([name, count]) => [name, number(count)])),
    judged: number(q.judged), right: number(q.right),
  };
}
function activityOf(v: unknown): ActivityFigures {
  const a = fields(v);
  return {
    scenario: text(a.scenario), activity: text(a.activity), visits: number(a.visits), done: number(a.done), doneAlone: number(a.doneAlone),
    left: number(a.left), cut: number(a.cut), running: number(a.running), mistakesAVisit: number(a.mistakesAVisit), hints: number(a.hints),
    time: spreadOf(a.time), steps: list(a.steps).map(stepOf), questions: list(a.questions).map(questionOf),
  };
}
function countOf(v: unknown): CountFigures {
  const c = fields(v);
  return { name: text(c.name), visits: number(c.visits), done: number(c.done), doneAlone: number(c.doneAlone), left: number(c.left) };
}
export function remarksOf(v: unknown): Remark[] {
  return list(v).map(fields).map((r) => ({
    when: text(r.when), author: text(r.author), text: text(r.text), at: typeof r.at === 'number' ? r.at : null,
  }));
}
function visitOf(v: unknown): Visit {
  const r = fields(v);
  return {
    visit: text(r.visit), began: text(r.began), kiosk: text(r.kiosk), scenario: text(r.scenario), activity: text(r.activity),
    language: text(r.language), ending: text(r.ending), doneAlone: r.doneAlone === true, durationS: number(r.durationS),
    steps: list(r.steps).map(fields).map((s) => ({
      step: text(s.step), durationS: number(s.durationS), ending: text(s.ending), hint: s.hint === true,
    })),
    remarks: remarksOf(r.remarks),
  };
}

export function visitsOf(v: unknown): VisitsFigures {
  const all = fields(v);
  const names = (of: unknown): string[] => list(of).map(text).filter((name) => name !== '');
  const satisfaction = fields(all.satisfaction);
  return {
    days: number(all.days),
    visits: number(all.visits),
    cut: all.cut === true,
    exhibitNames: names(all.exhibitNames),
    languageNames: names(all.languageNames),
    satisfaction: { marks: number(satisfaction.marks), satisfied: number(satisfaction.satisfied) },
    exhibits: list(all.exhibits).map(countOf),
    languages: list(all.languages).map(countOf),
    perDay: list(all.perDay).map(fields).map((d) => ({ day: text(d.day), visits: number(d.visits), done: number(d.done) })),
    activities: list(all.activities).map(activityOf),
    recent: list(all.recent).map(visitOf),
  };
}

export function playbackOf(v: unknown): PlaybackState {
  const p = fields(v);
  const state = p.state === 'ready' || p.state === 'failed' ? p.state : 'preparing';
  return { state, share: number(p.share), trouble: text(p.trouble), visit: visitOf(p.visit) };
}

export function visitsAddress(path: string, query: VisitsQuery): string {
  const wanted = new URLSearchParams({ days: String(query.days) });
  if (query.exhibit) wanted.set('exhibit', query.exhibit);
  if (query.language) wanted.set('language', query.language);
  return `${path}?${wanted}`;
}

// Words

export const titled = (name: string): string => name.replaceAll('-', ' ').replace(/^./, (c) => c.toUpperCase());
/** "75 %", or "–" of nothing. */
export const percent = (part: number, all: number): string => (all > 0 ? `${Math.round((100 * part) / all)} %` : '–');
/** "8.4 s", "2 min 05 s". */
export function seconds(s: number): string {
  if (s < 59.95) return `${s.toFixed(1)} s`;
  const whole = Math.round(s);
  return `${Math.floor(whole / 60)} min ${String(whole % 60).padStart(2, '0')} s`;
}
/** A language by its own name: "Ελληνικά". */
export function languageName(code: string): string {
  if (!code) return 'unknown';
  try {
    return new Intl.DisplayNames([code], { type: 'language' }).of(code) ?? code;
  } catch {
    return code;
  }
}

// Plots

/** The first of 1, 2, 5, 10, 20, 50 ... that is not below a value: the end of an axis. */
export function axisEnd(most: number): number {
  if (!(most > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(most));
  return power * ([1, 2, 5].find((step) => step * power >= most * (1 - 1e-9)) ?? 10);
}

export interface TimeBar {
  step: string;
  count: number;
  medianS: number;
  p90S: number;
  /** Shares of the axis, 0 to 1. */
  median: number;
  p90: number;
}
/** The median of each step's time, and where nine of ten ended. */
export function timeBars(steps: readonly StepFigures[]): { end: number; bars: TimeBar[] } {
  const timed = steps.filter((s) => s.time.count > 0);
  const end = axisEnd(Math.max(0, ...timed.map((s) => s.time.p90S)));
  return { end, bars: timed.map(({ step, time }) => ({ step, ...time, median: time.medianS / end, p90: time.p90S / end })) };
}

export interface FunnelRow {
  step: string;
  reached: number;
  left: number;
  /** Shares of the step that most visits reached. */
  stayed: number;
  gone: number;
}
/** How many visits came to each step, and how many of them were left there. */
export function funnel(steps: readonly StepFigures[]): FunnelRow[] {
  const most = Math.max(1, ...steps.map((s) => s.visits));
  return steps.map((s) => {
    const left = Math.min(s.left, s.visits);
    return { step: s.step, reached: s.visits, left, stayed: (s.visits - left) / most, gone: left / most };
  });
}

export interface MarkColumn {
  mark: number;
  count: number;
  share: number;
  satisfied: boolean;
}
/** Satisfied is a mark above the middle of its scale, as in the report. */
export function markColumns(atMark: readonly number[]): MarkColumn[] {
  const most = Math.max(1, ...atMark);
  return atMark.map((count, i) => ({ mark: i + 1, count, share: count / most, satisfied: 2 * (i + 1) > atMark.length + 1 }));
}

export interface DayColumn {
  from: string;
  to: string;
  visits: number;
  done: number;
}
/** Days side by side in at most `most` columns: each a day, or the same number of days; the newest column is always a full one. */
export function dayColumns(days: readonly DayFigures[], most: number): DayColumn[] {
  const each = Math.max(1, Math.ceil(days.length / Math.max(1, most)));
  const columns: DayColumn[] = [];
  for (let end = days.length; end > 0; end -= each) {
    const part = days.slice(Math.max(0, end - each), end);
    const sum = (of: 'visits' | 'done'): number => part.reduce((total, day) => total + day[of], 0);
    columns.unshift({ from: part[0]!.day, to: part.at(-1)!.day, visits: sum('visits'), done: sum('done') });
  }
  return columns;
}
