// The draft with all that it uses, as a file in the author's hands.
import type { Workspace } from '../workspace.svelte';

/** Errors are ApiErrors. */
export async function exportDraft(ws: Workspace): Promise<void> {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(await ws.requests.exported(ws.name));
  link.download = `${ws.name}.zip`;
  link.click();
  // The browser has taken it by then.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
