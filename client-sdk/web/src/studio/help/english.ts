import type { HelpWords } from './topics';

export const kEnglishHelp: HelpWords = {
  help: 'Help',
  open: 'Help on this part (F1)',
  close: 'Close the help',
  subjects: 'Subjects',
  search: 'Search the help',
  nothing: 'Nothing in the help has these words.',
  how: 'What you do here',
  tips: 'Good to know',
  keys: 'Keys',
  topics: {
    begin: {
      title: 'Begin',
      what: 'An exhibit is a machine that visitors can touch, with the steps of a visit and the words that they read. You work on a ' +
        'copy, ' +
        'the draft. Visitors see what you have changed only once you publish it.',
      how: [
        'Something new: choose what to begin from, write a name for it, and press Make it. The template of the crank and the rope has a ' +
          'machine that works already.',
        'Something that is there: press Open on its card, or Continue the draft if you or a colleague have begun to change it.',
        'Your first time: press Show me how. It leads you to a machine of your own in ten minutes.',
      ],
      tips: ['All that you do is stored at once. You can close the page and go on another day, at another computer.'],
    },
    picture: {
      title: 'Picture',
      what: 'The scene shows the exhibit at rest, as visitors find it. Here you choose things, put them in their place, bring new ones ' +
        'in, ' +
        'and decide from where visitors look.',
      how: [
        'Click a thing to choose it. Its properties appear at the right. With Shift choose several, and they move together.',
        'Drag beside the things to look around; the wheel goes nearer and farther. Show all leads back to the view of visitors.',
        'Press Move or Turn, then drag the coloured arrows or rings.',
        'Choose a part, such as a post or a crank, and press Insert. It appears in a free place.',
        'Hide what is in the way, or lock it, so that no click takes it. Visitors see it as before.',
        'Press Measure, then click on two points: below stands how far they are from each other.',
        'Keep this view stores where you look from. A step can then show a close-up from there.',
      ],
      tips: ['With Snap on, things move by whole centimetres and turn by 5°. Switch it off for fine work.',
        'For exact places write numbers in the properties: x is to the right, y up, z towards the visitor.'],
      keys: [['← → ↑ ↓', 'look around'], ['Shift + arrows', 'shift the view'], ['+ −', 'nearer, farther'], ['Home', 'show all'],
        ['F', 'show what is chosen'], ['G', 'move it'], ['R', 'turn it'],
        ['H', 'hide it'], ['L', 'lock it'], ['M', 'measure']],
    },
    things: {
      title: 'Things',
      what: 'The contents list all that is in the exhibit: things, joints, hands and ropes, steps. What you choose there has its ' +
        'properties ' +
        'at the right.',
      how: [
        'Choose a thing and set what it weighs, where it is, and how it feels to the hand.',
        'Tick “Fixed” for what stands fast, such as a post or a wall. Tick “A hand may take it” for what visitors should hold.',
        'Under “What touch feels”, “Share that the hand feels” makes heavy things bearable: with 0.05, a stone of 20 kg feels ' +
          'like 1 kg.',
        'The + above the contents adds what is not a body: a hand that may take things, a rope, a ratchet, a quantity, an effect.',
        'Choose “Add a property” for what is not written yet. Without it, the usual value holds.',
      ],
      tips: [
        'What acts on things is called an agent: the hand that takes them, the rope that pulls, the ratchet that holds. Steps switch ' +
          'agents ' +
          'on and off.',
        'A quantity is something that the machine measures, such as the height of the stone. Rules and gauges use it.',
        'A value is stored when you press Enter or leave the field. Esc brings the old one back, Undo takes the last change back.',
      ],
      keys: [['↑ ↓', 'up and down in the contents'], ['← →', 'close and open a group'], ['Enter', 'choose, or store a field'],
        ['Esc', 'give up what is typed']],
    },
    joints: {
      title: 'Joints',
      what: 'A joint says how one thing moves against another. A hinge turns, like a door or a crank; a slider slides, like a drawer; ' +
        'a ball ' +
        'joint turns any way, like a shoulder.',
      how: [
        'Put both things where they belong first. A joint does not follow when a thing is moved later.',
        'Press New joint. Choose what moves, then what it is held by: another thing, or the room.',
        'Choose the kind and the axis. The picture shows both while you choose; the arrow points in the positive direction.',
        'Give the point about which it turns: “Its middle”, or “Its position”, where parts of the library have their axle.',
        'Write two stops if it must not go all the way, such as −90 and 45 for a door. Then press Add.',
      ],
      tips: ['Seen by a visitor, x goes to the right, y up, and z comes towards them: a crank that faces them turns about z.',
        'A crank that turns too easily needs friction: choose the joint, and add “Friction” under “What the joint does”.'],
    },
    steps: {
      title: 'Steps',
      what: 'A visit goes step by step. Each step asks for one thing, such as “Turn the crank”, and goes on when a rule sees that it ' +
        'is done.',
      how: [
        'Press Add a step. What visitors read in it is written under Words.',
        'Press Add a rule and fill it in: a quantity, a comparison and a value. “height > 0.6” goes on once the stone is above 0.6 m.',
        'For a pause without a rule, set “Goes on by itself after” in the step’s properties.',
        'The table shows what acts in each step. Click a circle to switch a hand, a rope or a ratchet on or off from that step on.',
      ],
      tips: ['Three to six steps are plenty. If visitors get stuck, a hint appears after the time set in the step.',
        '“end” as the next step ends the activity; the questions follow, if there are any.'],
    },
    words: {
      title: 'Words',
      what: 'All that visitors read or hear, in all languages of the exhibit, side by side. Words that are missing are counted at the top.',
      how: [
        'Write a title for the exhibit, and for each thing that visitors take.',
        'Write a caption for each step: what to do now, in one short sentence.',
        'Hint and narration are optional. The hint appears when a visitor waits too long; the narration tells more while the step goes on.',
        'Choose “Only missing ones” to see what is still to be written.',
      ],
      tips: ['A caption of up to 60 letters is read at a glance. Say what the hand does: “Take the handle and turn.”'],
    },
    files: {
      title: 'Files',
      what: 'Shapes and sounds of your own: a mesh from a scan or a drawing program, a recording of a voice or a creaking axle.',
      how: [
        'Press Add a file, or drop files here.',
        'Press Make a body beside a mesh. Choose what it is made of, and its weight is worked out from its volume.',
        'A sound is chosen where it is heard: as narration of a step, or as an effect.',
      ],
      tips: ['Meshes are in metres. A mesh with holes has no volume, so its weight must be written.',
        'Simplify scans first: fifty thousand triangles are enough for a thing on a table.'],
    },
    catalogue: {
      title: 'Catalogue',
      what: 'The catalogue lists all that the museum has: exhibits and drafts, meshes and sounds, templates and parts. Use again what a ' +
        'colleague has made, and find out who uses what.',
      how: [
        'Write a word of what you look for. Capitals and accents do not matter; two words must both be there.',
        'Choose a kind, a tag, a licence or a language to see only those.',
        'To use a mesh or a sound of another exhibit, open your draft, then Files, then From the catalogue, and press Take into this ' +
          'draft. You get a copy: if the other changes, yours stays.',
        'Press What it is to write a description, the licence and tags, so that others find it and know whether they may use it.',
        'Open “Used in” below a file to see in which exhibits and lines it is.',
      ],
      tips: ['A file without a licence cannot be shown elsewhere with a clear conscience: write it when you add the file.',
        'Tags in Greek and in English find it for everybody.'],
    },
    try: {
      title: 'Try it',
      what: 'The draft runs here just as visitors will find it, in a world of its own. Nothing changes for visitors.',
      how: [
        'Press Start it, then play: take a thing with the mouse, press and hold, drag; round and round on a crank.',
        'Slow time down, or pause and go on by small steps, to see what happens.',
        'Watch, at the right, shows the quantities over time, and what each step waits for.',
        'Below it stands what does not move and why, with a way to the field that decides it.',
        'Visits, at the right, keeps what you do in the picture as a scripted visit. A visitor does it again whenever you press Let a ' +
          'visitor do it, and you are told which move did not succeed.',
        'What you change goes into what runs, after hands have let go. Where a thing begins elsewhere, or steps have changed, you are told ' +
          'to press Start anew.',
      ],
      keys: [['Ctrl + Enter', 'start, or start anew'], ['P', 'pause, go on'], ['.', 'while paused: 10 ms on'],
        ['Tab, Space, arrows', 'in the exhibit: choose, take, move']],
    },
    versions: {
      title: 'Versions',
      what: 'A version is the draft as it was at a moment that you have named. You can always come back to it.',
      how: [
        'Before you try something bold, write what the draft is now, and press Keep.',
        'Press Restore beside a version to bring it back. This is a change like any other: Undo takes it back, too.',
        'Download the file to keep a copy, or to hand it to a programmer.',
        'Discard the draft ends it. What is published stays as it is.',
      ],
      tips: ['Each time you publish, what visitors had before is kept as a version.'],
    },
    publish: {
      title: 'Publish',
      what: 'Publishing gives your draft to visitors. Problems are what the checker has found in it.',
      how: [
        'Press the button with the number of problems. Each says what is wrong and what to do, and leads to the place.',
        'Errors must be mended first. Warnings may stay, if you know why.',
        'Press Publish and confirm. Visits that go on end in their own time, unless you choose “at once”.',
        'An operator’s account also puts it into use. With an author’s account, ask an operator to load it at the console.',
        'Then open it at a kiosk, and play it through once yourself.',
      ],
    },
    keys: {
      title: 'Keys',
      what: 'All of the studio works without a mouse. Tab goes from part to part, arrows move within one.',
      how: ['Ctrl + K finds everything by name: commands, parts of the page, and all in the contents.'],
      keys: [['F1 or ?', 'help on this part'], ['Ctrl + K', 'all commands and all things, by name'], ['Ctrl + Z', 'undo'],
        ['Ctrl + Shift + Z', 'redo'], ['Ctrl + Enter', 'try the draft'], ['Enter', 'store a field'], ['Esc', 'give up what is typed; ' +
          'close'],
        ['← → ↑ ↓', 'in the contents and in the scene'], ['Home', 'in the scene: show all'], ['F, G, R', 'in the scene: show, move, turn'],
        ['P and .', 'in Try it: pause, one step on']],
    },
  },
};
