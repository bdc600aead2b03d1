// Words around a tape that is shown.
export interface TapeWords {
  machine: string;
  inStep: (step: string) => string;
  asItWas: string;
  play: string;
  pause: string;
  time: string;
  of: (at: string, all: string) => string;
  speed: string;
  language: string;
  steps: string;
  stepsAndRemarks: string;
}

const kEnglish: TapeWords = {
  machine: 'The machine', inStep: (step) => `step ${step}`, asItWas: 'as it was', play: 'Play', pause: 'Pause', time: 'Time',
  of: (at, all) => `${at} of ${all}`, speed: 'Speed', language: 'Language', steps: 'Steps', stepsAndRemarks: 'Steps and remarks',
};
const kGreek: TapeWords = {
  machine: 'Η μηχανή', inStep: (step) => `βήμα ${step}`, asItWas: 'όπως ήταν', play: 'Αναπαραγωγή', pause: 'Παύση', time: 'Χρόνος',
  of: (at, all) => `${at} από ${all}`, speed: 'Ταχύτητα', language: 'Γλώσσα', steps: 'Βήματα', stepsAndRemarks: 'Βήματα και σχόλια',
};
export const tapeWords = (language: string): TapeWords => (language === 'el' ? kGreek : kEnglish);
