#include "diagnose/confirm/simulate_whole.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "diagnose/blocks/candidate_list.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/discrepancy/discrepancy_correction.h"
#include "diagnose/measurements.h"
#include "diagnose/replay/base_log.h"
#include "physics/actuation/axes.h"

namespace tera {
namespace {

constexpr double kLongest_s = 600;   ///< longest simulation of the unchanged scenario
constexpr double kCompared_s = 120;  ///< longest simulation with the findings
/// If the first sample of a recording is later than this, it is the simulation's time zero.
constexpr double kMostLateStart_s = 1;
constexpr double kLead_s = 5;  ///< start of the comparison before the first lever moves
/// A lever moves when it is this far from its first value, in full levers.
constexpr double kLeverMoves = 0.05;
constexpr double kPathStep_s = 0.5;
constexpr double kLeastPath_m = 0.5;  ///< shortest path of a base that moves

/// The recording's time at which the simulation starts.
TimeNs ZeroOf(TimeNs start_ns) { return ToSeconds(start_ns) > kMostLateStart_s ? start_ns : 0; }

/// Start of the comparison. Motion while all levers rest has another cause, and would use up the
/// compared time.
TimeNs ComparedFrom(TimeNs zero_ns, const TableRecording& levers) {
  for (std::size_t k = 0; k < levers.rows.size(); ++k) {
    for (std::size_t c = 0; c < levers.rows[k].size(); ++c) {
      if (std::abs(levers.rows[k][c] - levers.rows.front()[c]) <= kLeverMoves) continue;
      return std::max(zero_ns, levers.t_ns[k] - FromSeconds(kLead_s));
    }
  }
  return zero_ns;
}

/// Time of the machine's last encoder sample.
std::optional<TimeNs> LastOf(const Measurements& measured) {
  std::optional<TimeNs> last_ns;
  for (const NamedEncoders& named : measured.encoders) {
    if (named.recording.samples.empty()) continue;
    last_ns = std::max(last_ns.value_or(0), named.recording.samples.back().t_ns);
  }
  return last_ns;
}

double PathLength_m(const std::vector<TruthPose>& poses) {
  double length_m = 0;
  const TruthPose* last = nullptr;
  for (const TruthPose& pose : poses) {
    if (last != nullptr && ToSeconds(pose.t_ns - last->t_ns) < kPathStep_s) continue;
    if (last != nullptr) {
      length_m += (pose.X_WB.translation() - last->X_WB.translation()).head<2>().norm();
    }
    last = &pose;
  }
  return length_m;
}

class Comparison {
 public:
  Comparison(const DiagnosisInput& input, const Measurements& measured,
             const std::vector<DiagnosedBlock>& blocks)
      : input_(input),
        measured_(measured),
        blocks_(blocks),
        start_ns_(measured.start_ns),
        zero_ns_(ComparedFrom(ZeroOf(measured.start_ns), input.commands)) {}

  WholeSimulation Run(const std::optional<SimulatedCourse>& as_it_is,
                      const SimulateMachine& simulate) const;

 private:
  /// End of the comparison, in seconds.
  double Until_s() const;
  void AddBlock(const DiagnosedBlock& diagnosed, const SimulatedCourse& before,
                const SimulatedCourse& after, WholeSimulation* out) const;
  std::vector<std::vector<double>> Simulated(const DiagnosedBlock& diagnosed,
                                             const SimulatedCourse& course) const;
  std::vector<std::vector<double>> OfBase(const DiagnosedBlock& diagnosed,
                                          const SimulatedCourse& course) const;
  std::vector<TruthPose> PosesOf(const SimulatedCourse& course, double until_s) const;
  /// Time in the simulation of a sample of the block's grid.
  double TimeOf_s(const ReplayBlock& block, std::size_t place) const {
    return block.time_s(place) + ToSeconds(start_ns_ - zero_ns_);
  }

  const DiagnosisInput& input_;
  const Measurements& measured_;
  const std::vector<DiagnosedBlock>& blocks_;
  TimeNs start_ns_, zero_ns_;
};

double Comparison::Until_s() const {
  double until_s = 0;
  for (const DiagnosedBlock& diagnosed : blocks_) {
    until_s = std::max(until_s, TimeOf_s(diagnosed.block, diagnosed.block.samples() - 1));
  }
  return std::min(until_s, kCompared_s);
}

/// The simulation's poses at the times of the measured poses.
std::vector<TruthPose> Comparison::PosesOf(const SimulatedCourse& course, double until_s) const {
  std::vector<TruthPose> poses = AsSimulated(course, BasePoses(measured_));
  std::erase_if(poses,
                [&](const TruthPose& pose) { return ToSeconds(pose.t_ns - zero_ns_) > until_s; });
  return poses;
}

/// The base's channels in the simulation, over the intervals of the measured poses. Empty where the
/// simulation ends before any.
std::vector<std::vector<double>> Comparison::OfBase(const DiagnosedBlock& diagnosed,
                                                    const SimulatedCourse& course) const {
  const ReplayBlock& block = diagnosed.block;
  const std::vector<TruthPose> poses = PosesOf(course, Until_s());
  if (!HaveCommonTime(*input_.model, measured_.encoders, poses)) return {};
  const BaseLog log = MakeBaseLog(*input_.model, measured_.encoders, poses, kBaseInterval_s);
  std::vector<std::vector<double>> values(3, std::vector<double>(block.samples(), NAN));
  for (const BaseInterval& interval : log.intervals) {
    const double place =
        (ToSeconds(interval.to_ns - start_ns_) - block.time_s(0)) / block.period_s();
    const auto k = static_cast<std::ptrdiff_t>(std::llround(place));
    if (k < 0 || k >= static_cast<std::ptrdiff_t>(block.samples())) continue;
    const auto at = static_cast<std::size_t>(k);
    values[0][at] = interval.twist.forward_mps;
    values[1][at] = interval.twist.left_mps;
    values[2][at] = interval.twist.yaw_radps;
  }
  return values;
}

/// A block's channels in the simulation, NaN beyond its end. Empty where the simulation lacks them.
std::vector<std::vector<double>> Comparison::Simulated(const DiagnosedBlock& diagnosed,
                                                       const SimulatedCourse& course) const {
  const ReplayBlock& block = diagnosed.block;
  const MachineModel& model = *input_.model;
  if (block.name == input_.machine + "/base") return OfBase(diagnosed, course);
  const int axis = AxisNamed(model, block.name);
  if (axis < 0) return {};
  const double end_s = std::min(Until_s(), ToSeconds(course.end_ns() - zero_ns_));
  std::vector<double> values(block.samples(), NAN);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double t_s = TimeOf_s(block, k);
    if (t_s < 0 || t_s > end_s) continue;
    values[k] = course.RateAt(zero_ns_ + FromSeconds(t_s), static_cast<std::size_t>(axis));
  }
  return {values};
}

/// RMSE over the samples of FINAL that the simulation covers. NaN where it covers none.
double RmseOnFinal(const DiagnosedBlock& diagnosed, std::size_t channel,
                   const std::vector<double>& simulated) {
  const Series& measured = diagnosed.block.channels[channel].measured;
  const Mask final = MaskOf(diagnosed.diagnosis.manoeuvres, Part::kFinal, measured.size());
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    if (!final[k] || !measured.valid[k] || !std::isfinite(simulated[k])) continue;
    sum += std::pow(measured.value[k] - simulated[k], 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

void Comparison::AddBlock(const DiagnosedBlock& diagnosed, const SimulatedCourse& before,
                          const SimulatedCourse& after, WholeSimulation* out) const {
  const auto was = Simulated(diagnosed, before), is = Simulated(diagnosed, after);
  for (std::size_t c = 0; c < diagnosed.block.channels.size(); ++c) {
    const Channel& channel = diagnosed.block.channels[c];
    const bool is_learned =
        std::any_of(diagnosed.learned.begin(), diagnosed.learned.end(),
                    [&](const Learned& learned) { return learned.channel == c; });
    const bool is_named = std::any_of(
        diagnosed.diagnosis.findings.begin(), diagnosed.diagnosis.findings.end(),
        [&](const Finding& finding) {
          return finding.location.channel == c && finding.term.candidate->target != kPoses;
        });
    if (!is_named && !is_learned) continue;
    const double rmse = was.empty() ? NAN : RmseOnFinal(diagnosed, c, was[c]);
    if (std::isfinite(rmse)) {
      out->channels.push_back({channel.name, channel.unit, rmse, RmseOnFinal(diagnosed, c, is[c])});
    } else {
      out->not_simulated.push_back(channel.name);
    }
  }
}

WholeSimulation Comparison::Run(const std::optional<SimulatedCourse>& as_it_is,
                                const SimulateMachine& simulate) const {
  WholeSimulation out;
  const double duration_s = Until_s();
  out.from_s = ToSeconds(zero_ns_);
  out.until_s = out.from_s + duration_s;
  if (input_.commands.rows.empty()) {
    out.obstacle = "the recording has no levers to drive it by";
    return out;
  }
  const SimulatedFindings found = FindingsToSimulate(blocks_);
  const CourseSpan span{zero_ns_, duration_s};
  const bool starts_alike = as_it_is && zero_ns_ == ZeroOf(start_ns_);
  const SimulatedCourse before = starts_alike ? *as_it_is : simulate({}, input_.commands, span);
  const SimulatedCourse after = simulate(found, input_.commands, span);
  for (const DiagnosedBlock& diagnosed : blocks_) {
    AddBlock(diagnosed, before, after, &out);
  }
  std::vector<TruthPose> recorded;
  for (const TruthPose& pose : BasePoses(measured_)) {
    const double t_s = ToSeconds(pose.t_ns - zero_ns_);
    if (t_s >= 0 && t_s <= duration_s) recorded.push_back(pose);
  }
  const PathLengths path{PathLength_m(recorded), PathLength_m(PosesOf(before, duration_s)),
                         PathLength_m(PosesOf(after, duration_s))};
  if (path.recorded_m > kLeastPath_m) out.path = path;
  return out;
}

}  // namespace

SimulatedFindings FindingsToSimulate(const std::vector<DiagnosedBlock>& blocks) {
  SimulatedFindings found;
  for (const DiagnosedBlock& diagnosed : blocks) {
    for (const Finding& finding : diagnosed.diagnosis.findings) {
      if (finding.term.candidate->target != kPoses) found.terms.push_back(finding.term);
    }
    for (const Learned& learned : diagnosed.learned) {
      found.learned.push_back({diagnosed.block.name, learned.effect});
    }
  }
  return found;
}

std::optional<SimulatedCourse> SimulateAsItIs(const DiagnosisInput& input,
                                              const Measurements& measured,
                                              const SimulateMachine& simulate) {
  const std::optional<TimeNs> last_ns = LastOf(measured);
  if (!simulate || input.commands.rows.empty() || !last_ns) return std::nullopt;
  const TimeNs zero_ns = ZeroOf(measured.start_ns);
  return simulate({}, input.commands,
                  {zero_ns, std::min(ToSeconds(*last_ns - zero_ns), kLongest_s)});
}

WholeSimulation SimulateWhole(const DiagnosisInput& input, const Measurements& measured,
                              const std::vector<DiagnosedBlock>& blocks,
                              const std::optional<SimulatedCourse>& before,
                              const SimulateMachine& simulate) {
  return Comparison(input, measured, blocks).Run(before, simulate);
}

}  // namespace tera
