// The studio's requests, over an author's Api.
import { Api, ApiError, fields, list, text } from '../console/api';
import { reduce, kNothingKnown, type KioskState } from '../wire/messages';
import { catalogueOf, queryText, type About, type Catalogue, type Query } from './shelf/catalogue';
import type { DraftRequests, Order } from './draft';
import { filesOf, nodesOf, type DraftFile, type MeshNode } from './shelf/files';
import type { DeviceOrder } from '../console/devices';
import { previewOf, type Pacing, type Preview } from './preview/preview';
import { schemaOf, type Schema } from './inspector/schema';
import { libraryOf, versionsOf, viewOf, type Library, type Version, type View } from './view';

const at = (name: string, verb = ''): string => `/api/studio/drafts/${encodeURIComponent(name)}${verb}`;

export const studio = (api: Api) => ({
  shelf: async (): Promise<Library> => libraryOf(await api.json('GET', '/api/studio/exhibits')),
  schema: async (): Promise<Schema> => schemaOf(await api.json('GET', '/api/studio/schema')),
  begin: async (name: string, from: string): Promise<View> => viewOf(await api.json('POST', '/api/studio/drafts', { name, from })),
  versions: async (name: string): Promise<Version[]> => versionsOf(await api.json('GET', at(name, '/versions'))),
  keep: (name: string, title: string): Promise<unknown> => api.json('POST', at(name, '/versions'), { title }),
  publish: (name: string, revision: number): Promise<unknown> => api.json('POST', at(name, '/publish'), { revision }),
  discard: (name: string, revision: number): Promise<unknown> => api.json('POST', at(name, '/discard'), { revision }),
  preview: async (name: string): Promise<Preview> => previewOf(await api.json('GET', at(name, '/preview'))),
  /** `step`: where it begins, "use/lift"; "": where the exhibit does. */
  startPreview: async (name: string, revision: number, step: string): Promise<Preview> =>
    previewOf(await api.json('POST', at(name, '/preview'), { revision, ...(step && { step }) })),
  pacePreview: async (name: string, pacing: Pacing): Promise<Preview> =>
    previewOf(await api.json('POST', at(name, '/preview/pace'), pacing)),
  /** The world that runs goes on as the draft is now, where it can. */
  editPreview: async (name: string, revision: number): Promise<Preview> =>
    previewOf(await api.json('POST', at(name, '/preview/edit'), { revision })),
  playVisit: async (name: string, visit: string): Promise<Preview> =>
    previewOf(await api.json('POST', at(name, '/preview/visit'), { visit })),
  askDevice: async (name: string, order: DeviceOrder): Promise<Preview> =>
    previewOf(await api.json('POST', at(name, '/preview/device'), order)),
  stopPreview: async (name: string): Promise<Preview> => previewOf(await api.json('POST', at(name, '/preview/stop'), {})),
  files: async (name: string): Promise<DraftFile[]> => filesOf(await api.json('GET', at(name, '/files'))),
  addFile: async (name: string, file: string, bytes: Blob, replace: boolean): Promise<DraftFile[]> =>
    filesOf(await api.json('POST', `${at(name, '/files')}/${encodeURIComponent(file)}${replace ? '?replace=1' : ''}`, bytes)),
  meshNodes: async (name: string, file: string): Promise<MeshNode[]> =>
    nodesOf(await api.json('GET', `${at(name, '/files')}/${encodeURIComponent(file)}`)),
  deleteFile: async (name: string, file: string): Promise<DraftFile[]> =>
    filesOf(await api.json('POST', `${at(name, '/files')}/${encodeURIComponent(file)}/delete`, {})),
  catalogue: async (query: Query): Promise<Catalogue> => catalogueOf(await api.json('GET', `/api/studio/catalogue?${queryText(query)}`)),
  /** Says of a mesh or sound what it is; `before`: what its author has seen. */
  describe: (path: string, about: About, before: About): Promise<unknown> =>
    api.json('POST', '/api/studio/catalogue/about', { path, about, before }),
  /** The name that it has among the draft's files then. */
  take: async (name: string, path: string): Promise<string> => text(fields(await api.json('POST', at(name, '/take'), { path })).taken),
  /** Edits a draft that is not open here, as it is now. */
  edit: async (name: string, commands: unknown[]): Promise<void> => {
    if (commands.length === 0) return;
    const { revision } = viewOf(await api.json('GET', at(name)));
    await api.json('POST', at(name, '/commands'), { revision, commands });
  },
  /** The draft with all that it uses, as one file. */
  exported: (name: string): Promise<Blob> => api.file(at(name, '/export')),
  imported: async (name: string, bytes: Blob): Promise<View> => viewOf(await api.json('POST', at(name, '/import'), bytes)),
  pictureAddress: (name: string, version: string): string => `${at(name, '/picture')}?${version}`,
  keepPicture: (name: string, webp: Blob): Promise<unknown> => api.json('POST', at(name, '/picture'), webp),
  textAddress: (name: string): string => at(name, '/text'),
  /** What a display would show of the draft at rest. */
  scene: async (name: string): Promise<KioskState> => {
    const said = fields(await api.json('GET', at(name, '/scene')));
    const parts = ['scene', 'presentation'].map((type) => ({ ...fields(said[type]), type }));
    return parts.reduce((state, part) => reduce(state, part), kNothingKnown);
  },
  /** Puts what was published into use. `now`: visits in progress end. */
  load: async (name: string, now: boolean): Promise<void> => {
    const known = list(fields(await api.json('GET', '/api/exhibits')).exhibits).some((e) => text(fields(e).id) === name);
    await api.json('POST', `/api/exhibits/${encodeURIComponent(name)}/${known ? 'replace' : 'load'}`, now ? { now } : {});
  },
});
export type StudioRequests = ReturnType<typeof studio>;

export const draftRequests = (api: Api, name: string): DraftRequests => ({
  view: async () => viewOf(await api.json('GET', at(name))),
  send: async (order: Order, revision: number) => {
    const ask = async (verb: string, more: object = {}): Promise<View> =>
      viewOf(await api.json('POST', at(name, verb), { revision, ...more }));
    switch (order.kind) {
      case 'edit':
        return ask('/commands', { commands: order.edit.commands });
      case 'restore':
        return ask(`/versions/${order.version}/restore`);
      case 'merge':
        return ask('/merge', { from: order.from });
      default:
        return ask(`/${order.kind}`);
    }
  },
  me: () => api.user?.user ?? '',
});

/** An error of the gateway as one sentence. */
export const sentence = (error: unknown): string => {
  if (!(error instanceof ApiError)) throw error;
  return said(error);
};
/** What happened, and what to do. */
export const said = ({ message, remedy }: { message: string; remedy: string }): string =>
  (remedy === '' ? message : `${message}${/[.!?…]$/.test(message) ? '' : ';'} ${remedy}`);
