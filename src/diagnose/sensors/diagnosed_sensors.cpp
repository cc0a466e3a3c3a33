#include "diagnose/sensors/diagnosed_sensors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "diagnose/blocks/measured_poses.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

/// Ratio of RMS error to noise (by successive differences) above which error remains.
constexpr double kMostOfDifferences = 2;
/// Largest ratio of RMS error to a unit's motion that excludes swapped or reversed axes. The error
/// of such an axis is as large as its motion. Errors of a too smooth spline are smaller.
constexpr double kMostOfMotion = 0.2;
/// A cause has at least this share of the sum of its own gain and all remaining gain, as in blocks.
constexpr double kLeastExcessOfCause = 1.0 / 3;
constexpr std::string_view kClockMechanism = "clock_offset";

/// Index of a parameter. Throws where the mechanism does not have it.
std::size_t IndexOf(const Mechanism& mechanism, const std::string& name) {
  const auto& all = mechanism.parameters;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const EffectParameter& one) { return one.name == name; });
  TERA_CHECK(found != all.end(), mechanism.id, name);
  return static_cast<std::size_t>(found - all.begin());
}

/// Reduction of a channel's error by the findings, in units of its noise.
double Lessened(const ChannelError& one) { return (one.rms_before - one.rms_after) / one.noise; }

/// The channel with this name prefix whose error the findings reduce most; null without such a
/// channel.
const ChannelError* MostLessened(const SensorDiagnosis& estimate, const std::string& prefix) {
  const ChannelError* most = nullptr;
  for (const ChannelError& one : estimate.channels) {
    if (!one.name.starts_with(prefix)) continue;
    if (most == nullptr || Lessened(one) > Lessened(*most)) most = &one;
  }
  return most;
}

/// The channel that shows the findings of a target best: one of its own if the findings reduce its
/// error, else any. A very precise sensor pulls the motion to its own errors, and other channels
/// then show them.
const ChannelError* ChannelThatShows(const SensorDiagnosis& estimate, const std::string& target) {
  const ChannelError* own = MostLessened(estimate, target);
  return own == nullptr || Lessened(*own) > 0 ? own : MostLessened(estimate, "");
}

/// Share of a channel's mean square beyond noise that the findings remove.
double ExcessRemoved(const ChannelError& channel) {
  const double excess = std::pow(channel.rms_before, 2) - std::pow(channel.noise, 2);
  const double removed = std::pow(channel.rms_before, 2) - std::pow(channel.rms_after, 2);
  return excess > 0 ? std::clamp(removed / excess, -1.0, 1.0) : 0;
}

class Teller {
 public:
  Teller(const std::string& machine, DiagnosedSensors* out) : machine_(machine), out_(out) {}

  SensorFound Tell(const SensorFinding& found) {
    SensorFound told;
    const Mechanism& mechanism = *found.mechanism;
    Finding& finding = told.finding;
    finding.term.candidate = &CandidateOf(found);
    for (const EffectParameter& parameter : mechanism.parameters) {
      finding.term.values.push_back(parameter.otherwise.value_or(0));
      finding.parameters.push_back({std::string(parameter.name), std::string(parameter.unit),
                                    finding.term.values.back(), std::nullopt});
    }
    auto& free = out_->candidates.back().free;
    for (const FoundNumber& number : found.numbers) {
      const std::size_t i = IndexOf(mechanism, number.name);
      finding.term.values[i] = finding.parameters[i].value =
          std::clamp(number.value, mechanism.parameters[i].lower, mechanism.parameters[i].upper);
      finding.parameters[i].sigma = number.sigma;
      free.push_back({i, mechanism.parameters[i].lower, mechanism.parameters[i].upper});
      free.back().expected = Expected{number.documented, number.tolerance};
    }
    out_->candidates.back().starts = {finding.term.values};
    SetEvidence(found, &told);
    return told;
  }

 private:
  Candidate& CandidateOf(const TargetMechanism& one) {
    out_->candidates.push_back({one.mechanism, one.target, {}, {}, {}});
    return out_->candidates.back();
  }

  void SetEvidence(const SensorFinding& found, SensorFound* told) {
    Finding& finding = told->finding;
    finding.evidence.p = finding.evidence.steady_p = finding.held_out.p = found.p;
    finding.evidence.share = 1;
    finding.is_confirmed = true;
    finding.evidence.rivals = {finding.term.candidate};
    for (const TargetMechanism& rival : found.rivals) {
      finding.evidence.rivals.push_back(&CandidateOf(rival));
    }
    told->channel = machine_ + "/" + found.target;
    const ChannelError* channel = ChannelThatShows(out_->estimate, told->channel);
    if (channel == nullptr) return;
    told->channel = channel->name;
    told->unit = channel->unit;
    HeldOutError& error = finding.held_out;
    error.rmse_before = channel->rms_before;
    error.rmse_after = channel->rms_after;
    error.excess_removed = ExcessRemoved(*channel);
  }

  const std::string& machine_;
  DiagnosedSensors* out_;
};

/// The remaining clock offset of a receiver with corrected stamps. It is removed from the findings,
/// because the offset includes it. Without such a finding it is the documented offset.
FoundNumber TakeRest(const OffsetReceiver& offset, DiagnosedSensors* sensors) {
  FoundNumber rest{.value = offset.documented_s, .sigma = offset.sigma_s};
  for (auto* list : {&sensors->findings, &sensors->unconfirmed, &sensors->within_tolerance}) {
    const auto is_rest = [&](const SensorFound& told) {
      const Candidate& candidate = *told.finding.term.candidate;
      return candidate.mechanism->id == kClockMechanism && candidate.target == offset.target;
    };
    const auto found = std::find_if(list->begin(), list->end(), is_rest);
    if (found == list->end()) continue;
    const ParameterEstimate& number = found->finding.parameters.front();
    rest.value = number.value;
    rest.sigma = number.sigma.value_or(offset.sigma_s);
    list->erase(found);
    break;
  }
  return rest;
}

}  // namespace

DiagnosedSensors DiagnosedOf(SensorDiagnosis estimate, const std::string& machine) {
  DiagnosedSensors out;
  out.estimate = std::move(estimate);
  Teller teller(machine, &out);
  const double left = out.estimate.left_to_gain;
  const auto is_cause = [&](const SensorFinding& found) {
    return found.gain >= kLeastExcessOfCause * (found.gain + left);
  };
  for (const SensorFinding& found : out.estimate.findings) {
    (is_cause(found) ? out.findings : out.unconfirmed).push_back(teller.Tell(found));
  }
  std::erase_if(out.estimate.findings, [&](const SensorFinding& one) { return !is_cause(one); });
  for (const SensorFinding& found : out.estimate.unproven) {
    out.unconfirmed.push_back(teller.Tell(found));
    out.unconfirmed.back().finding.is_confirmed = false;
  }
  for (const SensorFinding& found : out.estimate.within_tolerance) {
    out.within_tolerance.push_back(teller.Tell(found));
  }
  return out;
}

void TellReversed(const std::vector<ReversedAxis>& reversed, DiagnosedSensors* sensors) {
  const Mechanism& flip = SensorMechanism("axis_flip", EffectTarget::kEncoderAxis);
  for (const ReversedAxis& axis : reversed) {
    if (axis.is_documented) continue;
    SensorFound told;
    told.channel = axis.channel + "/" + axis.axis + "_radps";
    told.unit = "rad/s";
    Finding& finding = told.finding;
    sensors->candidates.push_back({&flip, axis.target, {}, {}, {}});
    finding.term.candidate = &sensors->candidates.back();
    finding.evidence.p = finding.evidence.steady_p = finding.held_out.p = axis.p;
    finding.evidence.share = 1;
    finding.evidence.rivals = {finding.term.candidate};
    finding.is_confirmed = true;
    finding.held_out.rmse_before = axis.rms_before_radps;
    finding.held_out.rmse_after = axis.rms_after_radps;
    finding.held_out.excess_removed = 1 - std::pow(axis.rms_after_radps / axis.rms_before_radps, 2);
    sensors->findings.push_back(std::move(told));
  }
}

void TellOffset(const std::vector<OffsetReceiver>& offset, const std::string& machine,
                DiagnosedSensors* sensors) {
  Teller teller(machine, sensors);
  for (const OffsetReceiver& one : offset) {
    const FoundNumber rest = TakeRest(one, sensors);
    SensorFinding found{{one.target, &SensorMechanism(kClockMechanism, EffectTarget::kGnss)}};
    found.numbers = {{"offset_s", "s", one.shift_s + rest.value, rest.sigma, one.documented_s,
                      one.tolerance_s, true}};
    found.p = one.p;
    SensorFound told = teller.Tell(found);
    told.channel = machine + "/" + one.target + "/east_m";
    told.unit = "m";
    HeldOutError& error = told.finding.held_out;
    error.rmse_before = one.rms_before_m;
    error.rmse_after = one.rms_after_m;
    error.excess_removed = 1 - std::pow(one.rms_after_m / one.rms_before_m, 2);
    sensors->findings.push_back(std::move(told));
  }
}

bool IsNoise(const ChannelError& channel) {
  return channel.rms_after <= kMostOfDifferences * channel.differences;
}

bool IsExplained(const ChannelError& channel) {
  return IsNoise(channel) ||
         channel.rms_after <= std::max(channel.tolerance, kMostOfMotion * channel.motion);
}

void RemoveEstimated(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                     std::vector<ReplayBlock>* blocks) {
  const auto has = [&](const std::string& target, std::string_view id) {
    return std::any_of(estimate.estimated.begin(), estimate.estimated.end(),
                       [&](const TargetMechanism& one) {
                         return one.target == target && one.mechanism->id == id;
                       });
  };
  for (const SensorDescription& sensor : input.sensors) {
    if (!has(sensor.name, "imu_lever_arm")) continue;
    for (ReplayBlock& block : *blocks) {
      if (block.name != input.machine + "/" + sensor.name) continue;
      std::erase_if(block.candidates, [&](const Candidate& candidate) {
        const std::string_view id = candidate.mechanism->id;
        const bool is_delay = id == "latency" || id == "filter_delay";
        return has(candidate.target, is_delay ? "clock_offset" : id);
      });
    }
  }
}

Measurements WithoutExplained(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                              Measurements measured) {
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    const std::string folder = input.machine + "/" + input.sensors[s].name + "/";
    const auto& findings = estimate.findings;
    const bool is_named = std::any_of(
        findings.begin(), findings.end(),
        [&](const SensorFinding& found) { return found.target == input.sensors[s].name; });
    std::size_t channels = 0;
    bool is_loud = false;
    for (const ChannelError& one : estimate.channels) {
      if (!one.name.starts_with(folder)) continue;
      ++channels;
      is_loud = is_loud || !IsExplained(one);
    }
    if (!is_named && (channels == 0 || is_loud)) continue;
    measured.imus[s].clear();
    measured.gnss[s].clear();
  }
  return measured;
}

}  // namespace tera
