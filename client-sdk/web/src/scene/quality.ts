// What pictures may cost: measured, then stepped down or up.

export interface Quality {
  name: 'high' | 'medium' | 'low' | 'least';
  /** Pixels of the drawing for each of the page, at most. */
  ratio: number;
  shadowSize: number;
  /** The sun's shadows are drawn with each picture of so many; 0: only when the view or the world is new. */
  shadowEvery: number;
}
export const kQualities: readonly Quality[] = [
  { name: 'high', ratio: 2, shadowSize: 2048, shadowEvery: 1 },
  { name: 'medium', ratio: 1, shadowSize: 2048, shadowEvery: 2 },
  { name: 'low', ratio: 0.75, shadowSize: 1024, shadowEvery: 4 },
  { name: 'least', ratio: 0.5, shadowSize: 1024, shadowEvery: 12 },
];

const kTooSlow_ms = 1000 / 26;
const kEasy_ms = 1000 / 50;
const kPictures = 30;
const kCalm_ms = 12_000;
/** A pause between pictures: the page was hidden or loaded something. It says nothing of drawing. */
const kPause_ms = 1_000;

/** Without a graphics card every pixel costs. */
export const isSoftware = (renderer: string): boolean => /swiftshader|llvmpipe|software|softpipe/i.test(renderer);

export class QualityGovernor {
  private times: number[] = [];
  private easySince: number | null = null;
  /** Each step up that had to be taken back makes the next one later. */
  private patience = 1;
  private level: number;

  constructor(renderer: string) {
    this.level = isSoftware(renderer) ? kQualities.length - 1 : 0;
  }
  get quality(): Quality {
    return kQualities[this.level]!;
  }
  /** A picture began so long after the one before. True: the quality has changed. */
  drawn(interval: number, now: number): boolean {
    if (interval > kPause_ms) return false;
    this.times.push(interval);
    if (this.times.length < kPictures) return false;
    const median = [...this.times].sort((a, b) => a - b)[kPictures >> 1]!;
    this.times = [];
    if (median > kTooSlow_ms) {
      this.easySince = null;
      if (this.level === kQualities.length - 1) return false;
      ++this.level;
      this.patience *= 2;
      return true;
    }
    if (median > kEasy_ms) this.easySince = null;
    else this.easySince ??= now;
    if (this.easySince === null || this.level === 0 || now - this.easySince < kCalm_ms * this.patience) return false;
    --this.level;
    this.easySince = null;
    return true;
  }
}
