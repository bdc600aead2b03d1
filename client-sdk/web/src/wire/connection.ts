// A WebSocket, to the gateway or to a program beside the browser: it comes back by itself, however often it is lost.

const kFirstWait_ms = 500;
const kLongestWait_ms = 10_000;
/** A connection that lived so long was a good one: the next wait is short again. */
const kGood_ms = 5_000;
export const kSubprotocol = 'mechane.1';

/** How long to wait before the n-th try (from 0), with up to a fifth more, so that many browsers do not come at once. */
export function waitBefore(tries: number, random: number): number {
  return Math.min(kFirstWait_ms * 2 ** tries, kLongestWait_ms) * (1 + random / 5);
}

export interface Listener {
  opened(): void;
  text(message: string): void;
  bytes(message: ArrayBuffer): void;
  /** It tries again by itself. */
  closed(): void;
}

export class Connection {
  private socket: WebSocket | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private tries = 0;
  private openedAt = 0;
  private ended = false;

  constructor(
    private readonly url: string,
    private readonly listener: Listener,
    private readonly Socket: typeof WebSocket = WebSocket,
    private readonly subprotocol = kSubprotocol,
  ) {
    this.open();
  }

  get isOpen(): boolean {
    return this.socket?.readyState === 1;
  }
  /** Messages to a gateway that is not there are lost: they were about a moment that has passed. */
  send(message: object): void {
    if (this.isOpen) this.socket?.send(JSON.stringify(message));
  }
  sendBytes(bytes: ArrayBuffer): void {
    if (this.isOpen) this.socket?.send(bytes);
  }
  /** Tries at once: the network or the page has come back. */
  hurry(): void {
    if (this.ended || this.socket) return;
    clearTimeout(this.timer);
    this.open();
  }
  end(): void {
    this.ended = true;
    clearTimeout(this.timer);
    this.socket?.close();
  }

  private open(): void {
    const socket = new this.Socket(this.url, this.subprotocol);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.openedAt = Date.now();
      this.listener.opened();
    };
    socket.onmessage = (event: MessageEvent) => {
      if (typeof event.data === 'string') this.listener.text(event.data);
      else if (event.data instanceof ArrayBuffer) this.listener.bytes(event.data);
    };
    socket.onclose = () => {
      if (this.openedAt && Date.now() - this.openedAt > kGood_ms) this.tries = 0;
      this.openedAt = 0;
      this.socket = null;
      this.listener.closed();
      if (!this.ended) this.timer = setTimeout(() => this.open(), waitBefore(this.tries++, Math.random()));
    };
  }
}
