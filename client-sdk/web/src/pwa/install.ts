// A kiosk's page as an app of a tablet: see service_worker.ts, and the manifest in vite.config.ts.

const kKiosk = 'mechane.kiosk';

/** Browsers offer this only over TLS that they trust, and on the gateway's own machine. */
export function keepShell(): void {
  if (!import.meta.env.PROD || !('serviceWorker' in navigator)) return;
  navigator.serviceWorker.register('/app/sw.js', { scope: '/', updateViaCache: 'none' }).then(
    (kept) => kept.update().catch(() => {}),  // without the gateway there is nothing newer
    (error: unknown) => console.warn('the page is not kept for a start without the gateway:', error),
  );
}

/** The kiosk that the app opens on this tablet: the last one that it showed. Its name alone is kept, no token. */
export function rememberKiosk(kiosk: string): void {
  try {
    localStorage.setItem(kKiosk, kiosk);
  } catch {
    // A browser that keeps nothing opens the console instead.
  }
}
export function rememberedKiosk(): string | null {
  try {
    return localStorage.getItem(kKiosk);
  } catch {
    return null;
  }
}
