#include "app/diagnose_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "diagnose/blocks/candidate_list.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/replay/base_log.h"
#include "sim/operators/lever_replay.h"
#include "sim/simulation.h"

namespace tera {
namespace {

constexpr double kLongest_s = 600;   ///< of the scenario as it is
constexpr double kCompared_s = 120;  ///< with what was found
constexpr double kEarly_s = 1;
constexpr double kPathStep_s = 0.5;
constexpr double kMoved_m = 0.5;  ///< a path that is shorter is none

std::unique_ptr<Operator> DriverOf(const DiagnosisInput& input, TimeNs zero_ns) {
  CommandTable table;
  std::vector<int> lever_of_column;
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < input.commands.columns.size(); ++c) {
    const int lever = input.model->LeverIndex(input.commands.columns[c]);
    if (lever < 0) continue;
    columns.push_back(c);
    lever_of_column.push_back(lever);
  }
  for (std::size_t r = 0; r < input.commands.rows.size(); ++r) {
    table.t_ns.push_back(input.commands.t_ns[r] - zero_ns);
    std::vector<double> row;
    for (const std::size_t c : columns) {
      row.push_back(std::clamp(input.commands.rows[r][c], -1.0, 1.0));
    }
    table.rows.push_back(std::move(row));
  }
  return std::make_unique<LeverReplay>(std::move(table), std::move(lever_of_column));
}

SimulatedCourse::Step StepOf(const MachineState& state) {
  SimulatedCourse::Step step{state.q_rad, state.qd_radps, state.links.front().X_WB};
  const auto append = [](const std::vector<double>& more, std::vector<double>* list) {
    list->insert(list->end(), more.begin(), more.end());
  };
  append(state.gear_angle_rad, &step.position_rad);
  append(state.gear_rate_radps, &step.rate_radps);
  return step;
}

SimulatedCourse Simulated(Scenario scenario, std::size_t machine, TimeNs zero_ns, double until_s) {
  SimulatedCourse course{.zero_ns = zero_ns, .step_s = 1 / scenario.physics_rate_hz, .steps = {}};
  Simulation simulation(&scenario);
  course.steps.push_back(StepOf(simulation.state().machines[machine]));
  const auto steps = static_cast<std::int64_t>(std::ceil(until_s * scenario.physics_rate_hz));
  for (std::int64_t k = 0; k < steps; ++k) {
    simulation.Step();
    course.steps.push_back(StepOf(simulation.state().machines[machine]));
  }
  return course;
}

Scenario UnderLevers(const ScenarioOptions& options, std::size_t machine,
                     const DiagnosisInput& input, TimeNs zero_ns) {
  Scenario scenario = Load(options).scenario;
  scenario.machines[machine].driver = DriverOf(input, zero_ns);
  return scenario;
}

/// When the simulation starts, in the recording.
TimeNs ZeroOf(TimeNs start_ns) { return ToSeconds(start_ns) > kEarly_s ? start_ns : 0; }

/// The last that encoders measured of the machine; none where there are none.
std::optional<TimeNs> LastOf(const Measurements& measured) {
  std::optional<TimeNs> last_ns;
  for (const NamedEncoders& named : measured.encoders) {
    if (named.recording.samples.empty()) continue;
    last_ns = std::max(last_ns.value_or(0), named.recording.samples.back().t_ns);
  }
  return last_ns;
}

/// Sum of the ground's steps between poses that lie `kPathStep_s` apart.
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
  Comparison(const DiagnosisInput& input, const Recording& recording,
             const DiagnosisOptions& options, const Diagnosis& diagnosis)
      : input_(input), recording_(recording), options_(options), diagnosis_(diagnosis) {
    start_ns_ = diagnosis.start_ns;
    zero_ns_ = ZeroOf(start_ns_);
    const std::string poses = "truth/" + input.machine + "/pose.csv";
    if (recording.Has(poses)) poses_ = recording.LoadPose(poses).poses;
  }

  WholeSimulation Run(const ScenarioOptions& scenario, std::size_t machine,
                      const std::optional<SimulatedCourse>& before);

 private:
  double Until_s() const;
  Scenario WithFindings(const ScenarioOptions& scenario, std::size_t machine) const;
  void AddBlock(const DiagnosedBlock& diagnosed, const SimulatedCourse& before,
                const SimulatedCourse& after, WholeSimulation* out) const;
  std::vector<std::vector<double>> Simulated(const DiagnosedBlock& diagnosed,
                                             const SimulatedCourse& course) const;
  std::vector<std::vector<double>> OfBase(const DiagnosedBlock& diagnosed,
                                          const SimulatedCourse& course) const;
  std::vector<TruthPose> PosesOf(const SimulatedCourse& course, double until_s) const;
  /// Of a place of a block's grid, in the simulation.
  double TimeOf_s(const ReplayBlock& block, std::size_t place) const {
    return block.time_s(place) + ToSeconds(start_ns_ - zero_ns_);
  }

  const DiagnosisInput& input_;
  const Recording& recording_;
  const DiagnosisOptions& options_;
  const Diagnosis& diagnosis_;
  std::vector<TruthPose> poses_;
  TimeNs start_ns_ = 0, zero_ns_ = 0;
};

double Comparison::Until_s() const {
  double until_s = 0;
  for (const DiagnosedBlock& diagnosed : diagnosis_.blocks) {
    until_s = std::max(until_s, TimeOf_s(diagnosed.block, diagnosed.block.samples() - 1));
  }
  return std::min(until_s, kCompared_s);
}

Scenario Comparison::WithFindings(const ScenarioOptions& options, std::size_t machine) const {
  Scenario scenario = UnderLevers(options, machine, input_, zero_ns_);
  MachineModel& model = scenario.machines[machine].placement.model;
  for (const DiagnosedBlock& diagnosed : diagnosis_.blocks) {
    model = WithTerms(std::move(model), diagnosed.diagnosis.search.found.terms);
  }
  return scenario;
}

/// Poses of the simulation at the times of the recorded ones.
std::vector<TruthPose> Comparison::PosesOf(const SimulatedCourse& course, double until_s) const {
  std::vector<TruthPose> poses = AsSimulated(course, poses_);
  std::erase_if(poses,
                [&](const TruthPose& pose) { return ToSeconds(pose.t_ns - zero_ns_) > until_s; });
  return poses;
}

/// The base's channels over the intervals of the recorded poses; nothing where there are none.
std::vector<std::vector<double>> Comparison::OfBase(const DiagnosedBlock& diagnosed,
                                                    const SimulatedCourse& course) const {
  const ReplayBlock& block = diagnosed.block;
  std::vector<NamedEncoders> encoders;
  for (const std::string& channel : recording_.ChannelsOf(ChannelType::kEncoder)) {
    if (channel.starts_with(input_.machine + "/")) {
      encoders.push_back({channel, recording_.LoadEncoder(channel)});
    }
  }
  const BaseLog log = MakeBaseLog(*input_.model, encoders, PosesOf(course, Until_s()),
                                  options_.blocks.base_interval_s);
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

/// What the simulation did in a block's channels, not a number beyond its end; empty where it does
/// not have them.
std::vector<std::vector<double>> Comparison::Simulated(const DiagnosedBlock& diagnosed,
                                                       const SimulatedCourse& course) const {
  const ReplayBlock& block = diagnosed.block;
  const MachineModel& model = *input_.model;
  if (block.name == input_.machine + "/base") return OfBase(diagnosed, course);
  int axis = model.JointIndex(block.name);
  for (std::size_t g = 0; g < model.ground_tools.gears.size() && axis < 0; ++g) {
    if (model.ground_tools.gears[g].name != block.name) continue;
    axis = static_cast<int>(model.joints.size() + g);
  }
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

/// RMSE over what FINAL has of a channel and the simulation knows; not a number where it has none.
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
    const bool is_named = std::any_of(
        diagnosed.diagnosis.findings.begin(), diagnosed.diagnosis.findings.end(),
        [&](const Finding& finding) {
          return finding.location.channel == c && finding.term.candidate->target != kPoses;
        });
    if (!is_named) continue;
    const double rmse = was.empty() ? NAN : RmseOnFinal(diagnosed, c, was[c]);
    if (std::isfinite(rmse)) {
      out->channels.push_back({channel.name, channel.unit, rmse, RmseOnFinal(diagnosed, c, is[c])});
    } else {
      out->not_simulated.push_back(channel.name);
    }
  }
}

WholeSimulation Comparison::Run(const ScenarioOptions& scenario, std::size_t machine,
                                const std::optional<SimulatedCourse>& as_it_is) {
  WholeSimulation out;
  out.until_s = Until_s();
  if (input_.commands.rows.empty()) {
    out.obstacle = "the recording has no levers to drive it by";
    return out;
  }
  const SimulatedCourse before =
      as_it_is ? *as_it_is
               : tera::Simulated(UnderLevers(scenario, machine, input_, zero_ns_), machine,
                                 zero_ns_, out.until_s);
  const SimulatedCourse after =
      tera::Simulated(WithFindings(scenario, machine), machine, zero_ns_, out.until_s);
  for (const DiagnosedBlock& diagnosed : diagnosis_.blocks) {
    AddBlock(diagnosed, before, after, &out);
  }
  std::vector<TruthPose> recorded;
  for (const TruthPose& pose : poses_) {
    const double t_s = ToSeconds(pose.t_ns - zero_ns_);
    if (t_s >= 0 && t_s <= out.until_s) recorded.push_back(pose);
  }
  const PathLengths path{PathLength_m(recorded), PathLength_m(PosesOf(before, out.until_s)),
                         PathLength_m(PosesOf(after, out.until_s))};
  if (path.recorded_m > kMoved_m) out.path = path;
  return out;
}

}  // namespace

std::optional<SimulatedCourse> SimulateAsItIs(const ScenarioOptions& scenario, std::size_t machine,
                                              const DiagnosisInput& input,
                                              const Measurements& measured) {
  const std::optional<TimeNs> last_ns = LastOf(measured);
  if (input.commands.rows.empty() || !last_ns) return std::nullopt;
  const TimeNs zero_ns = ZeroOf(measured.start_ns);
  return Simulated(UnderLevers(scenario, machine, input, zero_ns), machine, zero_ns,
                   std::min(ToSeconds(*last_ns - zero_ns), kLongest_s));
}

WholeSimulation SimulateWhole(const ScenarioOptions& scenario, std::size_t machine,
                              const DiagnosisInput& input, const Recording& recording,
                              const DiagnosisOptions& options, const Diagnosis& diagnosis,
                              const std::optional<SimulatedCourse>& before) {
  return Comparison(input, recording, options, diagnosis).Run(scenario, machine, before);
}

}  // namespace tera
