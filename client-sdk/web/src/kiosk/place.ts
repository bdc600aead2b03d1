// Where words stand so that they lie over no hand, nothing that can be taken and no goal: client-sdk/draw/text/overlay_place.cpp.
import type { EyePlace } from '../scene/stereo';

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** What is on the page around some words. */
export interface Surroundings {
  /** Where they may stand. */
  bounds: Box;
  /** Other words, and buttons. */
  fixed: readonly Box[];
  /** Must stay visible; the most important first. */
  seen: readonly Box[];
  /** To both. */
  gap: number;
}

/** Most machines stand in the middle: it costs to lie there. */
const kMiddleFrom = 0.2;
const kMiddleHigh = 0.5;
const kMiddleCosts = 2;
/** So many gaps lie between the usual place and what was in it before words return. */
const kReturns = 3;
/** Of a page's pixels, which are rounded. */
const kRounding = 0.5;

const right = (box: Box): number => box.left + box.width;
const below = (box: Box): number => box.top + box.height;
const enlarged = (box: Box, by: number): Box => ({
  left: box.left - by, top: box.top - by, width: box.width + 2 * by, height: box.height + 2 * by,
});

const isWithin = (box: Box, bounds: Box): boolean =>
  box.left >= bounds.left - kRounding && box.top >= bounds.top - kRounding &&
  right(box) <= right(bounds) + kRounding && below(box) <= below(bounds) + kRounding;

function sharedArea(a: Box, b: Box): number {
  const across = Math.min(right(a), right(b)) - Math.max(a.left, b.left);
  const down = Math.min(below(a), below(b)) - Math.max(a.top, b.top);
  return across > 0 && down > 0 ? across * down : 0;
}
const covered = (box: Box, others: readonly Box[]): number => others.reduce((sum, other) => sum + sharedArea(box, other), 0);

/** The way from the usual place, and what it covers of the middle; in heights of the page. */
function costOf(box: Box, usual: Box, bounds: Box): number {
  const middle: Box = {
    left: bounds.left + kMiddleFrom * bounds.width,
    top: bounds.top + kMiddleFrom * bounds.height,
    width: (1 - 2 * kMiddleFrom) * bounds.width,
    height: kMiddleHigh * bounds.height,
  };
  const way = Math.hypot(box.left - usual.left, box.top - usual.top) / bounds.height;
  return way + (kMiddleCosts * sharedArea(box, middle)) / (box.width * box.height);
}

/** The cheapest place over no obstacle. A free place can be pushed left and up until it touches, so these places are enough. */
function cheapest(bounds: Box, usual: Box, edges: readonly Box[], obstacles: readonly Box[], cost: (box: Box) => number): Box | null {
  const { width, height } = usual;
  const beside = edges.flatMap((box) => [Math.ceil(right(box)), Math.floor(box.left - width)]);
  const aboveAndBelow = edges.flatMap((box) => [Math.ceil(below(box)), Math.floor(box.top - height)]);
  const xs = [usual.left, bounds.left, right(bounds) - width, ...beside];
  const ys = [usual.top, bounds.top, below(bounds) - height, ...aboveAndBelow];
  let best: Box | null = null;
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

/** As usual, with room to spare, or as it was, or where it covers nothing; or else where it covers the least important, and of that as
 *  little as can be. */
export function freePlace({ bounds, fixed, seen, gap }: Surroundings, usual: Box, last: Box): Box {
  const isFree = (box: Box): boolean => covered(box, seen) === 0 && covered(box, fixed) === 0;
  if (covered(usual, seen.map((box) => enlarged(box, kReturns * gap))) === 0 && covered(usual, fixed) === 0) return usual;
  if (isFree(last) && isWithin(last, bounds)) return last;
  if (isFree(usual)) return usual;
  const apart = fixed.map((box) => enlarged(box, gap - 1));  // a usual place keeps it only as well as pixels are rounded
  const away = seen.map((box) => enlarged(box, gap));
  const free = cheapest(bounds, usual, [...apart, ...away], [...apart, ...away], (box) => costOf(box, usual, bounds));
  if (free) return free;
  for (let kept = seen.length; kept >= 0; --kept) {
    const rest = seen.slice(kept);
    const cost = (box: Box): number => covered(box, rest) + 0.001 * costOf(box, usual, bounds);
    const found = cheapest(bounds, usual, [...apart, ...seen], [...apart, ...seen.slice(0, kept)], cost);
    if (found) return found;
  }
  return usual;
}

const kWords = ['.top', '.caption'];
type Way = { x: number; y: number };
const moved = (box: Box, by: Way): Box => ({ ...box, left: box.left + by.x, top: box.top + by.y });

/** Where an element was laid out in an eye's page, without the way that it has gone since. */
function laidOut(element: HTMLElement, eye: HTMLElement): Box {
  const box = { left: element.offsetLeft, top: element.offsetTop, width: element.offsetWidth, height: element.offsetHeight };
  for (let above = element.offsetParent; above instanceof HTMLElement && above !== eye; above = above.offsetParent) {
    box.left += above.offsetLeft;
    box.top += above.offsetTop;
  }
  return box;
}

/** Lets the words of an eye's page give way, and remembers how far. */
export class WordPlaces {
  private gone = kWords.map(() => ({ text: '', by: { x: 0, y: 0 } }));

  /** How far notes and captions give way, in pixels. The notes first: they are smaller. */
  give(eye: HTMLElement, place: EyePlace, seen: readonly Box[]): Way[] {
    const words = kWords.map((name) => eye.querySelector<HTMLElement>(name));
    this.gone = this.gone.map(({ text, by }, k) => {
      const now = words[k]?.textContent ?? '';
      return { text: now, by: now === text ? by : { x: 0, y: 0 } };
    });
    const gap = eye.querySelector<HTMLElement>('footer')?.offsetLeft ?? 0;  // the page's margin
    words.forEach((element, k) => {
      if (!element || element.offsetHeight === 0) return;
      const usual = laidOut(element, eye);
      const fixed = words.flatMap((other, i) => (other && i !== k ? [moved(laidOut(other, eye), this.gone[i]!.by)] : []));
      const bounds = { left: gap, top: gap, width: place.seenWidth - 2 * gap, height: place.seenHeight - 2 * gap };
      const around = { bounds, fixed: [...fixed, ...standing(eye, place)], seen, gap };
      const box = freePlace(around, usual, moved(usual, this.gone[k]!.by));
      this.gone[k]!.by = { x: box.left - usual.left, y: box.top - usual.top };
    });
    return this.gone.map(({ by }) => by);
  }
}

/** Letters a second, and seconds: as the native display has them. */
const kLetters_per_s = 15;
const kLeast_s = 4;
const kEnd_px = 4;

/** Turns to what a long caption has not shown yet, once what it shows has been read; after the last lines come the first. */
export class CaptionPages {
  private text = '';
  private turned = 0;

  /** `now`: milliseconds. */
  turn(captions: Iterable<HTMLElement>, now: number): void {
    const [first] = captions;
    if (!first) return;
    const { scrollHeight, clientHeight, scrollTop } = first;
    const text = first.textContent ?? '';
    const again = text !== this.text;
    const letters = (text.length * clientHeight) / scrollHeight;
    if (!again && now - this.turned < 1000 * Math.max(letters / kLetters_per_s, kLeast_s)) return;
    this.text = text;
    this.turned = now;
    const line = parseFloat(getComputedStyle(first).lineHeight) || 0;
    const last = scrollTop + clientHeight >= scrollHeight - kEnd_px;
    const top = again || last ? 0 : scrollTop + clientHeight - line;
    for (const one of captions) one.scrollTo({ top, behavior: 'smooth' });
  }
}

/** What does not give way. */
function standing(eye: HTMLElement, place: EyePlace): Box[] {
  const of = eye.getBoundingClientRect();
  const [across, down] = [place.seenWidth / place.width, place.seenHeight / place.height];
  return [...eye.querySelectorAll('.title, .gauges, .inset, .buttons button, aside')].map((one) => {
    const { left, top, width, height } = one.getBoundingClientRect();
    return { left: across * (left - of.left), top: down * (top - of.top), width: across * width, height: down * height };
  });
}
