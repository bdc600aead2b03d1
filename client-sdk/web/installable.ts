// What makes the built app one that a tablet can install: manifest, icons, service worker.
import { initWasm, Resvg } from '@resvg/resvg-wasm';
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';
import { transformWithEsbuild } from 'vite';

const kSizes = [192, 512];
const near = (path: string): string => fileURLToPath(new URL(path, import.meta.url));
let drawer: Promise<void> | undefined;

async function icon(svg: string, size: number): Promise<Uint8Array> {
  drawer ??= initWasm(readFileSync(createRequire(import.meta.url).resolve('@resvg/resvg-wasm/index_bg.wasm')));
  await drawer;
  return new Resvg(svg, { fitTo: { mode: 'width', value: size } }).render().asPng();
}

const kManifest = {
  name: 'Mechane',
  short_name: 'Mechane',
  description: 'Touch, assemble and work the machines of ancient Greek engineers',
  id: '/?kiosk',
  start_url: '/?kiosk',  // without a token: the tablet signs in once
  scope: '/',
  display: 'fullscreen',
  orientation: 'any',
  background_color: '#8fa6b8',
  theme_color: '#2b2a26',
  icons: kSizes.flatMap((size) => ['any', 'maskable'].map((purpose) => ({
    src: `/app/icon-${size}${purpose === 'any' ? '' : '-full'}.png`, sizes: `${size}x${size}`, type: 'image/png', purpose,
  }))),
};

/** The finder of hands in a camera's pictures has 13 MB and needs the gateway's model: only a page that uses it fetches it. */
export const isShell = ({ fileName }: { fileName: string }): boolean => !/(vision_wasm|finder_worker)/.test(fileName);

export function installable(): Plugin {
  return {
    name: 'installable',
    apply: 'build',
    enforce: 'post',
    transformIndexHtml: () => [
      { tag: 'link', attrs: { rel: 'manifest', href: '/app/manifest.webmanifest' }, injectTo: 'head' },
      { tag: 'link', attrs: { rel: 'apple-touch-icon', href: '/app/icon-192.png' }, injectTo: 'head' },
      { tag: 'meta', attrs: { name: 'theme-color', content: kManifest.theme_color }, injectTo: 'head' },
    ],
    async generateBundle(_options, bundle) {
      const emit = (fileName: string, source: string | Uint8Array): void => void this.emitFile({ type: 'asset', fileName, source });
      const svg = readFileSync(near('src/icon.svg'), 'utf8');
      for (const size of kSizes) {
        emit(`icon-${size}.png`, await icon(svg, size));
        emit(`icon-${size}-full.png`, await icon(svg.replace('rx="14"', 'rx="0"'), size));  // a mask cuts its corners
      }
      emit('manifest.webmanifest', JSON.stringify(kManifest, null, 2));
      // The page's name is not hashed: its content decides, too, whether this is another version.
      const files = Object.values(bundle).filter((file) => isShell(file) && !/\.(png|webmanifest)$/.test(file.fileName));
      const version = createHash('sha256');
      for (const file of files) version.update(file.fileName).update(file.type === 'chunk' ? file.code : file.source);
      const shell = files.map((file) => `/app/${file.fileName}`).sort();
      const define = { __SHELL__: JSON.stringify(shell), __VERSION__: JSON.stringify(version.digest('hex').slice(0, 12)) };
      const source = readFileSync(near('src/pwa/service_worker.ts'), 'utf8');
      const { code } = await transformWithEsbuild(source, 'service_worker.ts',
        { define, minify: true, target: 'es2021', sourcemap: false });
      emit('sw.js', code);
    },
  };
}
