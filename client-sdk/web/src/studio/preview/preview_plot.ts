// Where things stand in a plot: its ends, its marks, its line.
import { axisEnd } from '../../console/visits';
import type { Sample } from './preview_series';

export interface Span {
  least: number;
  most: number;
}
export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** Of the last `window` ticks, or of all of them (0). A run that is shorter grows into the plot from its left. */
export function shownTicks(first: number, newest: number, window: number): Span {
  if (window === 0) return { least: first, most: Math.max(newest, first + 1) };
  const least = Math.max(0, newest - window);
  return { least, most: least + window };
}
/** All samples from a tick on, and the one before it, so that the line comes in from the edge. */
export function since(samples: readonly Sample[], tick: number): readonly Sample[] {
  const first = samples.findIndex((s) => s.tick > tick);
  return first < 0 ? samples.slice(-1) : samples.slice(Math.max(0, first - 1));
}
/** The values that a plot has to show, with its ends at marks; one value alone gets room on both sides. */
export function spanOf(values: readonly number[], marks: number): Span {
  const known = values.filter(Number.isFinite);
  if (known.length === 0) return { least: 0, most: 1 };
  let [least, most] = known.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]) as [number, number];
  const size = Math.max(Math.abs(least), Math.abs(most), 1e-6);
  if (most - least < 1e-6 * size) [least, most] = [least - size / 10, most + size / 10];
  const step = axisEnd((most - least) / marks);
  return { least: Math.floor(least / step + 1e-9) * step, most: Math.ceil(most / step - 1e-9) * step };
}
/** Round numbers within the span, about so many. */
export function marksIn({ least, most }: Span, count: number): number[] {
  const step = axisEnd((most - least) / count);
  const first = Math.ceil(least / step - 1e-9);
  const marks = Math.floor(most / step + 1e-9) - first + 1;
  return Array.from({ length: Math.max(0, marks) }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}
export const across = (x: number, { least, most }: Span, { left, width }: Box): number => left + ((x - least) / (most - least)) * width;
export const upward = (y: number, { least, most }: Span, { top, height }: Box): number =>
  top + height - ((y - least) / (most - least)) * height;

/** An SVG path of one quantity. Of samples within one pixel only the outermost are drawn; it has a gap where there is no number. */
export function lineOf(samples: readonly Sample[], index: number, ticks: Span, values: Span, box: Box): string {
  let path = '';
  let pen = 'M';
  let column = NaN;
  let [low, high] = [0, 0];
  const put = (x: number, y: number): void => {
    path += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
    pen = 'L';
  };
  for (const { tick, values: all } of samples) {
    const value = all[index];
    if (value === undefined || !Number.isFinite(value)) {
      [pen, column] = ['M', NaN];
      continue;
    }
    const x = Math.max(across(tick, ticks, box), box.left);
    const y = upward(value, values, box);
    if (Math.floor(x) === column && y >= low && y <= high) continue;
    [low, high] = Math.floor(x) === column ? [Math.min(low, y), Math.max(high, y)] : [y, y];
    column = Math.floor(x);
    put(x, y);
  }
  return path;
}
