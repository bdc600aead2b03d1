// What the properties of the scenario format and of X3D's nodes are, in Greek, as in docs_greek.ts.
export const kGreekFormatDocs: Record<string, string> = {
  // The scenario itself
  'on the WorldInfo: all that X3D itself cannot say': 'στο WorldInfo: όλα όσα δεν μπορεί να πει το ίδιο το X3D',
  'version of these tables': 'έκδοση αυτών των πινάκων',
  'the exhibit\'s name in logs and on the wire: small letters, digits, \'-\'':
    'το όνομα του εκθέματος στις καταγραφές και στο δίκτυο: μικρά λατινικά γράμματα, ψηφία και παύλες',
  'codes, the first is shown first': 'κωδικοί· η πρώτη φαίνεται πρώτη',
  'share of a machine\'s loads that the hand feels': 'μέρος των φορτίων της μηχανής που νιώθει το χέρι',
  'title.LANGUAGE': 'ο τίτλος, ως title.LANGUAGE',
  'the words, as WHAT.LANGUAGE': 'τα κείμενα, ως WHAT.LANGUAGE',
  'sets named as the agents, each with its type and parameters': 'οι δράσεις, η καθεμία με το όνομα, το είδος και τις ιδιότητές της',
  'sets named as the machines, each with its type and parameters': 'οι μηχανές, η καθεμία με το όνομα, το είδος και τις ιδιότητές της',
  'what rules and displays read, by name: a set each, or only a string with the source':
    'τα μεγέθη που διαβάζουν κανόνες και οθόνες: το καθένα με το όνομα και τις ιδιότητές του, ή μόνο με το τι διαβάζει (source)',
  'sets named as the activities': 'οι δραστηριότητες, η καθεμία με το όνομά της',
  'sets named as the scripted visits': 'οι έτοιμες επισκέψεις, η καθεμία με το όνομά της',
  'sets named as what is seen, heard and felt beside the bodies: water, steam, fire, a ratchet\'s clicks':
    'όσα βλέπει, ακούει και νιώθει κανείς πέρα από τα σώματα, το καθένα με το όνομά του: νερό, ατμός, φωτιά, χτύποι καστάνιας',
  // Quantities
  'a number with a name': 'ένας αριθμός με όνομα',
  'what it reads, as NAME.VALUE': 'τι διαβάζει, ως ΟΝΟΜΑ.ΤΙΜΗ',
  'as a visitor reads it; rpm and deg convert': 'όπως τη διαβάζει ο επισκέπτης· rpm και deg μετατρέπονται',
  'where its gauge begins, in its unit': 'πού αρχίζει ο δείκτης του, στη μονάδα του',
  'where its gauge ends; left out: the gauge begins at 0 and grows':
    'πού τελειώνει ο δείκτης του· αν λείπει, ο δείκτης αρχίζει από 0 και μεγαλώνει',
  ['label.LANGUAGE: what its gauge is called. Displays show quantities with a label; of those without, the first in l, l/min, rpm, ' +
    'N, degC and km, where no other in that unit has a label']:
    'label.LANGUAGE: πώς λέγεται ο δείκτης του. Οι οθόνες δείχνουν τα μεγέθη με label· από τα άλλα, το πρώτο σε l, l/min, rpm, N, degC ' +
    'και km, όπου κανένα άλλο στη μονάδα αυτή δεν έχει label',
  // Activities, their steps and rules
  'a task for a visitor': 'μια εργασία για τον επισκέπτη',
  'the step to begin with; else the first one written': 'το βήμα της αρχής· αλλιώς το πρώτο που γράφτηκε',
  'title.LANGUAGE; goal.LANGUAGE: what a visitor should learn': 'title.LANGUAGE· goal.LANGUAGE: τι να μάθει ο επισκέπτης',
  'sets named as the steps': 'τα βήματα, το καθένα με το όνομά του',
  'one thing to do': 'ένα πράγμα που κάνει ο επισκέπτης',
  'agents to switch on; before, in every activity, they are off': 'δράσεις που ανοίγουν· πριν είναι κλειστές',
  'agents to switch off; a snap that is off leaves what it has placed fixed':
    'δράσεις που κλείνουν· όταν κλείνει μια έλξη στη θέση, ό,τι τοποθέτησε μένει ακίνητο',
  'the step ends after this time, whatever happens; 0: never': 'το βήμα τελειώνει ύστερα από τόσο χρόνο· 0: ποτέ',
  'the step that follows then; end: the activity is done': 'το βήμα που ακολουθεί τότε· end: τέλος της δραστηριότητας',
  'the DEF of the Viewpoint from which a close-up is shown in a corner of the picture':
    'η όψη από την οποία φαίνεται μια λεπτομέρεια στη γωνία της εικόνας',
  ['the id of the scenario that the visitors go on to as this step begins. If the server does not have this scenario, they stay, ' +
    'and this is an ordinary step: give it a timeoutSeconds that leads back. Not for an activity\'s first step']:
    'το id του εκθέματος όπου πηγαίνουν οι επισκέπτες μόλις αρχίσει το βήμα. Αν ο διακομιστής δεν το έχει, μένουν, και το βήμα είναι ' +
    'όπως κάθε άλλο: δώστε του ένα timeoutSeconds που οδηγεί πίσω. Όχι για το πρώτο βήμα μιας δραστηριότητας',
  'when the hint is shown': 'πότε φαίνεται η υπόδειξη',
  'what changes of a body': 'τι αλλάζει σε ένα σώμα',
  'false: held still': 'αν όχι, μένει ακίνητο',
  'false: not drawn': 'αν όχι, δεν φαίνεται',
  'a hand may take it': 'μπορεί να το πιάσει ένα χέρι',
  'true: it has its weight; false: it floats, as if balanced': 'αν ναι, έχει το βάρος του· αν όχι, αιωρείται, σαν ζυγισμένο',
  'put it there when the step begins, in W': 'μπαίνει εκεί όταν αρχίζει το βήμα, στο σύστημα του κόσμου',
  'turn it so when the step begins, in W': 'στρέφεται έτσι όταν αρχίζει το βήμα, στο σύστημα του κόσμου',
  'caption, narration, hint, each with .LANGUAGE; audio.LANGUAGE: a sound file of the narration':
    'caption (λεζάντα), narration (αφήγηση), hint (υπόδειξη), το καθένα με .LANGUAGE· audio.LANGUAGE: αρχείο ήχου με την αφήγηση',
  'what ends the step; the first that fires decides. Displays mark on a gauge what `trigger:1` waits for':
    'τι τελειώνει το βήμα· αποφασίζει ο πρώτος κανόνας που ισχύει. Στους δείκτες σημειώνεται τι περιμένει ο `trigger:1`',
  'what is compared': 'τι συγκρίνεται',
  'how: below, equal, above': 'πώς: κάτω, ίσο, πάνω',
  'with what, in the quantity\'s unit': 'με τι, στη μονάδα του μεγέθους',
  'how near is equal': 'πόσο κοντά λογίζεται ίσο',
  'whether all rules must hold at once, or any one': 'αν ισχύουν όλοι οι κανόνες μαζί, ή αρκεί ένας',
  'how long it must hold without a break': 'πόση ώρα πρέπει να ισχύει συνέχεια',
  'the step that follows; end: the activity is done': 'το βήμα που ακολουθεί· end: τέλος της δραστηριότητας',
  'instead of quantity, op and value: a comparison each': 'αντί για quantity, op και value: μία σύγκριση στο καθένα',
  // Questions
  'sets named as the questions, asked in the order written': 'οι ερωτήσεις, η καθεμία με το όνομά της· τίθενται με τη σειρά που γράφτηκαν',
  'one question after an activity': 'μία ερώτηση ύστερα από μια δραστηριότητα',
  'choice: one of several answers; scale: a number from low to high':
    'choice: μία από πολλές απαντήσεις· scale: ένας αριθμός από το κάτω άκρο (low) έως το πάνω (high)',
  'choice: names of the answers, in the order shown': 'choice: ονόματα των απαντήσεων, με τη σειρά που φαίνονται',
  'choice: the right answer, if there is one': 'choice: η σωστή απάντηση, αν υπάρχει',
  'scale: how many marks it has': 'scale: πόσες βαθμίδες έχει',
  'question.LANGUAGE; choice: answer:NAME.LANGUAGE; scale: low.LANGUAGE, high.LANGUAGE':
    'question.LANGUAGE· choice: answer:NAME.LANGUAGE· scale: low.LANGUAGE, high.LANGUAGE',
  // Scripted visits
  'a scripted hand': 'ένα χέρι με έτοιμες κινήσεις',
  'which activity it plays': 'ποια δραστηριότητα παίζει',
  'the moves, played in the order written': 'οι κινήσεις, με τη σειρά που γράφτηκαν',
  'what the hand does': 'τι κάνει το χέρι',
  'reach, grasp, move_to: of which body': 'reach, grasp, move_to: ποιο σώμα',
  'reach: the grip\'s centre in the body\'s frame': 'reach: το σημείο όπου πιάνει το χέρι, στο σύστημα του σώματος',
  'move_to: where the body goes, in W': 'move_to: πού πάει το σώμα, στο σύστημα του κόσμου',
  'move_to: how the body stands, in W': 'move_to: πώς στέκεται το σώμα, στο σύστημα του κόσμου',
  'turn, swing: which hinge': 'turn, swing: ποιος μεντεσές',
  'turn: how far': 'turn: πόσο στρέφεται',
  'turn: how fast': 'turn: πόσο γρήγορα',
  'swing: how far to either side of the joint\'s 0; below 0: backwards first':
    'swing: πόσο σε κάθε πλευρά του 0 της άρθρωσης· κάτω από 0: πρώτα προς τα πίσω',
  'swing: how often to and fro': 'swing: πόσες φορές πέρα δώθε',
  'swing: how many cycles a minute': 'swing: πόσες ταλαντώσεις ανά λεπτό',
  'how long it lasts; not for turn and swing': 'πόση ώρα κρατά· όχι για turn και swing',
  // Effects
  'something seen, heard or felt of a machine\'s working, driven by a quantity':
    'κάτι που βλέπει, ακούει ή νιώθει κανείς από τη λειτουργία μιας μηχανής· το οδηγεί ένα μέγεθος',
  ['what is seen, heard or felt. level: a surface of water that rises; flow: one that flows, as a river does; stream: water that ' +
    'runs out; jet: water or steam under pressure, its speed from flow and size; sound.NAME: a sound at that place; touch.click: a ' +
    'short shake in the hands that hold or touch the body, each time the quantity has changed by another full']:
    'τι βλέπει, ακούει ή νιώθει κανείς. level: επιφάνεια νερού που ανεβαίνει· flow: επιφάνεια που κυλά, όπως σε ποτάμι· stream: νερό που ' +
    'τρέχει έξω· jet: νερό ή ατμός με πίεση, με ταχύτητα από τη ροή και το size· sound.NAME: ένας ήχος σε εκείνη τη θέση· touch.click: ' +
    'ένας σύντομος κραδασμός στα χέρια που κρατούν ή αγγίζουν το σώμα, κάθε φορά που το μέγεθος αλλάζει κατά ένα ακόμη full',
  'what drives it: l/s or l/min for stream and jet, a height in m for level, else any number; not for a flow':
    'τι το οδηγεί: l/s ή l/min για stream και jet, ύψος σε m για level, αλλιώς οποιοσδήποτε αριθμός· όχι για flow',
  'what it stays with, or is felt in; none: fixed in W':
    'με ποιο σώμα πάει, ή σε ποιο το νιώθει το χέρι· αν λείπει, μένει σταθερό στον κόσμο',
  'level, flow: the mesh file\'s node that rises or flows': 'level, flow: ο κόμβος του πλέγματος που ανεβαίνει ή κυλά',
  'where, in the body\'s frame': 'πού, στο σύστημα του σώματος',
  'which way, in the body\'s frame, of a flow in W; none: 0 1 0':
    'προς τα πού, στο σύστημα του σώματος, για flow στο σύστημα του κόσμου· αν λείπει, 0 1 0',
  'the quantity\'s value at which it is at its strongest': 'η τιμή του μεγέθους όπου είναι πιο έντονο',
  'how large: a jet\'s bore, a fire\'s width': 'πόσο μεγάλο: η διάμετρος του στομίου ενός πίδακα, το πλάτος μιας φωτιάς',
  'how fast water or steam leaves, or a river flows; not for a jet of water, whose flow says it':
    'πόσο γρήγορα φεύγει νερό ή ατμός, ή κυλά ένα ποτάμι· όχι για πίδακα νερού, όπου το λέει η ροή του',
  'how strong a touch.click is': 'πόσο δυνατό είναι ένα touch.click',
  // mechane:body: the shape of a body
  'on a RigidBody: its shape in a mesh file': 'σε RigidBody: το σχήμα του σε αρχείο πλέγματος',
  'DEF of the Inline whose file holds the shape; left out: the shape is the body\'s `geometry`':
    'το DEF του Inline του οποίου το αρχείο έχει το σχήμα· αν λείπει, σχήμα είναι το `geometry` του σώματος',
  'the node in that file; else the one named as the body': 'ο κόμβος σε εκείνο το αρχείο· αλλιώς αυτός που λέγεται όπως το σώμα',
  'false: drawn only': 'αν όχι, μόνο φαίνεται',
  ['what is inside, where the mesh is open: closed closes its holes, sheet T makes its surface T metres thick, auto closes what ' +
    'encloses something and makes a sheet of 1 mm of the rest']:
    'τι έχει μέσα, όπου το πλέγμα είναι ανοιχτό: το closed κλείνει τις τρύπες του, το sheet T δίνει στην επιφάνειά του πάχος T μέτρων, ' +
    'το auto κλείνει ό,τι περικλείει κάτι και κάνει τα υπόλοιπα φύλλο του 1 mm',
  'with every other body that does, but for those joined or snapped to it':
    'με όσα άλλα συγκρούονται, εκτός από όσα είναι ενωμένα μαζί του',
  'share of its speed that a collision gives back': 'μέρος της ταχύτητας που επιστρέφει η σύγκρουση',
  'title.LANGUAGE: what it is called; displays write it above what a hand comes near or points at':
    'title.LANGUAGE: πώς λέγεται· οι οθόνες το γράφουν πάνω από ό,τι πλησιάζει ή δείχνει ένα χέρι',
  'many such bodies instead of one': 'πολλά τέτοια σώματα αντί για ένα',
  'how many bodies there are: NAME-1, NAME-2 and so on': 'πόσα σώματα υπάρχουν: NAME-1, NAME-2 και ούτω καθεξής',
  'a row, or a pile: from each to the next, in W': 'σειρά ή στοίβα: από το ένα στο επόμενο, στο σύστημα του κόσμου',
  'a grid: how many stand in each row': 'κάναβος: πόσα στέκονται σε κάθε σειρά',
  'a grid: from each row to the next, in W': 'κάναβος: από κάθε σειρά στην επόμενη, στο σύστημα του κόσμου',
  'a ring: they stand evenly about this point of W, each turned as its place is':
    'δακτύλιος: στέκονται σε ίσες αποστάσεις γύρω από αυτό το σημείο του κόσμου, το καθένα στραμμένο όπως η θέση του',
  'a ring: what it lies about, in W; none: 0 1 0': 'δακτύλιος: γύρω από ποιον άξονα, στο σύστημα του κόσμου· αν λείπει, 0 1 0',
  'a list: x y z of each, in W, the first one\'s too': 'λίστα: x y z του καθενός, στο σύστημα του κόσμου, και του πρώτου',
  // mechane:haptic: what touch feels that touch.surface has not
  'on a RigidBody: what touch feels': 'σε RigidBody: τι νιώθει η αφή',
  'share of its weight that the hand lifts': 'μέρος του βάρους του που σηκώνει το χέρι',
  // X3D
  'the file': 'το αρχείο',
  'of X3D': 'του X3D',
  'which parts of X3D a reader must know': 'ποια μέρη του X3D πρέπει να ξέρει όποιο πρόγραμμα το διαβάζει',
  // unit
  'in the head: a unit of the file\'s numbers': 'στο head: μια μονάδα για τους αριθμούς του αρχείου',
  'what is measured': 'τι μετριέται',
  'what the unit is called': 'πώς λέγεται η μονάδα',
  '1: everything is in metres, kilograms, seconds and radians': '1: όλα είναι σε μέτρα, χιλιόγραμμα, δευτερόλεπτα και ακτίνια',
  // WorldInfo
  'under the Scene: carries `mechane:scenario`': 'κάτω από το Scene: έχει το `mechane:scenario`',
  'for people': 'για όποιον το διαβάζει',
  // Inline
  'under the Scene: a mesh file; bodies take their shapes from its nodes':
    'κάτω από το Scene: ένα αρχείο πλέγματος· τα σώματα παίρνουν το σχήμα τους από τους κόμβους του',
  'its name: all else refers to it by this': 'το όνομά του: με αυτό το βρίσκουν όλα τα άλλα',
  'the mesh file (.glb), by its path from this file': 'το αρχείο πλέγματος (.glb), με τη διαδρομή του από αυτό το αρχείο',
  // Viewpoint
  'under the Scene: where a display may look from': 'κάτω από το Scene: από πού μπορεί να κοιτάξει μια οθόνη',
  'its name in lists; displays ask for it': 'το όνομά της σε λίστες· με αυτό τη ζητούν οι οθόνες',
  'where the eye is': 'πού είναι το μάτι',
  'how the eye is turned from looking along -z with y up':
    'πώς έχει στραφεί το μάτι, που χωρίς στροφή κοιτά προς το -z με το y προς τα πάνω',
  'how wide it sees': 'το άνοιγμα της όψης',
  // RigidBodyCollection
  'under the Scene: bodies and the joints between them': 'κάτω από το Scene: τα σώματα και οι αρθρώσεις ανάμεσά τους',
  'how all bodies fall': 'πώς πέφτουν όλα τα σώματα',
  // RigidBody
  'a body: what can be touched, moved, or stands in the way': 'ένα σώμα: ό,τι αγγίζεται, μετακινείται ή στέκεται εμπόδιο',
  'true: it never moves, and its mass does not matter': 'αν ναι, δεν κινείται ποτέ και η μάζα του δεν μετρά',
  'of the real thing': 'του πραγματικού αντικειμένου',
  ['about the centre of mass, row by row; left out: computed from the mass and the mesh, as of a uniform solid, or of a thin shell ' +
    'where the mesh is open; without a mesh 1 about every axis']:
    'γύρω από το κέντρο μάζας, σειρά σειρά· αν λείπει, υπολογίζεται από τη μάζα και το πλέγμα, σαν ομοιόμορφο στερεό, ή σαν λεπτό ' +
    'κέλυφος όπου το πλέγμα είναι ανοιχτό· χωρίς πλέγμα, 1 γύρω από κάθε άξονα',
  'from its origin, in its own frame': 'από την αρχή του, στο δικό του σύστημα',
  'where its origin is at the start, in the world': 'πού είναι αρχικά το σημείο αρχής του, στο σύστημα του κόσμου',
  'how it stands at the start: axis x y z, then the angle': 'πώς στέκεται στην αρχή: άξονας x y z, ύστερα η γωνία',
  'false: it floats, as if balanced': 'αν όχι, αιωρείται, σαν ζυγισμένο',
  'true: the two factors below slow it down': 'αν ναι, το επιβραδύνουν οι δύο τιμές πιο κάτω',
  'share of its speed lost in a second': 'μέρος της ταχύτητας που χάνεται κάθε δευτερόλεπτο',
  'share of its turning lost in a second': 'μέρος της στροφής που χάνεται κάθε δευτερόλεπτο',
  'how fast its centre of mass moves at the start, in the world': 'πόσο γρήγορα κινείται το κέντρο μάζας στην αρχή',
  'how it turns at the start, in the world': 'πώς στρέφεται στην αρχή',
  'that act on its centre of mass all the time, in the world; several add up':
    'που δρουν συνέχεια στο κέντρο μάζας του, στο σύστημα του κόσμου· πολλές αθροίζονται',
  'that turn it all the time, in the world; several add up': 'που το στρέφουν συνέχεια, στο σύστημα του κόσμου· πολλές αθροίζονται',
  // SingleAxisHingeJoint
  'body2 turns about an axis against body1': 'το body2 στρέφεται γύρω από έναν άξονα ως προς το body1',
  'a point of the joint, in the world as it stands at the start': 'ένα σημείο της άρθρωσης, στο σύστημα του κόσμου, όπως είναι στην αρχή',
  'its direction, in the world as it stands at the start; any length but 0':
    'η κατεύθυνσή του, στο σύστημα του κόσμου, όπως είναι στην αρχή· με όποιο μήκος εκτός από 0',
  'how far it turns back; with both stops at a half turn or more it turns on for ever':
    'πόσο στρέφεται πίσω· με όρια μισής στροφής ή περισσότερο στρέφεται ασταμάτητα',
  'how far it turns': 'πόσο στρέφεται',
  // SliderJoint
  'body2 slides along an axis against body1': 'το body2 γλιστρά κατά μήκος ενός άξονα ως προς το body1',
  'how far it slides back': 'πόσο γλιστρά πίσω',
  'how far it slides': 'πόσο γλιστρά',
  // BallJoint
  'body2 turns about a point against body1': 'το body2 στρέφεται γύρω από ένα σημείο ως προς το body1',
};
