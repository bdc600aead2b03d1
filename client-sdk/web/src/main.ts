// One page for each address: a kiosk's display, the operators' console. Each loads only what it needs.
import { mount } from 'svelte';
import './app.css';

async function start(): Promise<void> {
  const target = document.getElementById('app')!;
  const kiosk = /^\/kiosk\/([^/]+)\/?$/.exec(location.pathname);
  if (kiosk) {
    const [{ default: Kiosk }, { stereoOf }] = await Promise.all([import('./kiosk/Kiosk.svelte'), import('./scene/stereo')]);
    const given = new URLSearchParams(location.search);
    const token = given.get('token') ?? '';
    mount(Kiosk, { target, props: { kiosk: decodeURIComponent(kiosk[1]!), token, stereo: stereoOf(given) } });
  } else {
    const { default: Console } = await import('./console/Console.svelte');
    mount(Console, { target });
  }
}

void start();
