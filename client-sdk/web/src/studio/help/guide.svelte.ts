// What stands beside the page: its help, which follows what the author looks at, and the tour.
import { Tour } from '../tour/tour.svelte';
import type { Workspace } from '../workspace.svelte';
import { isTopic, type TopicName } from './topics';

export class Guide {
  open = $state(false);
  topic = $state<TopicName>('begin');
  readonly tour = new Tour();
  /** The draft that is open. */
  workspace = $state.raw<Workspace | null>(null);

  /** The part of the page in which somebody clicks or has the focus: elements say it themselves, with `data-help`. */
  noticed(target: EventTarget | null): void {
    const name = target instanceof Element ? target.closest<HTMLElement>('[data-help]')?.dataset.help : undefined;
    if (isTopic(name)) this.topic = name;
  }
  showTour(): void {
    this.open = false;
    this.tour.begin();
  }
  toggle(): void {
    this.open = !this.open;
  }
}
