import { describe, expect, it } from 'vitest';
import { freePlace } from '../src/kiosk/place';
import type { PageBox } from '../src/scene/picture';

const bounds: PageBox = { left: 10, top: 10, width: 1260, height: 700 };
const usual: PageBox = { left: 10, top: 590, width: 400, height: 120 };
const buttons: PageBox = { left: 1100, top: 660, width: 160, height: 50 };
const around = (...seen: PageBox[]) => ({ bounds, fixed: [buttons], seen, gap: 10 });
const apart = (a: PageBox, b: PageBox): boolean =>
  a.left + a.width <= b.left || b.left + b.width <= a.left || a.top + a.height <= b.top || b.top + b.height <= a.top;

describe('a caption', () => {
  it('stands as usual where it covers nothing', () => {
    expect(freePlace(around({ left: 600, top: 300, width: 100, height: 100 }), usual, usual)).toBe(usual);
  });
  it('gives way to a hand, to the nearest free place', () => {
    const hand = { left: 300, top: 640, width: 120, height: 80 };
    const now = freePlace(around(hand), usual, usual);
    expect(now).toMatchObject({ width: 400, height: 120 });
    expect(now.top + now.height).toBeLessThanOrEqual(hand.top - 10);
    expect([now, hand, buttons].every((box, i, all) => all.every((other, k) => i === k || apart(box, other)))).toBe(true);
  });
  it('returns once its usual place is free with room to spare, and stays where it is till then', () => {
    const last = { ...usual, top: 300 };
    expect(freePlace(around(), usual, last)).toBe(usual);
    expect(freePlace(around({ left: 420, top: 600, width: 50, height: 60 }), usual, last)).toEqual(last);
    expect(freePlace(around({ left: 420, top: 310, width: 50, height: 60 }), usual, last)).toBe(usual);
  });
  it('covers what matters least where no place is free', () => {
    const hand = { left: 0, top: 0, width: 1280, height: 560 };
    const goal = { left: 0, top: 540, width: 300, height: 180 };
    const far = { left: 650, top: 540, width: 630, height: 180 };
    const now = freePlace(around(hand, goal, far), usual, usual);
    expect(apart(now, hand)).toBe(true);
    expect(apart(now, goal)).toBe(true);
    expect(apart(now, far)).toBe(false);
  });
  it('stays as usual where not even the page has room', () => {
    const large = { ...usual, width: 1300 };
    expect(freePlace(around({ left: 0, top: 0, width: 1280, height: 720 }), large, large)).toBe(large);
  });
  it('finds a free place wherever there is one', () => {
    let [state, free] = [7, 0];
    const next = (most: number): number => (state = (state * 1103515245 + 12345) % 2147483648) % most;
    for (let i = 0; i < 300; ++i) {
      const seen = Array.from({ length: 4 }, () => ({ left: next(1200), top: next(650), width: 20 + next(300), height: 20 + next(200) }));
      const isFree = (box: PageBox): boolean => [...seen, buttons].every((other) => apart(box, other));
      let some = false;
      for (let x = bounds.left; x <= 870; x += 20) for (let y = bounds.top; y <= 590; y += 20)
        some ||= isFree({ ...usual, left: x - 10, top: y - 10, width: 420, height: 140 });  // with the gap around it
      if (!some) continue;
      ++free;
      expect(isFree(freePlace(around(...seen), usual, usual))).toBe(true);
    }
    expect(free).toBeGreaterThan(30);
  });
});
