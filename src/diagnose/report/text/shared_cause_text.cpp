#include "diagnose/report/text/shared_cause_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "diagnose/report/text/mechanism_words.h"
#include "diagnose/report/text/plain_sentence.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

using Kind = CauseInRecording::Kind;

std::string LabelOf(const Candidate& candidate) {
  const MechanismWords* words = WordsOf(candidate.mechanism->id, candidate.target);
  return words != nullptr ? std::string(words->label) : Spaced(candidate.mechanism->id);
}

/// "recording 2", "recordings 1 and 3": those of a kind, counted from 1; empty where there is none.
std::string RecordingsOf(const SharedCause& cause, Kind kind) {
  std::vector<std::string> numbers;
  for (std::size_t r = 0; r < cause.recordings.size(); ++r) {
    if (cause.recordings[r].kind == kind) numbers.push_back(std::to_string(r + 1));
  }
  if (numbers.empty()) return "";
  return (numbers.size() == 1 ? "recording " : "recordings ") + Listed(numbers);
}

std::string NumberText(const UncertainNumber& number, const std::string& unit) {
  const ReadableUnit readable = ReadableUnitOf(ParameterEstimate{"", unit, 0, {}});
  return WithUnit(WithSigma(number.value * readable.factor, number.sigma * readable.factor),
                  readable);
}

/// ", width 0.121 ± 0.003": all of a cause's numbers; what differs says so.
std::string PooledText(const SharedCause& cause) {
  std::string text;
  for (const SharedNumber& number : cause.numbers) {
    const PooledNumber& pooled = number.pooled;
    text += fmt::format("{} {} {}", text.empty() ? "," : " and", WithoutUnit(number.name),
                        NumberText({pooled.value, pooled.sigma}, number.unit));
    if (!number.differs) continue;
    const ReadableUnit unit =
        ReadableUnitOf(ParameterEstimate{number.name, number.unit, pooled.value, {}});
    text += fmt::format(", which differs from one to another by {}, more than its errors ({})",
                        WithUnit(Significant(pooled.between * unit.factor, 2), unit),
                        ProbabilityText(pooled.p));
  }
  return text;
}

/// A sentence on the recordings of a kind; `what` follows on them.
std::string ClauseOn(const SharedCause& cause, Kind kind, const std::string& what) {
  const std::string recordings = RecordingsOf(cause, kind);
  return recordings.empty() ? "" : fmt::format(" {}: {}.", Capitalised(recordings), what);
}

}  // namespace

std::string HeadingOf(const SharedCause& cause) {
  std::string target = TargetText(*cause.candidate);
  if (target.starts_with("the ")) target = target.substr(4);
  std::vector<std::string> labels;
  for (const Candidate* one : cause.rivals) {
    labels.push_back(LabelOf(*one));
    if (one->target != cause.target()) labels.back() += " of " + TargetText(*one);
  }
  return fmt::format("{}: {}", Capitalised(target), fmt::join(labels, " or "));
}

std::string CellOf(const SharedCause& cause, const CauseInRecording& one) {
  std::string numbers;
  if (one.finding != nullptr) {
    for (const SharedNumber& number : cause.numbers) {
      for (const ParameterEstimate& estimate : one.finding->parameters) {
        if (estimate.name != number.name || !estimate.sigma) continue;
        numbers += (numbers.empty() ? "" : ", ") +
                   NumberText({estimate.value, *estimate.sigma}, number.unit);
      }
    }
  }
  switch (one.kind) {
    case Kind::kNamed:
      return numbers.empty() ? "named" : numbers;
    case Kind::kAsRival:
      return "as well as what is named";
    case Kind::kWithinTolerance:
      return "within tolerance" + (numbers.empty() ? "" : ": " + numbers);
    case Kind::kUnconfirmed:
      return "chosen, not confirmed";
    case Kind::kAbsent:
      return "not there";
    case Kind::kTooFaint:
      return "would not show";
    case Kind::kNotCompared:
      return "not compared";
  }
  return "";
}

std::string SentenceOf(const SharedCause& cause) {
  std::string named = RecordingsOf(cause, Kind::kNamed);
  if (cause.Found() == cause.recordings.size()) {
    named = fmt::format("all {} recordings", cause.recordings.size());
  }
  std::string text = HeadingOf(cause);
  if (!named.empty()) text += fmt::format(" in {}", named);
  text += PooledText(cause) + ".";
  text += ClauseOn(cause, Kind::kAsRival, "does as well as what is named there");
  text += ClauseOn(cause, Kind::kWithinTolerance, "within tolerance");
  text += ClauseOn(cause, Kind::kAbsent, "not there, where one of this size would have shown");
  text += ClauseOn(cause, Kind::kUnconfirmed, "chosen, and not confirmed on what was kept back");
  text += ClauseOn(cause, Kind::kTooFaint, "one of this size would not have shown");
  text += ClauseOn(cause, Kind::kNotCompared, "not compared, or hardly moved");
  return text;
}

std::string AnswerText(const std::vector<SharedCause>& causes, std::size_t recordings) {
  const auto shared =
      static_cast<std::size_t>(std::count_if(causes.begin(), causes.end(), [](const auto& one) {
        return one.IsShared() && one.Found() > 1;
      }));
  const auto of_one =
      static_cast<std::size_t>(std::count_if(causes.begin(), causes.end(), [](const auto& one) {
        return one.IsShared() && one.Found() == 1;
      }));
  const std::size_t differing = causes.size() - shared - of_one;
  if (causes.empty()) return fmt::format("{} recordings: none of them names a cause.", recordings);
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const char* what_one, const char* what_many) {
    if (count == 0) return;
    parts.push_back(fmt::format("{} {} {}", count, count == 1 ? "cause" : "causes",
                                count == 1 ? what_one : what_many));
  };
  add(shared, "that they share", "that they share");
  add(differing, "that differs from one to another", "that differ from one to another");
  add(of_one, "that only one of them could show", "that only one of them each could show");
  return fmt::format("{} recordings: {}.", recordings, Listed(parts));
}

}  // namespace tera
