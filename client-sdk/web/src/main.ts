// One page for each address: a kiosk's display, the operators' console, the studio. Each loads only what it needs.
import { mount } from 'svelte';
import './app.css';
import { keepShell, rememberKiosk, rememberedKiosk } from './pwa/install';

/** The kiosk of the address, or the one that an installed app begins with: `/?kiosk`. */
function kioskHere(): string | null {
  const named = /^\/kiosk\/([^/]+)\/?$/.exec(location.pathname);
  if (named) return decodeURIComponent(named[1]!);
  const known = location.pathname === '/' && location.search === '?kiosk' ? rememberedKiosk() : null;
  if (known) history.replaceState(null, '', `/kiosk/${encodeURIComponent(known)}`);
  return known;
}

async function start(): Promise<void> {
  const target = document.getElementById('app')!;
  const kiosk = kioskHere();
  if (kiosk) {
    if (window.top === window) rememberKiosk(kiosk);  // within the studio it is a draft's
    const [{ default: Kiosk }, { stereoOf }] = await Promise.all([import('./kiosk/Kiosk.svelte'), import('./scene/stereo')]);
    const given = new URLSearchParams(location.search);
    const [token, language] = [given.get('token') ?? '', given.get('language') ?? ''];
    mount(Kiosk, { target, props: { kiosk, token, language, stereo: stereoOf(given), handAtOnce: given.get('hand') === 'camera' } });
  } else if (location.pathname.startsWith('/playback/')) {
    const { default: Playback } = await import('./playback/Playback.svelte');
    mount(Playback, { target, props: { visit: decodeURIComponent(location.pathname.slice('/playback/'.length)) } });
  } else if (location.pathname === '/studio' || location.pathname.startsWith('/studio/')) {
    const { default: Studio } = await import('./studio/Studio.svelte');
    mount(Studio, { target });
  } else {
    const { default: Console } = await import('./console/Console.svelte');
    mount(Console, { target });
  }
  keepShell();
}

void start();
