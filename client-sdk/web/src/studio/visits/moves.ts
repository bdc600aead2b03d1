// Moves of a scripted visit, as the metadata has them, and the commands that write them.
import type { Vector, Command } from '../commands';
import { childSets, metaAt, stringAt, type View } from '../view';

export type Move =
  | { kind: 'reach'; body: string; grip: Vector; seconds: number }
  | { kind: 'grasp'; body: string; seconds: number }
  | { kind: 'move_to'; body: string; position: Vector; orientation: [number, number, number, number]; seconds: number }
  | { kind: 'turn'; joint: string; turns: number; rpm: number }
  | { kind: 'swing'; joint: string; angle: number; cycles: number; perMinute: number }
  | { kind: 'release'; seconds: number }
  | { kind: 'wait'; seconds: number };

/** What the gateway takes in one step. */
export const kMostCommands = 500;

/** The names of the visits that play an activity. */
export const visitsOf = (view: View, activity: string): string[] => childSets(metaAt(view, 'visits'))
  .map((visit) => visit.name).filter((name) => stringAt(view, `visits/${name}/activity`) === activity);

/** Writes a visit; one of this name is replaced. Null: it has more moves than one step can write. */
export function visitCommands(view: View, name: string, activity: string, moves: readonly Move[]): Command[] | null {
  const path = `visits/${name}`;
  const commands: Command[] = metaAt(view, path) ? [{ op: 'remove', path }] : [];
  commands.push({ op: 'set', path: `${path}/activity`, value: activity });
  for (const [i, move] of moves.entries())
    for (const [key, value] of Object.entries(move)) commands.push({ op: 'set', path: `${path}/move:${i + 1}/${key}`, value });
  return commands.length <= kMostCommands ? commands : null;
}

const kComesBackAfter_s = 1;
/** How a hand comes back to what it let go of: as it came there first. */
function again(moves: readonly Move[], to: number): Move[] {
  const grasp = moves.slice(0, to).map((m) => m.kind).lastIndexOf('grasp');
  const reach = moves[grasp - 1];
  if (reach?.kind !== 'reach') return [];
  return [{ kind: 'release', seconds: 0.5 }, { kind: 'wait', seconds: kComesBackAfter_s }, reach, moves[grasp]!];
}

/** The same visit by somebody who lets go half way, turns the wrong way at first, and too fast then. */
export function withMistakes(moves: readonly Move[]): Move[] {
  return moves.flatMap((move, i): Move[] => {
    const back = again(moves, i);
    if (back.length === 0) return [move];
    if (move.kind === 'turn') {
      const first = Number((0.4 * move.turns).toFixed(3));
      return [{ ...move, turns: first }, ...back, { ...move, turns: Number((-0.2 * move.turns).toFixed(3)) },
        { ...move, turns: Number((1.2 * move.turns - first).toFixed(3)), rpm: Number(Math.min(1.6 * move.rpm, 60).toFixed(1)) }];
    }
    // What fell is carried from where it lies.
    if (move.kind === 'move_to' && moves[i - 1]?.kind === 'grasp')
      return [{ kind: 'wait', seconds: 0.5 }, ...back, move];
    return [move];
  });
}
