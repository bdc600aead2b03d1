// Meshes and sounds of a draft, as the gateway lists them, and what a body of a mesh weighs.
import { fields, list, number, text } from '../../console/api';

/** A place where an exhibit names a file. */
export interface FileUse {
  place: string;
  line: number;
  exhibit: string;
  /** It is in its draft; otherwise only in what is published. */
  draft: boolean;
}
export interface DraftFile {
  name: string;
  /** As the exhibit names it. */
  url: string;
  kind: 'mesh' | 'sound';
  bytes: number;
  published: boolean;
  /** By all exhibits. */
  uses: FileUse[];
}
export interface MeshNode {
  name: string;
  /** m³; null: it is open. */
  volume: number | null;
}

export const kMostBytes = 64 * 1024 * 1024;
/** Of an exhibit as one file. */
export const kMostArchiveBytes = 128 * 1024 * 1024;
export const kEndings = ['.glb', '.obj', '.stl', '.ply', '.x3d', '.ogg', '.wav', '.flac'];
/** kg/m³. */
export const kDensities = { oak: 700, pine: 500, stone: 2600, bronze: 8700, iron: 7800, lead: 11300 } as const;
export type Material = keyof typeof kDensities;

export const usesOf = (v: unknown): FileUse[] => list(v).map(fields).map((use) => (
  { place: text(use.place), line: number(use.line), exhibit: text(use.exhibit), draft: use.draft === true }));
export const filesOf = (v: unknown): DraftFile[] => list(fields(v).files).map(fields).map((f) => ({
  name: text(f.name), url: text(f.url), kind: f.kind === 'sound' ? 'sound' : 'mesh', bytes: number(f.bytes),
  published: f.published === true, uses: usesOf(f.uses),
}));
export const nodesOf = (v: unknown): MeshNode[] => list(fields(v).nodes).map(fields)
  .map((n) => ({ name: text(n.name), volume: typeof n.volume === 'number' ? n.volume : null }));

/** The name that the gateway takes: "Τροχός 2.GLB" is "2.glb". */
export function plainName(given: string): string {
  const dot = given.lastIndexOf('.');
  const ending = dot < 0 ? '' : given.slice(dot).toLowerCase();
  const plain = given.slice(0, dot < 0 ? undefined : dot).normalize('NFD').replace(/\p{M}/gu, '').replace(/[^A-Za-z0-9_-]+/g, '-')
    .replace(/^[-_]+|[-_]+$/g, '');
  return `${plain === '' ? 'file' : plain.slice(0, 50)}${ending}`;
}
/** The name that an exhibit's file suggests: "My Crane (2).zip" is "my-crane-2". */
export const exhibitName = (file: string): string => plainName(file).replace(/\.[^.]*$/, '').toLowerCase().replace(/_/g, '-').slice(0, 31)
  .replace(/-+$/, '');
export const isTaken = (name: string): boolean => kEndings.some((ending) => name.endsWith(ending));
/** kg, in three digits; "": it cannot be known. */
export const massOf = (node: MeshNode | undefined, material: Material): string =>
  (node?.volume ? String(Number((node.volume * kDensities[material]).toPrecision(3))) : '');
export const sizeOf = (bytes: number): string =>
  (bytes < 1024 ? `${bytes} B` : bytes < 1024 * 1024 ? `${Math.round(bytes / 1024)} KiB` : `${(bytes / 1024 / 1024).toFixed(1)} MiB`);
