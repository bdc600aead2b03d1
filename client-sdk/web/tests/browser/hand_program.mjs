// A program beside the browser that sees hands in front of a camera (client-sdk/web/CAMERA.md).
import { once } from 'node:events';
import { WebSocketServer } from 'ws';
import { seenHand } from './seen_hand.mjs';

const kEvery_s = 1 / 30;
const kSpeed_m_per_s = 0.15;
const kCamera = { width: 640, height: 480, fov: 1.1 };

export class HandProgram {
  /** Of the hand that it sees, thirty times a second; null: none. */
  pose = { p: [0, 0, 0.5], bent: 0.3 };
  /** Where its middle goes, as fast as a calm person; null: it stays. */
  goal = null;
  async start(port = 0) {
    const handleProtocols = (all) => (all.has('mechane.hands.1') ? 'mechane.hands.1' : false);
    this.server = new WebSocketServer({ host: '127.0.0.1', port, handleProtocols });
    await once(this.server, 'listening');
    this.server.on('connection', (socket) => {
      const pace = setInterval(() => socket.send(this.message()), 1000 * kEvery_s);
      socket.on('close', () => clearInterval(pace));
    });
    return this.server.address().port;
  }
  glide() {
    if (!this.goal || !this.pose) return;
    const way = this.goal.map((x, k) => x - this.pose.p[k]);
    const share = Math.min(kSpeed_m_per_s * kEvery_s / Math.max(Math.hypot(...way), 1e-9), 1);
    this.pose = { ...this.pose, p: this.pose.p.map((x, k) => x + share * way[k]) };
  }
  message() {
    this.glide();
    return JSON.stringify({ version: 1, ...kCamera, hands: this.pose ? [seenHand(this.pose, kCamera)] : [] });
  }
  async stop() {
    for (const socket of this.server.clients) socket.terminate();
    this.server.close();
    await once(this.server, 'close');
  }
}
