#include "diagnose/next/open_question.h"

#include <algorithm>

#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

const char* const kNothing = "nothing";

bool Has(const Structure& terms, const Suspect* suspect) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const Term& term) { return term.suspect == suspect; });
}

Structure Without(Structure terms, const Suspect* suspect) {
  std::erase_if(terms, [&](const Term& term) { return term.suspect == suspect; });
  return terms;
}

/// A finding and its rivals, each fitted in its place.
OpenMatter ClassOf(const Finding& finding, const Structure& found, const StructureFitter& fitter) {
  OpenMatter matter;
  matter.is_class = true;
  const Structure others = Without(found, finding.term.suspect);
  std::vector<Structure> accounts;
  for (const Suspect* rival : finding.evidence.rivals) {
    matter.members.emplace_back(rival->mechanism->id);
    Structure account = others;
    account.push_back({rival, rival->starts.front()});
    accounts.push_back(rival == finding.term.suspect ? found : fitter.FitValues(account).terms);
  }
  for (const Structure& truth : accounts) {
    for (const Structure& instead : accounts) {
      if (&truth != &instead) matter.questions.push_back({truth, instead});
    }
    matter.questions.push_back({truth, others});
  }
  return matter;
}

}  // namespace

std::vector<OpenMatter> OpenMattersOf(const ReplayBlock& block, const BlockDiagnosis& diagnosis) {
  std::vector<OpenMatter> matters;
  const Structure& found = diagnosis.search.found.terms;
  const std::vector<Segment> seen = SeenSegmentsOf(diagnosis.manoeuvres);
  Mask mask(block.samples(), 0);
  for (const Segment& samples : seen) {
    for (std::size_t k = samples.begin; k < samples.end; ++k) mask[k] = 1;
  }
  const Likelihood likelihood(block, diagnosis.noise, mask);
  const StructureFitter fitter(block, likelihood, seen);
  for (const Finding& finding : diagnosis.findings) {
    if (finding.evidence.rivals.size() > 1) matters.push_back(ClassOf(finding, found, fitter));
  }
  for (const Detectability& one : diagnosis.detectability) {
    if (one.smallest || Has(found, one.suspect)) continue;
    const auto& starts = one.suspect->starts;
    Structure truth = found;
    truth.push_back({one.suspect, starts[starts.size() / 2]});
    matters.push_back(
        {{std::string(one.suspect->mechanism->id), kNothing}, false, {{truth, found}}});
  }
  return matters;
}

}  // namespace tera
