// Where words stand so that they lie over no hand, nothing that can be taken and no goal: client-sdk/draw/text/overlay_place.cpp.
import type { PageBox } from '../scene/picture';
import type { EyePlace } from '../scene/stereo';

/** What is on the page around some words. */
export interface Surroundings {
  /** Where they may stand. */
  bounds: PageBox;
  /** Other words, and buttons. */
  fixed: readonly PageBox[];
  /** Must stay visible; the most important first. */
  seen: readonly PageBox[];
  /** To both. */
  gap: number;
}

/** Most machines stand in the middle: it costs to lie there. */
const kMiddleFrom = 0.2;
const kMiddleHigh = 0.5;
const kMiddleCosts = 2;
/** Words return once their usual place is this many gaps from all that must be seen. */
const kReturns = 3;
/** Of a page's pixels, which are rounded. */
const kRounding = 0.5;

const right = (box: PageBox): number => box.left + box.width;
const below = (box: PageBox): number => box.top + box.height;
const enlarged = (box: PageBox, by: number): PageBox => ({
  left: box.left - by, top: box.top - by, width: box.width + 2 * by, height: box.height + 2 * by,
});

const isWithin = (box: PageBox, bounds: PageBox): boolean =>
  box.left >= bounds.left - kRounding && box.top >= bounds.top - kRounding &&
  right(box) <= right(bounds) + kRounding && below(box) <= below(bounds) + kRounding;

function sharedArea(a: PageBox, b: PageBox): number {
  const across = Math.min(right(a), right(b)) - Math.max(a.left, b.left);
  const down = Math.min(below(a), below(b)) - Math.max(a.top, b.top);
  return across > 0 && down > 0 ? across * down : 0;
}
const covered = (box: PageBox, others: readonly PageBox[]): number => others.reduce((sum, other) => sum + sharedArea(box, other), 0);

/** The way from the usual place, and what it covers of the middle; in heights of the page. */
function costOf(box: PageBox, usual: PageBox, bounds: PageBox): number {
  const middle: PageBox = {
    left: bounds.left + kMiddleFrom * bounds.width,
    top: bounds.top + kMiddleFrom * bounds.height,
    width: (1 - 2 * kMiddleFrom) * bounds.width,
    height: kMiddleHigh * bounds.height,
  };
  const way = Math.hypot(box.left - usual.left, box.top - usual.top) / bounds.height;
  return way + (kMiddleCosts * sharedArea(box, middle)) / (box.width * box.height);
}

/** The cheapest place over no obstacle. A free place can be pushed left and up until it touches, so these places are enough. */
function cheapest(
  bounds: PageBox, usual: PageBox, edges: readonly PageBox[], obstacles: readonly PageBox[], cost: (box: PageBox) => number,
): PageBox | null {
  const { width, height } = usual;
  const beside = edges.flatMap((box) => [Math.ceil(right(box)), Math.floor(box.left - width)]);
  const aboveAndBelow = edges.flatMap((box) => [Math.ceil(below(box)), Math.floor(box.top - height)]);
  const xs = [usual.left, bounds.left, right(bounds) - width, ...beside];
  const ys = [usual.top, bounds.top, below(bounds) - height, ...aboveAndBelow];
  let best: PageBox | null = null;
  let least = Infinity;
  for (const top of ys) {
    for (const left of xs) {
      const box = { left, top, width, height };
      const costs = isWithin(box, bounds) ? cost(box) : Infinity;
      if (costs >= least || covered(box, obstacles) > 0) continue;
      least = costs;
      best = box;
    }
  }
  return best;
}

/** The usual place if it is free with room to spare; else the last; else the cheapest free one; else the one that covers least, and of the
 *  least important. */
export function freePlace({ bounds, fixed, seen, gap }: Surroundings, usual: PageBox, last: PageBox): PageBox {
  const isFree = (box: PageBox): boolean => covered(box, seen) === 0 && covered(box, fixed) === 0;
  if (covered(usual, seen.map((box) => enlarged(box, kReturns * gap))) === 0 && covered(usual, fixed) === 0) return usual;
  if (isFree(last) && isWithin(last, bounds)) return last;
  if (isFree(usual)) return usual;
  // Usual places keep the gap only to within a rounded pixel.
  const apart = fixed.filter((box) => box.width > 0 && box.height > 0).map((box) => enlarged(box, gap - 1));
  const away = seen.map((box) => enlarged(box, gap));
  const cost = (box: PageBox): number => costOf(box, usual, bounds);
  // First the places that do not depend on what moves: words in one of these rest.
  const around = [...apart, ...away];
  const free = cheapest(bounds, usual, apart, around, cost) ?? cheapest(bounds, usual, around, around, cost);
  if (free) return free;
  for (let kept = seen.length; kept >= 0; --kept) {
    const rest = seen.slice(kept);
    const areaFirst = (box: PageBox): number => covered(box, rest) + 0.001 * cost(box);
    const found = cheapest(bounds, usual, [...apart, ...seen], [...apart, ...seen.slice(0, kept)], areaFirst);
    if (found) return found;
  }
  return usual;
}

interface Offset {
  x: number;
  y: number;
}
const shifted = (box: PageBox, by: Offset): PageBox => ({ ...box, left: box.left + by.x, top: box.top + by.y });

/** Where an element was laid out in an eye's page, without its offset. */
function laidOut(element: HTMLElement, eye: HTMLElement): PageBox {
  const box = { left: element.offsetLeft, top: element.offsetTop, width: element.offsetWidth, height: element.offsetHeight };
  for (let above = element.offsetParent; above instanceof HTMLElement && above !== eye; above = above.offsetParent) {
    box.left += above.offsetLeft;
    box.top += above.offsetTop;
  }
  return box;
}

export interface Offsets {
  note: Offset;
  caption: Offset;
}
export const kNoOffsets: Offsets = { note: { x: 0, y: 0 }, caption: { x: 0, y: 0 } };
const kSelectors = { note: '.top', caption: '.caption' };

/** Lets the words of an eye's page give way, and remembers how far. */
export class WordPlaces {
  private texts = { note: '', caption: '' };
  private offsets = kNoOffsets;

  /** In pixels. */
  give(eye: HTMLElement, place: EyePlace, seen: readonly PageBox[]): Offsets {
    const standing = standingWords(eye, place);
    const gap = eye.querySelector<HTMLElement>('footer')?.offsetLeft ?? 0;  // the page's margin
    const bounds = { left: gap, top: gap, width: place.seenWidth - 2 * gap, height: place.seenHeight - 2 * gap };
    const element = (words: keyof Offsets): HTMLElement | null => eye.querySelector<HTMLElement>(kSelectors[words]);
    for (const words of ['note', 'caption'] as const) {
      const text = element(words)?.textContent ?? '';
      if (text !== this.texts[words]) this.offsets = { ...this.offsets, [words]: kNoOffsets[words] };
      this.texts[words] = text;
    }
    // Notes give way first: they are smaller.
    for (const [words, others] of [['note', 'caption'], ['caption', 'note']] as const) {
      const [own, other] = [element(words), element(others)];
      if (!own || own.offsetHeight === 0) continue;
      const fixed = other ? [...standing, shifted(laidOut(other, eye), this.offsets[others])] : standing;
      const usual = laidOut(own, eye);
      const box = freePlace({ bounds, fixed, seen, gap }, usual, shifted(usual, this.offsets[words]));
      this.offsets = { ...this.offsets, [words]: { x: box.left - usual.left, y: box.top - usual.top } };
    }
    return this.offsets;
  }
}

/** Letters a second, and seconds: as the native display has them. */
const kLetters_per_s = 15;
const kLeast_s = 4;
const kEnd_px = 4;

/** Turns to what a long caption has not shown yet, once what it shows has been read; after the last lines come the first. */
export class CaptionPages {
  private text = '';
  private turnedAt = 0;
  private top = 0;

  /** `now`: milliseconds. Captions that a visitor has scrolled stay for as long again. */
  turn(captions: NodeListOf<HTMLElement>, now: number): void {
    const first = captions[0];
    const text = first?.textContent ?? '';
    const isNew = text !== this.text;
    this.text = text;
    if (!first) return;
    const { scrollHeight, clientHeight, scrollTop } = first;
    const letters = (text.length * clientHeight) / scrollHeight;
    if (!isNew && now - this.turnedAt < 1000 * Math.max(letters / kLetters_per_s, kLeast_s)) return;
    this.turnedAt = now;
    const isScrolled = !isNew && Math.abs(scrollTop - this.top) > kEnd_px;
    const isAtEnd = scrollTop + clientHeight >= scrollHeight - kEnd_px;
    const line = parseFloat(getComputedStyle(first).lineHeight) || 0;
    this.top = isScrolled ? scrollTop : isNew || isAtEnd ? 0 : Math.min(scrollTop + clientHeight - line, scrollHeight - clientHeight);
    for (const one of captions) one.scrollTop = this.top;
  }
}

/** What does not give way. */
function standingWords(eye: HTMLElement, place: EyePlace): PageBox[] {
  const of = eye.getBoundingClientRect();
  const [across, down] = [place.seenWidth / place.width, place.seenHeight / place.height];
  return [...eye.querySelectorAll('.title, .gauges, .inset, .buttons button, aside')].map((one) => {
    const { left, top, width, height } = one.getBoundingClientRect();
    return { left: across * (left - of.left), top: down * (top - of.top), width: across * width, height: down * height };
  });
}
