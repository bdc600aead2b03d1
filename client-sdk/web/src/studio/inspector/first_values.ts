// What an agent between joints begins with, so that it works as it was made: its joints, and teeth where it must have some.
import type { Command } from '../commands';
import type { Key } from './schema';
import type { OutlineNode, Value, View } from '../view';

const kSlider = 'SliderJoint';
const kTurnOrSlide = ['SingleAxisHingeJoint', kSlider];
/** Where nothing says how many. */
const kTeeth = { driver: 12, driven: 24, ratchet: 16 };
const kPinion_m = 0.1;
const kPitch_m = 0.02;

/** The keys of a type that name a joint and must be written. */
export const jointKeys = (keys: readonly Key[]): Key[] => keys.filter((k) => k.required && k.names === 'joint');
export const jointsFor = (view: View): string[] => view.joints.filter((j) => kTurnOrSlide.includes(j.type)).map((j) => j.def);

/** The teeth of a wheel that a joint moves, by the name of its shape, as the library has it: GEAR_TEETH_24; null: it has none. */
function teethOf(view: View, joint: string): number | null {
  const found = view.joints.find((j) => j.def === joint);
  const within = (nodes: readonly OutlineNode[], inside: boolean): string[] => nodes.flatMap((n) => {
    const here = inside || (n.def !== '' && [found?.body1, found?.body2].includes(n.def));
    return [...(here ? [n.def] : []), ...within(n.children, here)];
  });
  const [, teeth] = within(view.outline, false).map((def) => /_TEETH_(\d+)/.exec(def)).find((m) => m !== null) ?? [];
  return teeth === undefined ? null : Number(teeth);
}

/** `joints`: by key, "" where none is chosen. */
export function firstCommands(view: View, path: string, type: string, joints: Record<string, string>): Command[] {
  const slides = (key: string): boolean => view.joints.some((j) => j.def === joints[key] && j.type === kSlider);
  const teeth = (key: string, usual: number): number => teethOf(view, joints[key] ?? '') ?? usual;
  const needed = ((): [string, Value] | null => {
    switch (type) {
      case 'geometry.gear':
        if (slides('joint1')) return ['ratio', 1];
        return slides('joint2') ? ['radius', kPinion_m] : ['teeth', [teeth('joint1', kTeeth.driver), teeth('joint2', kTeeth.driven)]];
      case 'geometry.worm':
      case 'geometry.intermittent_gear':
        return ['teeth', teeth('joint2', kTeeth.driven)];
      case 'geometry.ratchet':
        return slides('joint') ? ['pitch', kPitch_m] : ['teeth', teeth('joint', kTeeth.ratchet)];
      default:
        return null;
    }
  })();
  const chosen = Object.entries(joints).filter(([, joint]) => joint !== '');
  return [...chosen, ...(needed ? [needed] : [])].map(([key, value]): Command => ({ op: 'set', path: `${path}/${key}`, value }));
}
