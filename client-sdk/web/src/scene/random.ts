// 32-bit PCG with its RXS-M-XS output (O'Neill 2014), as server/base/random.hpp has it: the same plants and drops everywhere.

export class ShortRandom {
  private state: number;
  constructor(first: number, second = 0, third = 0) {
    this.state = (Math.imul(first, 0x9e3779b9) ^ Math.imul(second, 0x85ebca6b) ^ Math.imul(third, 0xc2b2ae35)) >>> 0;
  }
  /** In [0, 1). */
  unit(): number {
    this.state = (Math.imul(this.state, 747796405) + 2891336453) >>> 0;
    const word = Math.imul((this.state >>> ((this.state >>> 28) + 4)) ^ this.state, 277803737) >>> 0;
    return (((word >>> 22) ^ word) >>> 8) / 0x1000000;
  }
  between(low: number, high: number): number {
    return low + (high - low) * this.unit();
  }
}
