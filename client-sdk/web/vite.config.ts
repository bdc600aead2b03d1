import { svelte, vitePreprocess } from '@sveltejs/vite-plugin-svelte';
import { gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';
import { installable, isShell } from './installable';

/** First load of the kiosk page, without meshes: what a tablet fetches before its first picture, compressed. */
const kMostKb = 1024;

/** Prints the size of all code and styles, and fails a build that is too large. */
function firstLoad(): Plugin {
  return {
    name: 'first-load',
    generateBundle(_options, bundle) {
      let bytes = 0;
      for (const file of Object.values(bundle).filter(isShell)) bytes += gzipSync(file.type === 'chunk' ? file.code : file.source).length;
      const kb = bytes / 1024;
      this.info(`first_load.gzip_kb ${kb.toFixed(1)} (at most ${kMostKb})`);
      if (kb > kMostKb) this.error(`the app has ${kb.toFixed(0)} KB compressed, at most ${kMostKb}: take a library out`);
    },
  };
}

export default defineConfig({
  base: '/app/',
  plugins: [svelte({ preprocess: vitePreprocess() }), firstLoad(), installable()],
  worker: { format: 'es' },
  build: { target: 'es2021', assetsInlineLimit: 0, chunkSizeWarningLimit: 1024, emptyOutDir: true },
  test: { environment: 'node', include: ['tests/*.test.ts'] },
});
