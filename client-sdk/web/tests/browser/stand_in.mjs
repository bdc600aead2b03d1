// A stand-in for the gateway: the built app, one mesh file, a world that stands still, and what the page says.
import { createReadStream, existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { WebSocketServer } from 'ws';

const kModels = fileURLToPath(new URL('../../../../scenarios/models/', import.meta.url));
const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm',
  '.png': 'image/png', '.webmanifest': 'application/manifest+json' };
const kStill = [0, 0, 0, 0, 0, 0, 1];
/** As the gateway has it: what the page may not do there, it may not do here. */
const policyFor = (pathname) => "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' blob: data:; " +
  "connect-src 'self' blob: ws:; media-src 'self' blob:; worker-src 'self' blob:; " +
  `frame-ancestors ${pathname.startsWith('/kiosk/studio-') ? "'self'" : "'none'"}`;

/** The nodes of a .glb file that are things, with where they stand. */
function thingsOf(bytes) {
  const gltf = JSON.parse(bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12)));
  const nodes = gltf.scenes[0].nodes.map((k) => gltf.nodes[k]).filter((n) => n.name !== 'SCENE' && !n.name.startsWith('WATER_'));
  return nodes.map((n) => ({ name: n.name, pose: [...(n.translation ?? [0, 0, 0]), ...(n.rotation ?? [0, 0, 0, 1])] }));
}

function frameBytes(things, sequence, { tick, quantities }) {
  const out = Buffer.alloc(48 + 36 * things.length + 4 * quantities.length);
  out.writeUInt16LE(0x0101, 0);
  out.writeUInt16LE(54_321, 2); // when it was sent
  out.writeBigUInt64LE(BigInt(sequence), 8);
  out.writeBigUInt64LE(BigInt(tick), 16);
  out.writeUInt32LE(things.length, 32);
  out.writeUInt32LE(quantities.length, 36);
  things.forEach(({ pose }, i) => {
    out.writeUInt32LE(i, 48 + 36 * i);
    out.writeUInt32LE(1, 52 + 36 * i);
    pose.forEach((value, k) => out.writeFloatLE(value, 56 + 36 * i + 4 * k));
  });
  quantities.forEach((value, i) => out.writeFloatLE(value, 48 + 36 * things.length + 4 * i));
  return out;
}

const overlay = (more) => ({
  type: 'overlay', language: 'en', languages: ['el', 'en'], title: 'The crane', caption: 'Turn the crank', subtitle: '', hint: '',
  note: '', goal: '',
  notice: null, steps: { done: 1, total: 3 },
  gauges: [{ label: 'Speed', value: '24', unit: 'turns/min', fraction: 0.4, begin: '0', end: '60', goal: 0.8 }],
  buttons: [{ action: 'home', text: 'To the village' }], panel: null, pose: null, largeText: false, highContrast: false, ...more,
});

export const kQuestion = overlay({
  panel: { title: 'The crane', goal: '', text: 'What lifts the stone?', more: '', scale: false, low: '', high: '', asked: 0, questions: 2,
    answers: [{ action: 'answer:rope', text: 'The rope' }, { action: 'answer:wind', text: 'The wind' }],
    leave: { action: 'skip', text: 'Skip' } },
});

/** The messages of a world in which one thing of a model can be taken. */
function worldOf(model, things, takeable) {
  return [
    { type: 'hello', protocol: 1, kiosk: 'k', display: 'web-1', mayPoint: true },
    { type: 'link', state: 'joined', refusal: '' },
    { type: 'world', world: 'w', scenario: model, activity: 'use', step: 'turn', done: false, agents: ['A'],
      quantities: [], narration: {}, audio: {}, detail: '' },
    { type: 'scene', objects: things.map((t, index) => ({
      index, uri: `${model}.glb`, hash: model, node: t.name, parent: '', movable: true, title: { en: t.name }, ...t,
    })) },
    { type: 'presentation', world: 'w', languages: ['en'], activities: [{ name: 'use' }], effects: [],
      views: [{ name: 'FRONT', pose: [0, 1.55, 3.4, 0, 0, 0, 1], fov: 0.9 }],
      affordances: things.flatMap((t, object) => (t.name === takeable
        ? [{ kind: 'taken', agent: 'A', object, AJ: kStill, BJ: kStill }] : [])) },
    overlay({}),
  ];
}

export class StandIn {
  heard = [];
  /** Messages of tracked hands. */
  hands = [];
  sockets = new Set();
  frame = frameBytes;
  /** Of hands, for pages with a camera; null: none is there. */
  handModel = null;

  /** `file`: the mesh file; without it, the tree's own of the model's name. */
  constructor(app, model, takeable, file = readFileSync(join(kModels, `${model}.glb`))) {
    this.app = app;
    this.file = file;
    this.things = thingsOf(file);
    this.messages = worldOf(model, this.things, takeable);
    this.fetched = [];
  }
  async start(port = 0) {
    this.http = createServer((request, response) => this.answer(request, response));
    const sockets = new WebSocketServer({ server: this.http, handleProtocols: () => 'mechane.1' });
    sockets.on('connection', (socket) => this.meet(socket));
    await new Promise((done) => this.http.listen(port, '127.0.0.1', done));
    this.port = this.http.address().port;
    return `http://127.0.0.1:${this.port}`;
  }
  async stop() {
    for (const socket of this.sockets) socket.terminate();
    this.http.closeAllConnections();
    await new Promise((done) => this.http.close(done));
  }
  say(message) {
    const sent = typeof message === 'object' && !Buffer.isBuffer(message) ? JSON.stringify(message) : message;
    for (const socket of this.sockets) socket.send(sent);
  }

  /** The tick and the quantities of a frame. */
  moment(sequence) {
    return { tick: 33 * sequence, quantities: [] };
  }
  meet(socket) {
    this.sockets.add(socket);
    for (const message of this.messages) socket.send(JSON.stringify(message));
    let sequence = 0;
    const pace = setInterval(() => socket.send(this.frame(this.things, ++sequence, this.moment(sequence))), 33);
    socket.on('message', (message, binary) => (binary ? this.hands.push(message) : this.heard.push(JSON.parse(String(message)))));
    socket.on('close', () => {
      clearInterval(pace);
      this.sockets.delete(socket);
    });
  }
  answer(request, response) {
    const { pathname } = new URL(request.url, 'http://stand-in');
    const content = /^\/content\/([\w-]+)$/.exec(pathname);
    if (content) {
      this.fetched.push(content[1]);
      response.writeHead(200, { 'content-type': 'application/octet-stream' });
      return response.end(this.file);
    }
    if (pathname === '/hand-model') {
      response.writeHead(this.handModel ? 200 : 404, { 'content-type': 'application/octet-stream' });
      return response.end(this.handModel);
    }
    const file = pathname.startsWith('/app/') ? join(this.app, pathname.slice(4)) : join(this.app, 'index.html');
    if (pathname.startsWith('/api/') || !existsSync(file)) {
      response.writeHead(pathname === '/api/me' ? 401 : 404, { 'content-type': 'application/json' });
      return response.end('{"error":"nobody is signed in","remedy":"sign in"}');
    }
    response.writeHead(200, { 'content-type': kTypes[extname(file)] ?? 'application/octet-stream',
      'content-security-policy': policyFor(pathname),
      ...(pathname === '/app/sw.js' && { 'service-worker-allowed': '/' }) });
    return createReadStream(file).pipe(response);
  }
}
