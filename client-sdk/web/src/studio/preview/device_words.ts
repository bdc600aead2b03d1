// Words about the haptic devices of a trial.
import type { Language } from '../words';
import type { kAnswers } from '../../console/devices';

export interface DeviceWords {
  tab: string;
  title: string;
  device: (n: number) => string;
  states: Record<string, string>;
  none: string;
  resting: string;
  comes: string;
  limits: (peak: string, long: string) => string;
  fingers: (most: string) => string;
  readsOnly: string;
  rate: (now: string, wanted: string) => string;
  late: (ms: string) => string;
  force: (newtons: string) => string;
  warmth: (percent: string) => string;
  test: string;
  endTest: string;
  testHelp: string;
  testing: string;
  tested: (newtons: string, millijoules: string) => string;
  fit: string;
  fitHelp: string;
  answers: Record<(typeof kAnswers)[number], string>;
  refused: (why: string) => string;
  place: string;
  placeHelp: string;
  above: string;
  front: string;
  center: (axis: string) => string;
  turn: string;
  scale: string;
  around: string;
  everything: string;
  fill: string;
  unreached: (names: string) => string;
  unknownReach: string;
  put: string;
  back: string;
  wrongPlace: string;
  keep: string;
  map: (view: string) => string;
}

const kEnglish: DeviceWords = {
  tab: 'Devices',
  title: 'Haptic devices',
  device: (n) => `device ${n}`,
  states: { preparing: 'is being prepared', ready: 'ready', 'let-go': 'nobody holds it', 'not-ready': 'not held, or switched off',
    uncalibrated: 'to be calibrated', warm: 'warm, its force is lowered', hot: 'too hot', lost: 'gone or faulty' },
  none: 'No device is connected yet.',
  resting: 'While the draft runs, haptic devices that are at it are listed here, with their tests and the place of their hands.',
  comes: 'To feel what runs here, start this on the machine of a device:',
  limits: (peak, long) => `up to ${peak} N, ${long} N for long`,
  fingers: (most) => `up to ${most} N on a finger`,
  readsOnly: 'reads the hand, and renders no force',
  rate: (now, wanted) => `${now} of ${wanted} times a second`,
  late: (ms) => `${ms} ms late at most`,
  force: (newtons) => `${newtons} N now`,
  warmth: (percent) => `motors ${percent} % warm`,
  test: 'Test it',
  endTest: 'End the test',
  testHelp: 'For 20 s there is a soft floor 1 cm under the hand, and nothing of the exhibit; fingers of a glove are held half closed. ' +
    'At most 1 N.',
  testing: 'Being tested: press down gently.',
  tested: (newtons, millijoules) => `In the test: ${newtons} N at most, ${millijoules} mJ given out (good: near 0).`,
  fit: 'Fit to the hand',
  fitHelp: 'The page shows three poses: flat hand, fist, thumb and index finger as a ring.',
  answers: { none: '', waiting: 'Asking the device ...', done: 'Done.', refused: '',
    silent: 'Its program does not answer. Look whether it still runs.' },
  refused: (why) => `Not done: ${why}`,
  place: 'Where its hand works',
  placeHelp: 'Blue: what the device reaches in the world. Drag it, or give the numbers. Grey: what a hand can work. Orange: the hand.',
  above: 'from above',
  front: 'from the front',
  center: (axis) => `Middle, ${axis}, m`,
  turn: 'Turned by, degrees',
  scale: 'Metres for each metre of the device',
  around: 'Around',
  everything: 'all of them',
  fill: 'Fill in',
  unreached: (names) => `Out of reach: ${names}`,
  unknownReach: 'The device does not say how far it reaches; only its middle is drawn.',
  put: 'Put it there',
  back: 'As it is now',
  wrongPlace: 'Give a middle within 100 m, a turn within 360 degrees and a scale of 1 to 100.',
  keep: 'It stays so until the program ends. To keep it at a kiosk, start the program there with',
  map: (view) => `Reach of the device, ${view}`,
};

const kGreek: DeviceWords = {
  tab: 'Συσκευές',
  title: 'Απτικές συσκευές',
  device: (n) => `συσκευή ${n}`,
  states: { preparing: 'ετοιμάζεται', ready: 'έτοιμη', 'let-go': 'δεν την κρατά κανείς',
    'not-ready': 'δεν την κρατά κανείς ή είναι κλειστή',
    uncalibrated: 'χρειάζεται βαθμονόμηση', warm: 'ζεστή, με μειωμένη δύναμη', hot: 'πολύ ζεστή', lost: 'χάθηκε ή έχει βλάβη' },
  none: 'Δεν έχει συνδεθεί ακόμη καμία συσκευή.',
  resting: 'Όσο τρέχει το σχέδιο, εδώ φαίνονται οι απτικές συσκευές του, με τις δοκιμές τους και τη θέση των χεριών τους.',
  comes: 'Για να νιώσετε ό,τι τρέχει εδώ, ξεκινήστε στο μηχάνημα μιας συσκευής:',
  limits: (peak, long) => `έως ${peak} N, για πολλή ώρα ${long} N`,
  fingers: (most) => `έως ${most} N σε κάθε δάχτυλο`,
  readsOnly: 'διαβάζει το χέρι και δεν ασκεί δύναμη',
  rate: (now, wanted) => `${now} από ${wanted} φορές το δευτερόλεπτο`,
  late: (ms) => `καθυστέρηση έως ${ms} ms`,
  force: (newtons) => `τώρα ${newtons} N`,
  warmth: (percent) => `κινητήρες ζεστοί κατά ${percent} %`,
  test: 'Δοκιμή',
  endTest: 'Τέλος δοκιμής',
  testHelp: 'Για 20 s υπάρχει ένα μαλακό δάπεδο 1 cm κάτω από το χέρι και τίποτε από το έκθεμα· τα δάχτυλα ενός γαντιού κρατιούνται ' +
    'μισόκλειστα. Το πολύ 1 N.',
  testing: 'Δοκιμάζεται: πιέστε απαλά προς τα κάτω.',
  tested: (newtons, millijoules) => `Στη δοκιμή: έως ${newtons} N, απέδωσε ${millijoules} mJ (καλό: κοντά στο 0).`,
  fit: 'Προσαρμογή στο χέρι',
  fitHelp: 'Η σελίδα δείχνει τρεις στάσεις: ανοιχτή παλάμη, γροθιά, αντίχειρας και δείκτης σε κύκλο.',
  answers: { none: '', waiting: 'Ερωτάται η συσκευή ...', done: 'Έγινε.', refused: '',
    silent: 'Το πρόγραμμά της δεν απαντά. Δείτε αν τρέχει ακόμη.' },
  refused: (why) => `Δεν έγινε: ${why}`,
  place: 'Πού δουλεύει το χέρι της',
  placeHelp: 'Μπλε: ως πού φτάνει η συσκευή στον κόσμο. Σύρετέ το ή δώστε τους αριθμούς. Γκρι: ό,τι μπορεί να δουλέψει ένα χέρι. ' +
    'Πορτοκαλί: το χέρι.',
  above: 'από πάνω',
  front: 'από μπροστά',
  center: (axis) => `Μέσο, ${axis}, m`,
  turn: 'Στροφή, μοίρες',
  scale: 'Μέτρα για κάθε μέτρο της συσκευής',
  around: 'Γύρω από',
  everything: 'όλα',
  fill: 'Συμπλήρωση',
  unreached: (names) => `Δεν φτάνει: ${names}`,
  unknownReach: 'Η συσκευή δεν λέει ως πού φτάνει· σχεδιάζεται μόνο το μέσο της.',
  put: 'Τοποθέτηση εκεί',
  back: 'Όπως είναι τώρα',
  wrongPlace: 'Δώστε μέσο εντός 100 m, στροφή εντός 360 μοιρών και κλίμακα από 1 έως 100.',
  keep: 'Μένει έτσι ώσπου να τελειώσει το πρόγραμμα. Για να μείνει σε ένα περίπτερο, ξεκινήστε εκεί το πρόγραμμα με',
  map: (view) => `Ως πού φτάνει η συσκευή, ${view}`,
};

export const deviceWords = (language: Language): DeviceWords => (language === 'el' ? kGreek : kEnglish);
