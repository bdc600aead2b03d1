// What the console knows of the server's exhibits, and the orders that were given. It outlasts the page's part: a load takes minutes.
import { Action } from './action.svelte';
import { ApiError, type Api } from './api';
import { exhibitsOf, orderDone, type Exhibits, type ExhibitVerb } from './exhibits';

export class ExhibitDesk {
  known = $state.raw<Exhibits | null>(null);
  trouble = $state('');
  /** For how long this console has seen the server prepare what it prepares now, seconds. */
  preparing_s = $state(0);
  /** By exhibit: one order at a time, and what came of it. */
  actions = $state.raw<Record<string, Action>>({});
  private since = 0;

  constructor(private readonly api: Api) {}

  async look(): Promise<void> {
    try {
      this.take(exhibitsOf(await this.api.json('GET', '/api/exhibits')));
      this.trouble = '';
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.trouble = error.told;
    }
  }
  /** `now`: visits in progress end. */
  async order(name: string, verb: ExhibitVerb, now = false): Promise<void> {
    const action = (this.actions[name] ??= new Action(() => this.look()));
    this.actions = { ...this.actions };
    const before = this.hashOf(name);
    const path = `/api/exhibits/${encodeURIComponent(name)}/${verb}`;
    if (await action.run('', () => this.api.json('POST', path, { now })))
      action.said = orderDone(verb, now, this.hashOf(name) !== before);
  }
  /** Exhibits that the server does not have: those that can be loaded, and those of which something is to be said. */
  others(): string[] {
    const { loadable, exhibits, preparing } = this.known ?? { loadable: [], exhibits: [], preparing: '' };
    const told = Object.keys(this.actions).filter((name) => this.actions[name]!.busy || this.actions[name]!.said !== '');
    const names = new Set([...loadable, ...told, ...(preparing ? [preparing] : [])]);
    for (const { id } of exhibits) names.delete(id);
    return [...names].sort();
  }

  private hashOf(name: string): string {
    return this.known?.exhibits.find((one) => one.id === name)?.contentHash ?? '';
  }
  private take(known: Exhibits): void {
    const now = performance.now();
    if (known.preparing !== this.known?.preparing) this.since = now;
    this.preparing_s = (now - this.since) / 1000;
    this.known = known;
  }
}
