import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { ApiError } from '../src/console/api';
import type { PoseArray } from '../src/wire/messages';
import { degreesOf, numbersFrom, quaternionFrom, switchCommands, wordsCommand, written, type Command } from '../src/studio/commands';
import { Draft, type DraftRequests, type DraftState, type Order } from '../src/studio/draft';
import { exhibitName, filesOf, isTaken, massOf, nodesOf, plainName } from '../src/studio/shelf/files';
import { agentsOf, firstFieldOf, ruleText, stepsOf } from '../src/studio/flow/flow';
import { jointsOfMoved } from '../src/studio/picture/left_behind';
import { joinCommands, markOfJoint, markOfPlan, movableBodies, newPlan, stopsOf } from '../src/studio/picture/joint';
import { isInPicture, unseenFrom } from '../src/studio/picture/seen';
import { isOrdered, orderCommands } from '../src/studio/order';
import { found } from '../src/studio/palette';
import { addAnswer, addQuestion, freeQuestion, isPlainName, isTakenQuestion, questionsOf, removeAnswer, removeQuestion, renameAnswer,
  setCorrect, setKind, type Question } from '../src/studio/flow/questions';
import { kGreekHelp } from '../src/studio/help/greek';
import { docIn, labelOf, setLabel } from '../src/studio/help/labels';
import { helpWords, kTopics, topicsAbout } from '../src/studio/help/topics';
import { beyond, keyIn, namesFor, schemaOf, tableAt } from '../src/studio/inspector/schema';
import { crankOf, isDone, kStops, targetOf } from '../src/studio/tour/stops';
import { tourWords } from '../src/studio/tour/words';
import type { Workspace } from '../src/studio/workspace.svelte';
import { missingIn, wordGroups } from '../src/studio/flow/texts';
import { rowAround, rowsOf, treeOf, whereIs } from '../src/studio/tree';
import { childSets, freePlace, metaAt, stringAt, viewOf, libraryOf, versionsOf, type View } from '../src/studio/view';
import { firstCommands, jointsFor } from '../src/studio/inspector/first_values';
import { nameFault } from '../src/studio/naming';
import { freeTitles, nameOfTitle } from '../src/studio/shelf/new_exhibit';
import { studioWords } from '../src/studio/words';

const value = (name: string, value: unknown) => ({ kind: 'value', name, value, line: 1 });
const set = (name: string, ...children: object[]) => ({ kind: 'set', name, line: 1, children });
const view = (more: object = {}): View => viewOf({
  name: 'crane', revision: 3, by: 'eleni',
  outline: [{ def: 'DRUM', type: 'RigidBody', pose: [0, 1, 0, 0, 0, 0, 1], children: [] }, { def: 'AXLE', type: 'SingleAxisHingeJoint',
    children: [] },
    { def: 'FRONT', type: 'Viewpoint', children: [] }],
  bodies: [{ def: 'DRUM', fields: { mass: '12' }, sets: { 'mechane:haptic': set('mechane:haptic', value('stiffness', 600)),
    'mechane:body': set('mechane:body', set('text', value('title.el', 'Τύμπανο'))) } }],
  joints: [{ def: 'AXLE', type: 'SingleAxisHingeJoint', fields: {}, sets: { 'mechane:agent': set('mechane:agent', value('type',
    'geometry.hinge')) } }],
  metadata: set('mechane:scenario', value('languages', ['el', 'en']), set('text', value('title.el', 'Γερανός'), value('title.en', 'Crane')),
    set('agents', set('HOLD', value('type', 'simulation.grasp'), value('bodies', 'DRUM')), set('PEG')),
    set('quantities', value('held', 'HOLD.active')),
    set('activities', set('use', set('steps',
      set('grasp', value('enable', ['HOLD', 'AXLE']), set('text', value('caption.el', 'Πιάστε'), value('hint.en', 'There'),
        value('audio.el', 'a.ogg')),
        set('trigger:1', value('quantity', 'held'), value('op', '>'), value('value', 0.5), value('holdSeconds', 0.2), value('next',
          'turn'))),
      set('turn', value('disable', 'HOLD'), set('trigger:1', value('match', 'any'),
        set('rule:1', value('quantity', 'held'), value('op', '<'), value('value', 1)), set('rule:2', value('quantity', 'a'), value('op',
          '='), value('value', 2))))))),
    ),
  ...more,
});
const schema = schemaOf({
  metadata: [{ name: 'mechane:scenario', keys: [], sets: [{ name: 'activities', keys: [], sets: [{ name: '*', keys: [{ name: 'first',
    type: 'string' }], sets: [
    { name: 'steps', keys: [], sets: [{ name: '*', keys: [{ name: 'hintSeconds', type: 'number', least: 0, most: 3600 }], sets: [
      { name: 'trigger:*', keys: [{ name: 'next', type: 'string', names: 'step' }], sets: [] }] }] }] }] }] },
  { name: 'mechane:haptic', keys: [{ name: 'stiffness', type: 'number', least: 50 }], sets: [] }],
  agents: [{ name: 'simulation.grasp', keys: [{ name: 'forceLimit', type: 'number' }] }, { name: 'geometry.hinge',
    keys: [{ name: 'viscous', type: 'number' }] }],
});

it('reads the gateway’s answers, whatever is missing', () => {
  for (const nothing of [null, [], 'x', { outline: 3, metadata: [], bodies: [null], problems: {} }])
    expect(() => [viewOf(nothing), schemaOf(nothing), libraryOf(nothing), versionsOf(nothing), treeOf(viewOf(nothing)),
      wordGroups(viewOf(nothing))]).not.toThrow();
  expect(stringAt(view(), 'DRUM/mechane:haptic/stiffness')).toBe('600');
  expect(childSets(metaAt(view(), 'activities/use/steps')).map((s) => s.name)).toEqual(['grasp', 'turn']);
  expect(metaAt(view(), 'activities/none/steps')).toBeUndefined();
});

it('numbers are read as people write them, turns survive their degrees', () => {
  expect(numbersFrom(' 0,5 -1;.25 1e-3 ')).toEqual([0.5, -1, 0.25, 0.001]);
  for (const wrong of ['', 'a', '1 x', '0x10', '1,2,3', 'Infinity']) expect(numbersFrom(wrong)).toBeNull();
  expect(written(0.1 + 0.2)).toBe('0.3');
  for (const degrees of [[0, 0, 0], [90, 0, 0], [10, -20, 30], [0, 90, 0], [-170, 45, 100], [30, -90, 0]]) {
    const q = quaternionFrom(degrees);
    const again = quaternionFrom(degreesOf([0, 0, 0, ...q]));
    expect(Math.abs(q.reduce((dot, x, i) => dot + x * again[i]!, 0))).toBeCloseTo(1, 9);
  }
  expect(degreesOf([0, 0, 0, ...quaternionFrom([10, -20, 30])])).toEqual([10, -20, 30]);
});

it('finds the table of a place, the names that fit there, and the end of a range', () => {
  expect(tableAt(schema, view(), 'activities/use/steps/turn/trigger:7')?.keys[0]?.name).toBe('next');
  expect(keyIn(tableAt(schema, view(), 'activities/use/steps/turn'), 'hintSeconds')?.most).toBe(3600);
  expect(keyIn(tableAt(schema, view(), 'agents/HOLD'), 'forceLimit')).not.toBeNull();
  expect(keyIn(tableAt(schema, view(), 'agents/HOLD'), 'type')).toMatchObject({ choices: ['simulation.grasp', 'geometry.hinge'],
    required: true });
  expect(keyIn(tableAt(schema, view(), 'AXLE/mechane:agent'), 'viscous')).not.toBeNull();
  expect(tableAt(schema, view(), 'nothing/here')).toBeNull();
  expect(namesFor(view(), 'step', 'activities/use/steps/turn/trigger:1/next')).toEqual(['grasp', 'turn', 'end']);
  expect(namesFor(view(), 'agent', '')).toEqual(['HOLD', 'PEG', 'AXLE']);
  // One body that stands for many has their names.
  const coins = (key: string, to: unknown): View => view({ bodies: [{ def: 'POST' }, { def: 'COIN', sets: {
    'mechane:body': set('mechane:body', set('copies', value(key, to))) } }] });
  expect(namesFor(coins('count', 3), 'body', '')).toEqual(['POST', 'COIN-1', 'COIN-2', 'COIN-3']);
  expect(namesFor(coins('positions', [0, 0, 0, 0, 1, 0]), 'body', '', true)).toEqual(['POST', 'COIN-*', 'COIN-1', 'COIN-2']);
  const stiffness = keyIn(tableAt(schema, view(), 'DRUM/mechane:haptic'), 'stiffness')!;
  expect([beyond(stiffness, 49), beyond(stiffness, 1e9)]).toEqual([{ least: 50 }, null]);
});

it('the contents have all that can be selected, filtered by name, and a problem leads to its place', () => {
  const tree = treeOf(view());
  const names = rowsOf(tree, new Set(), '').map((r) => `${r.level}${r.node.group ?? r.node.name}`);
  expect(names).toEqual(['1crane', '1bodies', '2DRUM', '1joints', '2AXLE', '1agents', '2HOLD', '2PEG', '1activities', '2use', '3grasp',
    '3turn',
    '1quantities', '2held', '1views', '2FRONT']);
  const some = rowsOf(tree, new Set(['group:agents']), 'GRASP');
  expect(some.map((r) => r.node.name)).toEqual(['agents', 'HOLD', 'activities', 'use', 'grasp']);
  expect(rowAround(some, 4)).toBe(3);
  expect(rowsOf(tree, new Set(['group:activities']), '').some((r) => r.node.name === 'grasp')).toBe(false);
  expect(whereIs(tree, 'activities/use/steps/turn/trigger:1/value', '')).toEqual(
    { selection: 'path:activities/use/steps/turn', field: 'activities/use/steps/turn/trigger:1/value' });
  expect(whereIs(tree, 'DRUM/mechane:haptic/stiffness', '')?.selection).toBe('node:DRUM');
  expect(whereIs(tree, '', 'AXLE')?.selection).toBe('node:AXLE');
  expect(whereIs(tree, '', '')).toBeNull();
});

it('a new body stands where no other one stands', () => {
  expect(freePlace(view({ bodies: [] }))).toEqual([0, 0.5, 0]);
  const beside = freePlace(view());
  expect(Math.hypot(beside[0], beside[2])).toBeCloseTo(0.8);
  const all = Array.from({ length: 40 }, (_, i) => ({ def: `B${i}`, type: 'RigidBody', pose: [0, 0, 0, 0, 0, 0, 1] }));
  for (const one of all) {
    const [x, , z] = freePlace(view({ outline: all, bodies: all }));
    expect(all.every(({ pose: [px, , pz] }) => Math.hypot(px! - x, pz! - z) > 0.6)).toBe(true);
    one.pose = [x, 0.5, z, 0, 0, 0, 1];
  }
});
it('words are missing where one language has them, or where visitors cannot do without', () => {
  const groups = wordGroups(view());
  const missing = groups.flatMap((g) => g.rows.flatMap((r) => r.missing.map((code) => `${g.name} ${r.what}.${code}`)));
  expect(missing).toEqual(['use title.el', 'use title.en', 'grasp caption.en', 'grasp hint.el', 'turn caption.el', 'turn caption.en',
    'DRUM title.en']);
  expect(missingIn(groups)).toBe(missing.length);
  expect(groups.some((g) => g.rows.some((r) => r.what === 'audio'))).toBe(false);
  // What hands take has a name for visitors, if the author gives one.
  const nameless = wordGroups(view({ bodies: [{ def: 'DRUM' }, { def: 'POST' }] })).filter((g) => g.kind === 'body');
  expect(nameless.map((g) => [g.name, ...g.rows.map((r) => `${r.path}/${r.what} ${r.missing.length}`)])).toEqual([
    ['DRUM', 'DRUM/mechane:body/text/title 0']]);
  // A gauge has words where its quantity is a set of its own.
  const gauge = { kind: 'set', name: 'height', children: [{ kind: 'set', name: 'text', children: [
    { kind: 'value', name: 'label.en', value: 'Height of the load' }] }] };
  const gauges = wordGroups(view({ metadata: { kind: 'set', name: '', children: [
    { kind: 'set', name: 'quantities', children: [gauge, { kind: 'value', name: 'held', value: 'HOLD.active' }] }] } }));
  expect(gauges.filter((g) => g.kind === 'quantity').map((g) => [g.name, ...g.rows.map((r) => [r.path, r.what, r.words])])).toEqual([
    ['height', ['quantities/height/text', 'label', { el: '', en: 'Height of the load' }]]]);
  expect(wordsCommand(view(), 'text/title.el', ' ')).toEqual([{ op: 'remove', path: 'text/title.el' }]);
  expect(wordsCommand(view(), 'text/title.de', '')).toEqual([]);
  expect(wordsCommand(view(), 'text/title.de', ' Kran ')).toEqual([{ op: 'set', path: 'text/title.de', value: 'Kran' }]);
});

it('joints go along where all that they join moves alike; others are named', () => {
  const draft = viewOf({ outline: [{ def: 'POST', type: 'RigidBody', pose: [1, 0, 0, 0, 0, 0, 1] },
    { def: 'ARM', type: 'RigidBody', pose: [1, 1, 0, 0, 0, 0, 1] }], bodies: [{ def: 'POST' }, { def: 'ARM' }], joints: [
    { def: 'AXLE', type: 'SingleAxisHingeJoint', body1: 'POST', body2: 'ARM', fields: { anchorPoint: '1 1 0.5', axis: '0 0 1' } },
    { def: 'RAIL', type: 'SliderJoint', body1: 'POST', body2: '', fields: { axis: '0 0 1' } }] });
  const move = (node: string, ...pose: number[]): Command => ({ op: 'move', node, pose: pose as PoseArray });
  const axle = (field: string, value: string): object => ({ op: 'field', node: 'AXLE', field, value });
  expect(jointsOfMoved(draft, [move('POST', 1.5, 0, 0, 0, 0, 0, 1), move('ARM', 1.5, 1, 0, 0, 0, 0, 1)])).toEqual(
    { together: [axle('anchorPoint', '1.5 1 0.5')], left: [] });
  // A drag rounds each pose for itself.
  expect(jointsOfMoved(draft, [move('POST', 1.50001, 0, 0, 0, 0, 0, 1), move('ARM', 1.5, 1, 0, 0, 0, 0, 1)]).left).toEqual([]);
  expect(jointsOfMoved(draft, [move('ARM', 1, 1.25, 0, 0, 0, 0, 1)])).toEqual(
    { together: [], left: [{ def: 'AXLE', commands: [axle('anchorPoint', '1 1.25 0.5')] }] });
  // A quarter turn about y, of both about the post: the rail's axis turns, its other end is the room.
  const half = Math.SQRT1_2;
  expect(jointsOfMoved(draft, [move('POST', 1, 0, 0, 0, half, 0, half), move('ARM', 1, 1, 0, 0, half, 0, half)])).toEqual({
    together: [axle('anchorPoint', '1.5 1 0'), axle('axis', '1 0 0')],
    left: [{ def: 'RAIL', commands: [{ op: 'field', node: 'RAIL', field: 'axis', value: '1 0 0' }] }] });
  expect(jointsOfMoved(draft, [move('ARM', 1, 1, 0, 0, 0, 0, 1), { op: 'delete', node: 'POST' }])).toEqual({ together: [], left: [] });
});

it('what lies beside the picture of the first view is told', () => {
  const draft = viewOf({ views: [{ def: 'FRONT', type: 'Viewpoint', fields: { fieldOfView: '1.5707963' } }],
    outline: [{ def: 'FRONT', type: 'Viewpoint', pose: [0, 1, 2, 0, 0, 0, 1] }] });
  // Half of a right angle up and down, two metres before the eye; 16 to 9 of it to each side.
  for (const [at, seen] of [[[0, 1, 0], true], [[0, 2.9, 0], true], [[0, 3.1, 0], false], [[3.5, 1, 0], true], [[3.6, 1, 0], false],
    [[0, 1, 4], false]] as const) expect([at, unseenFrom(draft, [...at])]).toEqual([at, seen ? '' : 'FRONT']);
  const turned: PoseArray = [0, 1, 2, 0, Math.SQRT1_2, 0, Math.SQRT1_2];  // looks along -x
  expect([isInPicture(turned, 0.8, [-3, 1, 2]), isInPicture(turned, 0.8, [3, 1, 2])]).toEqual([true, false]);
  expect([unseenFrom(draft, null), unseenFrom(viewOf(null), [0, 0, 0])]).toEqual(['', '']);
});

it('gears begin with the teeth of their wheels, or with usual ones', () => {
  const wheel = (def: string, teeth: number) => ({ def, type: 'RigidBody',
    children: [{ def: `${def}_TEETH_${teeth}`, type: 'CollidableShape' }] });
  const draft = view({ outline: [wheel('SMALL', 12), wheel('LARGE', 36)], bodies: [{ def: 'SMALL' }, { def: 'LARGE' }, { def: 'PLAIN' }],
    joints: [{ def: 'A', type: 'SingleAxisHingeJoint', body1: 'FRAME', body2: 'LARGE' },
      { def: 'B', type: 'SingleAxisHingeJoint', body2: 'SMALL' }, { def: 'C', type: 'SingleAxisHingeJoint', body2: 'PLAIN' },
      { def: 'RACK', type: 'SliderJoint', body2: 'PLAIN' }, { def: 'BALL', type: 'BallJoint' }] });
  expect(jointsFor(draft)).toEqual(['A', 'B', 'C', 'RACK']);
  const made = (type: string, joints: Record<string, string>) =>
    firstCommands(draft, 'agents/G', type, joints).map((c) => (c.op === 'set' ? [c.path.slice('agents/G/'.length), c.value] : []));
  expect(made('geometry.gear', { joint1: 'A', joint2: 'B' })).toEqual([['joint1', 'A'], ['joint2', 'B'], ['teeth', [36, 12]]]);
  expect(made('geometry.gear', { joint1: 'B', joint2: 'C' })[2]).toEqual(['teeth', [12, 24]]);
  expect(made('geometry.gear', { joint1: '', joint2: '' })).toEqual([['teeth', [12, 24]]]);
  expect(made('geometry.gear', { joint1: 'B', joint2: 'RACK' })[2]).toEqual(['radius', 0.1]);
  expect(made('geometry.gear', { joint1: 'RACK', joint2: 'B' })[2]).toEqual(['ratio', 1]);
  expect(made('geometry.worm', { joint1: 'C', joint2: 'A' })[2]).toEqual(['teeth', 36]);
  expect(made('geometry.ratchet', { joint: 'RACK' })[1]).toEqual(['pitch', 0.02]);
  expect(made('geometry.rope', {})).toEqual([]);
});

it('a new exhibit has titles and a name that no other has', () => {
  const exhibit = (name: string, title: object) => ({ name, title, draft: null, picture: null });
  const titles = (...exhibits: object[]) => freeTitles(libraryOf({ exhibits, templates: [] }));
  expect(titles()).toEqual({ el: 'Το έκθεμά μου', en: 'My exhibit' });
  expect(titles(exhibit('a', { el: 'Το έκθεμά μου' }), exhibit('my-exhibit-2', {})).en).toBe('My exhibit 3');
  expect(['My winch', 'No. 2 of St. Mark', 'Βαρούλκο'].map(nameOfTitle)).toEqual(['my-winch', 'no-2-of-st-mark', '']);
});

it('what is wrong with a name is said, and nothing of one that is right', () => {
  const words = studioWords('en');
  for (const right of ['my-crane', '2-cranes', ' my-crane ', 'a', '']) expect(nameFault(right, 'page', words)).toBe('');
  for (const right of ['CRANK_2', 'a-b']) expect(nameFault(right, 'thing', words)).toBe('');
  for (const [wrong, kind, why] of [['my crane', 'page', /blanks/], ['My-crane', 'page', /“M” is a capital/], ['crane_2', 'page', /“_”/],
    ['-crane', 'page', /begin with “-”/], ['crαne', 'page', /“α” is a Greek letter/], ['2CRANK', 'thing', /begin with “2”/],
    ['CRANΚ', 'thing', /“Κ” is a Greek letter/], ['CRANK!', 'thing', /“!”/]] as const)
    expect(nameFault(wrong, kind, words)).toMatch(why);
  expect(nameFault('Γερανός', 'page', studioWords('el'))).toContain('«Γ» είναι ελληνικό');
});

it('numbers in Greek sentences have a comma, and those of other languages a point', () => {
  const [greek, english] = [studioWords('el'), studioWords('en')];
  expect([greek, english].map((w) => w.decimal('0.5 -1.25 m, 3. 1e-3'))).toEqual(['0,5 -1,25 m, 3. 1e-3', '0.5 -1.25 m, 3. 1e-3']);
  expect(stepsOf(view(), 'use').map((step) => ruleText(step.triggers[0]!, greek))[0]).toContain('held > 0,5');
  const all = (words: unknown): string[] => (typeof words === 'string' ? [words] : typeof words === 'object' && words !== null
    ? Object.values(words).flatMap(all) : []);
  const prose = [...all(kGreekHelp), ...all(greek), ...all(tourWords('el'))];
  expect(prose.filter((words) => /\d\.\d/.test(words))).toEqual([]);
});

it('agents stay as they were until a step says otherwise', () => {
  expect(agentsOf(view())).toEqual(['HOLD', 'PEG', 'AXLE']);
  const cells = stepsOf(view(), 'use').map((step) => step.cells.map((c) => `${c.agent}${c.on ? '+' : '-'}${c.said ? '!' : ''}`).join(' '));
  expect(cells).toEqual(['HOLD+! PEG- AXLE+!', 'HOLD-! PEG- AXLE+']);
  const turn = 'activities/use/steps/turn';
  expect(switchCommands(view(), turn, 'PEG', 'on')).toEqual([{ op: 'set', path: `${turn}/enable`, value: ['PEG'] }]);
  expect(switchCommands(view(), turn, 'HOLD', 'same')).toEqual([{ op: 'remove', path: `${turn}/disable` }]);
  expect(switchCommands(view(), turn, 'HOLD', 'on').map((c) => c.op)).toEqual(['set', 'remove']);
  const rules = stepsOf(view(), 'use').map((step) => ruleText(step.triggers[0]!, studioWords('en')));
  expect(rules).toEqual(['held > 0.5 for 0.2 s → turn', 'held < 1 or a = 2 → end']);
  const fields = stepsOf(view(), 'use').map((step) => firstFieldOf(step.triggers[0]!));
  expect(fields).toEqual(['trigger:1/quantity', 'trigger:1/rule:1/quantity']);
});

it('a joint in the making becomes one step, with its axis in the world and stops that go together', () => {
  const draft = view({ outline: [{ def: 'POST', type: 'RigidBody', pose: [0, 0, 0, 0, 0, 0, 1], movable: false },
    { def: 'ARM', type: 'RigidBody', pose: [1, 2, 3, ...quaternionFrom([90, 0, 0])], movable: true }],
  bodies: [{ def: 'POST' }, { def: 'ARM' }], joints: [
    { def: 'JOINT_1', type: 'SliderJoint', body2: 'ARM', fields: { axis: '0 0 2' } }, { def: 'ODD', type: 'MotorJoint' }] });
  expect(movableBodies(draft)).toEqual(['ARM']);
  const plan = { ...newPlan(draft, 'ARM'), frame: 'own' as const, axis: 'y' as const };
  expect(plan.name).toBe('JOINT_2');
  expect(joinCommands(draft, plan)).toBeNull();
  expect(joinCommands(draft, { ...plan, anchor: '0 1,5 0' })).toEqual([
    { op: 'join', kind: 'hinge', body1: 'ARM', anchor: [0, 1.5, 0], axis: [0, 0, 1], name: 'JOINT_2' }]);
  expect(joinCommands(draft, { ...plan, kind: 'slider', against: 'POST', stops: ['0', '0,4'] })).toEqual([
    { op: 'join', kind: 'slider', body1: 'POST', body2: 'ARM', axis: [0, 0, 1], name: 'JOINT_2' },
    { op: 'field', node: 'JOINT_2', field: 'minSeparation', value: '0' },
    { op: 'field', node: 'JOINT_2', field: 'maxSeparation', value: '0.4' }]);
  expect(joinCommands(draft, { ...plan, kind: 'ball', against: 'ARM', anchor: '0 0 0' })).toBeNull();
  for (const stops of [['1', ''], ['', 'a'], ['2', '1']] as [string, string][]) expect(stopsOf({ ...plan, stops })).toBeNull();
  expect(markOfPlan(draft, plan)).toBeNull();
  expect(markOfJoint(draft, 'JOINT_1')).toEqual({ kind: 'slider', at: [1, 2, 3], axis: [0, 0, 2] });
  expect(markOfJoint(draft, 'ODD')).toBeNull();
});

it('files get names that the gateway takes, and bodies of closed meshes their mass', () => {
  expect(['Τροχός 2.GLB', 'Ärm (new).obj', '.ogg', '../x.ply', 'a', 'a.exe'].map(plainName)).toEqual(
    ['2.glb', 'Arm-new.obj', 'file.ogg', 'x.ply', 'a', 'a.exe']);
  expect(['My Crane (2).zip', 'Γερανός.zip', 'a_b.ZIP', `${'x'.repeat(40)}.zip`].map(exhibitName)).toEqual(
    ['my-crane-2', 'file', 'a-b', 'x'.repeat(31)]);
  expect(['a.glb', 'a.exe', 'a'].map(isTaken)).toEqual([true, false, false]);
  expect(massOf({ name: 'a', volume: 0.0123456 }, 'oak')).toBe('8.64');
  expect(massOf({ name: 'a', volume: null }, 'oak')).toBe('');
  for (const nothing of [null, [], { files: [3], nodes: 'x' }]) expect(() => [filesOf(nothing), nodesOf(nothing)]).not.toThrow();
});

it('an added exhibit’s notes are read, whatever is missing', () => {
  expect(view({ merged: [{ what: 'step', theirs: 'lift', here: 'lift_2', renamed: true }, 3] }).merged).toEqual([
    { what: 'step', theirs: 'lift', here: 'lift_2', renamed: true }, { what: '', theirs: '', here: '', renamed: false }]);
  expect(view().merged).toEqual([]);
});

it('the palette finds Greek without accents, and what begins with it first', () => {
  const choices = ['Αναίρεση: μετακίνηση', 'Μετάβαση: DRUM', 'Κείμενα'].map((name) => ({ name, run: () => undefined }));
  expect(found(choices, 'μετα').map((c) => c.name)).toEqual(['Μετάβαση: DRUM', 'Αναίρεση: μετακίνηση']);
  expect(found(choices, 'drum μετ').length).toBe(1);
  expect(found(choices, '').length).toBe(3);
});

it('help has each subject in both languages, and finds it', () => {
  for (const name of kTopics) {
    const [here, there] = [helpWords('en').topics[name], kGreekHelp.topics[name]];
    expect([there.how.length, there.tips?.length, there.keys?.length]).toEqual([here.how.length, here.tips?.length, here.keys?.length]);
  }
  expect(topicsAbout(helpWords('en'), 'Joint')[0]).toBe('joints');
  expect(topicsAbout(kGreekHelp, 'σχοινι καστανια')).toContain('things');
  expect(topicsAbout(kGreekHelp, 'xyz')).toEqual([]);
  expect([labelOf('mass', 'el'), labelOf('unheard', 'el'), setLabel('trigger:2', 'en'), setLabel('odd', 'en')]).toEqual(
    ['Μάζα', '', 'Rule 2', 'odd']);
  expect([docIn('how hard it feels', 'el').lang, docIn('how hard it feels', 'en').lang, docIn('new', 'el').lang]).toEqual(
    ['el', 'en', 'en']);
});

it('a stop of the tour is done when the draft says so, and points at what is there', () => {
  vi.stubGlobal('CSS', { escape: (name: string) => name });
  const body = (def: string, x: number, fields = {}) => ({ def, pose: [x, 0.9, 0, 0, 0, 0, 1], fields });
  const ws = (bodies: ReturnType<typeof body>[], more: object = {}) => ({ part: 'scene', selection: 'path:', joint: null, published: 0, page: { code: 'en' },
    state: {}, view: view({ bodies, outline: bodies, ...more }) }) as unknown as Workspace;
  const first = ws([body('LOAD', 0, { mass: '10' })]);
  expect(kStops.slice(0, 5).map((stop) => isDone(stop, first))).toEqual([true, false, false, false, false]);
  const later = ws([body('LOAD', 0, { mass: '15' }), body('CRANK', 0.7)], { joints: [{ def: 'JOINT_1', body2: 'CRANK', fields: {} }] });
  expect(crankOf(later.view)).toBe('CRANK');
  const low = { def: 'CRANK', pose: [0.7, 0.5, 0, 0, 0, 0, 1], fields: {} };
  expect(isDone('place', ws([body('LOAD', 0), low]))).toBe(false);  // as high as the other
  expect(kStops.slice(2, 8).map((stop) => isDone(stop, later))).toEqual([true, true, true, true, false, false]);
  expect(targetOf('make', null)).toBe('[data-tour="new"]');
  expect(targetOf('words', { ...later, state: { view: later.view } } as unknown as Workspace)).toBe('[data-part="words"]');
  for (const language of ['el', 'en'] as const)
    expect(kStops.every((stop) => Object.values(tourWords(language).stops[stop]).every((said) => said !== ''))).toBe(true);
  vi.unstubAllGlobals();
});

/** A gateway with one draft; `next`: what it answers instead, once each. */
class Gateway implements DraftRequests {
  revision = 3;
  by = 'eleni';
  next: ApiError[] = [];
  heard: { order: Order; revision: number }[] = [];

  async view(): Promise<View> {
    const trouble = this.next.shift();
    if (trouble) throw trouble;
    return view({ revision: this.revision, by: this.by });
  }
  async send(order: Order, revision: number): Promise<View> {
    this.heard.push({ order, revision });
    const trouble = this.next.shift();
    if (trouble) throw trouble;
    if (revision !== this.revision) throw new ApiError(409, 'changed', 'look');
    this.take('eleni');
    return this.view();
  }
  take(by: string): void {
    ++this.revision;
    this.by = by;
  }
  me(): string {
    return 'eleni';
  }
}
const edit = (id: string) => ({ id, what: id, commands: [{ op: 'remove' as const, path: id }] });
const away = new ApiError(0, 'gone', '');

async function begun(): Promise<{ gateway: Gateway; draft: Draft; state: () => DraftState }> {
  const gateway = new Gateway();
  let state: DraftState;
  const draft = new Draft(gateway, (next) => (state = next));
  await draft.open();
  return { gateway, draft, state: () => state };
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it('edits go one after another, each with the revision before it', async () => {
  const { gateway, draft, state } = await begun();
  expect(await Promise.all([draft.edit(edit('a')), draft.edit(edit('b')), draft.undo()])).toEqual(['done', 'done', 'done']);
  expect(gateway.heard.map((h) => h.revision)).toEqual([3, 4, 5]);
  expect(state()).toMatchObject({ waiting: 0, conflict: null });
  expect(await draft.edit({ id: 'c', what: '', commands: [] })).toBe('done');
  expect(gateway.heard.length).toBe(3);
});

it('what is refused is said at its field until it is right', async () => {
  const { gateway, draft, state } = await begun();
  gateway.next = [new ApiError(422, 'too stiff', 'write less')];
  expect(await draft.edit(edit('a'))).toBe('refused');
  expect(state().refusals).toEqual({ a: { message: 'too stiff', remedy: 'write less' } });
  expect(await draft.edit(edit('a'))).toBe('done');
  expect(state().refusals).toEqual({});
});

it('another’s edit is shown, and one’s own waits until it is wanted', async () => {
  const { gateway, draft, state } = await begun();
  gateway.take('nikos');
  const mine = [draft.edit(edit('a')), draft.undo(), draft.edit(edit('b'))];
  await vi.waitFor(() => expect(state().conflict).toEqual({ by: 'nikos', mine: ['a', 'b'] }));
  expect(state().view?.revision).toBe(4);
  expect(await mine[1]).toBe('dropped');
  draft.applyAgain();
  expect([await mine[0], await mine[2]]).toEqual(['done', 'done']);
  expect(gateway.heard.map((h) => h.revision)).toEqual([3, 4, 5]);
  gateway.take('nikos');
  const more = draft.edit(edit('c'));
  await vi.waitFor(() => expect(state().conflict).not.toBeNull());
  draft.dropMine();
  expect(await more).toBe('dropped');
  expect(state()).toMatchObject({ conflict: null, waiting: 0 });
});

it('what somebody else has changed is told, and shown when it is wanted', async () => {
  const { gateway, draft, state } = await begun();
  await draft.look();
  expect(state()).toMatchObject({ theirs: null });
  gateway.take('nikos');
  await draft.look();
  expect(state()).toMatchObject({ theirs: { by: 'nikos', revision: 4 }, view: { revision: 3 } });
  draft.showTheirs();
  expect(state()).toMatchObject({ theirs: null, view: { revision: 4 } });
  gateway.take('nikos');
  await draft.look();
  const mine = draft.edit(edit('a'));
  await vi.waitFor(() => expect(state().conflict?.by).toBe('nikos'));
  expect(state().theirs).toBeNull();
  draft.dropMine();
  await mine;
});

it('while the gateway is away edits wait, and one whose answer was lost is not made twice', async () => {
  const { gateway, draft, state } = await begun();
  gateway.next = [away, new ApiError(503, 'busy', '')];
  const mine = draft.edit(edit('a'));
  await vi.waitFor(() => expect(state().away).toBe(true));
  expect(state().waiting).toBe(1);
  await vi.advanceTimersByTimeAsync(2_000);
  await vi.advanceTimersByTimeAsync(2_000);
  expect(await mine).toBe('done');
  expect(state()).toMatchObject({ away: false, waiting: 0 });
  gateway.next = [away];
  const lost = draft.edit(edit('b'));
  gateway.take('eleni');
  await vi.advanceTimersByTimeAsync(2_000);
  expect(await lost).toBe('done');
  expect(state()).toMatchObject({ conflict: null });
  expect(state().view?.revision).toBe(5);
  gateway.next = [away];
  const other = draft.edit(edit('c'));
  gateway.take('nikos');
  await vi.waitFor(() => expect(state().away).toBe(true));
  draft.hurry();
  await vi.waitFor(() => expect(state().conflict?.by).toBe('nikos'));
  draft.dropMine();
  await other;
});

it('what is refused for another reason than the revision is no conflict', async () => {
  const { gateway, draft, state } = await begun();
  gateway.next = [new ApiError(409, 'there is nothing to undo', '')];
  expect(await draft.undo()).toBe('refused');
  expect(state()).toMatchObject({ conflict: null, refusals: { '': { message: 'there is nothing to undo' } } });
});

it('when the session has ended, edits wait for the next', async () => {
  const { gateway, draft, state } = await begun();
  gateway.next = [new ApiError(401, 'sign in', '')];
  const mine = draft.edit(edit('a'));
  await vi.waitFor(() => expect(state().signedOut).toBe(true));
  expect(state().waiting).toBe(1);
  draft.resume();
  expect(await mine).toBe('done');
  expect(state().signedOut).toBe(false);
});

it('a draft that is not there is said, and not asked for again', async () => {
  const gateway = new Gateway();
  gateway.next = [new ApiError(404, 'there is no draft', 'begin one')];
  let state: DraftState | null = null;
  await new Draft(gateway, (next) => (state = next)).open();
  expect(state).toMatchObject({ view: null, refusals: { '': { message: 'there is no draft' } } });
});

it('a set is moved among its kind, and rules to the next step follow', () => {
  const go = (name: string) => set('trigger:1', value('next', name));
  const made = view({ metadata: set('mechane:scenario', set('visits', set('v', value('activity', 'use'), set('move:1'), set('move:2'))),
    set('activities', set('build'), set('use', value('first', 'a'), set('text'), set('steps', set('a', set('text'), go('b'), set('object:X'),
      set('trigger:2', value('next', 'd'))), set('b', go('a'), value('timeoutSeconds', 9), value('timeoutNext', 'c')),
    set('c', go('d')), set('d', set('trigger:1')))))) });
  const steps = 'activities/use/steps';
  expect(orderCommands(made, `${steps}/a`, -1, true)).toEqual([]);
  expect(orderCommands(made, `${steps}/nothing`, 1, true)).toEqual([]);
  expect(orderCommands(made, `${steps}/d`, -1, false)).toEqual([{ op: 'reorder', path: `${steps}/d`, after: 'b' }]);
  expect(orderCommands(made, `${steps}/d`, -1, true)).toEqual([{ op: 'reorder', path: `${steps}/d`, after: 'b' },
    { op: 'set', path: `${steps}/b/timeoutNext`, value: 'd' }, { op: 'set', path: `${steps}/c/trigger:1/next`, value: 'end' },
    { op: 'set', path: `${steps}/d/trigger:1/next`, value: 'c' }]);
  expect(orderCommands(made, `${steps}/b`, -1, true)).toEqual([{ op: 'reorder', path: `${steps}/b` },
    { op: 'set', path: `${steps}/a/trigger:1/next`, value: 'c' }, { op: 'set', path: `${steps}/b/timeoutNext`, value: 'a' },
    { op: 'set', path: 'activities/use/first', value: 'b' }]);
  expect(orderCommands(made, `${steps}/a/trigger:2`, -1, true)).toEqual(
    [{ op: 'reorder', path: `${steps}/a/trigger:2`, after: 'text' }]);
  expect(orderCommands(made, 'activities/use', -1, true)).toEqual([{ op: 'reorder', path: 'activities/use' }]);
  expect(orderCommands(made, 'visits/v/move:1', 1, true)).toEqual([{ op: 'reorder', path: 'visits/v/move:1', after: 'move:2' }]);
  expect(['activities/use', `${steps}/a`, 'visits/v/move:2', 'agents/HOLD', `${steps}/a/text`].map(isOrdered)).toEqual(
    [true, true, true, false, false]);
});

it('questions change with all that belongs to them', () => {
  const made = view({ metadata: set('mechane:scenario', set('activities', set('use', set('steps'), set('questionnaire',
    set('why', value('kind', 'choice'), value('answers', ['a', 'b', 'c']), value('correct', 'b'),
      set('text', value('question.en', 'Why?'), value('answer:a.en', 'A'), value('answer:b.el', 'Β'), value('answer:b.en', 'B'))),
    set('liked', value('kind', 'scale'), value('steps', 7), set('text', value('low.en', 'no'), value('question.en', 'Q'))))))) });
  const [why, liked] = questionsOf(made, 'use') as [Question, Question];
  expect(why).toEqual({ name: 'why', path: 'activities/use/questionnaire/why', kind: 'choice', answers: ['a', 'b', 'c'], correct: 'b' });
  const at = (commands: Command[]) => commands.map((c) => `${c.op} ${'path' in c ? c.path.split('/').slice(3).join('/') : ''}${
    c.op === 'set' ? ` ${String(c.value)}` : ''}`);
  expect(at(addQuestion('use', 'q', 'choice'))).toEqual(['set q/kind choice', 'set q/answers answer-1,answer-2', 'add q/text']);
  expect(at(addQuestion('use', 'q', 'scale'))).toEqual(['set q/kind scale', 'add q/text']);
  expect(at(setKind(made, why, 'scale'))).toEqual(['set why/kind scale', 'remove why/answers', 'remove why/correct',
    'remove why/text/answer:a.en', 'remove why/text/answer:b.el', 'remove why/text/answer:b.en']);
  expect(at(setKind(made, liked, 'choice'))).toEqual(['set liked/kind choice', 'remove liked/steps', 'remove liked/text/low.en',
    'set liked/answers answer-1,answer-2']);
  expect(at(removeAnswer(made, why, 'b'))).toEqual(['set why/answers a,c', 'remove why/correct', 'remove why/text/answer:b.el',
    'remove why/text/answer:b.en']);
  expect(at(renameAnswer(made, why, 'b', 'x'))).toEqual(['set why/answers a,x,c', 'set why/correct x', 'set why/text/answer:x.el Β',
    'remove why/text/answer:b.el', 'set why/text/answer:x.en B', 'remove why/text/answer:b.en']);
  expect(at(addAnswer(why))).toEqual(['set why/answers a,b,c,answer-1']);
  expect([setCorrect(why, 'b'), at(setCorrect(why, '')), at(setCorrect(liked, 'a'))]).toEqual([[], ['remove why/correct'],
    ['set liked/correct a']]);
  expect(removeQuestion(made, why)).toEqual([{ op: 'remove', path: why.path }]);
  expect([isTakenQuestion(made, 'use', 'why'), freeQuestion(made, 'use')]).toEqual([true, 'question-1']);
  expect(['a-1', '1a', 'two words', 'ά', ''].map(isPlainName)).toEqual([true, false, false, false, false]);
});
