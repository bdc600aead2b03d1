// Finds hands in pictures, on a thread of its own, by MediaPipe's hand landmarker and a model that it is given.
import { HandLandmarker } from '@mediapipe/tasks-vision';
import wasmLoaderPath from '@mediapipe/tasks-vision/vision_wasm_module_internal.js?url';
import wasmBinaryPath from '@mediapipe/tasks-vision/vision_wasm_module_internal.wasm?url';

/** To the thread: first a model, then pictures. */
export type Asked = { model: Uint8Array } | { picture: ImageBitmap; at: number };
type Points = { x: number; y: number; z: number }[];
export type Found = { ready: true } | { failed: string } | { landmarks: Points[]; world: Points[] };

let landmarker: HandLandmarker | null = null;
const tell = (found: Found): void => postMessage(found);

async function open(model: Uint8Array): Promise<void> {
  landmarker = await HandLandmarker.createFromOptions({ wasmLoaderPath, wasmBinaryPath },
    { baseOptions: { modelAssetBuffer: model, delegate: 'CPU' }, runningMode: 'VIDEO', numHands: 2 });
  tell({ ready: true });
}

self.onmessage = ({ data }: MessageEvent<Asked>) => {
  if ('model' in data) return void open(data.model).catch((error: unknown) => tell({ failed: String(error) }));
  try {
    const { landmarks, worldLandmarks } = landmarker!.detectForVideo(data.picture, data.at);
    tell({ landmarks, world: worldLandmarks });
  } catch (error) {
    tell({ failed: String(error) });
  }
  data.picture.close();
};
