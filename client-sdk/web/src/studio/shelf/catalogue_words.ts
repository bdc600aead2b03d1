import type { ItemKind, KindFilter } from './catalogue';
import type { Language } from '../words';

interface CatalogueWords {
  name: string;
  intro: string;
  search: string;
  filters: string;
  kind: string;
  tag: string;
  licence: string;
  language: string;
  all: string;
  noLicence: string;
  clear: string;
  found: (n: number, all: number) => string;
  nothing: string;
  nothingHelp: string;
  kindsMany: Record<KindFilter, string>;
  kinds: Record<ItemKind, string>;
  draft: string;
  published: string;
  from: (exhibit: string) => string;
  by: (author: string) => string;
  notUsed: string;
  used: (n: number) => string;
  use: (exhibit: string, draft: boolean, place: string, line: number) => string;
  take: string;
  taken: (name: string) => string;
  begin: string;
  about: string;
  aboutOf: (name: string) => string;
  aboutExhibit: string;
  aboutFile: string;
  description: string;
  author: string;
  source: string;
  tags: string;
  tagsHelp: string;
  languages: string;
  languagesHelp: string;
  save: string;
  saved: string;
  fromCatalogue: string;
  toFiles: string;
  cannotDelete: (name: string) => string;
  cannotDeleteText: string;
  replaces: string;
}

const kEnglish: CatalogueWords = {
  name: 'Catalogue',
  intro: 'All that the museum has: exhibits and drafts, their meshes and sounds, and the library. What is said of each is found here, too.',
  search: 'Search by name, title, description or tag',
  filters: 'Filters',
  kind: 'Kind',
  tag: 'Tag',
  licence: 'Licence',
  language: 'Language',
  all: 'all',
  noLicence: 'none is known',
  clear: 'Show all',
  found: (n, all) => (n === all ? `${all} in the catalogue` : `${n} of ${all}`),
  nothing: 'Nothing here fits what you look for.',
  nothingHelp: 'Take fewer words or the beginning of one, or show all and choose a filter.',
  kindsMany: { exhibit: 'Exhibits', draft: 'Drafts', mesh: 'Meshes', sound: 'Sounds', template: 'Templates', part: 'Parts' },
  kinds: { exhibit: 'Exhibit', mesh: 'Mesh', sound: 'Sound', template: 'Template', part: 'Part of the library' },
  draft: 'draft',
  published: 'published',
  from: (exhibit) => `of ${exhibit}`,
  by: (author) => `by ${author}`,
  notUsed: 'Nothing uses it',
  used: (n) => (n === 1 ? 'Used in 1 place' : `Used in ${n} places`),
  use: (exhibit, draft, place, line) => `${exhibit}${draft ? ' (draft)' : ''}: ${place}, line ${line}`,
  take: 'Take into this draft',
  taken: (name) => `${name} is now among the files of this draft.`,
  begin: 'Begin from it',
  about: 'What it is',
  aboutOf: (name) => `What ${name} is`,
  aboutExhibit: 'The exhibit’s file says this of itself. It is an edit of its draft, which undo takes back.',
  aboutFile: 'This is kept beside the file. Copies that others take have it, too.',
  description: 'Description',
  author: 'Author',
  source: 'Where it is from',
  tags: 'Tags',
  tagsHelp: 'Words by which it is found, with commas between them: wood, gear.',
  languages: 'Languages heard in it',
  languagesHelp: 'Their codes, with commas between them: el, en. Leave it empty where nobody speaks.',
  save: 'Save',
  saved: 'Saved.',
  fromCatalogue: 'From the catalogue',
  toFiles: 'Files of this draft',
  cannotDelete: (name) => `${name} is used`,
  cannotDeleteText: 'It is deleted once nothing uses it: remove it at these places, and publish the drafts that had it.',
  replaces: 'It changes here:',
};
const kGreek: CatalogueWords = {
  name: 'Κατάλογος',
  intro: 'Όσα έχει το μουσείο: εκθέματα και σχέδια, τα πλέγματα και οι ήχοι τους, και η βιβλιοθήκη, με όσα έχουν γραφτεί για το καθένα.',
  search: 'Αναζήτηση σε όνομα, τίτλο, περιγραφή ή ετικέτα',
  filters: 'Φίλτρα',
  kind: 'Είδος',
  tag: 'Ετικέτα',
  licence: 'Άδεια',
  language: 'Γλώσσα',
  all: 'όλα',
  noLicence: 'άγνωστη',
  clear: 'Εμφάνιση όλων',
  found: (n, all) => (n === all ? `${all} στον κατάλογο` : `${n} από ${all}`),
  nothing: 'Τίποτε εδώ δεν ταιριάζει με αυτό που ψάχνετε.',
  nothingHelp: 'Γράψτε λιγότερες λέξεις ή την αρχή μιας λέξης, ή εμφανίστε τα όλα και διαλέξτε φίλτρο.',
  kindsMany: { exhibit: 'Εκθέματα', draft: 'Σχέδια', mesh: 'Πλέγματα', sound: 'Ήχοι', template: 'Υποδείγματα', part: 'Εξαρτήματα' },
  kinds: { exhibit: 'Έκθεμα', mesh: 'Πλέγμα', sound: 'Ήχος', template: 'Υπόδειγμα', part: 'Εξάρτημα της βιβλιοθήκης' },
  draft: 'σχέδιο',
  published: 'δημοσιευμένο',
  from: (exhibit) => `του ${exhibit}`,
  by: (author) => `από ${author}`,
  notUsed: 'Δεν χρησιμοποιείται',
  used: (n) => (n === 1 ? 'Χρησιμοποιείται σε 1 σημείο' : `Χρησιμοποιείται σε ${n} σημεία`),
  use: (exhibit, draft, place, line) => `${exhibit}${draft ? ' (σχέδιο)' : ''}: ${place}, γραμμή ${line}`,
  take: 'Προσθήκη στο σχέδιο',
  taken: (name) => `Το ${name} είναι τώρα στα αρχεία αυτού του σχεδίου.`,
  begin: 'Νέο από αυτό',
  about: 'Τι είναι',
  aboutOf: (name) => `Τι είναι το ${name}`,
  aboutExhibit: 'Αυτά τα λέει το ίδιο το αρχείο του εκθέματος. Είναι αλλαγή του σχεδίου και η αναίρεση την παίρνει πίσω.',
  aboutFile: 'Αυτά φυλάσσονται δίπλα στο αρχείο. Τα έχουν και τα αντίγραφα που παίρνουν άλλοι.',
  description: 'Περιγραφή',
  author: 'Δημιουργός',
  source: 'Από πού προέρχεται',
  tags: 'Ετικέτες',
  tagsHelp: 'Λέξεις με τις οποίες βρίσκεται, με κόμμα ανάμεσα: ξύλο, γρανάζι.',
  languages: 'Γλώσσες που ακούγονται',
  languagesHelp: 'Οι κωδικοί τους, με κόμμα ανάμεσα: el, en. Αφήστε το κενό αν δεν μιλά κανείς.',
  save: 'Αποθήκευση',
  saved: 'Αποθηκεύτηκε.',
  fromCatalogue: 'Από τον κατάλογο',
  toFiles: 'Αρχεία αυτού του σχεδίου',
  cannotDelete: (name) => `Το ${name} χρησιμοποιείται`,
  cannotDeleteText: 'Διαγράφεται μόλις δεν το χρησιμοποιεί τίποτε: αφαιρέστε το από αυτά τα σημεία και δημοσιεύστε τα σχέδια που το είχαν.',
  replaces: 'Αλλάζει εδώ:',
};
export const catalogueWords = (language: Language): CatalogueWords => (language === 'el' ? kGreek : kEnglish);
