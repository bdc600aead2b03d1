// One page for each address: a kiosk's display, the operators' console. Each loads only what it needs.
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
    rememberKiosk(kiosk);
    const [{ default: Kiosk }, { stereoOf }] = await Promise.all([import('./kiosk/Kiosk.svelte'), import('./scene/stereo')]);
    const given = new URLSearchParams(location.search);
    mount(Kiosk, { target, props: { kiosk, token: given.get('token') ?? '', stereo: stereoOf(given) } });
  } else {
    const { default: Console } = await import('./console/Console.svelte');
    mount(Console, { target });
  }
  keepShell();
}

void start();
