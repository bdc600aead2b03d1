// Plays sounds at their places by WebAudio, and what is read aloud. Browsers allow it only after a first touch.
import type { PerspectiveCamera } from 'three';
import { Quaternion, Vector3 } from 'three';
import type { SoundKind, SoundSource } from './sources';

/** How a kind of sound is made of noise. */
interface Voice {
  filter: BiquadFilterType;
  frequency: number;
  q: number;
  level: number;
  /** How often and how much it swells. */
  swell: [number, number];
  /** Of a single sound: how long it takes to fade. */
  fades: number;
}
const kVoices: Record<SoundKind, Voice> = {
  water: { filter: 'bandpass', frequency: 900, q: 0.6, level: 0.55, swell: [3.1, 0.35], fades: 1 },
  creak: { filter: 'bandpass', frequency: 230, q: 9, level: 1.4, swell: [7.3, 0.8], fades: 0.4 },
  rope: { filter: 'bandpass', frequency: 420, q: 4, level: 0.7, swell: [11, 0.6], fades: 0.4 },
  scrape: { filter: 'bandpass', frequency: 650, q: 1.2, level: 0.7, swell: [17, 0.4], fades: 0.5 },
  fire: { filter: 'lowpass', frequency: 500, q: 0.4, level: 0.6, swell: [5.7, 0.6], fades: 0.8 },
  steam: { filter: 'highpass', frequency: 2600, q: 0.5, level: 0.3, swell: [1.3, 0.15], fades: 1 },
  ratchet: { filter: 'bandpass', frequency: 1700, q: 6, level: 0.8, swell: [14, 1], fades: 0.1 },
  knock: { filter: 'bandpass', frequency: 420, q: 3, level: 2.2, swell: [0, 0], fades: 0.09 },
  thud: { filter: 'lowpass', frequency: 160, q: 1, level: 2.6, swell: [0, 0], fades: 0.22 },
  splash: { filter: 'bandpass', frequency: 1300, q: 0.5, level: 1, swell: [0, 0], fades: 0.6 },
  bow: { filter: 'bandpass', frequency: 190, q: 2.4, level: 2.6, swell: [0, 0], fades: 0.25 },
};

interface Playing {
  gain: GainNode;
  filter: BiquadFilterNode;
  panner: PannerNode;
  nodes: AudioScheduledSourceNode[];
}

export class SoundPlayer {
  private context: AudioContext | null = null;
  private noise: AudioBuffer | null = null;
  private master: GainNode | null = null;
  private loops = new Map<string, Playing>();
  private heard = new Set<string>();
  private narration: HTMLAudioElement | null = null;
  private narrationId = '';
  private level = 1;

  /** From a touch or a key: only then may a page make sound. */
  unlock(): void {
    if (this.context) {
      if (this.context.state === 'suspended') void this.context.resume();
      return;
    }
    this.context = new AudioContext();
    const { sampleRate } = this.context;
    this.noise = this.context.createBuffer(1, 3 * sampleRate, sampleRate);
    const samples = this.noise.getChannelData(0);
    for (let i = 0; i < samples.length; ++i) samples[i] = 2 * Math.random() - 1;
    this.master = this.context.createGain();
    this.master.gain.value = this.level;
    this.master.connect(this.context.destination);
  }
  /** 0..1; 0 is silence. */
  set volume(level: number) {
    this.level = Math.min(Math.max(level, 0), 1);
    if (this.context) this.master?.gain.setTargetAtTime(this.level, this.context.currentTime, 0.1);
    if (this.narration) this.narration.volume = this.level;
  }

  /** Once a picture. */
  hear(camera: PerspectiveCamera, sources: readonly SoundSource[]): void {
    const { context } = this;
    if (!context || context.state !== 'running') return;
    this.listen(camera);
    const loops = new Set<string>();
    for (const source of sources) {
      if (source.looped) {
        loops.add(source.id);
        this.loop(source);
      } else if (!this.heard.has(source.id)) {
        this.heard.add(source.id);
        this.strike(source);
      }
    }
    if (this.heard.size > 500) this.heard.clear();
    for (const [id, playing] of this.loops) {
      if (loops.has(id)) continue;
      playing.gain.gain.setTargetAtTime(0, context.currentTime, 0.08);
      for (const node of playing.nodes) node.stop(context.currentTime + 0.5);
      this.loops.delete(id);
    }
  }
  /** Reads a step's words aloud once. */
  say(id: string, address: string): void {
    if (id === this.narrationId || !this.context) return;
    this.narrationId = id;
    this.narration?.pause();
    this.narration = new Audio(address);
    this.narration.volume = this.level;
    this.narration.play().catch(() => undefined); // without its file a step is silent; its words are written anyway
  }
  silence(): void {
    this.narrationId = '';
    this.narration?.pause();
    this.narration = null;
    for (const playing of this.loops.values()) for (const node of playing.nodes) node.stop();
    this.loops.clear();
  }

  private listen(camera: PerspectiveCamera): void {
    const { listener } = this.context!;
    const q = camera.getWorldQuaternion(new Quaternion());
    const ahead = new Vector3(0, 0, -1).applyQuaternion(q);
    const up = new Vector3(0, 1, 0).applyQuaternion(q);
    const p = camera.position;
    if ('positionX' in listener) {
      const values = [p.x, p.y, p.z, ahead.x, ahead.y, ahead.z, up.x, up.y, up.z];
      const names = ['positionX', 'positionY', 'positionZ', 'forwardX', 'forwardY', 'forwardZ', 'upX', 'upY', 'upZ'] as const;
      names.forEach((name, i) => (listener[name].value = values[i]!));
    }
  }
  private make(source: SoundSource): Playing {
    const context = this.context!;
    const voice = kVoices[source.kind];
    const noise = new AudioBufferSourceNode(context, { buffer: this.noise!, loop: true });
    const filter = new BiquadFilterNode(context, { type: voice.filter, frequency: voice.frequency * source.pitch, Q: voice.q });
    const swelling = new GainNode(context, { gain: 1 });
    const gain = new GainNode(context, { gain: 0 });
    const panner = new PannerNode(context, { panningModel: 'equalpower', distanceModel: 'inverse', refDistance: source.near });
    noise.connect(filter).connect(swelling).connect(gain).connect(panner).connect(this.master!);
    const nodes: AudioScheduledSourceNode[] = [noise];
    const [rate, depth] = voice.swell;
    if (rate > 0) {
      const slow = new OscillatorNode(context, { frequency: rate });
      slow.connect(new GainNode(context, { gain: depth / 2 })).connect(swelling.gain);
      slow.start();
      nodes.push(slow);
    }
    noise.start(0, Math.random() * 2);
    return { gain, filter, panner, nodes };
  }
  private put(panner: PannerNode, p: Vector3): void {
    panner.positionX.value = p.x;
    panner.positionY.value = p.y;
    panner.positionZ.value = p.z;
  }
  private loop(source: SoundSource): void {
    let playing = this.loops.get(source.id);
    if (!playing) {
      playing = this.make(source);
      this.loops.set(source.id, playing);
    }
    const now = this.context!.currentTime;
    const voice = kVoices[source.kind];
    playing.gain.gain.setTargetAtTime(voice.level * source.gain, now, 0.06);
    playing.filter.frequency.setTargetAtTime(voice.frequency * source.pitch, now, 0.06);
    this.put(playing.panner, source.p);
  }
  private strike(source: SoundSource): void {
    const playing = this.make(source);
    const voice = kVoices[source.kind];
    const now = this.context!.currentTime;
    this.put(playing.panner, source.p);
    playing.gain.gain.setValueAtTime(voice.level * source.gain, now);
    playing.gain.gain.setTargetAtTime(0, now, voice.fades / 3);
    for (const node of playing.nodes) node.stop(now + 2 * voice.fades);
  }
}
