// A stand-in for the gateway's studio: one draft of the crane, whose edits, undo and revisions are those of the contract in
// client-sdk/studio. Its scene is a mesh file of the tree.
import { StandIn } from './stand_in.mjs';

const value = (name, value, line = 20) => ({ kind: 'value', name, type: typeof value, value, line });
const set = (name, ...children) => ({ kind: 'set', name, line: 20, children });
const texts = (words) => set('text', ...Object.entries(words).map(([name, text]) => value(name, text)));
const key = (name, type, more = {}) => ({ name, type, doc: `what ${name} is`, ...more });
const number = (name, more = {}) => key(name, 'number', more);
const agent = (type, keys) => ({ name: type, doc: `an agent: ${type}`, keys: [key('type', 'string', { required: true }), ...keys],
  sets: [] });
const rule = [key('quantity', 'string', { names: 'quantity' }), key('op', 'string', { choices: ['<', '=', '>'] }), number('value')];
const text = { name: 'text', keys: [{ name: '*', type: 'string' }], sets: [] };

const kSchema = {
  metadata: [
    { name: 'mechane:scenario', doc: 'the exhibit', keys: [key('languages', 'strings', { names: 'language', required: true }),
      number('effortScale', { least: 1e-4, most: 1, default: 1, doc: 'share of a machine’s loads that the hand feels' })],
    sets: [text, { name: 'quantities', keys: [], sets: [{ name: '*', keys: [key('source', 'string'), key('unit', 'string')], sets: [] }] },
      { name: 'activities', keys: [], sets: [{ name: '*', doc: 'a task for a visitor', keys: [key('first', 'string', { names: 'step' })],
        sets: [text, { name: 'questionnaire', keys: [], sets: [{ name: '*', keys: [key('kind', 'string'), key('answers', 'strings'),
          key('correct', 'string'), number('steps', { least: 2, most: 11, default: 5 })], sets: [text] }] },
        { name: 'steps', keys: [], sets: [{ name: '*', doc: 'one thing to do', keys: [
          key('enable', 'strings', { names: 'agent' }), key('disable', 'strings', { names: 'agent' }),
          number('hintSeconds', { unit: 's', least: 0, most: 3600, default: 20, doc: 'when the hint is shown' }),
          number('timeoutSeconds', { unit: 's', least: 0, most: 3600 }), key('timeoutNext', 'string', { names: 'step' })],
        sets: [text, { name: 'trigger:*', doc: 'what ends the step', keys: [...rule,
          number('holdSeconds', { unit: 's', least: 0, most: 3600 }),
          key('next', 'string', { names: 'step' })], sets: [] }] }] }] }] }] },
    { name: 'mechane:haptic', doc: 'what touch feels', keys: [number('stiffness', { unit: 'N/m', least: 50, most: 3000, default: 600 }),
      number('damping', { unit: 'N s/m', least: 0, most: 20 }), key('graspable', 'boolean')], sets: [] },
    { name: 'mechane:body', doc: 'its shape', keys: [key('model', 'string', { names: 'model' }), key('collides', 'boolean')],
      sets: [text] },
  ],
  agents: [agent('simulation.grasp', [key('bodies', 'strings', { names: 'body' }),
    number('forceLimit', { unit: 'N', least: 0, most: 30 })]),
    agent('geometry.ratchet', [key('joint', 'string', { names: 'joint' }), number('teeth', { least: 3, most: 200 })]),
    agent('geometry.gear', [key('joint1', 'string', { names: 'joint', required: true }),
      key('joint2', 'string', { names: 'joint', required: true }), key('teeth', 'numbers', { least: 1, most: 1e5, count: 2 })])],
  machines: [],
  nodes: [{ name: 'RigidBody', doc: 'a body', keys: [number('mass', { unit: 'kg', least: 0.001, most: 1e6, doc: 'how heavy it is' }),
    key('fixed', 'boolean'), key('position', 'vector', { unit: 'm' })], sets: [] },
  { name: 'SingleAxisHingeJoint', doc: 'a hinge', keys: [key('axis', 'vector'), key('anchorPoint', 'vector', { unit: 'm' })], sets: [] }],
  parts: [{ name: 'block', title: { el: 'Κύβος', en: 'Block' } }],
};

const kMetadata = () => set('mechane:scenario',
  value('format', 1), value('id', 'my-crane'), value('languages', ['el', 'en']), value('effortScale', 0.01),
  texts({ 'title.el': 'Ο γερανός', 'title.en': 'The crane' }),
  set('agents',
    set('HOLD', value('type', 'simulation.grasp'), value('bodies', ['DRUM']), value('forceLimit', 12)),
    set('GUIDE', value('type', 'simulation.grasp'), value('bodies', ['LOAD']), value('forceLimit', 6)),
    set('RATCHET', value('type', 'geometry.ratchet'), value('joint', 'AXLE'), value('teeth', 16))),
  set('quantities', value('held', 'HOLD.active'), set('height', value('source', 'LOAD.position.y'), value('unit', 'm'))),
  set('activities', set('use', texts({ 'title.el': 'Χρήση', 'title.en': 'Use' }), set('steps',
    set('grasp', value('enable', ['HOLD', 'RATCHET']), texts({ 'caption.el': 'Πιάστε τη χειρολαβή.',
      'caption.en': 'Take hold of the handle.' }),
      set('trigger:1', value('quantity', 'held'), value('op', '>'), value('value', 0.5), value('holdSeconds', 0.2), value('next', 'lift'))),
    set('lift', value('hintSeconds', 30), texts({ 'caption.el': 'Ανεβάστε την πέτρα.', 'caption.en': 'Lift the stone.',
      'hint.en': 'Turn anticlockwise.' }),
      set('trigger:1', value('quantity', 'height'), value('op', '>'), value('value', 0.965), value('next', 'guide'))),
    set('guide', value('enable', ['GUIDE']), value('disable', ['HOLD']), texts({ 'caption.el': 'Φέρτε την πέτρα πάνω από τη θέση της.' }),
      value('timeoutSeconds', 90))))));

const kAt = {
  FRAME: [0, 0, 0, 0, 0, 0, 1], WALL: [0, 0, 0, 0, 0, 0, 1], DRUM: [0.3, 0.8, 0, 0, 0, 0, 1], LOAD: [-0.38, 0.186, 0, 0, 0, 0, 1],
};

const problemsOf = (draft) => draft.bodies.filter((b) => Number(b.fields.mass) > 1000).map((b) => ({
  severity: 'warning', message: `${b.def} weighs ${b.fields.mass} kg`, remedy: 'a hand cannot lift more than a tonne: make it lighter',
    line: 80,
  place: 'RigidBody', path: '', node: b.def,
})).concat(find(draft.metadata, 'activities/use/steps/lift/trigger:1/next')?.value === 'nowhere' ? [{
  severity: 'error', message: 'there is no step nowhere', remedy: 'name one of grasp, lift, guide', line: 61, place: 'trigger:1',
  path: 'activities/use/steps/lift/trigger:1/next' }] : []);

function find(from, path) {
  return path.split('/').reduce((at, name) => at?.children?.find((c) => c.name === name), from);
}
/** The set around a path, made where it is not. */
function around(from, path) {
  return path.split('/').slice(0, -1).reduce((at, name) => {
    let next = at.children.find((c) => c.name === name);
    if (!next) at.children.push((next = set(name)));
    return next;
  }, from);
}

class Refused extends Error {}

/** A stylus at the trial's kiosk, as the gateway tells of it. Its program does at once what it is asked for. */
class Stylus {
  told = { user: 0, name: 'Phantom Omni', state: 'ready', kind: 'one-point', side: 'right', request: 'none', details: {
    wanted_hz: 1000, peak_force_n: 3.3, continuous_force_n: 0.88, peak_torque_nm: 0, peak_finger_force_n: 0, max_stiffness_n_per_m: 1000,
    rate_hz: 998, late_us: 240, hand_m: [0.1, 0.7, 0.2], force_n: 0, testing: false, test_force_n: 0, test_energy_j: 0, temperature: 0.25,
    place: { center_m: [0, 0.72, 0.19], turn_rad: 0, scale: 1 },
    workspace_m: { least: [-0.08, -0.06, -0.035], greatest: [0.08, 0.06, 0.035] } } };

  take({ action, place }) {
    const { told } = this;
    told.request = action === 'calibrate' ? 'refused' : 'done';
    if (action === 'test') Object.assign(told.details, { testing: true, test_force_n: 0.62, test_energy_j: 0.0001 });
    if (action === 'end-test') told.details.testing = false;
    if (action === 'place') told.details.place = place;
  }
}

/** A run of the draft: its stone rises once `lift` was called, and the next step comes where the draft's trigger says so. */
class Trial {
  tick = 0;
  pace = 1;
  step = 'lift';
  at = performance.now();
  liftedAt = Infinity;
  stylus = new Stylus();

  constructor(revision, begins, wanted, stepped) {
    Object.assign(this, { revision, begins, wanted, stepped, looks: 0 });
    if (begins) this.step = begins.split('/')[1];
  }
  get height() {
    return Math.min(0.186 + Math.max(this.tick - this.liftedAt, 0) / 1000, 1.2);
  }
  lift() {
    this.liftedAt = this.tick;
  }
  /** The tick and the quantities of a frame: held, height. */
  moment() {
    const now = performance.now();
    this.tick += this.pace * (now - this.at);
    this.at = now;
    this.goOn();
    return { tick: Math.floor(this.tick), quantities: [1, this.height] };
  }
  go({ pace, ticks = 0 }) {
    this.moment();
    this.pace = pace ?? this.pace;
    this.tick = Math.floor(this.tick) + ticks;
    this.goOn();
  }
  goOn() {
    if (this.step !== 'lift' || this.height <= this.wanted) return;
    this.step = 'guide';
    this.stepped();
  }
  told() {
    if (++this.looks === 1) return { state: 'starting', revision: this.revision, pace: 1 };
    const fixed = { kind: 'fixed', text: { el: 'Είναι στερεωμένο στη γη.', en: 'It is fixed to the ground.' },
      remedy: { el: 'Κάντε το κινητό.', en: 'Make it movable.' }, path: 'FRAME/mechane:haptic/stiffness' };
    const off = { kind: 'off', text: { el: 'Η δράση GUIDE είναι κλειστή σε αυτό το βήμα.', en: 'GUIDE is off in this step.' },
      path: 'activities/use/steps/lift/trigger:1/value' };
    return { state: 'running', revision: this.revision, kept: this.kept, begins: this.begins, pace: this.pace,
      kiosk: 'studio-my-crane', activity: 'use', step: this.step,
      devices: [this.stylus.told],
      visit: this.visit, address: '/kiosk/studio-my-crane?token=t', socket: '/ws/kiosk/studio-my-crane?token=t', time_s: this.tick / 1000,
      still: [{ def: 'FRAME', reasons: [fixed] }, ...(this.step === 'lift' ? [{ def: 'LOAD', reasons: [off] }] : [])] };
  }
}

export class StudioStandIn extends StandIn {
  signedIn = true;
  away = false;
  asked = [];
  versions = [];
  files = [{ name: 'bell.ogg', said: 'OggS', url: 'files/bell.ogg', kind: 'sound', bytes: 48213, published: true,
    uses: [{ place: 'audio.el of lift', line: 61, exhibit: 'my-crane', draft: true },
      { place: 'audio.el of throw', line: 40, exhibit: 'catapult', draft: false }] }];
  published = 0;

  constructor(app) {
    super(app, 'pulley-crane', 'DRUM');
    this.draft = {
      metadata: kMetadata(),
      bodies: Object.keys(kAt).map((def) => ({ def, line: 40, pose: kAt[def],
        fields: def === 'DRUM' ? { mass: '12' } : def === 'LOAD' ? { mass: '60' } : { fixed: 'true' },
        sets: { 'mechane:haptic': set('mechane:haptic', value('stiffness', 800)), 'mechane:body':
          set('mechane:body', value('model', 'MODEL')) } })),
      joints: [{ def: 'AXLE', type: 'SingleAxisHingeJoint', line: 90, body1: 'FRAME', body2: 'DRUM',
        fields: { axis: '0 0 1', anchorPoint: '0.3 0.8 0' } }],
      views: [{ def: 'FRONT', type: 'Viewpoint', line: 30, pose: [0.35, 1.6, 4.6, 0, 0, 0, 1], fields: {} }],
    };
    Object.assign(this, { revision: 3, by: 'eleni', undone: [], done: [] });
    this.trial = null;
  }
  question(name) {
    return find(this.draft.metadata, `activities/use/questionnaire/${name}`);
  }
  moment(sequence) {
    return this.trial ? this.trial.moment() : super.moment(sequence);
  }
  /** What its sockets are told when the step is another. */
  begin(step) {
    const world = this.messages.find((m) => m.type === 'world');
    Object.assign(world, { step, quantities: [{ name: 'held', unit: '' }, { name: 'height', unit: 'm' }] });
    this.say(world);
  }
  preview(verb, body) {
    if (verb === '' && body.revision === this.revision) {
      const wanted = find(this.draft.metadata, 'activities/use/steps/lift/trigger:1/value').value;
      this.trial = new Trial(this.revision, body.step, wanted, () => this.begin('guide'));
      this.begin(this.trial.step);
    } else if (verb === '' && 'revision' in body) {
      return [409, { error: 'the draft was changed meanwhile', remedy: 'look at it, and start it again', revision: this.revision }];
    } else if (verb === '/edit') {
      if (this.keptBy) this.trial.kept = { revision: body.revision, by: this.keptBy };
      else this.trial.revision = body.revision;
    } else if (verb === '/pace') {
      this.trial.go(body);
    } else if (verb === '/device') {
      this.trial.stylus.take(body);
    } else if (verb === '/visit') {
      this.trial.visit = { name: body.visit, state: 'incomplete', reason: 'in step lift', moves: [
        { name: 'reach DRUM', ok: true, reason: '' }, { name: 'turn AXLE', ok: false, reason: 'it lost its handle' }] };
    } else if (verb === '/stop') {
      this.trial = null;
    }
    return [200, this.trial ? this.trial.told() : { state: 'none' }];
  }
  view(more = {}) {
    const { metadata, bodies, joints, views } = this.draft;
    return {
      name: 'my-crane', revision: this.revision, by: this.by, canUndo: this.done.length > 0, canRedo: this.undone.length > 0,
      undoes: this.done.at(-1)?.what ?? '', redoes: this.undone.at(-1)?.what ?? '', problems: problemsOf(this.draft), metadata, bodies,
        joints, views,
      outline: [
        ...bodies.map((b) => ({ def: b.def, type: 'RigidBody', line: b.line, pose: b.pose, movable: !b.fields.fixed, children: [] })),
        ...joints.map((j) => ({ def: j.def, type: j.type, line: j.line, children: [] })),
        ...views.map((v) => ({ def: v.def, type: v.type, line: v.line, pose: v.pose, children: [] })),
        { def: 'MODEL', type: 'Inline', line: 31, children: [] }], ...more,
    };
  }
  /** Another author's edit. */
  another(commands) {
    this.step(commands, 'nikos');
  }
  step(commands, by) {
    const before = structuredClone(this.draft);
    try {
      const added = commands.flatMap((command) => this.apply(command));
      this.done.push({ draft: before, what: commands.map((c) => c.op).join(', ') });
      Object.assign(this, { undone: [], by, revision: this.revision + 1 });
      return added;
    } catch (error) {
      this.draft = before;
      throw error;
    }
  }
  apply(command) {
    const body = (def) => this.draft.bodies.find((b) => b.def === def);
    const [root, path] = command.path && /^\w+\/mechane:/.test(command.path)
      ? [{ children: Object.values(body(command.path.split('/')[0]).sets) }, command.path.split('/').slice(1).join('/')]
        : [this.draft.metadata, command.path];
    const name = path?.split('/').at(-1);
    switch (command.op) {
      case 'set': {
        if (name === 'stiffness' && command.value === 666) throw new Refused('stiffness 666 is not one that the arm can bear');
        const parent = around(root, path);
        const old = parent.children.find((c) => c.name === name);
        if (old) old.value = command.value;
        else parent.children.push(value(name, command.value));
        return [];
      }
      case 'add':
        around(root, path).children.push(set(name));
        return [];
      case 'reorder': {
        const { children } = around(root, path);
        const [moved] = children.splice(children.findIndex((c) => c.name === name), 1);
        children.splice(children.findIndex((c) => (command.after ? c.name === command.after : c.kind === 'set')) + (command.after ? 1 : 0),
          0, moved);
        return [];
      }
      case 'remove': {
        const parent = around(root, path);
        parent.children = parent.children.filter((c) => c.name !== name);
        return [];
      }
      case 'field':
        [...this.draft.bodies, ...this.draft.joints, ...this.draft.views].find((n) => n.def === command.node).fields[command.field] =
          command.value;
        return [];
      case 'move':
        [...this.draft.bodies, ...this.draft.views].find((n) => n.def === command.node).pose = command.pose;
        return [];
      case 'join': {
        const { name: def, kind, body1, body2, anchor, axis } = command;
        if (!body(body1) || (body2 && !body(body2))) throw new Refused('there is no such body');
        const type = { hinge: 'SingleAxisHingeJoint', slider: 'SliderJoint', ball: 'BallJoint' }[kind];
        this.draft.joints.push({ def, type, line: 95, body1, body2,
          fields: { ...(anchor && { anchorPoint: anchor.join(' ') }), ...(axis && { axis: axis.join(' ') }) } });
        return [def];
      }
      case 'view': {
        const def = `VIEW_${this.draft.views.length + 1}`;
        this.draft.views.push({ def, type: 'Viewpoint', line: 31, pose: command.pose, fields: { fieldOfView: `${command.fieldOfView}` } });
        return [def];
      }
      case 'insert':
        this.draft.bodies.push({ ...structuredClone(body('DRUM')), def: command.name, fields: { mass: `${command.mass}` },
          pose: [...command.position, 0, 0, 0, 1] });
        return [command.name];
      case 'duplicate': {
        const copy = { ...structuredClone(body(command.node)), def: `${command.node}_2` };
        this.draft.bodies.push(copy);
        return [copy.def];
      }
      case 'delete':
        this.draft.bodies = this.draft.bodies.filter((b) => b.def !== command.node);
        return [];
      default:
        throw new Refused(`this stand-in has no ${command.op}`);
    }
  }
  back(from, to) {
    const step = from.pop();
    to.push({ draft: this.draft, what: step.what });
    Object.assign(this, { draft: step.draft, revision: this.revision + 1 });
  }
  sceneOf() {
    const objects = this.draft.bodies.map((b, index) => ({ index, name: b.def, uri: 'pulley-crane.glb', hash: 'pulley-crane',
      node: b.def.replace(/_\d$/, ''),
      parent: '', pose: b.pose, movable: b.fields.fixed !== 'true', title: { en: b.def } }));
    const presentation = this.messages.find((m) => m.type === 'presentation');
    return { scene: { type: 'scene', objects }, presentation: { ...presentation, affordances: [] } };
  }

  answer(request, response) {
    const { pathname } = new URL(request.url, 'http://stand-in');
    if (!pathname.startsWith('/api/')) return super.answer(request, response);
    if (this.away) return request.socket.destroy();
    if (pathname.endsWith('/picture')) return this.answerPicture(request, response);
    let said = '';
    request.on('data', (bytes) => (said += bytes));
    request.on('end', () => {
      const ways = { files: () => this.answerFiles(request, said), import: () => this.answerImport(request, pathname, said) };
      const [, way] = (this.signedIn && pathname.match(/\/(files|import)\b/)) || [];
      const [status, body] = way ? ways[way]() : this.answerTo(request.method, pathname, said === '' ? {} : JSON.parse(said));
      response.writeHead(status, { 'content-type': 'application/json' });
      response.end(JSON.stringify(body));
    });
  }
  answerPicture(request, response) {
    const parts = [];
    request.on('data', (bytes) => parts.push(bytes));
    request.on('end', () => {
      if (request.method === 'POST') this.picture = Buffer.concat(parts);
      response.writeHead(200, { 'content-type': request.method === 'POST' ? 'application/json' : 'image/webp' });
      response.end(request.method === 'POST' ? '{"kept":true}' : this.picture);
    });
  }
  answerFiles({ method, url, headers }, said) {
    const { pathname, search } = new URL(url, 'http://stand-in');
    const name = decodeURIComponent(pathname.split('/files/')[1] ?? '');
    if (method === 'GET' && name !== '') return [200, { nodes: [{ name: 'wheel', volume: 0.01 }, { name: 'flag', volume: null }] }];
    if (name.endsWith('/delete')) {
      const gone = this.files.find((f) => f.name === name.replace('/delete', ''));
      if (gone.uses.length > 0) return [409, { error: `${gone.name} is used`, remedy: 'remove what uses it first', uses: gone.uses }];
      this.files = this.files.filter((f) => f !== gone);
      return [200, { files: this.files }];
    }
    const old = this.files.find((f) => f.name === name);
    if (method === 'POST') {
      if (headers['content-type'] !== 'application/octet-stream') return [415, { error: 'this is not a file’s bytes', remedy: '' }];
      if (old && old.said !== said && search !== '?replace=1') return [409, { error: `there is another file ${name}`, remedy: '' }];
      const kind = /glb|ply/.test(name) ? 'mesh' : 'sound';
      this.files = [...this.files.filter((f) => f !== old), { name, said, url: `files/${name}`, kind,
        bytes: said.length, published: false, uses: old?.uses ?? [] }];
    }
    return [200, { files: this.files }];
  }
  answerImport({ headers }, path, said) {
    if (headers['content-type'] !== 'application/octet-stream') return [415, { error: 'this is not a file’s bytes', remedy: '' }];
    if (!said.startsWith('PK')) return [400, { error: 'this is not a zip archive, or it is damaged or cut short', remedy: 'export it again' }];
    this.asked.push({ path });
    return [200, this.view()];
  }
  answerTo(method, path, body) {
    const user = { user: 'eleni', role: 'operator', csrf: 'k' };
    if (path === '/api/sign-in') {
      if (body.password !== 'secret') return [401, { error: 'the name or the password is wrong', remedy: 'try again' }];
      this.signedIn = true;
      return [200, user];
    }
    if (!this.signedIn) return [401, { error: 'nobody is signed in', remedy: 'sign in' }];
    const rest = path.replace(/^\/api\/studio\/drafts\/[^/]+/, '');
    if (method === 'POST') this.asked.push({ path, body });
    if (path === '/api/me') return [200, user];
    if (path === '/api/kiosks') return [200, { kiosks: [{ kiosk: 'hall', scenario: 'village', address: '/kiosk/hall?token=t',
      displays: [] }] }];
    if (path === '/api/exhibits') return [200, { exhibits: [] }];
    if (path.startsWith('/api/exhibits/')) return [200, { exhibit: 'my-crane' }];
    if (path === '/api/studio/schema') return [200, kSchema];
    if (path === '/api/studio/exhibits') return [200, {
      exhibits: [{ name: 'my-crane', title: { el: 'Ο γερανός', en: 'The crane' }, draft: { revision: 3, by: 'eleni',
        changed_s: 1764340000, problems: 0 }, picture: this.picture ? String(this.picture.length) : null },
        { name: 'catapult', title: { el: 'Ο καταπέλτης', en: 'The catapult' }, draft: null, picture: null }],
      templates: [{ name: 'empty', title: { el: 'Κενό', en: 'Empty' } },
        { name: 'crank-and-rope', title: { el: 'Μανιβέλα και σχοινί', en: 'A crank and a rope' } }] }];
    if (path === '/api/studio/drafts') return [200, this.view()];
    if (rest === '') return [200, this.view()];
    if (rest === '/export') return [200, { an: 'archive' }];
    if (rest === '/scene') return [200, this.sceneOf()];
    if (rest.startsWith('/preview')) return this.preview(rest.replace('/preview', ''), body);
    if (rest === '/versions') {
      if (method === 'POST') this.versions.push({ number: this.versions.length + 1, title: body.title, by: 'eleni', made_s: 1764340000 });
      return [200, { versions: this.versions }];
    }
    return this.change(rest, body);
  }
  change(rest, body) {
    if (body.revision !== this.revision)
      return [409, { error: 'the draft was changed meanwhile', remedy: 'look at it, and edit again', revision: this.revision }];
    if (rest === '/publish') {
      ++this.published;
      return [200, { published: true }];
    }
    if (rest === '/merge') {
      if (body.from !== 'exhibit:catapult') return [404, { error: 'there is no such exhibit', remedy: 'take one of the list' }];
      this.step([], 'eleni');
      this.done.at(-1).what = 'add catapult';
      return [200, this.view({ merged: [
        { what: 'name', theirs: 'FRAME', here: 'FRAME_2', renamed: true }, { what: 'step', theirs: 'grasp', here: 'grasp_2', renamed: true },
        { what: 'effortScale', theirs: '0.02', here: '0.01', renamed: false }] })];
    }
    if (rest === '/undo') this.back(this.done, this.undone);
    else if (rest === '/redo') this.back(this.undone, this.done);
    else {
      try {
        const added = this.step(body.commands, 'eleni');
        return [200, this.view({ added })];
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
        return [422, { error: error.message, remedy: 'write another', command: 0 }];
      }
    }
    return [200, this.view()];
  }
}
