// Rings and dotted lines at this page's hands: client-sdk/pointer/pointer_aid.cpp, on a canvas of its own.
import { Vector3 } from 'three';
import type { PointerView } from '../wire/messages';

const kGold = 'rgb(250 204 92 / 95%)';
const kWater = 'rgb(140 219 245 / 90%)';
const kShade = 'rgb(13 15 20 / 45%)';

export interface Aid {
  pointer: PointerView | null;
  /** The takeable thing under a resting mouse. */
  hover: Vector3 | null;
  /** The thing that a key would take. */
  focus: { x: number; y: number } | null;
  /** Where the finger or mouse is. */
  finger: { x: number; y: number } | null;
  pixelOf: (p: Vector3) => { x: number; y: number } | null;
  height: number;
}

export function drawAid(context: CanvasRenderingContext2D, aid: Aid): void {
  const unit = Math.max(aid.height / 720, 0.75);
  const dot = (x: number, y: number, radius: number, colour: string): void => {
    for (const [r, fill] of [[radius + 1.4, kShade], [radius, colour]] as const) {
      context.fillStyle = fill;
      context.beginPath();
      context.arc(x, y, r * unit, 0, 2 * Math.PI);
      context.fill();
    }
  };
  const ring = (at: { x: number; y: number }, radius: number, colour: string): void => {
    for (let k = 0; k < 20; ++k) {
      const a = (2 * Math.PI * k) / 20;
      dot(at.x + radius * unit * Math.cos(a), at.y + radius * unit * Math.sin(a), 1.8, colour);
    }
  };
  const line = (from: { x: number; y: number }, to: { x: number; y: number }, colour: string): void => {
    const apart = Math.hypot(to.x - from.x, to.y - from.y);
    const dots = Math.min(Math.floor(apart / (11 * unit)), 200);
    for (let k = 1; k < dots; ++k) {
      const s = (k * 11 * unit) / apart;
      dot(from.x + s * (to.x - from.x), from.y + s * (to.y - from.y), 1.6, colour);
    }
  };
  const circle = (view: PointerView): void => {
    const axle = new Vector3(...view.axle!.p);
    const axis = new Vector3(...view.axle!.d).normalize();
    const arm = new Vector3(...view.p).sub(axle);
    arm.addScaledVector(axis, -arm.dot(axis));
    if (arm.length() < 1e-6) return;
    const x = arm.setLength(view.radius);
    let last: { x: number; y: number } | null = null;
    for (let k = 0; k < 360; ++k) {
      const at = aid.pixelOf(x.clone().applyAxisAngle(axis, (2 * Math.PI * k) / 360).add(axle));
      if (!at || (last && Math.hypot(at.x - last.x, at.y - last.y) < 9 * unit)) continue;
      dot(at.x, at.y, 1.6, kWater);
      last = at;
    }
  };

  if (aid.focus) {
    ring(aid.focus, 30, kGold);
    dot(aid.focus.x, aid.focus.y, 3, kGold);
  }
  const hands = aid.pointer ? [aid.pointer, ...aid.pointer.others].filter((view) => view.phase !== 'resting') : [];
  if (hands.length === 0) {
    const at = aid.hover && aid.pixelOf(aid.hover);
    if (at) ring(at, 20, kGold);
  }
  for (const view of hands) {
    const hand = aid.pixelOf(new Vector3(...view.p));
    if (!hand) continue;
    const holds = view.phase === 'holding';
    if (holds && view.drag === 'turn' && view.axle) circle(view);
    const goal = view.goal && aid.pixelOf(new Vector3(...view.goal));
    if (goal) {
      line(hand, goal, kWater);
      ring(goal, 24, kWater);
    }
    if (view === aid.pointer && view.phase !== 'leaving' && aid.finger) line(aid.finger, hand, kGold);
    ring(hand, holds ? 13 : 20, kGold);
  }
}
