import type { Language } from '../words';
import type { StopName } from './stops';

interface TourWords {
  showMe: string;
  goOn: string;
  intro: string;
  name: string;
  leave: string;
  place: (n: number, of: number) => string;
  done: (what: string) => string;
  isDone: string;
  where: string;
  back: string;
  next: string;
  skip: string;
  elsewhere: (exhibit: string) => string;
  open: string;
  end: { title: string; text: string; more: string[] };
  finish: string;
  again: string;
  /** `did`: said once it is done. */
  stops: Record<StopName, { title: string; todo: string; why: string; did: string }>;
}

const kEnglish: TourWords = {
  showMe: 'Show me how',
  goOn: 'Go on with the tour',
  intro: 'Ten minutes to your first machine: a crank that lifts a stone, and one beside it that lifts nothing.',
  name: 'Tour',
  leave: 'Leave the tour',
  place: (n, of) => `${n} of ${of}`,
  done: (what) => `Done: ${what}`,
  isDone: 'You have done this already.',
  where: 'Take me there',
  back: 'Back',
  next: 'Next',
  skip: 'Skip this',
  elsewhere: (exhibit) => `The tour goes on in “${exhibit}”.`,
  open: 'Open it',
  end: {
    title: 'You have made an exhibit',
    text: 'All others are made in the same way: things, joints, words and steps, tried and published.',
    more: ['Change it further: what is published stays until you publish again.',
      'Write a hint for visitors who get stuck, under Words.',
      'Help (F1) tells of each part of the page when you are there.'],
  },
  finish: 'Finish',
  again: 'Once more',
  stops: {
    make: {
      title: 'Begin your exhibit',
      todo: 'Choose the template “A crank and a rope”, write a title in both languages, such as “My winch”, and press Make it.',
      why: 'Visitors read the title first. The name follows it. You get a draft of your own; visitors see nothing of it yet.',
      did: 'you have a draft',
    },
    stone: {
      title: 'Look at the stone',
      todo: 'Click the small grey stone in the picture, at the end of the rope, or LOAD in the contents. The green block is the ground.',
      why: 'Drag beside the machine to look around it. Show all brings you back.',
      did: 'the stone is chosen',
    },
    weight: {
      title: 'Give it its weight',
      todo: 'Write 15 as its mass, and press Enter.',
      why: 'A stone of this size weighs about 15 kg. The hand feels a small share of it, so that everyone can lift it.',
      did: 'the stone has its weight',
    },
    insert: {
      title: 'Bring in a second crank',
      todo: 'In the scene, choose Crank in “Insert a part”, and press Insert.',
      why: 'It will lift nothing: so visitors feel what the stone weighs by the difference.',
      did: 'the crank is there',
    },
    place: {
      title: 'Put it in its place',
      todo: 'Write its position: x 0.7, y 0.9, z 0.2. It is then as high as the other crank, and its handle as far in front.',
      why: 'x goes to the right, y up, z towards the visitor, in metres. Its arrows drag it, too.',
      did: 'the crank is in its place',
    },
    join: {
      title: 'Let it turn',
      todo: 'Press New joint. Choose FRAME as what it moves against, keep Hinge and the axis z, press “Its position”, then Add.',
      why: 'A hinge turns about an axis. That of a crank from the library goes through its position.',
      did: 'the crank can turn',
    },
    hand: {
      title: 'Let hands take it',
      todo: 'Choose HOLD in the contents, under Agents. Under Bodies, choose CRANK in the empty box beside DRUM.',
      why: 'HOLD is the hand of visitors. It takes only what is named here.',
      did: 'hands can take the crank',
    },
    words: {
      title: 'Give it a name',
      todo: 'Open Words, and write the new crank’s title in each language, such as “The free crank”.',
      why: 'Visitors read it when their hand comes near.',
      did: 'the crank has its name',
    },
    rule: {
      title: 'Say when it is done',
      todo: 'Open Flow, choose the rule “height > 0.6”, and write 0.7 as its value.',
      why: 'A step goes on when its rule sees that it is done: here, once the stone is that high, in metres.',
      did: 'the step has its rule',
    },
    start: {
      title: 'Try it',
      todo: 'Open Try it, and press Start it.',
      why: 'Your draft runs here as visitors will find it.',
      did: 'it runs',
    },
    turn: {
      title: 'Turn the crank',
      todo: 'Press on the handle of the crank at the drum, hold, and go round anticlockwise, until the stone leaves the ground. By ' +
        'keys: Tab to ' +
        'the crank, Space takes it, arrows move it.',
      why: 'Then turn the free crank, too. At the right you see the height grow.',
      did: 'you have lifted the stone',
    },
    publish: {
      title: 'Publish it',
      todo: 'Press Publish, and once more in the question that comes.',
      why: 'Visitors can have it then. If this was only practice, skip this stop, and discard the draft under Versions.',
      did: 'it is published',
    },
  },
};

const kGreek: TourWords = {
  showMe: 'Δείξτε μου πώς',
  goOn: 'Συνέχεια της ξενάγησης',
  intro: 'Δέκα λεπτά ως την πρώτη σας μηχανή: μια μανιβέλα που σηκώνει μια πέτρα και δίπλα της μία που δεν σηκώνει τίποτε.',
  name: 'Ξενάγηση',
  leave: 'Έξοδος από την ξενάγηση',
  place: (n, of) => `${n} από ${of}`,
  done: (what) => `Έγινε: ${what}`,
  isDone: 'Αυτό το έχετε κάνει ήδη.',
  where: 'Πηγαίνετέ με εκεί',
  back: 'Πίσω',
  next: 'Επόμενο',
  skip: 'Παράλειψη',
  elsewhere: (exhibit) => `Η ξενάγηση συνεχίζει στο «${exhibit}».`,
  open: 'Άνοιγμα',
  end: {
    title: 'Φτιάξατε ένα έκθεμα',
    text: 'Έτσι φτιάχνονται και όλα τα άλλα: σώματα, αρθρώσεις, κείμενα και βήματα, δοκιμή και δημοσίευση.',
    more: ['Συνεχίστε να το αλλάζετε: ό,τι δημοσιεύτηκε μένει ώσπου να δημοσιεύσετε πάλι.',
      'Γράψτε στα «Κείμενα» μια υπόδειξη για όσους κολλούν.',
      'Η βοήθεια (F1) μιλά για κάθε μέρος της σελίδας όταν είστε εκεί.'],
  },
  finish: 'Τέλος',
  again: 'Άλλη μία φορά',
  stops: {
    make: {
      title: 'Αρχίστε το έκθεμά σας',
      todo: 'Διαλέξτε το υπόδειγμα «Μανιβέλα και σχοινί», γράψτε τίτλο στις δύο γλώσσες, όπως «Το βαρούλκο μου», και πατήστε «Δημιουργία».',
      why: 'Τον τίτλο διαβάζουν πρώτα οι επισκέπτες· από τον αγγλικό βγαίνει το όνομα. Το σχέδιο είναι δικό σας: ακόμη δεν το βλέπουν.',
      did: 'έχετε ένα σχέδιο',
    },
    stone: {
      title: 'Δείτε την πέτρα',
      todo: 'Πατήστε στην εικόνα τη μικρή γκρίζα πέτρα στην άκρη του σχοινιού, ή το LOAD στα περιεχόμενα. Το πράσινο είναι το έδαφος.',
      why: 'Σύρετε δίπλα στη μηχανή για να κοιτάξετε γύρω της. Το «Όλα» σας φέρνει πίσω.',
      did: 'διαλέξατε την πέτρα',
    },
    weight: {
      title: 'Δώστε της το βάρος της',
      todo: 'Γράψτε 15 στη μάζα και πατήστε Enter.',
      why: 'Μια τέτοια πέτρα ζυγίζει περίπου 15 kg. Το χέρι νιώθει μικρό μέρος, ώστε να τη σηκώνουν όλοι.',
      did: 'η πέτρα έχει το βάρος της',
    },
    insert: {
      title: 'Φέρτε δεύτερη μανιβέλα',
      todo: 'Στη σκηνή, διαλέξτε «Μανιβέλα» στην «Εισαγωγή εξαρτήματος» και πατήστε «Εισαγωγή».',
      why: 'Δεν θα σηκώνει τίποτε: από τη διαφορά οι επισκέπτες νιώθουν πόσο ζυγίζει η πέτρα.',
      did: 'η μανιβέλα ήρθε',
    },
    place: {
      title: 'Βάλτε τη στη θέση της',
      todo: 'Γράψτε τη θέση της: x 0,7, y 0,9, z 0,2. Έτσι είναι όσο ψηλά και η άλλη και η λαβή της όσο μπροστά.',
      why: 'Το x πάει δεξιά, το y πάνω, το z προς τον επισκέπτη, σε μέτρα. Τη σέρνουν και τα βέλη της.',
      did: 'η μανιβέλα είναι στη θέση της',
    },
    join: {
      title: 'Αφήστε τη να γυρίζει',
      todo: 'Πατήστε «Νέα άρθρωση». Στο «Ως προς» διαλέξτε FRAME, αφήστε «Μεντεσές» και άξονα z, πατήστε «Στη θέση του» και «Προσθήκη».',
      why: 'Ο μεντεσές στρέφεται γύρω από άξονα. Της έτοιμης μανιβέλας περνά από τη θέση της.',
      did: 'η μανιβέλα γυρίζει',
    },
    hand: {
      title: 'Αφήστε τα χέρια να την πιάνουν',
      todo: 'Διαλέξτε το HOLD στα περιεχόμενα, στις Δράσεις. Στα σώματά του διαλέξτε το CRANK, στο κενό δίπλα στο DRUM.',
      why: 'Το HOLD είναι το χέρι των επισκεπτών. Πιάνει μόνο ό,τι γράφεται εδώ.',
      did: 'τα χέρια πιάνουν τη μανιβέλα',
    },
    words: {
      title: 'Δώστε της όνομα',
      todo: 'Ανοίξτε τα «Κείμενα» και γράψτε τον τίτλο της νέας μανιβέλας σε κάθε γλώσσα, όπως «Η ελεύθερη μανιβέλα».',
      why: 'Οι επισκέπτες τον διαβάζουν όταν πλησιάζει το χέρι τους.',
      did: 'η μανιβέλα έχει όνομα',
    },
    rule: {
      title: 'Πείτε πότε τελειώνει',
      todo: 'Ανοίξτε τη «Ροή», διαλέξτε τον κανόνα «height > 0,6» και γράψτε 0,7 στην τιμή.',
      why: 'Το βήμα προχωρά όταν ο κανόνας του δει ότι έγινε: εδώ, μόλις η πέτρα φτάσει τόσο ψηλά, σε μέτρα.',
      did: 'το βήμα έχει τον κανόνα του',
    },
    start: {
      title: 'Δοκιμάστε το',
      todo: 'Ανοίξτε τη «Δοκιμή» και πατήστε «Εκκίνηση».',
      why: 'Το σχέδιό σας τρέχει εδώ όπως θα το βρουν οι επισκέπτες.',
      did: 'τρέχει',
    },
    turn: {
      title: 'Γυρίστε τη μανιβέλα',
      todo: 'Πατήστε τη λαβή της μανιβέλας στο τύμπανο, κρατήστε και γυρίστε αριστερόστροφα, ώσπου η πέτρα να αφήσει το έδαφος. Με ' +
        'πλήκτρα: ' +
        'Tab ως τη μανιβέλα, το κενό την πιάνει, τα βέλη την κινούν.',
      why: 'Ύστερα γυρίστε και την ελεύθερη μανιβέλα. Δεξιά βλέπετε το ύψος να μεγαλώνει.',
      did: 'σηκώσατε την πέτρα',
    },
    publish: {
      title: 'Δημοσιεύστε το',
      todo: 'Πατήστε «Δημοσίευση», και άλλη μία φορά στην ερώτηση που έρχεται.',
      why: 'Τότε μπορούν να το έχουν οι επισκέπτες. Αν ήταν μόνο άσκηση, παραλείψτε το και απορρίψτε το σχέδιο στις «Εκδόσεις».',
      did: 'δημοσιεύτηκε',
    },
  },
};

export const tourWords = (language: Language): TourWords => (language === 'el' ? kGreek : kEnglish);
