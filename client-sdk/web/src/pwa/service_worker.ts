// Keeps the app itself, and nothing else, so that a tablet that starts before its gateway shows a calm picture and not the
// browser's error. Vite puts in which files these are. Never kept: the API, meshes, exhibits' files, addresses with a token.

declare const __SHELL__: string[];
declare const __VERSION__: string;

interface WorkerEvent extends Event {
  readonly request: Request;
  waitUntil(work: Promise<unknown>): void;
  respondWith(answer: Promise<Response>): void;
}
interface Worker {
  addEventListener(type: 'install' | 'activate' | 'fetch', listener: (event: WorkerEvent) => void): void;
  skipWaiting(): Promise<void>;
  readonly clients: { claim(): Promise<void> };
}
const worker = self as unknown as Worker;

const kPrefix = 'mechane-shell-';
const kName = kPrefix + __VERSION__;
const kPage = '/app/index.html';
/** A gateway whose machine is off answers nothing at all. */
const kPatience_ms = 4_000;

async function keep(): Promise<void> {
  const kept = await caches.open(kName);
  await kept.addAll(__SHELL__.map((path) => new Request(path, { cache: 'reload' })));
  await worker.skipWaiting();
}

/** The version before stays for pages that are still open. */
async function forgetOlder(): Promise<void> {
  const mine = (await caches.keys()).filter((name) => name.startsWith(kPrefix) && name !== kName);
  await Promise.all(mine.slice(0, -1).map((name) => caches.delete(name)));
  await worker.clients.claim();
}

async function fromShell(path: string, request: Request): Promise<Response> {
  const kept = await caches.open(kName).then((cache) => cache.match(path));
  return kept ?? fetch(request);
}

/** The gateway's page goes first, so that a new version shows with the next load. */
async function page(request: Request): Promise<Response> {
  const kept = await caches.open(kName).then((cache) => cache.match(kPage));
  if (!kept) return fetch(request);
  const late = new Promise<Response>((done) => setTimeout(() => done(kept), kPatience_ms));
  return Promise.race([fetch(request).catch(() => kept), late]);
}

worker.addEventListener('install', (event) => event.waitUntil(keep()));
worker.addEventListener('activate', (event) => event.waitUntil(forgetOlder()));
worker.addEventListener('fetch', (event) => {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  if (request.method !== 'GET' || origin !== location.origin) return;
  const isPage = pathname === '/' || /^\/(kiosk|console)(\/|$)/.test(pathname);
  if (request.mode === 'navigate') {
    // A page within another is a preview of the studio: without the gateway there is none.
    if (isPage && request.destination === 'document') event.respondWith(page(request));
  } else if (__SHELL__.includes(pathname)) {
    event.respondWith(fromShell(pathname, request));
  }
});
