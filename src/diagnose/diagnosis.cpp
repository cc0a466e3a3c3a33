#include "diagnose/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tera {

std::string_view NameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNone:
      return "none";
    case Verdict::kNamed:
      return "named";
    case Verdict::kClass:
      return "class";
    case Verdict::kUnexplained:
      return "unexplained";
    case Verdict::kUntestable:
      return "untestable";
  }
  return "";
}

std::vector<Verdict> VerdictsOf(const Diagnosis& diagnosis) {
  bool named = false, several = false, unexplained = false, judged = false;
  bool untestable = !diagnosis.not_compared.empty() || !diagnosis.missing_input.empty();
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    judged = judged || diagnosed.diagnosis.is_testable;
    untestable = untestable || !diagnosed.diagnosis.is_testable;
    unexplained = unexplained || !diagnosed.diagnosis.unexplained.empty();
    for (const Detectability& candidate : diagnosed.diagnosis.detectability) {
      untestable = untestable || !candidate.smallest;
    }
  }
  unexplained = unexplained || !UnexplainedOfSensors(diagnosis).empty();
  judged = judged || !diagnosis.sensors.estimate.channels.empty();
  untestable = untestable || !diagnosis.sensors.estimate.untestable.empty();
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    judged = judged || sensor.is_judged();
    untestable = untestable || !sensor.is_judged();
  }
  for (const Cause& cause : RankedCauses(diagnosis)) {
    (cause.finding->evidence.rivals.size() > 1 ? several : named) = true;
  }
  std::vector<Verdict> verdicts;
  if (named) verdicts.push_back(Verdict::kNamed);
  if (several) verdicts.push_back(Verdict::kClass);
  if (unexplained) verdicts.push_back(Verdict::kUnexplained);
  if (verdicts.empty() && judged) verdicts.push_back(Verdict::kNone);
  if (untestable) verdicts.push_back(Verdict::kUntestable);
  return verdicts;
}

namespace {

/// Share of the channel's mean square error on FINAL that a finding removes.
double RemovedShare(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const HeldOutError& error = finding.held_out;
  double at_first = 0;
  for (const HeldOutError& all : diagnosed.diagnosis.confirmed) {
    if (all.channel == error.channel) at_first = all.rmse_before;
  }
  const double removed = std::pow(error.rmse_before, 2) - std::pow(error.rmse_after, 2);
  return at_first > 0 ? removed / (at_first * at_first) : removed;
}

/// Total gain in log-likelihood of a block's findings, each over the structure without it.
double GainOf(const DiagnosedBlock& diagnosed) {
  double share = 0;
  for (const Finding& finding : diagnosed.diagnosis.findings) share += finding.evidence.share;
  return share * diagnosed.diagnosis.search.flexible_gain;
}

const Finding& FindingOf(const Finding& finding) { return finding; }
const Finding& FindingOf(const SensorFound& found) { return found.finding; }
const Finding& FindingOf(const PerceptionFinding& found) { return found.finding; }

template <typename Found>
void Add(const std::vector<Found>& some, std::vector<const Finding*>* all) {
  for (const Found& one : some) all->push_back(&FindingOf(one));
}

}  // namespace

std::vector<const Finding*> RankedFindings(const DiagnosedBlock& diagnosed) {
  std::vector<const Finding*> all;
  for (const Finding& finding : diagnosed.diagnosis.findings) all.push_back(&finding);
  std::stable_sort(all.begin(), all.end(), [&](const Finding* a, const Finding* b) {
    return RemovedShare(diagnosed, *a) > RemovedShare(diagnosed, *b);
  });
  return all;
}

std::vector<UnexplainedInBlock> RankedUnexplained(const Diagnosis& diagnosis) {
  std::vector<UnexplainedInBlock> all;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Unexplained& unexplained : diagnosed.diagnosis.unexplained) {
      all.push_back({&diagnosed, &unexplained});
    }
  }
  const auto gain = [](const UnexplainedInBlock& entry) {
    return entry.unexplained->share * entry.diagnosed->diagnosis.search.flexible_gain;
  };
  std::stable_sort(
      all.begin(), all.end(),
      [&](const UnexplainedInBlock& a, const UnexplainedInBlock& b) { return gain(a) > gain(b); });
  return all;
}

bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const auto& left = diagnosed.diagnosis.unexplained;
  return std::any_of(left.begin(), left.end(), [&](const Unexplained& unexplained) {
    return unexplained.location.channel == channel;
  });
}

const Learned* LearnedOf(const DiagnosedBlock& diagnosed, std::size_t channel) {
  for (const Learned& learned : diagnosed.learned) {
    if (learned.channel == channel) return &learned;
  }
  return nullptr;
}

std::string Cause::ErrorUnit() const {
  if (block != nullptr) return block->block.channels[finding->held_out.channel].unit;
  return sensor != nullptr ? sensor->unit : seen_by->unit;
}

double Cause::ErrorRatio() const {
  const HeldOutError& error = finding->held_out;
  return error.rmse_after > 0 ? error.rmse_before / error.rmse_after : 0;
}

std::vector<Cause> RankedCauses(const Diagnosis& diagnosis) {
  std::vector<const DiagnosedBlock*> blocks;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) blocks.push_back(&diagnosed);
  std::stable_sort(
      blocks.begin(), blocks.end(),
      [](const DiagnosedBlock* a, const DiagnosedBlock* b) { return GainOf(*a) > GainOf(*b); });
  std::vector<Cause> causes;
  for (const DiagnosedBlock* block : blocks) {
    for (const Finding* finding : RankedFindings(*block)) {
      causes.push_back({.finding = finding, .block = block});
    }
  }
  for (const SensorFound& found : diagnosis.sensors.findings) {
    causes.push_back({.finding = &found.finding, .sensor = &found});
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const PerceptionFinding& found : sensor.findings) {
      causes.push_back({.finding = &found.finding, .seen_by = &sensor, .seen = &found});
    }
  }
  return causes;
}

std::vector<const Finding*> WithinToleranceOf(const Diagnosis& diagnosis) {
  std::vector<const Finding*> all;
  for (const DiagnosedBlock& block : diagnosis.blocks) Add(block.diagnosis.within_tolerance, &all);
  Add(diagnosis.sensors.within_tolerance, &all);
  return all;
}

std::vector<const Finding*> UnconfirmedOf(const Diagnosis& diagnosis) {
  std::vector<const Finding*> all;
  for (const DiagnosedBlock& block : diagnosis.blocks) Add(block.diagnosis.unconfirmed, &all);
  Add(diagnosis.sensors.unconfirmed, &all);
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) Add(sensor.unconfirmed, &all);
  return all;
}

std::vector<const Finding*> ProxiesOf(const Diagnosis& diagnosis) {
  std::vector<const Finding*> all;
  for (const DiagnosedBlock& block : diagnosis.blocks) Add(block.diagnosis.proxies, &all);
  return all;
}

std::vector<Cause> CausesOf(const Diagnosis& diagnosis) {
  std::vector<Cause> causes = RankedCauses(diagnosis);
  std::stable_sort(causes.begin(), causes.end(),
                   [](const Cause& a, const Cause& b) { return a.ErrorRatio() > b.ErrorRatio(); });
  return causes;
}

std::vector<const ChannelError*> UnexplainedOfSensors(const Diagnosis& diagnosis) {
  std::set<std::string> judged;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!diagnosed.diagnosis.is_testable) continue;
    for (const Channel& channel : diagnosed.block.channels) judged.insert(channel.name);
  }
  std::vector<const ChannelError*> left;
  for (const ChannelError& channel : diagnosis.sensors.estimate.channels) {
    if (!IsExplained(channel) && !judged.contains(channel.name)) left.push_back(&channel);
  }
  return left;
}

std::vector<const Candidate*> RivalsOf(const Finding& finding) {
  std::vector<const Candidate*> rivals = finding.evidence.rivals;
  std::erase(rivals, finding.term.candidate);
  return rivals;
}

}  // namespace tera
