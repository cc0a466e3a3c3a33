#include "diagnose/recordings/shared_causes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/diagnosis.h"
#include "diagnose/statistics/hypothesis_tests/multiple_testing.h"

namespace tera {
namespace {

using Kind = CauseInRecording::Kind;

/// Probability of reporting a difference if all parameters agree.
constexpr double kDifferingP = 0.01;

using Candidates = std::vector<const Candidate*>;

/// True if both candidates, perhaps of two recordings, have the same mechanism and target.
bool AreOne(const Candidate& a, const Candidate& b) {
  return a.target == b.target && a.mechanism == b.mechanism;
}

bool Has(const Candidates& all, const Candidate& one) {
  return std::any_of(all.begin(), all.end(),
                     [&](const Candidate* other) { return AreOne(*other, one); });
}

/// A finding's candidate and its rivals.
Candidates ClassOf(const Finding& finding) {
  Candidates all{finding.term.candidate};
  for (const Candidate* rival : finding.evidence.rivals) {
    if (!Has(all, *rival)) all.push_back(rival);
  }
  return all;
}

/// Findings of one cause, at most one per recording.
struct Group {
  Candidates alike;
  std::vector<const Finding*> findings;  ///< null for a recording without one

  bool Takes(const Finding& finding, std::size_t recording) const {
    const Candidates other = ClassOf(finding);
    return findings[recording] == nullptr &&
           std::any_of(other.begin(), other.end(),
                       [&](const Candidate* one) { return Has(alike, *one); });
  }
  void Add(const Finding& finding, std::size_t recording) {
    const Candidates other = ClassOf(finding);
    std::erase_if(alike, [&](const Candidate* one) { return !Has(other, *one); });
    findings[recording] = &finding;
  }
};

std::vector<Group> GroupsOf(const std::vector<const Diagnosis*>& diagnoses) {
  std::vector<Group> groups;
  for (std::size_t r = 0; r < diagnoses.size(); ++r) {
    for (const Cause& cause : CausesOf(*diagnoses[r])) {
      if (cause.seen != nullptr && cause.seen->place) continue;
      const Finding& finding = *cause.finding;
      auto group = std::find_if(groups.begin(), groups.end(),
                                [&](const Group& one) { return one.Takes(finding, r); });
      if (group == groups.end()) {
        groups.push_back({ClassOf(finding), {}});
        group = std::prev(groups.end());
        group->findings.resize(diagnoses.size(), nullptr);
      }
      group->Add(finding, r);
    }
  }
  return groups;
}

/// The candidate that most recordings of a group name; the first of several.
const Candidate* MostNamed(const Group& group) {
  const auto count = [&](const Candidate* one) {
    return std::count_if(group.findings.begin(), group.findings.end(), [&](const Finding* finding) {
      return finding != nullptr && AreOne(*finding->term.candidate, *one);
    });
  };
  return *std::max_element(
      group.alike.begin(), group.alike.end(),
      [&](const Candidate* a, const Candidate* b) { return count(a) < count(b); });
}

bool IsOf(const Finding& finding, const SharedCause& cause) {
  return AreOne(*finding.term.candidate, *cause.candidate);
}

/// The first finding of the cause in a list, or null.
const Finding* FindIn(const std::vector<const Finding*>& findings, const SharedCause& cause) {
  const auto found = std::find_if(findings.begin(), findings.end(),
                                  [&](const Finding* one) { return IsOf(*one, cause); });
  return found == findings.end() ? nullptr : *found;
}

bool IsUnconfirmed(const Diagnosis& diagnosis, const SharedCause& cause) {
  return FindIn(UnconfirmedOf(diagnosis), cause) != nullptr ||
         FindIn(ProxiesOf(diagnosis), cause) != nullptr;
}

std::size_t MainNumber(const Candidate& candidate) {
  return candidate.free.empty() ? 0 : candidate.free.front().index;
}

/// Index of the nearest starting value. Starting values are ordered from faint to strong.
std::size_t RungOf(const Candidate& candidate, double number) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < candidate.starts.size(); ++i) {
    if (candidate.starts[i].empty()) break;
    const double off = std::abs(candidate.starts[i][MainNumber(candidate)] - number);
    if (off >= least) continue;
    nearest = i;
    least = off;
  }
  return nearest;
}

/// True if a candidate with this main parameter was detectable in a block.
bool WouldShow(const Detectability& seen, const std::optional<double>& number) {
  return seen.smallest && number &&
         RungOf(*seen.candidate, *seen.smallest) <= RungOf(*seen.candidate, *number);
}

/// Result of a recording that does not find the cause. `number` is the cause's main parameter.
Kind WithoutIt(const Diagnosis& diagnosis, const SharedCause& cause,
               const std::optional<double>& number) {
  Kind kind = Kind::kNotCompared;
  for (const DiagnosedBlock& block : diagnosis.blocks) {
    if (!block.diagnosis.is_testable) continue;
    for (const Detectability& seen : block.diagnosis.detectability) {
      if (!AreOne(*seen.candidate, *cause.candidate)) continue;
      if (WouldShow(seen, number)) return Kind::kAbsent;
      kind = Kind::kTooFaint;
    }
  }
  const SensorDiagnosis& sensors = diagnosis.sensors.estimate;
  const TargetMechanism it{cause.target(), cause.candidate->mechanism};
  const auto is_it = [&](const TargetMechanism& one) { return one == it; };
  if (std::any_of(sensors.untestable.begin(), sensors.untestable.end(), is_it)) {
    return Kind::kTooFaint;
  }
  const auto& estimated = sensors.estimated;
  return std::any_of(estimated.begin(), estimated.end(), is_it) ? Kind::kAbsent : kind;
}

CauseInRecording InRecording(const Diagnosis& diagnosis, const Finding* finding,
                             const SharedCause& cause, const std::optional<double>& number) {
  if (finding != nullptr) {
    if (IsOf(*finding, cause)) return {Kind::kNamed, finding};
    return {Kind::kAsRival, nullptr};
  }
  if (const Finding* within = FindIn(WithinToleranceOf(diagnosis), cause)) {
    return {Kind::kWithinTolerance, within};
  }
  if (IsUnconfirmed(diagnosis, cause)) return {Kind::kUnconfirmed, nullptr};
  return {WithoutIt(diagnosis, cause, number), nullptr};
}

/// Parameters of a cause, pooled over the recordings that estimate them.
std::vector<SharedNumber> NumbersOf(const SharedCause& cause) {
  std::vector<SharedNumber> numbers;
  for (std::size_t i = 0; i < cause.mechanism().parameters.size(); ++i) {
    std::vector<UncertainNumber> values;
    for (const CauseInRecording& one : cause.recordings) {
      if (one.finding == nullptr) continue;
      const ParameterEstimate& estimate = one.finding->parameters[i];
      if (estimate.sigma && *estimate.sigma > 0)
        values.push_back({estimate.value, *estimate.sigma});
    }
    const auto& free = cause.candidate->free;
    const bool is_free = std::any_of(free.begin(), free.end(),
                                     [&](const FreeParameter& one) { return one.index == i; });
    if (values.empty() || !is_free) continue;
    const EffectParameter& parameter = cause.mechanism().parameters[i];
    numbers.push_back({std::string(parameter.name), std::string(parameter.unit), Pool(values)});
  }
  return numbers;
}

/// Main parameter of a group's candidate, from the first recording that names it.
std::optional<double> SizeOf(const Group& group, const SharedCause& cause) {
  for (const Finding* finding : group.findings) {
    if (finding == nullptr || !IsOf(*finding, cause)) continue;
    const std::size_t main = MainNumber(*finding->term.candidate);
    if (main < finding->parameters.size()) return finding->parameters[main].value;
  }
  return std::nullopt;
}

SharedCause CauseOf(const Group& group, const std::vector<const Diagnosis*>& diagnoses) {
  SharedCause cause{MostNamed(group), group.alike, {}, {}};
  std::stable_partition(cause.rivals.begin(), cause.rivals.end(),
                        [&](const Candidate* one) { return one == cause.candidate; });
  const std::optional<double> size = SizeOf(group, cause);
  for (std::size_t r = 0; r < diagnoses.size(); ++r) {
    cause.recordings.push_back(InRecording(*diagnoses[r], group.findings[r], cause, size));
  }
  cause.numbers = NumbersOf(cause);
  return cause;
}

/// Marks parameters that differ between recordings (Holm).
void JudgeDifferences(std::vector<SharedCause>* causes) {
  std::vector<SharedNumber*> numbers;
  std::vector<double> p;
  for (SharedCause& cause : *causes) {
    for (SharedNumber& number : cause.numbers) {
      if (number.pooled.p == 1) continue;
      numbers.push_back(&number);
      p.push_back(number.pooled.p);
    }
  }
  const std::vector<double> adjusted = HolmAdjusted(p);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i]->differs = adjusted[i] <= kDifferingP;
}

}  // namespace

std::size_t SharedCause::CountOf(Kind kind) const {
  return static_cast<std::size_t>(
      std::count_if(recordings.begin(), recordings.end(),
                    [&](const CauseInRecording& one) { return one.kind == kind; }));
}

std::size_t SharedCause::Found() const { return CountOf(Kind::kNamed) + CountOf(Kind::kAsRival); }

bool SharedCause::IsShared() const {
  return CountOf(Kind::kAbsent) == 0 && CountOf(Kind::kWithinTolerance) == 0 &&
         std::none_of(numbers.begin(), numbers.end(),
                      [](const SharedNumber& one) { return one.differs; });
}

std::vector<SharedCause> SharedCausesOf(const std::vector<const Diagnosis*>& diagnoses) {
  std::vector<SharedCause> causes;
  for (const Group& group : GroupsOf(diagnoses)) causes.push_back(CauseOf(group, diagnoses));
  JudgeDifferences(&causes);
  std::stable_sort(causes.begin(), causes.end(), [](const SharedCause& a, const SharedCause& b) {
    return a.Found() > b.Found();
  });
  return causes;
}

}  // namespace tera
