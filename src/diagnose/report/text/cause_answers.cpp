#include "diagnose/report/text/cause_answers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnose/report/text/finding_text.h"
#include "diagnose/report/text/mechanism_words.h"
#include "diagnose/report/text/next_manoeuvre_text.h"
#include "diagnose/report/text/plain_sentence.h"
#include "diagnose/report/text/ranking.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

/// Probabilities of chance, on what the cause was chosen by and on what was kept back, up to which
/// an answer goes by a word.
constexpr double kVerySure = 0.001, kSure = 0.01;
constexpr double kLeastP = 1e-4;  ///< smaller ones are told as smaller
constexpr double kOftenByChance = 0.5;

std::string SurenessText(const Finding& finding) {
  const std::size_t rivals = RivalsOf(finding).size();
  if (rivals > 0) {
    return fmt::format("Sure that something is wrong here, not which of {} causes it is.",
                       rivals + 1);
  }
  const double p = std::max(finding.evidence.p, finding.held_out.p);
  return p <= kVerySure ? "Very sure." : p <= kSure ? "Sure." : "Fairly sure.";
}

/// "valve curve of the arm (a valve that does not open in proportion to the lever)".
std::string RivalInWords(const Candidate& rival, const Candidate& found) {
  const MechanismWords& words = *WordsOf(rival.mechanism->id, rival.target);
  std::string name(words.label);
  if (rival.target != found.target) name += " of " + TargetText(rival);
  if (rival.target == found.target && rival.mechanism == found.mechanism) {
    name += " by its other numbers";
  }
  return fmt::format("{} ({})", name, words.kind);
}

/// Whether a set of the next manoeuvre is of a cause and its rivals.
bool IsOf(const DiscriminatedSet& set, const Cause& cause) {
  return set.is_class && set.target == cause.target() &&
         std::find(set.members.begin(), set.members.end(), cause.mechanism().id) !=
             set.members.end();
}

std::string LabelsOf(const DiscriminatedSet& set) {
  std::vector<std::string> labels;
  for (const std::string& member : set.members) {
    const MechanismWords* words = WordsOf(member, set.target);
    labels.push_back(words == nullptr ? Spaced(member) : std::string(words->label));
  }
  return Listed(labels);
}

/// How often chance would do as well, on the two parts of the recording that are asked.
std::string ChanceText(const Cause& cause) {
  const std::string chosen = OddsText(cause.finding->evidence.p);
  const std::string kept_back = OddsText(cause.finding->held_out.p);
  if (cause.sensor != nullptr) {
    return fmt::format(
        "Chance alone would do as well in {} cases, on parts of the recording that it was not "
        "fitted to.",
        chosen);
  }
  const char* const by = cause.block != nullptr ? "the driving" : "the measurements";
  if (chosen == kept_back) {
    return fmt::format(
        "Chance alone would do as well in {} cases, on {} by which the cause was chosen and again "
        "on what was kept back.",
        chosen, by);
  }
  return fmt::format(
      "Chance alone would do as well in {} cases on {} by which the cause was chosen, and in {} on "
      "what was kept back.",
      chosen, by, kept_back);
}

}  // namespace

std::string OddsText(double p) {
  if (p < kLeastP) return "fewer than 1 of 10 000";
  if (p > kOftenByChance) return "more than 1 of 2";
  return "1 of " + Significant(1 / p, 2);
}

std::string HowSureText(const Cause& cause) {
  const Finding& finding = *cause.finding;
  std::string text = SurenessText(finding) + " " + ChanceText(cause);
  if (cause.seen == nullptr || !cause.seen->place) {
    text += fmt::format(" With its standard deviation: {}.", NameAndNumbers(finding));
  }
  if (cause.block != nullptr && IsLeft(*cause.block, finding.location.channel)) {
    text += " Error is left beside it: do not trust the number yet.";
  }
  return text;
}

std::string WhatElseText(const Cause& cause) {
  const Candidate& found = *cause.finding->term.candidate;
  std::vector<std::string> rivals;
  for (const Candidate* rival : RivalsOf(*cause.finding)) {
    rivals.push_back(RivalInWords(*rival, found));
  }
  if (!rivals.empty()) {
    return fmt::format("This recording cannot tell it from: {}.", fmt::join(rivals, "; "));
  }
  const std::vector<Rival>& rejected = cause.finding->evidence.rejected;
  if (rejected.empty()) return "Nothing else that was tried does as well.";
  return fmt::format(
      "Nothing else that was tried does as well. Nearest comes {}, which is ruled out: "
      "chance would do that in {} cases.",
      RivalInWords(*rejected.front().candidate, found), OddsText(rejected.front().p));
}

std::string WhatToDriveText(const Cause& cause, const Diagnosis& diagnosis) {
  if (RivalsOf(*cause.finding).empty())
    return "Nothing, for this one: no other cause does as well.";
  if (diagnosis.next) {
    const NextManoeuvre& next = *diagnosis.next;
    const auto told = std::find_if(next.discriminated.begin(), next.discriminated.end(),
                                   [&](const DiscriminatedSet& set) { return IsOf(set, cause); });
    if (told != next.discriminated.end()) {
      return fmt::format(
          "The levers in {} ({:.0f} s; {}) tell {} apart in {:.0f} of 100 recordings.",
          kNextManoeuvreFile, next.duration_s, next.description, LabelsOf(*told),
          100 * told->power);
    }
  }
  if (cause.block != nullptr && HasLever(cause.block->block)) {
    return "No levers were found that would tell these causes apart.";
  }
  return "Levers are worked out for joints, tracks and wheels alone. Record more driving with "
         "other "
         "headings, tilts and loads, or measure on the machine.";
}

}  // namespace tera
