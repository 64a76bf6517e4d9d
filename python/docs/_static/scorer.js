// Pages come before the names of the reference that have the word in them.
var Scorer = {
  objNameMatch: 11, objPartialMatch: 1, objPrio: {0: 0, 1: 0, 2: -5}, objPrioDefault: 0,
  title: 15, partialTitle: 7, term: 5, partialTerm: 2,
};
