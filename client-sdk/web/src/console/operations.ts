// What operators order at the gateway: opening hours, messages, maintenance, changes that end; accounts and the log.
import { Api, ApiError, fields, list, number, text } from './api';

/** "10:00-18:00" by day; the server's own form. */
export interface Plan {
  week: Record<string, string[]>;
  exceptions: Record<string, string[]>;
}
export interface Hours {
  museum: Plan | null;
  kiosks: Record<string, Plan>;
  wake: Record<string, string>;
}
export interface Message {
  id: number;
  kiosks: string[];
  texts: Record<string, string>;
  until: number;
}
export interface Change {
  id: number;
  kiosk: string;
  name: string;
  value: string;
  until: number;
}
export interface KioskState {
  kiosk: string;
  open: boolean;
  sign: string;
  changesAt: number | null;
}
export interface Operations {
  zone: string;
  hours: Hours;
  messages: Message[];
  /** By kiosk: its end in seconds since 1970; null: by hand. */
  maintenance: Record<string, number | null>;
  changes: Change[];
  kiosks: KioskState[];
}
export interface Entry {
  time: string;
  user: string;
  address: string;
  action: string;
  detail: string;
}
/** When a change ends: after minutes, or at a time of the day; neither: it stays. */
export type End = { minutes: number } | { until: string } | Record<string, never>;

export const kDays = ['monday', 'tuesday', 'wednesday', 'thursday', 'friday', 'saturday', 'sunday'] as const;
/** As DisplaySettings::kMostMessage. */
export const kMostMessage = 240;
export const bytesOf = (words: string): number => new TextEncoder().encode(words).length;

const spans = (v: unknown): string[] => list(v).map(text).filter((span) => span !== '');
const byName = <T>(v: unknown, of: (one: unknown) => T): Record<string, T> =>
  Object.fromEntries(Object.entries(fields(v)).map(([name, one]) => [name, of(one)]));
const planOf = (v: unknown): Plan => {
  const plan = fields(v), week = fields(plan.week);
  return { week: Object.fromEntries(kDays.map((day) => [day, spans(week[day])])), exceptions: byName(plan.exceptions, spans) };
};
const endOf = (v: unknown): number | null => (typeof v === 'number' ? v : null);

export function operationsOf(v: unknown): Operations {
  const o = fields(v), hours = fields(o.hours);
  return {
    zone: text(o.zone),
    hours: {
      museum: hours.museum ? planOf(hours.museum) : null,
      kiosks: byName(hours.kiosks, planOf),
      wake: byName(hours.wake, text),
    },
    messages: list(o.messages).map(fields).map((m) => ({
      id: number(m.id), kiosks: list(m.kiosks).map(text), texts: byName(m.texts, text), until: number(m.until),
    })),
    maintenance: byName(o.maintenance, endOf),
    changes: list(o.changes).map(fields).map((c) => ({
      id: number(c.id), kiosk: text(c.kiosk), name: text(c.name), value: text(c.value), until: number(c.until),
    })),
    kiosks: list(o.kiosks).map(fields).map((k) => ({
      kiosk: text(k.kiosk), open: k.open !== false, sign: text(k.sign), changesAt: endOf(k.changesAt),
    })),
  };
}

const at = (kiosk: string, verb: string): string => `/api/kiosks/${encodeURIComponent(kiosk)}/${verb}`;

/** The requests of this file, over an operator's Api. */
export const orders = (api: Api) => ({
  get: async (): Promise<Operations> => operationsOf(await api.json('GET', '/api/operations')),
  putHours: (hours: Hours): Promise<unknown> => api.json('POST', '/api/hours', hours),
  say: (texts: Record<string, string>, kiosks: string[], end: End): Promise<unknown> =>
    api.json('POST', '/api/messages', { texts, kiosks, ...end }),
  unsay: (id: number): Promise<unknown> => api.json('POST', '/api/messages/remove', { id }),
  endChange: (id: number): Promise<unknown> => api.json('POST', '/api/changes/end', { id }),
  maintain: (kiosk: string, on: boolean, end: End = {}): Promise<unknown> => api.json('POST', at(kiosk, 'maintenance'), { on, ...end }),
  restart: (kiosk: string, display: string): Promise<unknown> => api.json('POST', at(kiosk, 'restart'), { display }),
  wake: (kiosk: string): Promise<unknown> => api.json('POST', at(kiosk, 'wake'), {}),
  accounts: async (): Promise<{ user: string; role: string }[]> =>
    list(fields(await api.json('GET', '/api/accounts')).accounts).map(fields).map((a) => ({ user: text(a.user), role: text(a.role) })),
  putAccount: (user: string, role: string, password: string): Promise<unknown> =>
    api.json('POST', '/api/accounts', { user, role, password }),
  removeAccount: (user: string): Promise<unknown> => api.json('POST', '/api/accounts/remove', { user }),
  log: async (): Promise<Entry[]> =>
    list(fields(await api.json('GET', '/api/audit')).entries).map(fields).map((e) => ({
      time: text(e.time), user: text(e.user), address: text(e.address), action: text(e.action), detail: text(e.detail),
    })),
  /** How many began in the last 24 hours; null where the gateway has no records. */
  visitsOfADay: async (): Promise<number | null> => {
    try {
      return number(fields(await api.json('GET', '/api/visits?days=1')).visits);
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return null;
      throw error;
    }
  },
});
export type Orders = ReturnType<typeof orders>;

/** "10:00-13:00, 17:00-20:00" as it is sent; what is wrong in it, the gateway says. */
export const hoursFrom = (written: string): string[] =>
  written.split(',').map((span) => span.replaceAll(' ', '').replaceAll('–', '-')).filter((span) => span !== '');

/** "18:30", with the date where it is not today. */
export function clock(seconds: number, now = new Date()): string {
  const then = new Date(seconds * 1000);
  const time = then.toLocaleTimeString(undefined, { hour: '2-digit', minute: '2-digit', hour12: false });
  return then.toDateString() === now.toDateString() ? time
    : `${then.toLocaleDateString(undefined, { day: 'numeric', month: 'short' })}, ${time}`;
}
