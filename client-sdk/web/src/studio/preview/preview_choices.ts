// What can be done with a preview: for its buttons, the palette and the keys.
import { activitiesOf, stepsIn } from '../flow/flow';
import type { Choice } from '../palette';
import type { PreviewDesk } from './preview_desk.svelte';
import type { Workspace } from '../workspace.svelte';

export const kPaces = [['pause', 0], ['tenth', 0.1], ['quarter', 0.25], ['real', 1]] as const;
export const kSteps = [1, 10, 100] as const;
/** What the key for a step does. */
const kKeyStep = 10;

export const hasErrors = (ws: Workspace): boolean => ws.view.problems.some((p) => p.severity === 'error');
/** What is typed must be stored first: that is what runs. */
export const canStart = (ws: Workspace): boolean => ws.state.waiting === 0 && !hasErrors(ws) && !ws.preview.busy;
/** The draft is another than the one that runs. */
export const isStale = (ws: Workspace): boolean => ws.preview.isOn && ws.preview.now!.revision !== ws.view.revision;

/** What becomes of the change, in words. */
export function staleText(ws: Workspace): string {
  const { words: { preview: words }, preview: { now } } = ws;
  if (hasErrors(ws)) return words.changed;
  const kept = now!.kept.revision === ws.view.revision;
  return kept ? words.kept(words.keptBy[now!.kept.by](now!.kept.name)) : words.changing;
}

/** The steps that it can begin at, "use/lift". */
export const startsOf = (ws: Workspace): string[] =>
  activitiesOf(ws.view).flatMap((activity) => stepsIn(ws.view, activity).map((step) => `${activity}/${step.name}`));
/** Where it begins when it is started; one that is not there any more is none. */
export const startOf = (ws: Workspace): string => (startsOf(ws).includes(ws.preview.from) ? ws.preview.from : '');

export function startPreview(ws: Workspace, from = startOf(ws)): void {
  ws.preview.from = from;
  ws.part = 'try';
  ws.preview.begin();
  if (canStart(ws)) void ws.preview.start(ws.view.revision, from);
}
export function previewChoices(ws: Workspace): Choice[] {
  const { preview: desk, words: { preview: words } } = ws;
  const start = { name: `${words.part}: ${desk.isOn ? words.again : words.start}`, keys: 'Ctrl Enter', run: () => startPreview(ws) };
  if (!desk.runs) return [start];
  return [start,
    { name: `${words.part}: ${words.stop}`, run: () => void desk.stop() },
    ...kPaces.map(([name, pace]) => ({ name: `${words.pace}: ${words.paces[name]}`, ...(pace === 0 && { keys: 'P' }),
      run: () => void desk.setPace(pace) })),
    ...(desk.now?.pace === 0 ? kSteps.map((ms) => ({ name: words.stepBy(ms), ...(ms === kKeyStep && { keys: '.' }),
      run: () => void desk.step(ms) })) : []),
  ];
}
/** A key within the preview's part. True: it was one of ours. */
export function previewKey(desk: PreviewDesk, event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.altKey || event.metaKey || !desk.runs) return false;
  if (event.key === 'p' || event.code === 'KeyP') void desk.togglePause();
  else if (event.key === '.' && desk.now?.pace === 0) void desk.step(kKeyStep);
  else return false;
  return true;
}
