// x3d.mjs FILE.x3d ...: each exhibit's file in X_ITE, an X3D browser that shares nothing with ours: it reports no error, asks for nothing
// from elsewhere, knows each node that has a name, bodies among them, and shows the things of mesh files.
import assert from 'node:assert/strict';
import { createReadStream, existsSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { basename, dirname, extname, join } from 'node:path';
import { openBrowser } from './page.mjs';

const kViewer = dirname(createRequire(import.meta.url).resolve('x_ite'));
const kTypes = { '.js': 'text/javascript', '.css': 'text/css', '.x3d': 'model/x3d+xml', '.glb': 'model/gltf-binary' };
const kPage = '<!doctype html><link rel="icon" href="data:," /><script src="/viewer/x_ite.min.js"></script>' +
  '<x3d-canvas style="width: 320px; height: 240px" antialiased="false" preserveDrawingBuffer="true" splashScreen="false" ' +
  'notifications="false"></x3d-canvas>';
/** Of the picture: what the exhibit covers, at least. */
const kLeastShare = 0.02;
const files = process.argv.slice(2);

/** `/viewer/...`: X_ITE; `/K/...`: what lies beside the folder of the file K. */
const server = createServer(({ url }, response) => {
  const { pathname } = new URL(url, 'http://here');
  if (pathname === '/') return response.writeHead(200, { 'content-type': 'text/html' }).end(kPage);
  const [, root, ...rest] = decodeURIComponent(pathname).split('/');
  const folder = root === 'viewer' ? kViewer : join(dirname(files[Number(root)] ?? ''), '..');
  const file = join(folder, ...rest.filter((part) => part !== '..'));
  if (!existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { 'content-type': kTypes[extname(file)] ?? 'application/octet-stream' });
  createReadStream(file).pipe(response);
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const origin = `http://127.0.0.1:${server.address().port}`;
const { browser, page } = await openBrowser({ viewport: { width: 340, height: 260 } });
const complaints = [];
page.on('pageerror', (error) => complaints.push(String(error)));
page.on('console', (message) => ['error', 'warning'].includes(message.type())
  && !message.text().includes('GL Driver Message') && complaints.push(message.text()));
page.on('request', (request) => !/^(blob|data):/.test(request.url()) && !request.url().startsWith(`${origin}/`)
  && complaints.push(`asked for ${request.url()}`));

/** The type of each named node, once its mesh files are there. */
async function load(address) {
  const x3d = window.X3D.getBrowser();
  x3d.beginUpdate();
  await x3d.loadURL(new window.X3D.MFString(address));
  const named = Object.fromEntries([...x3d.currentScene.namedNodes].map((node) => [node.getNodeName(), node.getNodeTypeName()]));
  const meshes = [...x3d.currentScene.namedNodes].filter((node) => node.getNodeTypeName() === 'Inline');
  await Promise.all(meshes.map((mesh) => mesh.getValue().requestImmediateLoad()));
  return named;
}
/** The share of the picture that the mesh files cover: pixels that are others without them. And the picture with them. */
async function seen() {
  const x3d = window.X3D.getBrowser();
  const canvas = document.querySelector('x3d-canvas').shadowRoot.querySelector('canvas');
  const meshes = [...x3d.currentScene.namedNodes].filter((node) => node.getNodeTypeName() === 'Inline');
  const pictures = [];
  for (const visible of [true, false]) {
    for (const mesh of meshes) mesh.visible = visible;
    for (let k = 0; k < 2; ++k) await x3d.nextFrame();
    const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
    copy.getContext('2d').drawImage(canvas, 0, 0);
    pictures.push(copy);
  }
  x3d.endUpdate();
  const [one, other] = pictures.map((copy) => new Uint32Array(
    copy.getContext('2d').getImageData(0, 0, copy.width, copy.height).data.buffer));
  return { share: one.filter((pixel, k) => pixel !== other[k]).length / one.length, picture: pictures[0].toDataURL().split(',')[1] };
}

try {
  await page.goto(origin);
  await page.waitForFunction(() => window.X3D?.getBrowser());
  for (const [k, file] of files.entries()) {
    const began = performance.now();
    const text = readFileSync(file, 'utf8');
    const written = Object.fromEntries([...text.matchAll(/<(\w+)\s[^>]*?\bDEF='([^']+)'/g)].map(([, type, name]) => [name, type]));
    const named = await page.evaluate(load, `/${k}/${basename(dirname(file))}/${basename(file)}`);
    const bodies = Object.keys(written).filter((name) => written[name] === 'RigidBody');
    assert.ok(bodies.length > 0, `${file} has no bodies`);
    assert.deepEqual(named, written, file);
    assert.deepEqual(complaints, [], file);
    const { share, picture } = await page.evaluate(seen);
    if (process.env.MECHANE_PICTURES)
      writeFileSync(join(process.env.MECHANE_PICTURES, `x3d-${basename(file)}.png`), Buffer.from(picture, 'base64'));
    // Bodies without a mesh are shapes of physics alone, which X3D does not draw.
    const drawn = Object.values(written).includes('Inline');
    assert.ok(share >= kLeastShare || !drawn, `${file}: the exhibit covers ${(100 * share).toFixed(1)} % of the picture`);
    assert.deepEqual(complaints, [], file);
    const took_s = (performance.now() - began) / 1000;
    console.log(`ok ${basename(file)}: ${bodies.length} bodies, ${(100 * share).toFixed(0)} % (${took_s.toFixed(1)} s)`);
  }
} finally {
  await browser.close();
  server.close();
}
