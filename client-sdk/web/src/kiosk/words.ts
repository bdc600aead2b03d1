// The page's own words. All others come from the gateway, in the visitor's language.

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
};

export const wordsIn = (language: string): Words => (language === 'el' ? kGreek : kEnglish);
