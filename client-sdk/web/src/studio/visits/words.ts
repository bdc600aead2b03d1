// Words about scripted visits, beside a draft that is tried.
import { studioWords, type Language } from '../words';
import type { Move } from './moves';

export interface VisitWords {
  resting: string;
  byYou: string;
  byVisitor: string;
  intro: string;
  afterVisitor: string;
  midway: string;
  leftOut: string;
  name: string;
  mistakes: string;
  save: string;
  replace: string;
  tooLong: string;
  forget: string;
  saved: (name: string) => string;
  edit: (name: string) => string;
  play: string;
  end: string;
  visit: string;
  none: string;
  state: Record<'playing' | 'done' | 'incomplete' | 'failed', string>;
  moves: (done: number, all: number) => string;
  failed: string;
  move: (move: Move) => string;
}

const place = (p: readonly number[]): string => p.map((x) => x.toFixed(2)).join(' ');
const size = (x: number): string => Math.abs(x).toFixed(2);

const kDecimal = studioWords('el').decimal;

const kEnglish: VisitWords = {
  resting: 'While the draft runs, you can show here once what a visitor is to do, and have a scripted ' +
    'visitor do it.',
  byYou: 'Shown by you',
  byVisitor: 'Done by a visitor',
  intro: 'Do it once in the picture: take things, carry them, turn them. What you do becomes a scripted visit, which does it again ' +
    'whenever you want to know whether the exhibit still works.',
  afterVisitor: 'A visitor has been here. To do it yourself, begin the activity anew.',
  midway: 'This trial began at a later step, and a visit begins at the start: start it anew from there.',
  leftOut: 'A visit has one hand. What a second hand did at the same time is not in it.',
  name: 'Its name',
  mistakes: 'and one that lets go half way and turns the wrong way',
  save: 'Keep it as a visit',
  replace: 'Replace the visit',
  tooLong: 'There are too many moves for one visit. Forget them, and do it with fewer.',
  forget: 'Forget it',
  saved: (name) => `The draft has the visit ${name} now.`,
  edit: (name) => `visit ${name}`,
  play: 'Let a visitor do it',
  end: 'Send the visitor away',
  visit: 'Visit',
  none: 'This activity has no scripted visit yet.',
  state: { playing: 'It is being played …', done: 'The visitor has done it.', incomplete: 'The visitor has not done it.',
    failed: 'No visitor came:' },
  moves: (done, all) => `${done} of ${all} moves succeeded`,
  failed: 'did not succeed',
  move: (move) => {
    switch (move.kind) {
      case 'reach': return `reach for ${move.body}`;
      case 'grasp': return `take ${move.body}`;
      case 'move_to': return `bring ${move.body} to ${place(move.position)}`;
      case 'turn': return `turn ${move.joint} by ${size(move.turns)} turns ${move.turns < 0 ? 'backwards' : 'forwards'}`;
      case 'swing': return `swing ${move.joint} to and fro ${move.cycles} times`;
      case 'release': return 'let go';
      case 'wait': return `wait ${move.seconds.toFixed(1)} s`;
    }
  },
};

const kGreek: VisitWords = {
  resting: 'Όσο τρέχει το σχέδιο, μπορείτε να δείξετε εδώ μία φορά τι θα κάνει ο επισκέπτης, ' +
    'και να βάλετε έναν έτοιμο επισκέπτη να το κάνει.',
  byYou: 'Όπως το δείξατε',
  byVisitor: 'Από έναν επισκέπτη',
  intro: 'Κάντε το μία φορά μέσα στην εικόνα: πιάστε πράγματα, μεταφέρετέ τα, γυρίστε τα. Ό,τι κάνετε γίνεται έτοιμη επίσκεψη, που το ' +
    'επαναλαμβάνει όποτε θέλετε να δείτε αν το έκθεμα δουλεύει ακόμη.',
  afterVisitor: 'Πέρασε ένας επισκέπτης. Για να το κάνετε εσείς, αρχίστε τη δραστηριότητα από την αρχή.',
  midway: 'Αυτή η δοκιμή άρχισε από μεταγενέστερο βήμα, ενώ μια επίσκεψη αρχίζει από την αρχή: ξεκινήστε την πάλι από εκεί.',
  leftOut: 'Μια επίσκεψη έχει ένα χέρι. Ό,τι έκανε ταυτόχρονα ένα δεύτερο χέρι δεν περιλαμβάνεται.',
  name: 'Το όνομά της',
  mistakes: 'και μία που αφήνει στη μέση και γυρίζει ανάποδα',
  save: 'Κράτησέ το ως επίσκεψη',
  replace: 'Αντικατάσταση της επίσκεψης',
  tooLong: 'Οι κινήσεις είναι πάρα πολλές για μία επίσκεψη. Ξεχάστε τις, και κάντε το με λιγότερες.',
  forget: 'Ξέχασέ το',
  saved: (name) => `Το σχέδιο έχει τώρα την επίσκεψη ${name}.`,
  edit: (name) => `επίσκεψη ${name}`,
  play: 'Να το κάνει ένας επισκέπτης',
  end: 'Να φύγει ο επισκέπτης',
  visit: 'Επίσκεψη',
  none: 'Η δραστηριότητα αυτή δεν έχει ακόμη έτοιμη επίσκεψη.',
  state: { playing: 'Παίζεται …', done: 'Ο επισκέπτης τα κατάφερε.', incomplete: 'Ο επισκέπτης δεν τα κατάφερε.',
    failed: 'Δεν ήρθε επισκέπτης:' },
  moves: (done, all) => `πέτυχαν ${done} από ${all} κινήσεις`,
  failed: 'δεν πέτυχε',
  move: (move) => {
    switch (move.kind) {
      case 'reach': return `απλώστε το χέρι προς ${move.body}`;
      case 'grasp': return `πιάστε ${move.body}`;
      case 'move_to': return `φέρτε ${move.body} στο ${kDecimal(place(move.position))}`;
      case 'turn': return `γυρίστε ${move.joint} κατά ${kDecimal(size(move.turns))} στροφές ${move.turns < 0 ? 'ανάποδα' : 'εμπρός'}`;
      case 'swing': return `κουνήστε ${move.joint} πέρα-δώθε ${move.cycles} φορές`;
      case 'release': return 'αφήστε';
      case 'wait': return `περιμένετε ${kDecimal(move.seconds.toFixed(1))} s`;
    }
  },
};

export const visitWords = (language: Language): VisitWords => (language === 'el' ? kGreek : kEnglish);
