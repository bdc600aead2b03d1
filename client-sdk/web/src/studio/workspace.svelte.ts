// What the parts of the studio share: the draft, what is selected, what is typed and not yet taken.
import { tick } from 'svelte';
import { SvelteSet } from 'svelte/reactivity';
import type { Api } from '../console/api';
import type { Edit, Vector } from './commands';
import { jointsOfMoved, type JointsOfMoved } from './picture/left_behind';
import { Draft, type DraftState, type Outcome } from './draft';
import type { JointPlan } from './picture/joint';
import { orderCommands, siblingsOf } from './order';
import type { Box } from '../console/devices';
import { PreviewDesk } from './preview/preview_desk.svelte';
import { draftRequests, studio } from './requests';
import type { Schema } from './inspector/schema';
import { wordGroups } from './flow/texts';
import { nodeId, pathId, selectedNode, treeOf, whereIs } from './tree';
import { outlineAt, type View } from './view';
import { studioWords, type Language } from './words';

export type PartName = 'scene' | 'flow' | 'words' | 'files' | 'try' | 'versions';

/** The language of the page, for all its parts. */
export class PageLanguage {
  code = $state<Language>(navigator.language.startsWith('el') ? 'el' : 'en');
  words = $derived(studioWords(this.code));
}

export class Workspace {
  readonly draft: Draft;
  readonly requests: ReturnType<typeof studio>;
  readonly preview: PreviewDesk;
  state = $state.raw<DraftState>({ view: null, theirs: null, waiting: 0, away: false, signedOut: false, conflict: null, refusals: {} });
  schema = $state.raw<Schema | null>(null);
  private chosen = $state(pathId(''));
  /** Bodies that are selected besides. */
  readonly also = new SvelteSet<string>();
  part = $state<PartName>('scene');
  /** Where a body of the draft is, as it begins; the picture knows. */
  boxOf: (def: string) => Box | null = () => null;
  /** What stands beside the preview. */
  beside = $state<'watch' | 'visits' | 'devices' | 'properties'>('watch');
  /** By field: what was typed and is not in the draft. It survives everything but leaving the page. */
  typed = $state<Record<string, string>>({});
  /** The field that gets the focus once it is there. */
  wanted = $state('');
  /** How often it was published from here. */
  published = $state(0);
  /** The joint in the making. */
  joint = $state<JointPlan | null>(null);
  /** Joints that stayed where they were in the step that led to this revision, while a body of theirs moved. */
  private behind = $state.raw<{ revision: number; joints: JointsOfMoved['left'] }>({ revision: -1, joints: [] });
  /** Rules that lead from a step to the one after it do so in a new order, too. */
  rulesFollow = $state(true);
  /** For who does not see it: where what was moved is now. */
  placed = $state('');
  /** Bodies that this page's picture leaves out, and those that no click in it takes. What visitors see does not change. */
  readonly hidden = new SvelteSet<string>();
  readonly locked = new SvelteSet<string>();
  private moving = false;
  /** The middle of a thing, in W; the picture knows it better. */
  middleOf = (def: string): Vector | null => (outlineAt(this.view, def)?.pose?.slice(0, 3) as Vector | undefined) ?? null;
  tree = $derived(this.state.view ? treeOf(this.state.view) : []);
  groups = $derived(this.state.view ? wordGroups(this.state.view) : []);

  constructor(
    readonly api: Api,
    readonly name: string,
    readonly page: PageLanguage,
  ) {
    this.requests = studio(api);
    this.draft = new Draft(draftRequests(api, name), (state) => (this.state = state));
    this.preview = new PreviewDesk(name, this.requests, this.draft);
  }

  get selection(): string {
    return this.chosen;
  }
  set selection(to: string) {
    this.also.clear();
    this.chosen = to;
  }
  /** Selects a body besides those that are, or not any more. */
  selectAlso(def: string): void {
    const first = selectedNode(this.chosen);
    const isBody = (name: string): boolean => this.view.bodies.some((b) => b.def === name);
    if (!isBody(def)) return;
    if (!isBody(first)) this.selection = nodeId(def);
    else if (def !== first) {
      if (!this.also.delete(def)) this.also.add(def);
    } else {
      const [next, ...rest] = this.also;
      if (next === undefined) return;
      this.selection = nodeId(next);
      for (const one of rest) this.also.add(one);
    }
  }
  /** The bodies that are selected, the one with the properties first. */
  get selectedBodies(): string[] {
    const known = new Set(this.state.view?.bodies.map((b) => b.def));
    return [selectedNode(this.chosen), ...this.also].filter((def) => known.has(def));
  }
  get words() {
    return this.page.words;
  }
  get view(): View {
    return this.state.view!;
  }
  async edit(id: string, what: string, commands: Edit['commands']): Promise<Outcome> {
    const { together, left } = jointsOfMoved(this.view, commands);
    const outcome = await this.draft.edit({ id, what, commands: [...commands, ...together] });
    if (outcome === 'done') this.behind = { revision: this.view.revision, joints: left };
    return outcome;
  }
  /** The joints that the newest step left behind. */
  get leftBehind(): JointsOfMoved['left'] {
    return this.behind.revision === this.view.revision ? this.behind.joints : [];
  }
  async takeAlong(): Promise<void> {
    const joints = this.leftBehind;
    await this.edit('', this.words.edits.move(joints.map((j) => j.def).join(', ')), joints.flatMap((j) => j.commands));
  }
  /** Moves a set up (-1) or down (1) among those that it stands with. */
  reorder(path: string, by: -1 | 1): Promise<void> {
    const commands = orderCommands(this.view, path, by, this.rulesFollow);
    return this.place(path.split('/').at(-1)!, commands, () => siblingsOf(this.view, path));
  }
  /** Puts something elsewhere, and says where it is among `all` then. What has the focus keeps it. */
  async place(name: string, commands: Edit['commands'], all: () => string[]): Promise<void> {
    if (this.moving || commands.length === 0) return;
    this.moving = true;
    const focused = document.activeElement;
    const outcome = await this.edit('', this.words.edits.move(name), commands);
    await tick();
    this.moving = false;
    if (focused instanceof HTMLElement && focused.isConnected) focused.focus();
    if (outcome === 'done') this.placed = this.words.order.placed(name, all().indexOf(name) + 1, all().length);
  }
  /** What was typed in a field is in the draft, or is given up. */
  forget(id: string): void {
    for (const known of Object.keys(this.typed)) if (known === id || known.startsWith(`${id}#`)) delete this.typed[known];
    this.draft.forgive(id);
  }
  goTo(path: string, node: string): void {
    if (/(^|\/)text\/[^/]+$/.test(path)) {
      this.part = 'words';
      this.wanted = path;
      return;
    }
    const place = whereIs(this.tree, path, node);
    if (!place) return;
    // Beside a preview, so that what runs stays in sight.
    if (this.part === 'try') this.beside = 'properties';
    // A rule's form stands beside the flow, too, where its step is read.
    else if (this.part !== 'flow' || !path.startsWith('activities/')) this.part = 'scene';
    this.selection = place.selection;
    this.wanted = place.field;
  }
}
