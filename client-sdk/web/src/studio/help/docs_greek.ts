// What the properties of agents and machines are, in Greek, by the words of the server's tables. An explanation that several have stands
// with the first of them; tests/integration/studio_e2e.py finds what is missing or left over.
export const kGreekAgentDocs: Record<string, string> = {
  // geometry.hinge: hinge
  'Ties two bodies by a hinge while it is on': 'Δένει δύο σώματα με μεντεσέ όσο είναι ανοιχτή η δράση',
  'the hinge that is on while this agent is': 'ο μεντεσές που ισχύει όσο είναι ανοιχτή η δράση',
  'Coulomb friction of the real bearing; felt times the world\'s effort_scale':
    'η τριβή του πραγματικού εδράνου· το χέρι νιώθει το μέρος που ορίζει το έκθεμα',
  'drag that grows with the rate; felt times the world\'s effort_scale':
    'αντίσταση που μεγαλώνει με την ταχύτητα· το χέρι νιώθει το μέρος που ορίζει το έκθεμα',
  'lower stop; with maxAngle. Neither: the joint\'s own': 'κάτω όριο, μαζί με maxAngle· αν λείπουν και τα δύο, τα όρια της άρθρωσης',
  'upper stop; with minAngle': 'άνω όριο, μαζί με minAngle',
  'of body2 against body1; counts on over whole turns': 'του body2 ως προς το body1· μετρά συνέχεια, και πάνω από μία στροφή',
  'how fast it turns': 'πόσο γρήγορα στρέφεται',
  'the angle in turns': 'η γωνία σε στροφές',
  // geometry.slider: slider
  'Ties two bodies by a straight guide while it is on': 'Δένει δύο σώματα με ίσιο οδηγό όσο είναι ανοιχτή η δράση',
  'the slider that is on while this agent is': 'ο ολισθητής που ισχύει όσο είναι ανοιχτή η δράση',
  'Coulomb friction of the real guide; felt times the world\'s effort_scale':
    'η τριβή του πραγματικού οδηγού· το χέρι νιώθει το μέρος που ορίζει το έκθεμα',
  'drag that grows with the speed; felt times the world\'s effort_scale':
    'αντίσταση που μεγαλώνει με την ταχύτητα· το χέρι νιώθει το μέρος που ορίζει το έκθεμα',
  'lower stop; with maxPosition. Neither: the joint\'s own': 'κάτω όριο, μαζί με maxPosition· αν λείπουν και τα δύο, τα όρια της άρθρωσης',
  'upper stop; with minPosition': 'άνω όριο, μαζί με minPosition',
  'of body2 against body1, along the axis; 0 at the start': 'του body2 ως προς το body1, κατά τον άξονα· 0 στην αρχή',
  'how fast it slides': 'πόσο γρήγορα γλιστρά',
  // geometry.ball: ball joint
  'Ties two bodies at a point while it is on': 'Δένει δύο σώματα σε ένα σημείο όσο είναι ανοιχτή η δράση',
  'the ball joint that is on while this agent is': 'η σφαιρική άρθρωση που ισχύει όσο είναι ανοιχτή η δράση',
  'how far the axis may tilt; none: any way': 'πόσο μπορεί να γείρει ο άξονας· αν λείπει, ελεύθερα',
  'the cone\'s axis as the bodies stand at the start; none: 0 1 0':
    'ο άξονας του κώνου, όπως στέκονται τα σώματα στην αρχή· αν λείπει, 0 1 0',
  'how far the axis is from where it was at the start': 'πόσο απέχει ο άξονας από εκεί όπου ήταν στην αρχή',
  // geometry.fixed: held together
  'Two bodies move as one, as they stand when it is switched on':
    'Δύο σώματα κινούνται σαν ένα, όπως στέκονται τη στιγμή που ανοίγει η δράση',
  'the body that is tied': 'το σώμα που δένεται',
  'the body that it is tied to; none: the world': 'το σώμα με το οποίο δένεται· αν λείπει, με τον χώρο',
  '1 while it ties': '1 όσο δένει',
  'what the tie bears: the real force': 'τι δέχεται ο δεσμός: η πραγματική δύναμη',
  'what it bears at the body\'s origin: the real torque': 'τι δέχεται στο σημείο αρχής του σώματος: η πραγματική ροπή',
  // geometry.screw: screw
  'Ties two bodies by a screw thread while it is on': 'Δένει δύο σώματα με σπείρωμα κοχλία όσο είναι ανοιχτή η δράση',
  'the hinge that is on, and a screw, while this agent is on': 'ο μεντεσές που ισχύει, ως κοχλίας, όσο είναι ανοιχτή η δράση',
  'how far it goes along the axis in one turn; below 0: a left-handed thread':
    'πόσο προχωρά κατά τον άξονα σε μία στροφή· κάτω από 0: αριστερόστροφο σπείρωμα',
  'Coulomb friction of the real thread; felt times the world\'s effort_scale':
    'η τριβή του πραγματικού σπειρώματος· το χέρι νιώθει το μέρος που ορίζει το έκθεμα',
  'how far it has gone along the axis': 'πόσο προχώρησε κατά τον άξονα',
  // geometry.gear: gears
  'Two joints go together by a ratio: wheels, rack and pinion, drum':
    'Δύο αρθρώσεις κινούνται μαζί με σταθερό λόγο: τροχοί, γρανάζι με οδοντωτή ράβδο, τύμπανο',
  'a hinge or slider; the worm': 'μεντεσές ή ολισθητής· ή ο ατέρμονας',
  'the hinge or slider that it moves; the worm\'s wheel': 'ο μεντεσές ή ο ολισθητής που κινείται από την πρώτη· ή ο τροχός του ατέρμονα',
  'how far joint2 goes for 1 of joint1, in rad or m; below 0: the other way':
    'πόσο πάει η joint2 για 1 της joint1, σε rad ή m· κάτω από 0: αντίστροφα',
  'of both wheels; they turn against each other': 'των δύο τροχών· στρέφονται αντίθετα ο ένας από τον άλλο',
  'with teeth: one wheel\'s teeth are inside, or a peg wheel at right angles turns the same way':
    'με teeth: ο ένας τροχός έχει τα δόντια από μέσα, ή ένας τροχός με πείρους σε ορθή γωνία στρέφεται κατά την ίδια φορά',
  'of a pinion or a drum that moves a rack': 'του γραναζιού ή του τυμπάνου που κινεί μια οδοντωτή ράβδο',
  'with radius: the rack goes the other way': 'με radius: η οδοντωτή ράβδος πάει αντίστροφα',
  'work out of the teeth over work into them, driven by joint1; below 0.5 joint2 cannot drive':
    'το έργο που βγαίνει από τα δόντια προς το έργο που μπαίνει, όταν κινεί η joint1· κάτω από 0,5 η joint2 δεν μπορεί να κινήσει',
  '1 while the teeth mesh: it is on, and both joints are':
    '1 όσο τα δόντια πιάνουν: είναι ανοιχτή η δράση και ισχύουν και οι δύο αρθρώσεις',
  'of the teeth on a joint2 that is a hinge: the real torque': 'των δοντιών στην joint2, όταν είναι μεντεσές: η πραγματική ροπή',
  'of the teeth on a joint2 that is a slider: the real force': 'των δοντιών στην joint2, όταν είναι ολισθητής: η πραγματική δύναμη',
  // geometry.worm: worm gear
  'A worm turns a wheel, which cannot turn the worm': 'Ένας ατέρμονας στρέφει έναν τροχό, που δεν μπορεί να στρέψει τον ατέρμονα',
  'of the wheel': 'του τροχού',
  'threads of the worm': 'σπειρώματα του ατέρμονα',
  'the wheel turns the other way': 'ο τροχός στρέφεται αντίστροφα',
  'work out of the wheel over work into the worm; below one half, so that the wheel cannot turn the worm':
    'το έργο που βγαίνει από τον τροχό προς το έργο που μπαίνει στον ατέρμονα· κάτω από το μισό, ώστε ο τροχός να μη στρέφει τον ατέρμονα',
  // geometry.intermittent_gear: gear that moves tooth by tooth
  'One tooth moves a wheel by one of its teeth a turn': 'Ένα δόντι κινεί έναν τροχό κατά ένα από τα δόντια του σε κάθε στροφή',
  'the hinge whose one tooth drives': 'ο μεντεσές που οδηγεί με το ένα του δόντι',
  'the hinge of the wheel that is moved': 'ο μεντεσές του τροχού που κινείται',
  'of the wheel: it goes 1/teeth of a turn each time': 'του τροχού: προχωρά 1/teeth της στροφής κάθε φορά',
  'how far joint1 turns while its tooth drives': 'πόσο στρέφεται η joint1 όσο οδηγεί το δόντι της',
  'where joint1 stands in the middle of that': 'πού στέκεται η joint1 στη μέση αυτής της γωνίας',
  'the wheel turns the same way as the tooth': 'ο τροχός στρέφεται κατά την ίδια φορά με το δόντι',
  'the wheel is held while the tooth is elsewhere; false: only its bearing\'s friction holds it':
    'ο τροχός κρατιέται όσο το δόντι είναι αλλού· αν όχι, τον κρατά μόνο η τριβή του εδράνου του',
  '1 while it is on, and both joints are': '1 όσο είναι ανοιχτή η δράση και ισχύουν και οι δύο αρθρώσεις',
  'teeth that the wheel has gone since then': 'πόσα δόντια προχώρησε ο τροχός από τότε που άνοιξε η δράση',
  // geometry.ratchet: ratchet
  'A joint goes one way; teeth hold it from going back':
    'Μια άρθρωση κινείται μόνο προς τη μία μεριά· δόντια δεν την αφήνουν να γυρίσει πίσω',
  'the hinge or slider that is held': 'ο μεντεσές ή ο ολισθητής που κρατιέται',
  'of a hinge\'s wheel': 'του τροχού ενός μεντεσέ',
  'from tooth to tooth of a slider\'s bar': 'από δόντι σε δόντι στη ράβδο ενός ολισθητή',
  'position of a tooth': 'η θέση ενός δοντιού',
  'it goes to lower positions and is held from higher': 'πάει προς μικρότερες θέσεις και δεν γυρίζει προς μεγαλύτερες',
  'the joint of a pawl that a hand lifts; none: the pawl is down while this agent is on':
    'η άρθρωση ενός αναστολέα που τον σηκώνει το χέρι· αν λείπει, ο αναστολέας είναι κάτω όσο είναι ανοιχτή η δράση',
  'the pawl is off the teeth where it is further than this from where it was at the start':
    'ο αναστολέας αφήνει τα δόντια όταν απομακρυνθεί πάνω από τόσο από την αρχική του θέση',
  '1 while the pawl is on the teeth': '1 όσο ο αναστολέας πιάνει τα δόντια',
  'the last tooth passed': 'το τελευταίο δόντι που πέρασε',
  '1 while the pawl bears a load': '1 όσο ο αναστολέας κρατά φορτίο',
  'what it bears on a hinge: the real torque': 'τι δέχεται σε μεντεσέ: η πραγματική ροπή',
  'what it bears on a slider: the real force': 'τι δέχεται σε ολισθητή: η πραγματική δύναμη',
  // geometry.rope: rope
  'A rope over sheaves, from a drum or a point; off: it is cut':
    'Σχοινί πάνω σε τροχαλίες, από τύμπανο ή σημείο· όσο είναι κλειστή η δράση, είναι κομμένο',
  'where it begins (without a drum), what it runs over, where it ends; a body for each':
    'πού αρχίζει (χωρίς τύμπανο), από πού περνά, πού τελειώνει· ένα σώμα για το καθένα',
  'x y z of each in its body\'s frame: an end, or a sheave\'s centre':
    'x y z του καθενός στο σύστημα του σώματός του: άκρη του σχοινιού ή κέντρο τροχαλίας',
  'of the sheaves; 0: the rope runs through the point. Of an end it is not used':
    'των τροχαλιών· 0: το σχοινί περνά από το σημείο. Στις άκρες δεν μετρά',
  'x y z of each sheave\'s axis in its body\'s frame; none: 0 0 1':
    'x y z του άξονα κάθε τροχαλίας στο σύστημα του σώματός της· αν λείπει, 0 0 1',
  'which way round each: 1 right-handed about its axis from first to last, -1 left-handed':
    'κατά ποια φορά γύρω από την καθεμία, από την αρχή έως το τέλος του σχοινιού: 1 κατά τον κανόνα του δεξιού χεριού γύρω από τον άξονά ' +
    'της, -1 αντίθετα',
  'of every sheave: the lower tension over the higher while the rope moves':
    'κάθε τροχαλίας: η μικρότερη τάση προς τη μεγαλύτερη όσο κινείται το σχοινί',
  'the same, for each': 'το ίδιο, για την καθεμία',
  'friction coefficient of a rope on a beam or a post: efficiency falls with the wrap, exp(-it * rad)':
    'συντελεστής τριβής σχοινιού σε δοκάρι ή στύλο: η απόδοση πέφτει όσο πιο πολύ τυλίγεται, exp(-συντελεστής * rad)',
  'unstretched, off the drum, at the start; none: as long as its way then':
    'χωρίς τέντωμα, έξω από το τύμπανο, στην αρχή· αν λείπει, όσο η διαδρομή του τότε',
  'as it is drawn': 'όπως σχεδιάζεται',
  'the hinge of a drum that it begins on and is wound on': 'ο μεντεσές του τυμπάνου όπου αρχίζει και τυλίγεται',
  'of the drum, to the rope\'s middle': 'του τυμπάνου, έως τη μέση του σχοινιού',
  'turning the drum to lower angles winds; otherwise to higher ones':
    'τυλίγεται όταν το τύμπανο στρέφεται προς μικρότερες γωνίες· αλλιώς προς μεγαλύτερες',
  'of its first part, at the drum: the real tension': 'του πρώτου τμήματος, στο τύμπανο: η πραγματική τάση',
  'of its last part: the real tension': 'του τελευταίου τμήματος: η πραγματική τάση',
  'off the drum': 'έξω από το τύμπανο',
  'how much longer it is than its way; 0: taut': 'πόσο μακρύτερο είναι από τη διαδρομή του· 0: τεντωμένο',
  // geometry.snap: place that a thing goes home to
  'Leads a body that is close to its place home and holds it there': 'Φέρνει στη θέση του ένα σώμα που την πλησίασε και το κρατά εκεί',
  'the body that goes to its place': 'το σώμα που πάει στη θέση του',
  'the body in whose frame the place is; none: the world': 'το σώμα ως προς το οποίο μετριέται η θέση· αν λείπει, ο κόσμος',
  'where the object\'s frame goes': 'πού πάει το σημείο αρχής του σώματος',
  'how it stands there: axis x y z, angle': 'πώς στέκεται εκεί: άξονας x y z, γωνία',
  'how close it must come: distance, angle': 'πόσο κοντά πρέπει να έρθει: απόσταση, γωνία',
  'insertion axis in the object\'s frame: any rotation about it is right':
    'ο άξονας κατά τον οποίο μπαίνει, στο σύστημα του σώματος: κάθε στροφή γύρω του είναι σωστή',
  'how long the last way takes': 'πόση ώρα κρατά ο τελευταίος δρόμος',
  'how strongly the place draws the body while a hand carries it, at most; the hand feels it; 0: not at all':
    'πόσο δυνατά, το πολύ, τραβά η θέση το σώμα όσο το κρατά ένα χέρι· το χέρι το νιώθει· 0: καθόλου',
  'how far from the place the pull begins, more than the tolerance; it is strongest at 0.45 of this':
    'πόσο μακριά από τη θέση αρχίζει η έλξη, πέρα από την ανοχή· είναι πιο δυνατή στα 0,45 της απόστασης αυτής',
  'held in its place by a tie, which bears forces and can break, instead of standing still':
    'στη θέση του το κρατά δεσμός, που δέχεται δυνάμεις και μπορεί να σπάσει, αντί να μένει ακίνητο',
  '1 once the object is in its place': '1 αφού το σώμα έρθει στη θέση του',
  'from the object to its place': 'από το σώμα έως τη θέση του',
  'between the object\'s attitude and the place\'s': 'ανάμεσα στον προσανατολισμό του σώματος και της θέσης',
  // geometry.breakable: bond that can break
  'Something lets go over a force or a torque': 'Κάτι σπάει πάνω από μια δύναμη ή ροπή',
  'what breaks: it is switched off, and stays off until the activity begins anew':
    'ποια δράση σπάει: κλείνει, και μένει κλειστή ώσπου να αρχίσει πάλι η δραστηριότητα',
  'the real force that breaks it': 'η πραγματική δύναμη που τη σπάει',
  'the real torque that breaks it': 'η πραγματική ροπή που τη σπάει',
  '1 once it is broken': '1 αφού σπάσει',
  'what it bears: the real force': 'τι δέχεται: η πραγματική δύναμη',
  'what it bears: the real torque': 'τι δέχεται: η πραγματική ροπή',
  // simulation.grasp: a hand takes
  'Lets hands take hold of bodies': 'Αφήνει τα χέρια να πιάνουν σώματα',
  'what may be grasped, while it is graspable and movable; none named: every body':
    'τι πιάνεται, όσο πιάνεται και κινείται· αν δεν ονομάσετε τίποτε, όλα τα σώματα',
  'what the hand can pull with, as felt': 'με πόση δύναμη τραβά το χέρι, όπως τη νιώθει',
  'what the hand can turn with before the body turns in it; small for a crank\'s handle':
    'με πόση ροπή στρέφει πριν γυρίσει το σώμα μέσα του· μικρή για λαβή μανιβέλας',
  'how long a hand must close, or open, before it counts': 'πόση ώρα πρέπει να κλείσει ή να ανοίξει το χέρι για να μετρήσει',
  'grasp intent below which a hand is open': 'κλείσιμο, από 0 έως 1, κάτω από το οποίο το χέρι λογίζεται ανοιχτό',
  'the body is lost where it lags this far behind the hand': 'το σώμα χάνεται αν μείνει τόσο πίσω από το χέρι',
  'hands that hold one of the bodies': 'πόσα χέρια κρατούν κάποιο από τα σώματα',
  'index of the body that the first of them holds; -1: none': 'αύξων αριθμός του σώματος που κρατά το πρώτο χέρι· -1: κανένα',
  // simulation.placed: a thing is in its place
  'Says when a body has come to its place': 'Λέει πότε ένα σώμα ήρθε στη θέση του',
  'the geometry.snap that is watched': 'το geometry.snap που παρακολουθείται',
  '1 while the snap has its object': '1 όσο η θέση έχει το σώμα της',
  // simulation.turned: turns are counted
  'Counts the turns of a hinge': 'Μετρά τις στροφές ενός μεντεσέ',
  'the hinge whose turns are counted': 'ο μεντεσές του οποίου μετριούνται οι στροφές',
  'an event each time that it has turned this far, either way': 'ένα συμβάν κάθε τόσες στροφές, όποια κι αν είναι η φορά',
  'turned since the agent was switched on, signed': 'στροφές από τότε που άνοιξε η δράση, με πρόσημο',
  // simulation.pulled: a hand pulls
  'Says when a hand pulls a body hard or far enough': 'Λέει πότε ένα χέρι τραβά ένα σώμα αρκετά δυνατά ή αρκετά μακριά',
  'the body that a hand moves': 'το σώμα που κινεί ένα χέρι',
  'enough from this force of the hand on, as felt': 'αρκεί μόλις η δύναμη του χεριού φτάσει τόσο, όπως τη νιώθει',
  'enough from this way on; with force: one of them is enough': 'αρκεί μόλις διανύσει τόσο δρόμο· μαζί με force: αρκεί το ένα από τα δύο',
  'the direction that counts, in the body\'s frame; none: any': 'η κατεύθυνση που μετρά, στο σύστημα του σώματος· αν λείπει, όλες',
  'the joint whose way is the travel; none: the body\'s own': 'η άρθρωση της οποίας ο δρόμος μετρά· αν λείπει, ο δρόμος του σώματος',
  'with joint: towards lower positions': 'με joint: προς μικρότερες θέσεις',
  'how long it must be enough': 'πόση ώρα πρέπει να διαρκέσει',
  '1 while a hand pulls it hard or far enough': '1 όσο ένα χέρι το τραβά αρκετά δυνατά ή αρκετά μακριά',
  'of the hand on the body, along the axis, as felt': 'του χεριού στο σώμα, κατά τον άξονα, όπως τη νιώθει',
  'how far the body went with the hand; rad where the joint is a hinge':
    'πόσο προχώρησε το σώμα με το χέρι· σε rad αν η άρθρωση είναι μεντεσές',
  // simulation.pushed: a hand pushes
  'Says when a hand pushes a body hard or far enough': 'Λέει πότε ένα χέρι σπρώχνει ένα σώμα αρκετά δυνατά ή αρκετά μακριά',
  '1 while a hand pushes it hard or far enough': '1 όσο ένα χέρι το σπρώχνει αρκετά δυνατά ή αρκετά μακριά',
  // simulation.fired: something is let go
  'A trigger lets go of what it held when a hand pulls it': 'Μια σκανδάλη αφήνει ό,τι κρατούσε όταν την τραβήξει ένα χέρι',
  'agents that it switches off: a tie, a ratchet, a rope': 'δράσεις που κλείνει: δεσμός, καστάνια, σχοινί',
  '1 once it has fired': '1 αφού απελευθερώσει',
  'of the hand on the trigger, along the axis, as felt': 'του χεριού στη σκανδάλη, κατά τον άξονα, όπως τη νιώθει',
  'how far the trigger went with the hand; rad where the joint is a hinge':
    'πόσο προχώρησε η σκανδάλη με το χέρι· σε rad αν η άρθρωση είναι μεντεσές',
  // simulation.lit: something catches fire
  'A flame that is near for a while lights a fire': 'Μια φλόγα που μένει λίγη ώρα κοντά ανάβει φωτιά',
  'what is lit: a hearth, a lamp, a torch': 'τι ανάβει: εστία, λυχνάρι, δάδα',
  'the body that brings the fire; while it is hidden, it lights nothing':
    'το σώμα που φέρνει τη φωτιά· όσο είναι κρυμμένο, δεν ανάβει τίποτε',
  'where it catches fire, in its frame': 'πού παίρνει φωτιά, στο σύστημά του',
  'where the flame is, in its body\'s frame': 'πού είναι η φλόγα, στο σύστημα του σώματός της',
  'how close they must be': 'πόσο κοντά πρέπει να είναι',
  'for how long': 'για πόση ώρα',
  'how long it burns; 0: on and on': 'πόση ώρα καίει· 0: ασταμάτητα',
  'the simulation.lit by which the flame itself must burn; none: it always does':
    'το simulation.lit με το οποίο πρέπει να καίει η ίδια η φλόγα· αν λείπει, καίει πάντα',
  'a body that is seen while it burns, and only then: its flames': 'ένα σώμα που φαίνεται όσο καίει, και μόνο τότε: οι φλόγες',
  'the hinge or slider of a door that lets air to the fire; none: it always has air':
    'ο μεντεσές ή ο ολισθητής μιας πόρτας που αφήνει αέρα στη φωτιά· αν λείπει, έχει πάντα αέρα',
  'with door: from this position of the joint on no air comes in': 'με door: από αυτή τη θέση της άρθρωσης και πάνω δεν μπαίνει αέρας',
  'with door: how long a fire burns without air': 'με door: πόση ώρα καίει μια φωτιά χωρίς αέρα',
  '1 while it burns': '1 όσο καίει',
  'from the flame to where it catches fire': 'από τη φλόγα έως εκεί όπου παίρνει φωτιά',
  'how long it has burned': 'πόση ώρα καίει ως τώρα',
  // simulation.assembled: all parts are in place
  'Takes parts in their order, and says when all are in place': 'Δέχεται κομμάτια με τη σειρά τους και λέει πότε είναι όλα στη θέση τους',
  'the geometry.snap of each part; this agent switches them': 'το geometry.snap κάθε κομματιού· η δράση αυτή τα ανοίγει και τα κλείνει',
  'lines like "ONE before OTHER": what must be in place before what; none: one after the other as listed':
    'γραμμές όπως «ONE before OTHER»: τι πρέπει να είναι στη θέση του πριν από τι· αν λείπουν, το ένα μετά το άλλο όπως γράφτηκαν',
  'how many parts are in their places': 'πόσα κομμάτια είναι στη θέση τους',
  '1 while all are': '1 όσο είναι όλα',
  'how often a part came before its turn': 'πόσες φορές ένα κομμάτι ήρθε πριν από τη σειρά του',
  'index of a body whose turn it is; -1: none': 'αύξων αριθμός ενός σώματος που έχει τώρα σειρά· -1: κανένα',
  // simulation.dwell: something stays at a place
  'A hand or a body stays at a place for a while': 'Ένα χέρι ή ένα σώμα μένει λίγη ώρα σε μια θέση',
  'the place\'s middle': 'το κέντρο της θέσης',
  'how close counts': 'σε πόση απόσταση λογίζεται εκεί',
  'how long it must stay': 'πόση ώρα πρέπει να μείνει',
  'what must stay there; none: any hand': 'τι πρέπει να μείνει εκεί· αν λείπει, οποιοδήποτε χέρι',
  '1 while it has stayed long enough': '1 όσο έχει μείνει αρκετή ώρα',
  '1 while it is there': '1 όσο είναι εκεί',
  // simulation.point: a finger points
  ['An index finger is at a sign, or points at it; or somebody clicks on it. For a sign that opens an exhibit: a quantity ' +
    'NAME.pointed, a trigger on it, a step with opens; village/village.x3d has eight']:
    'Ένα δάχτυλο αγγίζει μια πινακίδα ή τη δείχνει· ή κάποιος κάνει κλικ επάνω της. Για πινακίδα που ανοίγει έκθεμα: ένα μέγεθος ' +
    'NAME.pointed, ένας κανόνας με αυτό, ένα βήμα με opens· το village/village.x3d έχει οκτώ',
  'the sign; a hidden one is not pointed at': 'η πινακίδα· όσο είναι κρυμμένη, δεν μετρά',
  'the point meant, in its frame; behind a board\'s face, so that the fingertip is near it only where it touches the board':
    'το σημείο που εννοείται, στο σύστημά της· πίσω από την επιφάνεια της πινακίδας, ώστε η άκρη του δαχτύλου να είναι κοντά του μόνο ' +
    'όπου την αγγίζει',
  'the fingertip is at the sign within this of the point. Where a cone is given and this is not, only pointing counts':
    'η άκρη του δαχτύλου είναι στην πινακίδα όταν απέχει το πολύ τόσο από το σημείο. Αν έχει τιμή το cone και όχι αυτό, το δάχτυλο μετρά ' +
    'μόνο όταν δείχνει',
  'from afar too: the finger points at the point within this angle, and is within reach':
    'και από μακριά: το δάχτυλο δείχνει το σημείο μέσα σε αυτή τη γωνία, το πολύ από απόσταση reach',
  'how far pointing reaches': 'πόσο μακριά δείχνει το δάχτυλο',
  '1 while a finger has been on it for long enough': '1 όσο ένα δάχτυλο είναι εκεί για αρκετή ώρα',
  'from the nearest fingertip': 'από την πιο κοντινή άκρη δαχτύλου',
  'between the sign and where the best finger points': 'ανάμεσα στην πινακίδα και εκεί όπου δείχνει το πιο εύστοχο δάχτυλο',
  'how long a click on the sign still counts as a finger': 'για πόση ώρα ακόμη ένα κλικ στην πινακίδα λογίζεται δάχτυλο',
  // simulation.idle: nobody does anything
  'No hand has moved or touched anything for a while': 'Κανένα χέρι δεν έχει κινηθεί ή αγγίξει κάτι για λίγη ώρα',
  'after how long': 'ύστερα από πόση ώρα',
  'a hand that is slower than this does not move: people tremble': 'χέρι πιο αργό από αυτό λογίζεται ακίνητο: οι άνθρωποι τρέμουν λίγο',
  'the same for its rotation': 'το ίδιο για τη στροφή του',
  '1 while nothing has happened for that long': '1 όσο δεν έχει γίνει τίποτε για τόση ώρα',
  'since something happened': 'από τότε που έγινε κάτι',
  // touch.surface: feels otherwise
  ['While it is on, a body feels otherwise to hands; a hand that touches it goes on feeling what it met, until it leaves. Of two ' +
    'that are on, the later in `agents` counts, with all its keys; one that is written on the body itself is earlier than those']:
    'Όσο είναι ανοιχτή η δράση, τα χέρια νιώθουν αλλιώς ένα σώμα· ένα χέρι που το αγγίζει συνεχίζει να νιώθει ό,τι βρήκε, ώσπου να ' +
    'φύγει. Από δύο ανοιχτές μετρά όποια γράφτηκε πιο κάτω στο `agents`, με όλες τις ιδιότητές της· όποια γράφτηκε στο ίδιο το σώμα ' +
    'έρχεται πρώτη στη σειρά',
  'the body that feels otherwise': 'το σώμα του οποίου αλλάζει η αφή',
  'how hard it feels': 'πόσο σκληρό το νιώθει το χέρι',
  'how dull': 'πόσο πνίγει τον κραδασμό',
  'before it slips': 'πριν γλιστρήσει το δάχτυλο',
  'while it slips; at most staticFriction': 'όσο γλιστρά· το πολύ όσο πριν γλιστρήσει',
  'how syrupy it is to slide over: grease, wet clay': 'πόσο κολλά όταν γλιστράς: λίπος, υγρός πηλός',
  'the shake at the first touch, per speed of approach: stone and metal knock, cloth does not':
    'ο κραδασμός στο πρώτο άγγιγμα, ανά ταχύτητα προσέγγισης: πέτρα και μέταλλο χτυπούν, ύφασμα όχι',
  ['from ridge to bottom of even grooves in the surface: a grain, staves; 0: smooth; at most 0.00008 at a distance of 0.004, 0.0005 ' +
    'at 0.01']:
    'από την κορυφή έως τον πάτο ομοιόμορφων αυλακώσεων: νερά του ξύλου, σανίδες· 0: λεία επιφάνεια· το πολύ 0,00008 σε απόσταση 0,004 ' +
    'και 0,0005 σε 0,01',
  'from one groove to the next': 'από τη μία αυλάκωση στην άλλη',
  'across the grooves, in the body\'s frame; any length': 'κάθετα στις αυλακώσεις, στο σύστημα του σώματος· με όποιο μήκος',
  '1 while the body feels so: a hand that touches it goes on feeling what it met':
    '1 όσο το σώμα έχει αυτή την αφή: ένα χέρι που το αγγίζει συνεχίζει να νιώθει ό,τι βρήκε',
  // machine.screw_pump: Archimedes’ screw
  'Archimedes\' screw: lifts water as a hinge turns': 'Κοχλίας του Αρχιμήδη: ανεβάζει νερό όσο στρέφεται ένας μεντεσές',
  'the hinge that turns the screw': 'ο μεντεσές που στρέφει τον κοχλία',
  'over the blades': 'μαζί με τις έλικες',
  'of the bladed part': 'του μέρους που έχει έλικες',
  'advance of a blade in a turn; not given: the core\'s circumference (Vitruvius)':
    'πόσο προχωρά μια έλικα σε μία στροφή· αν λείπει, όσο η περιφέρεια του πυρήνα (Βιτρούβιος)',
  'of the core; not given: half the diameter (Vitruvius)': 'του πυρήνα· αν λείπει, η μισή διάμετρος (Βιτρούβιος)',
  'how many': 'πόσες είναι',
  'of the axis against the horizontal; Vitruvius\' triangle of 3, 4, 5 has 0.6435':
    'του άξονα ως προς το οριζόντιο επίπεδο· το τρίγωνο 3, 4, 5 του Βιτρούβιου έχει 0,6435',
  'from the river\'s surface to the outlet': 'από την επιφάνεια του ποταμού έως την έξοδο',
  'of the lifting, 0 to 1': 'της ανύψωσης, 0 έως 1',
  'share of the load that the hand feels; not given: the world\'s effort_scale':
    'μέρος του φορτίου που νιώθει το χέρι· αν λείπει, όσο ορίζει το έκθεμα',
  'true: the screw lifts when the hinge turns to negative angles':
    'αν ναι, ο κοχλίας ανυψώνει όταν ο μεντεσές στρέφεται προς αρνητικές γωνίες',
  'in which a standing screw loses two thirds of its water': 'σε πόσο χρόνο ένας σταματημένος κοχλίας χάνει τα δύο τρίτα του νερού του',
  'of the basin\'s water surface': 'του νερού στη δεξαμενή',
  'up to the rim': 'έως το χείλος',
  'in the basin at the start': 'στη δεξαμενή, στην αρχή',
  'water in the basin': 'νερό στη δεξαμενή',
  'of the basin\'s water over its floor': 'του νερού της δεξαμενής πάνω από τον πάτο της',
  'what comes into the basin now': 'τι έρχεται τώρα στη δεξαμενή',
  'what runs back over the core or over the basin\'s rim now': 'τι χύνεται τώρα πίσω, πάνω από τον πυρήνα ή από το χείλος της δεξαμενής',
  'lifted to the outlet so far': 'πόσο ανέβηκε ως τώρα έως την έξοδο',
  'what the water asks of the crank, unscaled': 'η πραγματική ροπή που ζητά το νερό από τη μανιβέλα',
  'share of the screw that is full of water, 0 to 1': 'μέρος του κοχλία που είναι γεμάτο νερό, 0 έως 1',
  // machine.force_pump: force pump
  'Ktesibios\' pump: pistons and valves lift water': 'Η αντλία του Κτησίβιου: έμβολα και βαλβίδες ανεβάζουν νερό',
  'one slider or two that move the pistons, upwards to positive positions; or see beam':
    'ένας ή δύο ολισθητές που κινούν τα έμβολα, με τις θετικές θέσεις προς τα πάνω· ή δείτε beam',
  'the hinge of the beam that moves the pistons; level, with both half way, at angle 0':
    'ο μεντεσές του ζυγού που κινεί τα έμβολα· στη γωνία 0 ο ζυγός είναι οριζόντιος και τα δύο έμβολα στη μέση',
  'of the beam, from its hinge to a piston\'s rod': 'του ζυγού, από τον μεντεσέ του έως τη ράβδο ενός εμβόλου',
  'of the beam, from its hinge to the hand; not given: as arm. With sliders both only tell handle_n':
    'του ζυγού, από τον μεντεσέ του έως το χέρι· αν λείπει, όσο arm. Με ολισθητές, τα arm και handleArm ορίζουν μόνο το handle_n',
  'under a beam: 1 or 2': 'με ζυγό: 1 ή 2',
  'of a cylinder, inside': 'ενός κυλίνδρου, από μέσα',
  'of a piston': 'ενός εμβόλου',
  'of sliders: the position at which a piston is at the bottom': 'με ολισθητές: η θέση όπου το έμβολο είναι στον πάτο',
  'from the well\'s surface to the trumpet\'s mouth': 'από την επιφάνεια του πηγαδιού έως το στόμιο της σάλπιγγας',
  'share of the displaced water that is lifted, 0 to 1': 'μέρος του εκτοπιζόμενου νερού που ανεβαίνει, 0 έως 1',
  'of each piston\'s leather': 'του δέρματος κάθε εμβόλου',
  'in the cylinders\' bottoms: good, reversed or missing; one word, or one for each cylinder':
    'στον πάτο των κυλίνδρων: good (σωστή), reversed (ανάποδη) ή missing (λείπει)· μία λέξη, ή μία για κάθε κύλινδρο',
  'over the forked pipe\'s ends: good, reversed or missing; one word, or one for each cylinder':
    'πάνω από τις άκρες του διχαλωτού σωλήνα: good (σωστή), reversed (ανάποδη) ή missing (λείπει)· μία λέξη, ή μία για κάθε κύλινδρο',
  'vessel and pipe up to the mouth: filled before the first water comes':
    'δοχείο και σωλήνας έως το στόμιο: γεμίζουν πριν έρθει το πρώτο νερό',
  'how long the air under the cowl takes to give back two thirds of a pulse; 0: no air':
    'σε πόσο χρόνο ο αέρας κάτω από το κάλυμμα δίνει πίσω τα δύο τρίτα ενός παλμού· 0: δεν υπάρχει',
  'of the water in the tub that the jet falls into': 'του νερού στον κάδο όπου πέφτει ο πίδακας',
  'true: the (first) piston rises when its joint goes to negative positions':
    'αν ναι, το (πρώτο) έμβολο ανεβαίνει όταν η άρθρωσή του πάει προς αρνητικές θέσεις',
  'what comes into the vessel now; negative where it runs back': 'τι έρχεται τώρα στο δοχείο· αρνητικό όταν τρέχει πίσω',
  'what leaves the trumpet now': 'τι βγαίνει τώρα από τη σάλπιγγα',
  'out of the trumpet so far': 'πόσο βγήκε ως τώρα από τη σάλπιγγα',
  'past the pistons so far': 'πόσο ξέφυγε ως τώρα γύρω από τα έμβολα',
  'of the water in the tub over its floor; 0 where no basinArea is given':
    'του νερού στον κάδο πάνω από τον πάτο του· 0 όπου δεν υπάρχει basinArea',
  'of the water over the well': 'του νερού πάνω από το πηγάδι',
  'of the water on the pressing pistons, unscaled': 'η πραγματική δύναμη του νερού στα έμβολα που πιέζουν',
  'what pistons and friction ask of the hand, unscaled': 'η πραγματική δύναμη που ζητούν έμβολα και τριβή από το χέρι',
  'how often the first piston has turned round': 'πόσες φορές το πρώτο έμβολο άλλαξε φορά',
  // machine.torsion_spring: twisted sinew
  'Twisted sinew that drives a catapult\'s arm': 'Στριμμένα νεύρα που κινούν τον βραχίονα ενός καταπέλτη',
  'the hinge of the arm, at 0 when the arm is at rest': 'ο μεντεσές του βραχίονα, στο 0 όταν ο βραχίονας ηρεμεί',
  'how many bundles drive it; 0: they are cut': 'πόσες δέσμες τον κινούν· 0: είναι κομμένες',
  'torque of one bundle at rest': 'ροπή μιας δέσμης σε ηρεμία',
  'torque of one bundle that each radian adds': 'ροπή που προσθέτει κάθε rad σε μια δέσμη',
  'of a bundle; checked against Philon\'s rule where stoneMass is given':
    'μιας δέσμης· ελέγχεται με τον κανόνα του Φίλωνα όπου υπάρχει stoneMass',
  'what the machine is made to throw; the springs\' diameter follows from it by Philon\'s rule':
    'του λίθου για τον οποίο είναι φτιαγμένη η μηχανή· από τη μάζα του βγαίνει η διάμετρος των ελατηρίων, με τον κανόνα του Φίλωνα',
  'the quantity that lets the arm go as it rises above 0.5: a projectile may take the energy then':
    'το μέγεθος που αφήνει τον βραχίονα μόλις περάσει το 0,5: τότε ένα βλήμα μπορεί να πάρει την ενέργεια',
  'share of the torque that the hand feels; not given: the world\'s effort_scale':
    'μέρος της ροπής που νιώθει το χέρι· αν λείπει, όσο ορίζει το έκθεμα',
  'true: the arm is drawn to negative angles': 'αν ναι, ο βραχίονας τραβιέται προς αρνητικές γωνίες',
  'of all springs on the arm, unscaled': 'η πραγματική ροπή όλων των ελατηρίων στον βραχίονα',
  'held by the springs, unscaled': 'η πραγματική ενέργεια που κρατούν τα ελατήρια',
  'how far the arm is drawn, from rest': 'πόσο τραβήχτηκε ο βραχίονας από τη θέση ηρεμίας',
  'what the last projectile took': 'τι πήρε το τελευταίο βλήμα',
  'the springs\' diameter in dactyls of 18.5 mm': 'η διάμετρος των ελατηρίων σε δακτύλους των 18,5 mm',
  // machine.bow: bow
  'A bow that a slider draws, and a claw that lets go': 'Ένα τόξο που το τεντώνει ένας ολισθητής, και ένα άγκιστρο που το αφήνει',
  'the slider that draws the string back': 'ο ολισθητής που τραβά πίσω τη χορδή',
  'at the full draw': 'στο πλήρες τέντωμα',
  'of the full draw, from the string at rest': 'του πλήρους τεντώματος, από τη χορδή σε ηρεμία',
  'shares of fullForce at equal steps of the draw; not given: 0 1, a straight line':
    'μέρη της fullForce σε ίσα διαστήματα του τεντώματος· αν λείπουν, 0 1, μια ευθεία',
  'position of the slider (from 0 in the direction of the draw) where its claw meets the string':
    'θέση του ολισθητή (από το 0, κατά τη φορά του τεντώματος) όπου το άγκιστρό του συναντά τη χορδή',
  'the quantity that opens the claw as it rises above 0.5': 'το μέγεθος που ανοίγει το άγκιστρο μόλις περάσει το 0,5',
  'false: the bow has no string, or the string is cut': 'αν όχι, δεν υπάρχει χορδή, ή είναι κομμένη',
  'the bodies of its two limbs, which the string bends; origins where they leave its middle':
    'τα σώματα των δύο βραχιόνων του, που τους λυγίζει η χορδή· με σημείο αρχής εκεί όπου φεύγουν από τη μέση του τόξου',
  'the bodies of the string\'s two halves, in the same order; origins at the limbs\' tips':
    'τα σώματα των δύο μισών της χορδής, με την ίδια σειρά· με σημείο αρχής στις άκρες των βραχιόνων',
  'share of the force that the hand feels; not given: the world\'s effort_scale':
    'μέρος της δύναμης που νιώθει το χέρι· αν λείπει, όσο ορίζει το έκθεμα',
  'true: the slider draws to negative positions': 'αν ναι, ο ολισθητής τεντώνει προς αρνητικές θέσεις',
  '1 while the claw holds the string': '1 όσο το άγκιστρο κρατά τη χορδή',
  'how far the string is drawn': 'πόσο τραβήχτηκε η χορδή',
  'of the string on the slider, unscaled': 'η πραγματική δύναμη της χορδής στον ολισθητή',
  'held by the bow, unscaled': 'η πραγματική ενέργεια που κρατά το τόξο',
  // machine.projectile: missile
  'A stone or an arrow that a spring throws': 'Πέτρα ή βέλος που το ρίχνει ένα ελατήριο',
  'the missile': 'το βλήμα',
  'the machine that throws it, written before this one': 'η μηχανή που το ρίχνει, γραμμένη πριν από αυτήν εδώ',
  'the body that seat and direction are measured in; not given: the world':
    'το σώμα ως προς το οποίο μετριούνται seat και direction· αν λείπει, ο κόσμος',
  'where the missile\'s origin lies before the shot, in the stock\'s frame':
    'πού είναι το σημείο αρχής του βλήματος πριν από τη βολή, στο σύστημα του stock',
  'how far from its seat it may lie to be thrown': 'πόσο, το πολύ, μπορεί να απέχει από τη θέση του για να ριχτεί',
  'of the shot, in the stock\'s frame': 'της βολής, στο σύστημα του stock',
  'a joint that holds it before the shot: it is thrown when that is off':
    'άρθρωση που το κρατά πριν από τη βολή: ρίχνεται όταν αυτή πάψει να ισχύει',
  'share of the spring\'s energy that it gets: 0.6 of torsion springs, 0.8 of a bow':
    'μέρος της ενέργειας του ελατηρίου που παίρνει: 0,6 από στριμμένα νεύρα, 0,8 από τόξο',
  'of its cross-section, for the drag': 'της διατομής του, για την αντίσταση του αέρα',
  '0.47 of a ball; 2 of an arrow\'s cross-section with its fletching': '0,47 για σφαίρα· 2 για τη διατομή ενός βέλους με τα φτερά του',
  'in its own frame, towards its tip: the missile is fletched. Not given: it flies as it turns':
    'στο δικό του σύστημα, προς τη μύτη του: το βλήμα έχει φτερά. Αν λείπει, πετά ενώ στρέφεται ελεύθερα',
  'in its own frame: what meets the target': 'στο δικό του σύστημα: τι συναντά τον στόχο',
  'height in the world at which the flight ends': 'ύψος, στο σύστημα του κόσμου, όπου τελειώνει η πτήση',
  'the body whose face holds what enters': 'το σώμα του οποίου η επιφάνεια κρατά ό,τι μπαίνει',
  'of the face, in the target\'s frame': 'της επιφάνειας, στο σύστημα του στόχου',
  'out of the face, in the target\'s frame; not given: its z':
    'προς τα έξω από την επιφάνεια, στο σύστημα του στόχου· αν λείπει, ο άξονας z του',
  'of the face': 'της επιφάνειας',
  'by which the target holds what enters; straw: some 1000': 'με αυτήν ο στόχος κρατά ό,τι μπαίνει· άχυρο: περίπου 1000',
  '1 from the shot to the blow': '1 από τη βολή έως το χτύπημα',
  'of the flight, the last one where it has ended': 'της πτήσης· όταν έχει τελειώσει, η τελευταία',
  'over ground, from the shot to here or to where the flight ended': 'οριζόντια, από τη βολή έως εδώ ή έως εκεί όπου τελείωσε η πτήση',
  'the highest so far, above the shot': 'το μεγαλύτερο ως τώρα, πάνω από το σημείο της βολής',
  'since the shot': 'από τη στιγμή της βολής',
  'at the shot': 'τη στιγμή της βολής',
  'so far': 'ως τώρα',
  '1 when the flight ended at something else than the target': '1 αν η πτήση τελείωσε σε κάτι άλλο από τον στόχο',
  '1 when it went into the target': '1 αν μπήκε στον στόχο',
  'from the target\'s centre to the hit': 'από το κέντρο του στόχου έως εκεί όπου χτύπησε',
  'how far it went in': 'πόσο μπήκε μέσα',
  // machine.steam_sphere: Heron’s steam sphere
  'A fire boils water, and jets of steam turn a sphere': 'Μια φωτιά βράζει νερό, και πίδακες ατμού στρέφουν μια σφαίρα',
  'the hinge that the sphere turns on': 'ο μεντεσές γύρω από τον οποίο στρέφεται η σφαίρα',
  'the quantity that is above 0.5 while the fire burns; or write litBy':
    'το μέγεθος που είναι πάνω από 0,5 όσο καίει η φωτιά· ή γράψτε litBy',
  'the simulation.lit that says whether the fire burns; or write fire': 'το simulation.lit που λέει αν καίει η φωτιά· ή γράψτε fire',
  'of the fire into the water': 'της φωτιάς προς το νερό',
  'in the cauldron at the start': 'στον λέβητα, στην αρχή',
  'around, and of the water at the start': 'γύρω, και του νερού στην αρχή',
  'what the cauldron gives to the air': 'τι δίνει ο λέβητας στον αέρα',
  'how many times as fast as the clock the water heats and is used up':
    'πόσες φορές πιο γρήγορα από το ρολόι ζεσταίνεται και ξοδεύεται το νερό',
  'by which the flow of steam follows the boiling, real time':
    'με πόση καθυστέρηση η ροή του ατμού ακολουθεί τον βρασμό, σε πραγματικό χρόνο',
  'from the sphere\'s axis to a nozzle\'s mouth': 'από τον άξονα της σφαίρας έως το στόμιο ενός ακροφυσίου',
  'of a nozzle\'s bore': 'η εσωτερική διάμετρος ενός ακροφυσίου',
  'of each nozzle\'s jet, from the tangent against the turning; pi: bent the wrong way. Not given: 0 0':
    'του πίδακα κάθε ακροφυσίου, από την εφαπτομένη αντίθετα στη στροφή· pi: λυγισμένο ανάποδα. Αν λείπουν, 0 0',
  'false: the cauldron is open, and no steam reaches the sphere': 'αν όχι, ο λέβητας είναι ανοιχτός, και ο ατμός δεν φτάνει στη σφαίρα',
  'friction of the two pivots': 'τριβή των δύο πείρων',
  'torque of the air at 1 rad/s; it grows with the square of the rate': 'ροπή του αέρα σε 1 rad/s· μεγαλώνει με το τετράγωνο της ταχύτητας',
  'share of the torques that is applied; not given: the world\'s effort_scale, as for the sphere\'s mass':
    'μέρος των ροπών που εφαρμόζεται· αν λείπει, όσο ορίζει το έκθεμα, όπως για τη μάζα της σφαίρας',
  'true: the nozzles drive the hinge to negative angles': 'αν ναι, τα ακροφύσια κινούν τον μεντεσέ προς αρνητικές γωνίες',
  'of the water': 'του νερού',
  'that comes off the water, in real time': 'ατμός που φεύγει από το νερό, σε πραγματικό χρόνο',
  'left in the cauldron': 'τι μένει στον λέβητα',
  'of the sphere; the unit rpm converts': 'της σφαίρας· η μονάδα rpm μετατρέπεται',
  'of the jets, unscaled': 'η πραγματική ροπή των πιδάκων',
  'of the steam out of the nozzles': 'του ατμού που βγαίνει από τα ακροφύσια',
  '1 while the water boils': '1 όσο βράζει το νερό',
  // machine.pebble_counter: counter of pebbles
  'Drops a pebble as each hole of a drum passes': 'Ρίχνει ένα βότσαλο κάθε φορά που περνά μια τρύπα ενός τυμπάνου',
  'the hinge of the drum with the pebbles; its second body is the drum':
    'ο μεντεσές του τυμπάνου με τα βότσαλα· το δεύτερο σώμα του είναι το τύμπανο',
  'of the drum, each with a pebble': 'του τυμπάνου, καθεμία με ένα βότσαλο',
  'the way of the cart from one pebble to the next; a Roman mile is 1480 m':
    'ο δρόμος του κάρου από το ένα βότσαλο στο επόμενο· ένα ρωμαϊκό μίλι είναι 1480 m',
  'of the drum, when the first hole comes over the opening; not given: half of one hole\'s share':
    'του τυμπάνου, όταν η πρώτη τρύπα έρχεται πάνω από το άνοιγμα· αν λείπει, η μισή γωνία από τρύπα σε τρύπα',
  'the pebbles, in the order in which they fall; none: they are only counted':
    'τα βότσαλα, με τη σειρά που πέφτουν· αν λείπουν, μόνο μετριούνται',
  'true: the drum counts when it turns to negative angles': 'αν ναι, το τύμπανο μετρά όταν στρέφεται προς αρνητικές γωνίες',
  'fallen so far': 'πόσα έπεσαν ως τώρα',
  'that the pebbles stand for': 'δρόμος που δείχνουν τα βότσαλα',
  'pebbles still in the drum': 'βότσαλα που μένουν στο τύμπανο',
  // machine.formula: machine of formulas
  'A machine of your own: its values and loads are formulas': 'Μια δική σας μηχανή: οι τιμές και τα φορτία της είναι τύποι',
  'each `NAME = FORMULA` or `NAME = FORMULA in UNIT`; those with a unit can be read by quantities':
    'ο καθένας `NAME = FORMULA` ή `NAME = FORMULA in UNIT`· όσοι έχουν μονάδα διαβάζονται από μεγέθη',
  'the hinge or slider that `load` and `resistance` act on': 'ο μεντεσές ή ο ολισθητής όπου δρουν `load` και `resistance`',
  'formula of the force along the slider, or of the torque about the hinge':
    'τύπος της δύναμης κατά τον ολισθητή, ή της ροπής γύρω από τον μεντεσέ',
  'formula of what only brakes the joint; below 0 it is 0': 'τύπος για ό,τι μόνο φρενάρει την άρθρωση· κάτω από 0 είναι 0',
  'the body that `force` and `torque` act on': 'το σώμα όπου δρουν `force` και `torque`',
  'formula of the force on the body, along `axis` at `point`': 'τύπος της δύναμης στο σώμα, κατά τον `axis` στο `point`',
  'formula of the torque on the body, about `axis`': 'τύπος της ροπής στο σώμα, γύρω από τον `axis`',
  'of force and torque, in the body\'s frame; not given: its y axis':
    'της δύναμης και της ροπής, στο σύστημα του σώματος· αν λείπει, ο άξονας y του',
  'where the force acts, in the body\'s frame': 'πού δρα η δύναμη, στο σύστημα του σώματος',
  'the most that any of the loads comes to, either way': 'έως πού φτάνει, το πολύ, κάθε φορτίο, όποια κι αν είναι η φορά',
  'share of the loads that is applied; not given: the world\'s effort_scale':
    'μέρος των φορτίων που εφαρμόζεται· αν λείπει, όσο ορίζει το έκθεμα',
  'ticks in which a formula divided by zero, or had no finite result':
    'σε πόσα χιλιοστά του δευτερολέπτου ένας τύπος διαίρεσε με το μηδέν ή δεν έδωσε πεπερασμένο αποτέλεσμα',
  // machine.water_network: water and pipes
  'Vessels, pipes, valves, siphons, shut-in air and floats': 'Δοχεία, σωλήνες, βαλβίδες, σίφωνες, κλεισμένος αέρας και πλωτήρες',
  'each `NAME: area 0.02 m2, height 0.3 m`; see *Water networks*':
    'το καθένα `NAME: area 0.02 m2, height 0.3 m`· δείτε το κεφάλαιο *Water networks*',
  'each `NAME: from VESSEL at 0.5 m, to air, bore 8 mm`': 'ο καθένας `NAME: from VESSEL at 0.5 m, to air, bore 8 mm`',
  'each `NAME: into VESSEL, flow 2 l/min`': 'το καθένα `NAME: into VESSEL, flow 2 l/min`',
  'each `NAME: in VESSEL, of BODY.body, area 40 cm2, height 3 cm`': 'ο καθένας `NAME: in VESSEL, of BODY.body, area 40 cm2, height 3 cm`',
  'how many times as fast as the clock the water flows': 'πόσες φορές πιο γρήγορα από το ρολόι τρέχει το νερό',
  'the most that a float\'s lift or the weight of a vessel\'s water comes to':
    'έως πού φτάνει, το πολύ, η άνωση ενός πλωτήρα ή το βάρος του νερού ενός δοχείου',
  'that feeds have poured': 'νερό που χύθηκε μέσα (feeds)',
  'that has left by pipes into the open': 'νερό που έφυγε από σωλήνες προς τα έξω',
  'that has run over rims': 'νερό που ξεχείλισε',
};
