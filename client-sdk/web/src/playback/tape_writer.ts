// A tape in the making, of what a page hears of a world (STREAM.md); Tape reads it.
const kText = 1;
const kFrame = 2;
const kHead = 8;
/** As long as the gateway's tapes of visits. */
const kMostBytes = 64 << 20;

export class TapeWriter {
  private parts: Uint8Array[] = [];
  private size = 0;
  private frames = 0;
  private tick = -1;
  /** It has all that it may have: what comes is left out. */
  full = false;

  constructor(private readonly most = kMostBytes) {}

  /** Whether there is something to be shown. */
  get isLong(): boolean {
    return this.frames > 1;
  }
  clear(): void {
    Object.assign(this, { parts: [], size: 0, frames: 0, tick: -1, full: false });
  }
  text(json: string): void {
    this.add(kText, new TextEncoder().encode(json));
  }
  /** A world that stands still sends the same tick again. */
  frame(tick: number, bytes: ArrayBuffer): void {
    if (tick === this.tick) return;
    this.tick = tick;
    this.frames += 1;
    this.add(kFrame, new Uint8Array(bytes));
  }
  bytes(): ArrayBuffer {
    const out = new Uint8Array(this.size);
    let at = 0;
    for (const part of this.parts) {
      out.set(part, at);
      at += part.length;
    }
    return out.buffer;
  }
  private add(kind: number, bytes: Uint8Array): void {
    const part = new Uint8Array(kHead + 4 * Math.ceil(bytes.length / 4));
    this.full ||= this.size + part.length > this.most;
    if (this.full) return;
    new DataView(part.buffer).setUint32(0, kind, true);
    new DataView(part.buffer).setUint32(4, bytes.length, true);
    part.set(bytes, kHead);
    this.parts.push(part);
    this.size += part.length;
  }
}
