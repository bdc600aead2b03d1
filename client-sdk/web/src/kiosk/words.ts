// The page's own words. All others come from the gateway, in the visitor's language.
import type { CameraState } from '../camera/camera_hand';

export interface Words {
  waiting: string;
  loading: string;
  lost: string;
  offline: string;
  refused: string;
  outdated: string;
  picture: string;
  take: string;
  closeUp: string;
  wholeMachine: string;
  sound: string;
  largeText: string;
  contrast: string;
  step: string;
  of: string;
  goal: string;
  question: string;
  noWebGL: string;
  pressAndHold: string;
  spaceTakes: string;
  busy: string;
  enterHeadset: string;
  enterRoom: string;
  recenter: string;
  leaveHeadset: string;
  noHeadset: string;
  useHand: string;
  cameraHand: string;
  cameraMiddle: string;
  cameraStop: string;
  cameraOff: string;
  camera: Record<CameraState, string>;
}

const kEnglish: Words = {
  waiting: 'The exhibit is getting ready …',
  loading: 'The exhibit is being fetched …',
  lost: 'One moment, the exhibit will go on …',
  offline: 'One moment, the exhibit will be back …',
  refused: 'This page may not show the exhibit.',
  outdated: 'This page is of another version than the museum’s server. Load it again.',
  picture: 'The machine. Tab goes to what can be taken, Space takes it, arrows move it.',
  take: 'Take',
  closeUp: 'Close up',
  wholeMachine: 'The whole machine',
  sound: 'Sound',
  largeText: 'Large text',
  contrast: 'High contrast',
  step: 'Step',
  of: 'of',
  goal: 'goal',
  question: 'Question',
  noWebGL: 'This browser cannot draw the machine: it has no WebGL 2.',
  pressAndHold: 'Press and hold to take it',
  spaceTakes: 'Space takes it; Tab goes to the next',
  busy: 'All hands are busy at the moment',
  enterHeadset: 'Enter headset',
  enterRoom: 'Headset, in this room',
  recenter: 'To the machine',
  leaveHeadset: 'Leave',
  noHeadset: 'The headset did not begin. Put it on, and try again.',
  useHand: 'Use your own hand',
  cameraHand: 'Your hand before the camera',
  cameraMiddle: 'My hand is at the machine',
  cameraStop: 'Stop',
  cameraOff: 'The camera hand is off here: the gateway has neither a model (--hand-model) nor a program (--hand-program).',
  camera: {
    starting: 'The camera is being started …',
    looking: 'Show your hand to the camera, as if you were at the machine. No picture leaves this device.',
    seen: 'Close your hand to take something, open it to let go.',
    slow: 'This machine sees your hand too seldom to hold anything.',
    noCamera: 'No camera can be used. Connect one, allow it for this page, and open the page by https.',
    noModel: 'The gateway gives no model of hands. See its log, or start it with --hand-model FILE.',
    badModel: 'The model of hands does not work in this browser. Give the gateway the file hand_landmarker.task.',
    noProgram: 'The program that sees hands does not answer. Start it on this machine.',
    badProgram: 'The program that sees hands sends what this page cannot read. Compare their versions.',
  },
};
const kGreek: Words = {
  waiting: 'Το έκθεμα ετοιμάζεται …',
  loading: 'Το έκθεμα φορτώνεται …',
  lost: 'Μια στιγμή, το έκθεμα συνεχίζει αμέσως …',
  offline: 'Μια στιγμή, το έκθεμα επιστρέφει …',
  refused: 'Η σελίδα αυτή δεν μπορεί να δείξει το έκθεμα.',
  outdated: 'Η σελίδα είναι άλλης έκδοσης από τον διακομιστή του μουσείου. Φορτώστε την ξανά.',
  picture: 'Η μηχανή. Με το Tab πάτε σε ό,τι πιάνεται, με το διάστημα το πιάνετε, με τα βέλη το μετακινείτε.',
  take: 'Πιάστε',
  closeUp: 'Από κοντά',
  wholeMachine: 'Ολόκληρη η μηχανή',
  sound: 'Ήχος',
  largeText: 'Μεγάλα γράμματα',
  contrast: 'Έντονη αντίθεση',
  step: 'Βήμα',
  of: 'από',
  goal: 'στόχος',
  question: 'Ερώτηση',
  noWebGL: 'Ο φυλλομετρητής αυτός δεν μπορεί να σχεδιάσει τη μηχανή: δεν έχει WebGL 2.',
  pressAndHold: 'Πατήστε και κρατήστε για να το πιάσετε',
  spaceTakes: 'Με το πλήκτρο διαστήματος το πιάνετε, με το Tab πάτε στο επόμενο',
  busy: 'Όλα τα χέρια είναι απασχολημένα',
  enterHeadset: 'Με κράνος VR',
  enterRoom: 'Με κράνος, στον χώρο σας',
  recenter: 'Προς τη μηχανή',
  leaveHeadset: 'Έξοδος',
  noHeadset: 'Το κράνος δεν ξεκίνησε. Φορέστε το και δοκιμάστε πάλι.',
  useHand: 'Με το δικό σας χέρι',
  cameraHand: 'Το χέρι σας μπροστά στην κάμερα',
  cameraMiddle: 'Το χέρι μου είναι στη μηχανή',
  cameraStop: 'Τέλος',
  cameraOff: 'Το χέρι με κάμερα είναι εκτός λειτουργίας: η πύλη δεν έχει ούτε μοντέλο (--hand-model) ούτε πρόγραμμα (--hand-program).',
  camera: {
    starting: 'Η κάμερα ξεκινά …',
    looking: 'Δείξτε το χέρι σας στην κάμερα, σαν να ήσασταν στη μηχανή. Καμία εικόνα δεν φεύγει από τη συσκευή.',
    seen: 'Κλείστε το χέρι για να πιάσετε κάτι, ανοίξτε το για να το αφήσετε.',
    slow: 'Το μηχάνημα αυτό βλέπει το χέρι σας πολύ σπάνια και δεν μπορεί να κρατήσει τίποτα.',
    noCamera: 'Δεν υπάρχει κάμερα για χρήση. Συνδέστε μία, επιτρέψτε την για τη σελίδα και ανοίξτε τη σελίδα με https.',
    noModel: 'Η πύλη δεν δίνει μοντέλο χεριών. Δείτε το αρχείο καταγραφής της ή ξεκινήστε την με --hand-model ΑΡΧΕΙΟ.',
    badModel: 'Το μοντέλο χεριών δεν λειτουργεί σε αυτόν τον φυλλομετρητή. Δώστε στην πύλη το αρχείο hand_landmarker.task.',
    noProgram: 'Το πρόγραμμα που βλέπει τα χέρια δεν απαντά. Ξεκινήστε το σε αυτό το μηχάνημα.',
    badProgram: 'Το πρόγραμμα που βλέπει τα χέρια στέλνει κάτι που η σελίδα δεν διαβάζει. Συγκρίνετε τις εκδόσεις τους.',
  },
};

export const wordsIn = (language: string): Words => (language === 'el' ? kGreek : kEnglish);
