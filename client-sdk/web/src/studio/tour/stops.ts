// The stops of the tour: what each points at, and how the draft or the page shows that it is done. The tour makes an exhibit of the
// template crank-and-rope, whose crank lifts a stone, and puts a second crank beside it that lifts nothing.
import { nodeId, pathId } from '../tree';
import { languagesOf, metaAt, nodeAt, outlineAt, stringAt, stringsAt, type View } from '../view';
import type { PartName, Workspace } from '../workspace.svelte';

export const kStops = ['make', 'stone', 'weight', 'insert', 'place', 'join', 'hand', 'words', 'rule', 'start', 'turn', 'publish'] as const;
export type StopName = (typeof kStops)[number];
export const kTemplate = 'crank-and-rope';

const kStone = 'LOAD';
const kHand = 'agents/HOLD';
const kRule = 'activities/lift/steps/wind/trigger:1/value';
/** As the template has them. */
const kFirst = { mass: 10, height: 0.6 };
/** The stone has left the ground. */
const kLifted_m = 0.45;
/** Beside the other crank, and as high. */
const kAside_m = 0.4;
const kHeight_m = 0.9;
const kNear_m = 0.03;

/** The draft is one that the tour can go on with. */
export const isOfTour = (view: View): boolean => nodeAt(view, kStone) !== undefined && metaAt(view, kHand) !== undefined;
/** The crank that the author has inserted; "": none. */
export const crankOf = (view: View): string => view.bodies.filter((b) => b.def.startsWith('CRANK')).at(-1)?.def ?? '';

function isLifted({ preview }: Workspace): boolean {
  void preview.drawn;
  const height = preview.quantities.findIndex((q) => q.name === 'height');
  return (preview.series.newest?.values[height] ?? 0) > kLifted_m;
}
export function isDone(stop: StopName, ws: Workspace): boolean {
  const { view } = ws;
  const crank = crankOf(view);
  switch (stop) {
    case 'make': return isOfTour(view);
    case 'stone': return ws.selection === nodeId(kStone);
    case 'weight': return Number(nodeAt(view, kStone)?.fields.mass ?? kFirst.mass) !== kFirst.mass;
    case 'insert': return crank !== '';
    case 'place': {
      const [x = 0, y = 0] = outlineAt(view, crank)?.pose ?? [];
      return x >= kAside_m && Math.abs(y - kHeight_m) <= kNear_m;
    }
    case 'join': return crank !== '' && view.joints.some((j) => j.body1 === crank || j.body2 === crank);
    case 'hand': return crank !== '' && stringsAt(view, `${kHand}/bodies`).includes(crank);
    case 'words': return languagesOf(view).every((code) => stringAt(view, `${crank}/mechane:body/text/title.${code}`) !== '');
    case 'rule': return metaAt(view, kRule) !== undefined && Number(stringAt(view, kRule)) !== kFirst.height;
    case 'start': return ws.preview.runs;
    case 'turn': return ws.preview.runs && isLifted(ws);
    case 'publish': return ws.published > 0;
  }
}

const field = (id: string): string => `[data-field="${CSS.escape(id)}"]`;
const row = (id: string): string => `[data-row="${CSS.escape(id)}"]`;
/** Something in a part of the page, or, while another part is shown, the button that leads there. */
const within = (ws: Workspace, part: PartName, there: string): string => (ws.part === part ? there : `[data-part="${part}"]`);
/** A field of what is selected, or, until then, its row in the contents. */
const chosen = (ws: Workspace, id: string, there: string): string =>
  (ws.selection === id && (ws.part !== 'try' || ws.beside === 'properties') ? there : row(id));

/** A selector of what the stop points at. */
export function targetOf(stop: StopName, ws: Workspace | null): string {
  if (stop === 'make' || !ws?.state.view) return '[data-tour="new"]';
  const crank = crankOf(ws.view);
  switch (stop) {
    case 'stone': return row(nodeId(kStone));
    case 'weight': return chosen(ws, nodeId(kStone), field(`${kStone}/mass`));
    case 'insert': return within(ws, 'scene', '[data-tour="insert"]');
    case 'place': return chosen(ws, nodeId(crank), field(`${crank}/position`));
    case 'join': return ws.joint ? '[data-tour="join"]' : within(ws, 'scene', '[data-tour="joint"]');
    case 'hand': return chosen(ws, pathId(kHand), field(`${kHand}/bodies`));
    case 'words': return within(ws, 'words', `.row:has(${field(`${crank}/mechane:body/text/title.${ws.page.code}`)})`);
    case 'rule': return ws.selection === pathId(kRule.split('/').slice(0, -2).join('/')) && ws.part !== 'try'
      ? field(kRule) : within(ws, 'flow', 'button.rule');
    case 'start': return within(ws, 'try', '[data-tour="start"]');
    case 'turn': return within(ws, 'try', '[data-tour="page"]');
    case 'publish': return '[data-tour="publish"]';
  }
}
