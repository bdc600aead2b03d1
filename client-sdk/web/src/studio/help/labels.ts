// Names of the commonest properties as an educator says them, and what they are in Greek. The server's tables have their own words, in
// English; a property that is not here is shown as the tables have it.
import type { Language } from '../words';

type Pair = readonly [english: string, greek: string];

/** By the key's name. */
export const kLabels: Record<string, Pair> = {
  mass: ['Mass', 'Μάζα'],
  fixed: ['Fixed', 'Ακίνητο'],
  position: ['Position', 'Θέση'],
  orientation: ['Orientation', 'Προσανατολισμός'],
  centerOfMass: ['Centre of mass', 'Κέντρο μάζας'],
  inertia: ['Inertia', 'Αδράνεια'],
  useGlobalGravity: ['Falls by gravity', 'Πέφτει με τη βαρύτητα'],
  autoDamp: ['Is slowed by air', 'Το επιβραδύνει ο αέρας'],
  linearDampingFactor: ['Speed lost in a second', 'Απώλεια ταχύτητας ανά δευτερόλεπτο'],
  angularDampingFactor: ['Turning lost in a second', 'Απώλεια στροφής ανά δευτερόλεπτο'],
  linearVelocity: ['Speed at the start', 'Αρχική ταχύτητα'],
  angularVelocity: ['Turning at the start', 'Αρχική στροφή'],
  visible: ['Visible', 'Ορατό'],
  stiffness: ['Hardness', 'Σκληρότητα'],
  damping: ['Dullness', 'Απόσβεση'],
  staticFriction: ['Friction before it slips', 'Τριβή πριν γλιστρήσει'],
  dynamicFriction: ['Friction while it slips', 'Τριβή όσο γλιστρά'],
  viscosity: ['Stickiness', 'Ιξώδες'],
  knock: ['Knock at the first touch', 'Χτύπος στο πρώτο άγγιγμα'],
  grooveDepth: ['Depth of grooves', 'Βάθος αυλακώσεων'],
  grooveDistance: ['Distance of grooves', 'Απόσταση αυλακώσεων'],
  grooveDirection: ['Direction across grooves', 'Κατεύθυνση κάθετα στις αυλακώσεις'],
  graspable: ['A hand may take it', 'Πιάνεται με το χέρι'],
  effortScale: ['Share that the hand feels', 'Μέρος που νιώθει το χέρι'],
  model: ['Model with its shape', 'Μοντέλο με το σχήμα του'],
  node: ['Node of the mesh', 'Κόμβος του πλέγματος'],
  touchable: ['Can be touched', 'Αγγίζεται'],
  solid: ['What is inside the mesh', 'Τι έχει μέσα το πλέγμα'],
  collides: ['Collides with others', 'Συγκρούεται με άλλα'],
  restitution: ['Bounce', 'Αναπήδηση'],
  axis: ['Axis', 'Άξονας'],
  anchorPoint: ['Point', 'Σημείο'],
  minAngle: ['Turns back to', 'Στρέφεται πίσω έως'],
  maxAngle: ['Turns to', 'Στρέφεται έως'],
  minSeparation: ['Slides back to', 'Γλιστρά πίσω έως'],
  maxSeparation: ['Slides to', 'Γλιστρά έως'],
  fieldOfView: ['How wide it sees', 'Πόσο πλατιά βλέπει'],
  description: ['Description', 'Περιγραφή'],
  type: ['Type', 'Είδος'],
  bodies: ['Bodies', 'Σώματα'],
  forceLimit: ['Strongest pull of the hand', 'Μεγαλύτερη έλξη του χεριού'],
  torqueLimit: ['Strongest twist of the hand', 'Μεγαλύτερη στρέψη του χεριού'],
  holdTime: ['How long it must close', 'Πόση ώρα πρέπει να κλείσει'],
  breakDistance: ['Lost at a distance of', 'Χάνεται σε απόσταση'],
  frictionTorque: ['Friction', 'Τριβή'],
  viscous: ['Drag', 'Αντίσταση'],
  joint: ['Joint', 'Άρθρωση'],
  joint1: ['First joint', 'Πρώτη άρθρωση'],
  joint2: ['Second joint', 'Δεύτερη άρθρωση'],
  ratio: ['Ratio', 'Λόγος'],
  teeth: ['Teeth', 'Δόντια'],
  drum: ['Hinge of its drum', 'Μεντεσές του τυμπάνου'],
  drumRadius: ['Radius of the drum', 'Ακτίνα του τυμπάνου'],
  diameter: ['Diameter', 'Διάμετρος'],
  points: ['Points on its way', 'Σημεία της διαδρομής'],
  radii: ['Radii of the sheaves', 'Ακτίνες των τροχαλιών'],
  source: ['What it reads', 'Τι διαβάζει'],
  unit: ['Unit', 'Μονάδα'],
  quantity: ['Quantity', 'Μέγεθος'],
  op: ['Comparison', 'Σύγκριση'],
  value: ['Value', 'Τιμή'],
  tolerance: ['Tolerance', 'Ανοχή'],
  holdSeconds: ['For how long', 'Για πόση ώρα'],
  match: ['All rules or any one', 'Όλοι οι κανόνες ή ένας'],
  next: ['Next step', 'Επόμενο βήμα'],
  first: ['First step', 'Πρώτο βήμα'],
  enable: ['Switched on', 'Ανοίγουν'],
  disable: ['Switched off', 'Κλείνουν'],
  hintSeconds: ['The hint appears after', 'Η υπόδειξη φαίνεται ύστερα από'],
  timeoutSeconds: ['Goes on by itself after', 'Προχωρά μόνο του ύστερα από'],
  timeoutNext: ['Then the next step is', 'Τότε το επόμενο βήμα είναι'],
  detail: ['Close-up from the view', 'Λεπτομέρεια από την όψη'],
  opens: ['Opens the exhibit', 'Ανοίγει το έκθεμα'],
  languages: ['Languages', 'Γλώσσες'],
  activity: ['Activity', 'Δραστηριότητα'],
  kind: ['Kind', 'Είδος'],
  answers: ['Answers', 'Απαντήσεις'],
  correct: ['Right answer', 'Σωστή απάντηση'],
  body: ['Body', 'Σώμα'],
  force: ['Force', 'Δύναμη'],
  speed: ['Speed', 'Ταχύτητα'],
  size: ['Size', 'Μέγεθος'],
};

/** Sets in a form, without the number or name behind the colon. */
export const kSetLabels: Record<string, Pair> = {
  trigger: ['Rule', 'Κανόνας'],
  rule: ['Comparison', 'Σύγκριση'],
  object: ['Change of', 'Αλλαγή:'],
  move: ['Move', 'Κίνηση'],
  questionnaire: ['Questions', 'Ερωτήσεις'],
};

/** Types of agents, machines and nodes. */
export const kTypeLabels: Record<string, Pair> = {
  RigidBody: ['Body', 'Σώμα'],
  SingleAxisHingeJoint: ['Hinge', 'Μεντεσές'],
  SliderJoint: ['Slider', 'Ολισθητής'],
  BallJoint: ['Ball joint', 'Σφαιρική άρθρωση'],
  Viewpoint: ['View', 'Όψη'],
  CollidableShape: ['Shape', 'Σχήμα'],
  Inline: ['Model', 'Μοντέλο'],
  'simulation.grasp': ['A hand takes', 'Χέρι που πιάνει'],
  'simulation.turned': ['Turns are counted', 'Μέτρηση στροφών'],
  'simulation.assembled': ['All parts are in place', 'Όλα στη θέση τους'],
  'simulation.placed': ['A thing is in its place', 'Κάτι στη θέση του'],
  'simulation.dwell': ['Something stays at a place', 'Κάτι μένει σε μια θέση'],
  'simulation.idle': ['Nobody does anything', 'Κανείς δεν κάνει κάτι'],
  'geometry.hinge': ['Hinge', 'Μεντεσές'],
  'geometry.slider': ['Slider', 'Ολισθητής'],
  'geometry.ball': ['Ball joint', 'Σφαιρική άρθρωση'],
  'geometry.fixed': ['Held together', 'Σταθερή ένωση'],
  'geometry.rope': ['Rope', 'Σχοινί'],
  'geometry.ratchet': ['Ratchet', 'Καστάνια'],
  'geometry.gear': ['Gears', 'Γρανάζια'],
  'geometry.worm': ['Worm gear', 'Ατέρμονας'],
  'geometry.screw': ['Screw', 'Κοχλίας'],
  'geometry.snap': ['Place that a thing goes home to', 'Θέση που τραβά κάτι'],
  'geometry.breakable': ['Bond that can break', 'Δεσμός που σπάει'],
  'machine.formula': ['Machine of formulas', 'Μηχανή με τύπους'],
  'machine.water_network': ['Water and pipes', 'Νερό και σωλήνες'],
  'machine.torsion_spring': ['Twisted sinew', 'Στριμμένα νεύρα'],
  'machine.screw_pump': ['Archimedes’ screw', 'Κοχλίας του Αρχιμήδη'],
  'machine.force_pump': ['Force pump', 'Καταθλιπτική αντλία'],
};

/** What properties are, by the words of the server's tables: where those change, theirs are shown. */
export const kGreekDocs: Record<string, string> = {
  'of the real thing': 'του πραγματικού αντικειμένου',
  'true: it never moves, and its mass does not matter': 'αν ναι, δεν κινείται ποτέ και η μάζα του δεν μετρά',
  'false: it floats, as if balanced': 'αν όχι, αιωρείται, σαν ζυγισμένο',
  'true: the two factors below slow it down': 'αν ναι, το επιβραδύνουν οι δύο τιμές πιο κάτω',
  'share of its speed lost in a second': 'μέρος της ταχύτητας που χάνεται κάθε δευτερόλεπτο',
  'share of its turning lost in a second': 'μέρος της στροφής που χάνεται κάθε δευτερόλεπτο',
  'from its origin, in its own frame': 'από την αρχή του, στο δικό του σύστημα',
  'how fast its centre of mass moves at the start, in the world': 'πόσο γρήγορα κινείται το κέντρο μάζας στην αρχή',
  'how it turns at the start, in the world': 'πώς στρέφεται στην αρχή',
  'false: not drawn': 'αν όχι, δεν φαίνεται',
  'false: drawn only': 'αν όχι, μόνο φαίνεται',
  'how hard it feels': 'πόσο σκληρό το νιώθει το χέρι',
  'how dull': 'πόσο πνίγει τον κραδασμό',
  'before it slips': 'πριν γλιστρήσει το δάχτυλο',
  'while it slips; at most staticFriction': 'όσο γλιστρά· το πολύ όσο πριν γλιστρήσει',
  'how syrupy it is to slide over: grease, wet clay': 'πόσο κολλά όταν γλιστράς: λίπος, υγρός πηλός',
  'from one groove to the next': 'από τη μία αυλάκωση στην άλλη',
  'share of its weight that the hand lifts': 'μέρος του βάρους του που σηκώνει το χέρι',
  'share of a machine\'s loads that the hand feels': 'μέρος των φορτίων της μηχανής που νιώθει το χέρι',
  'a hand may take it': 'μπορεί να το πιάσει ένα χέρι',
  'with every other body that does, but for those joined or snapped to it':
    'με όσα άλλα συγκρούονται, εκτός από όσα είναι ενωμένα μαζί του',
  'share of its speed that a collision gives back': 'μέρος της ταχύτητας που επιστρέφει η σύγκρουση',
  'how wide it sees': 'το άνοιγμα της όψης',
  'how far it turns': 'πόσο στρέφεται',
  'how far it slides': 'πόσο γλιστρά',
  'how far it slides back': 'πόσο γλιστρά πίσω',
  'how far it turns back; with both stops at a half turn or more it turns on for ever':
    'πόσο στρέφεται πίσω· με όρια μισής στροφής ή περισσότερο στρέφεται ασταμάτητα',
  'Lets hands take hold of bodies': 'Αφήνει τα χέρια να πιάνουν σώματα',
  'Counts the turns of a hinge': 'Μετρά τις στροφές ενός μεντεσέ',
  'what may be grasped, while it is graspable and movable; none named: every body':
    'τι πιάνεται, όσο πιάνεται και κινείται· αν δεν ονομάσετε τίποτε, όλα τα σώματα',
  'what the hand can pull with, as felt': 'με πόση δύναμη τραβά το χέρι, όπως τη νιώθει',
  'what the hand can turn with before the body turns in it; small for a crank\'s handle':
    'με πόση ροπή στρέφει πριν γυρίσει το σώμα μέσα του· μικρή για λαβή μανιβέλας',
  'how long a hand must close, or open, before it counts': 'πόση ώρα πρέπει να κλείσει ή να ανοίξει το χέρι για να μετρήσει',
  'the body is lost where it lags this far behind the hand': 'το σώμα χάνεται αν μείνει τόσο πίσω από το χέρι',
  'Coulomb friction of the real bearing; felt times the world\'s effort_scale':
    'η τριβή του πραγματικού εδράνου· το χέρι νιώθει το μέρος που ορίζει το έκθεμα',
  'drag that grows with the rate; felt times the world\'s effort_scale':
    'αντίσταση που μεγαλώνει με την ταχύτητα· το χέρι νιώθει το μέρος που ορίζει το έκθεμα',
  'the hinge or slider that is held': 'ο μεντεσές ή ο ολισθητής που κρατιέται',
  'of a hinge\'s wheel': 'του τροχού ενός μεντεσέ',
  'as it is drawn': 'όπως σχεδιάζεται',
  'the hinge of a drum that it begins on and is wound on': 'ο μεντεσές του τυμπάνου όπου αρχίζει και τυλίγεται',
  'of the drum, to the rope\'s middle': 'του τυμπάνου, έως τη μέση του σχοινιού',
  'what it reads, as NAME.VALUE': 'τι διαβάζει, ως ΟΝΟΜΑ.ΤΙΜΗ',
  'as a visitor reads it; rpm and deg convert': 'όπως τη διαβάζει ο επισκέπτης· rpm και deg μετατρέπονται',
  'what is compared': 'τι συγκρίνεται',
  'how: below, equal, above': 'πώς: κάτω, ίσο, πάνω',
  'with what, in the quantity\'s unit': 'με τι, στη μονάδα του μεγέθους',
  'how near is equal': 'πόσο κοντά λογίζεται ίσο',
  'whether all rules must hold at once, or any one': 'αν ισχύουν όλοι οι κανόνες μαζί, ή αρκεί ένας',
  'how long it must hold without a break': 'πόση ώρα πρέπει να ισχύει συνέχεια',
  'the step that follows; end: the activity is done': 'το βήμα που ακολουθεί· end: τέλος της δραστηριότητας',
  'the step that follows then; end: the activity is done': 'το βήμα που ακολουθεί τότε· end: τέλος της δραστηριότητας',
  'agents to switch on; before, in every activity, they are off': 'δράσεις που ανοίγουν· πριν είναι κλειστές',
  'agents to switch off; a snap that is off leaves what it has placed fixed': 'δράσεις που κλείνουν',
  'what changes of a body': 'τι αλλάζει σε ένα σώμα',
  'what ends the step; the first that fires decides. Displays mark on a gauge what `trigger:1` waits for':
    'τι τελειώνει το βήμα· αποφασίζει ο πρώτος κανόνας που ισχύει',
  'the step ends after this time, whatever happens; 0: never': 'το βήμα τελειώνει ύστερα από τόσο χρόνο· 0: ποτέ',
  'the DEF of the Viewpoint from which a close-up is shown in a corner of the picture':
    'η όψη από την οποία φαίνεται μια λεπτομέρεια στη γωνία της εικόνας',
  'when the hint is shown': 'πότε φαίνεται η υπόδειξη',
  'the step to begin with; else the first one written': 'το βήμα της αρχής· αλλιώς το πρώτο που γράφτηκε',
  'codes, the first is shown first': 'κωδικοί· η πρώτη φαίνεται πρώτη',
};

/** What the forms say of themselves; "": nothing. */
export const formsNote = (language: Language): string =>
  (language === 'el' ? 'Όσες εξηγήσεις δεν έχουν ακόμη μεταφραστεί είναι στα αγγλικά.' : '');
const said = (pair: Pair | undefined, language: Language): string => pair?.[language === 'el' ? 1 : 0] ?? '';
/** A key as it is offered, with its unit. */
export const offered = (key: { name: string; unit: string }, language: Language): string =>
  (labelOf(key.name, language) || key.name) + (key.unit === '' ? '' : ` (${key.unit})`);
/** "": it has none. */
export const labelOf = (key: string, language: Language): string => said(kLabels[key], language);
export const typeLabel = (type: string, language: Language): string => said(kTypeLabels[type], language);
/** "Rule 1" of "trigger:1". */
export function setLabel(name: string, language: Language): string {
  const [kind, ...rest] = name.split(':');
  return [said(kSetLabels[kind!], language) || kind, rest.join(':')].filter((one) => one !== '').join(' ');
}
/** What a property is, and in which language that is said. */
export const docIn = (doc: string, language: Language): { text: string; lang: Language } =>
  (language === 'el' && kGreekDocs[doc] ? { text: kGreekDocs[doc], lang: 'el' } : { text: doc, lang: 'en' });
