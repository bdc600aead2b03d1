// One action at a time of a part of the console, and what came of it.
import { ApiError } from './api';

export class Action {
  busy = $state(false);
  said = $state('');
  trouble = $state(false);

  constructor(private readonly after: () => Promise<void> = async () => undefined) {}

  /** True: it was done. */
  async run(done: string, action: () => Promise<unknown>): Promise<boolean> {
    this.busy = true;
    try {
      await action();
      this.said = done;
      this.trouble = false;
      await this.after();
      return true;
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.said = error.told;
      this.trouble = true;
      return false;
    } finally {
      this.busy = false;
    }
  }
}
