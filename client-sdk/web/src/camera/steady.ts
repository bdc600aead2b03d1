// The 1 euro filter (Casiez, Roussel, Vogel 2012): what rests is calm, what moves fast comes without delay.

export interface Steadiness {
  /** Of what rests, hertz. */
  cutoff: number;
  /** Hertz more for each unit a second. */
  perSpeed: number;
}

const kSpeedCutoff = 1;
const share = (cutoff: number, dt: number): number => 1 / (1 + 1 / (2 * Math.PI * cutoff * dt));

export class Steady {
  private value: number[] | null = null;
  private speed: number[] = [];
  private at = 0;

  constructor(private readonly by: Steadiness) {}

  forget(): void {
    this.value = null;
  }
  /** `at`: seconds. As many numbers each time. */
  next(raw: readonly number[], at: number): number[] {
    const dt = Math.max(at - this.at, 1e-3);
    const before = this.value;
    this.at = at;
    if (before?.length !== raw.length) {
      this.speed = raw.map(() => 0);
      return (this.value = [...raw]);
    }
    this.value = raw.map((x, k) => {
      const speed = this.speed[k]! + share(kSpeedCutoff, dt) * ((x - before[k]!) / dt - this.speed[k]!);
      this.speed[k] = speed;
      return before[k]! + share(this.by.cutoff + this.by.perSpeed * Math.abs(speed), dt) * (x - before[k]!);
    });
    return this.value;
  }
}
