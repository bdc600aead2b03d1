// Where landmarks come from: a model in this page, which looks at the machine's camera, or a program beside the browser. In both cases no
// picture leaves the machine.
import { Vector3 } from 'three';
import { Connection } from '../wire/connection';
import type { Asked, Found } from './finder_worker';
import { kUsualFov, parsePicture, type CameraPicture } from './landmarks';

export type Trouble = 'noCamera' | 'noModel' | 'badModel' | 'noProgram' | 'badProgram';
export interface HandListener {
  seen(picture: CameraPicture): void;
  /** Null: it goes on. */
  trouble(what: Trouble | null, detail?: string): void;
}
export interface HandSource {
  end(): void;
}

const kSubprotocol = 'mechane.hands.1';
/** So many messages in a row, a second of them, that cannot be read. */
const kUnreadable = 30;
/** The finder looks at small pictures anyway. */
const kWidth = 480;

export function fromProgram(port: number, listener: HandListener): HandSource {
  let unread = 0;
  const read = (picture: CameraPicture | null): void => {
    unread = picture ? 0 : unread + 1;
    if (unread >= kUnreadable) listener.trouble('badProgram');
    else if (picture) listener.seen(picture);
  };
  return new Connection(`ws://127.0.0.1:${port}/`, {
    opened: () => listener.trouble(null),
    closed: () => listener.trouble('noProgram'),
    bytes: () => read(null),
    text: (json) => read(parsePicture(json)),
  }, WebSocket, kSubprotocol);
}

class ModelSource implements HandSource {
  private readonly video = document.createElement('video');
  private stream: MediaStream | null = null;
  private worker: Worker | null = null;
  private ended = false;

  constructor(
    private readonly listener: HandListener,
    private readonly address: string,
  ) {
    void this.begin();
  }
  end(): void {
    this.ended = true;
    this.worker?.terminate();
    for (const track of this.stream?.getTracks() ?? []) track.stop();
    this.video.srcObject = null;
  }

  private async begin(): Promise<void> {
    const video = { width: 640, height: 480, facingMode: 'user', frameRate: 30 };
    try {
      this.stream = await navigator.mediaDevices.getUserMedia({ video, audio: false });
    } catch (error) {  // also where the page is not from a secure address: then there are no mediaDevices
      return this.fail('noCamera', error);
    }
    const answer = await fetch(this.address).catch(() => null);
    if (this.ended) return this.end();
    if (!answer?.ok) return this.fail('noModel', answer?.status);
    Object.assign(this.video, { srcObject: this.stream, muted: true, playsInline: true });
    await this.video.play().catch(() => undefined);
    const model = new Uint8Array(await answer.arrayBuffer());
    if (this.ended) return this.end();
    this.worker = new Worker(new URL('./finder_worker.ts', import.meta.url), { type: 'module' });
    this.worker.onmessage = ({ data }: MessageEvent<Found>) => this.hear(data);
    this.worker.onerror = (event) => this.fail('badModel', event.message);
    this.worker.postMessage({ model } satisfies Asked, [model.buffer]);
  }
  private fail(what: Trouble, why: unknown): void {
    this.end();
    console.warn('camera hand:', what, why);
    this.listener.trouble(what, String(why).split(/[;\n]/, 1)[0]);  // the rest is for those who make the library
  }
  private hear(found: Found): void {
    if ('failed' in found) return this.fail('badModel', found.failed);
    if ('landmarks' in found) {
      const { videoWidth: width, videoHeight: height } = this.video;
      const hands = found.landmarks.map((points, k) => ({
        image: points.map(({ x, y }): [number, number] => [x, y]),
        world: found.world[k]!.map(({ x, y, z }) => new Vector3(x, y, z)),
      }));
      this.listener.seen({ width, height, fov: kUsualFov, hands });
    } else {
      this.listener.trouble(null);
    }
    this.lookAgain();
  }
  /** One picture at a time: a slow machine sees fewer, and none that is old. */
  private lookAgain(): void {
    const look = async (): Promise<void> => {
      const high = Math.round((kWidth * this.video.videoHeight) / this.video.videoWidth);
      const picture = await createImageBitmap(this.video, { resizeWidth: kWidth, resizeHeight: high }).catch(() => null);
      if (!picture || this.ended) return;
      this.worker?.postMessage({ picture, at: performance.now() } satisfies Asked, [picture]);
    };
    const { video } = this;
    if ('requestVideoFrameCallback' in video) video.requestVideoFrameCallback(() => void look());
    else requestAnimationFrame(() => void look());
  }
}

export const fromModel = (address: string, listener: HandListener): HandSource => new ModelSource(listener, address);
