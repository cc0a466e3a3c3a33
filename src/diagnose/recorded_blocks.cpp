#include "diagnose/recorded_blocks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/in_parallel.h"
#include "core/units.h"
#include "diagnose/blocks/axis_block.h"
#include "diagnose/blocks/effort_block.h"
#include "diagnose/blocks/gnss_block.h"
#include "diagnose/blocks/imu_block.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/discrepancy/discrepancy_correction.h"
#include "diagnose/input_checks.h"
#include "diagnose/recorded_base.h"
#include "diagnose/replay/base_log.h"

namespace tera {
namespace {

/// Step of the axes' replay over the encoders' shortest period.
constexpr double kMostStepOfPeriod = 0.2;

/// The step of the axes' replay, longer where no encoder needs it to be so fine.
double AxisStep_s(const std::vector<NamedEncoders>& encoders) {
  double shortest_s = std::numeric_limits<double>::max();
  for (const NamedEncoders& named : encoders) {
    const std::vector<EncoderSample>& samples = named.recording.samples;
    if (samples.size() < 2) continue;
    const double length_s = ToSeconds(samples.back().t_ns - samples.front().t_ns);
    shortest_s = std::min(shortest_s, length_s / static_cast<double>(samples.size() - 1));
  }
  const bool any = shortest_s < std::numeric_limits<double>::max();
  return any ? std::max(kReplayStep_s, kMostStepOfPeriod * shortest_s) : kReplayStep_s;
}

/// Calls `add`. An InputError becomes an obstacle with its place, and the caller continues.
void Try(const std::string& place, std::vector<std::string>* obstacles,
         const std::function<void()>& add) {
  try {
    add();
  } catch (const InputError& error) {
    obstacles->push_back(place + error.what());
  }
}

/// Blocks of one kind, and the reasons for missing blocks.
struct Made {
  std::vector<ReplayBlock> blocks;
  std::vector<std::string> obstacles;
  std::vector<std::string> motion_unknown;  ///< sensors and base whose motion was not measured

  std::vector<std::string> NotCompared() && {
    std::move(motion_unknown.begin(), motion_unknown.end(), std::back_inserter(obstacles));
    return std::move(obstacles);
  }
};

/// Runs several makers in parallel. Results keep the order of the makers.
Made MakeAll(std::size_t makers, int threads, const std::function<void(std::size_t, Made*)>& make) {
  std::vector<Made> parts = InParallel<Made>(makers, threads, [&](std::size_t k) {
    Made part;
    Try("", &part.obstacles, [&] { make(k, &part); });
    return part;
  });
  Made all;
  for (Made& part : parts) {
    std::move(part.blocks.begin(), part.blocks.end(), std::back_inserter(all.blocks));
    std::move(part.obstacles.begin(), part.obstacles.end(), std::back_inserter(all.obstacles));
    std::move(part.motion_unknown.begin(), part.motion_unknown.end(),
              std::back_inserter(all.motion_unknown));
  }
  return all;
}

/// Throws where the recording lacks the lever of an axis that it measured.
void RequireLever(const DiagnosisInput& input, std::size_t axis) {
  const std::vector<std::string>& columns = input.commands.columns;
  for (const Lever& lever : input.model->levers) {
    if (AxisOf(*input.model, lever) != axis) continue;
    if (std::find(columns.begin(), columns.end(), lever.name) != columns.end()) return;
    throw InputError("", {FaultKind::kMistyped,
                          fmt::format("commands have no column '{}', but {}; need its lever",
                                      lever.name, fmt::join(columns, ", "))});
  }
}

/// Adds a block for each joint and running gear with an encoder and a lever.
void AddAxes(const DiagnosisInput& input, const Measurements& measured, const BlockOptions& options,
             Made* out) {
  if (input.commands.columns.empty() || measured.encoders.empty()) return;
  const AxisLog log =
      MakeAxisLog(*input.model, input.commands, measured.encoders, AxisStep_s(measured.encoders));
  *out = MakeAll(log.measured.size(), options.threads, [&](std::size_t axis, Made* one) {
    Try(log.measured[axis].channel + ": ", &one->obstacles, [&] {
      auto block = MakeAxisBlock(*input.model, log, axis);
      RequireLever(input, log.measured[axis].axis);
      if (block) one->blocks.push_back(std::move(*block));
    });
  });
}

/// Adds a block for each joint with measured effort and position.
void AddEfforts(const DiagnosisInput& input, const Measurements& measured,
                std::vector<ReplayBlock>* blocks) {
  for (EffortLog& log : MakeEffortLogs(*input.model, input.machine + "/efforts", measured.efforts,
                                       measured.encoders)) {
    if (auto block = MakeEffortBlock(*input.model, std::move(log))) {
      blocks->push_back(std::move(*block));
    }
  }
}

/// Adds the block of the base, or what is missing for it.
void AddBase(const DiagnosisInput& input, const Measurements& measured, Made* out) {
  std::string why_not;
  auto block = RecordedBase(input, measured, &why_not);
  if (block) out->blocks.push_back(std::move(*block));
  if (!why_not.empty()) out->motion_unknown.push_back(why_not);
}

/// Adds the discrepancies of the replays of joints and running gears.
void AddRateDiscrepancies(const DiagnosisInput& input, const Measurements& measured,
                          const std::vector<NamedEncoders>& simulated,
                          std::vector<ReplayDiscrepancy>* out) {
  if (input.commands.columns.empty() || measured.encoders.empty()) return;
  const double step_s = AxisStep_s(measured.encoders);
  const AxisLog log = MakeAxisLog(*input.model, input.commands, measured.encoders, step_s);
  const AxisLog course = MakeAxisLog(*input.model, input.commands, simulated, step_s);
  for (std::size_t axis = 0; axis < log.measured.size(); ++axis) {
    std::vector<double> left = RateDiscrepancy(*input.model, log, course, axis);
    if (!left.empty()) out->push_back({log.measured[axis].channel, {left}});
  }
}

/// Reason why a recorded sensor has no block.
std::string TooFewText(const DiagnosisInput& input, const SensorDescription& sensor) {
  return fmt::format(
      "{}/{}: how '{}' moved is known at too few of its times; need poses, and encoders of the "
      "joints between the base and that link",
      input.machine, sensor.name, sensor.link);
}

/// Adds a block for each inertial unit whose link's motion was measured.
void AddImus(const DiagnosisInput& input, const Measurements& measured, const BlockOptions& options,
             Made* out) {
  const double interval_s = std::max(kBaseInterval_s, ImuInterval_s(measured.poses));
  *out = MakeAll(input.sensors.size(), options.threads, [&](std::size_t s, Made* one) {
    const SensorDescription& sensor = input.sensors[s];
    if (measured.imus[s].empty()) return;
    ImuLog log = MakeImuLog(*input.model, sensor, measured.imus[s], measured.encoders,
                            measured.poses, interval_s);
    if (auto block = MakeImuBlock(sensor, std::move(log), input.machine + "/" + sensor.name,
                                  measured.poses_were_measured)) {
      one->blocks.push_back(std::move(*block));
    } else {
      one->motion_unknown.push_back(TooFewText(input, sensor));
    }
  });
}

/// Block of some receivers, given by their indices among the scenario's sensors. Returns nothing if
/// the motion of an antenna was not measured.
std::optional<ReplayBlock> GnssBlockOf(const DiagnosisInput& input, const Measurements& measured,
                                       const std::vector<std::size_t>& which) {
  std::vector<SensorDescription> receivers;
  std::vector<std::vector<GnssSample>> samples;
  for (const std::size_t s : which) {
    receivers.push_back(input.sensors[s]);
    samples.push_back(measured.gnss[s]);
  }
  GnssLog log = MakeGnssLog(*input.model, receivers, samples, measured.encoders, measured.poses);
  return MakeGnssBlock(receivers, std::move(log), input.machine);
}

/// Adds the blocks of receivers. If the scenario has exactly two receivers, they share a block. If
/// this block cannot be made, each has its own.
void AddGnss(const DiagnosisInput& input, const Measurements& measured, Made* out) {
  std::vector<std::size_t> which;
  std::size_t in_all = 0;
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    in_all += std::holds_alternative<GnssModel>(input.sensors[s].model) ? 1 : 0;
    if (!measured.gnss[s].empty()) which.push_back(s);
  }
  const auto add = [&](const std::vector<std::size_t>& receivers) {
    auto block = GnssBlockOf(input, measured, receivers);
    if (block) out->blocks.push_back(std::move(*block));
    return block.has_value();
  };
  if (which.size() == 2 && in_all == 2) {
    bool is_made = false;
    std::vector<std::string> of_one;  // the separate blocks report these again
    Try("", &of_one, [&] { is_made = add(which); });
    if (is_made) return;
  }
  for (const std::size_t s : which) {
    const std::string channel = input.machine + "/" + input.sensors[s].name;
    Try(channel + ": ", &out->obstacles, [&] {
      if (!add({s})) out->motion_unknown.push_back(TooFewText(input, input.sensors[s]));
    });
  }
}

/// Names of the recorded measurements: "digger/encoders, gnss_left".
std::string RecordedText(const DiagnosisInput& input, const Measurements& measured) {
  std::vector<std::string> found;
  for (const NamedEncoders& named : measured.encoders) found.push_back(named.channel);
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    const bool has_any = !measured.imus[s].empty() || !measured.gnss[s].empty();
    if (has_any) found.push_back(input.sensors[s].name);
  }
  if (!input.commands.columns.empty()) found.emplace_back("levers");
  if (!measured.efforts.columns.empty()) found.emplace_back("efforts");
  if (!measured.poses.empty()) found.emplace_back("poses");
  return found.empty() ? "nothing" : fmt::format("{}", fmt::join(found, ", "));
}

[[noreturn]] void ThrowNothingToCompare(const DiagnosisInput& input, const Measurements& measured,
                                        const std::vector<std::string>& obstacles) {
  if (!obstacles.empty()) {
    throw InputError(measured.recording, fmt::format("{}", fmt::join(obstacles, "; ")));
  }
  throw InputError(
      measured.recording,
      fmt::format("nothing of {} can be replayed: found {}; need levers and encoders of the same "
                  "joints, efforts and encoders of the same joints, encoders of all tracks or "
                  "wheels and poses, a receiver and poses, or an inertial unit and what tells how "
                  "its link moved, over {} s at least",
                  input.machine, RecordedText(input, measured), kShortestRecording_s));
}

void CountTimeFrom(TimeNs start_ns, ReplayBlock* block) {
  block->first_ns -= start_ns;
  for (Channel& channel : block->channels) {
    for (RegimeVariable& variable : channel.variables) {
      if (variable.name != "time") continue;
      const double late_s = block->time_s(0) - variable.series.value.front();
      for (double& t_s : variable.series.value) t_s += late_s;
    }
  }
}

/// Removes blocks that are too short and notes the reason. Makes times relative to the recording's
/// start.
void Complete(TimeNs start_ns, Made* made) {
  std::erase_if(made->blocks, [&](const ReplayBlock& block) {
    const double length_s = static_cast<double>(block.samples()) * block.period_s();
    if (length_s >= kShortestRecording_s) return false;
    made->obstacles.push_back(fmt::format("{}: {:.1f} s can be compared; need {:g} s at least",
                                          block.name, length_s, kShortestRecording_s));
    return true;
  });
  for (ReplayBlock& block : made->blocks) CountTimeFrom(start_ns, &block);
}

}  // namespace

std::vector<ReplayBlock> BlocksOf(const DiagnosisInput& input, const Measurements& measured,
                                  const BlockOptions& options,
                                  std::vector<std::string>* not_compared) {
  const std::vector<std::function<void(Made*)>> kinds = {
      [&](Made* out) { AddAxes(input, measured, options, out); },
      [&](Made* out) { AddEfforts(input, measured, &out->blocks); },
      [&](Made* out) { AddBase(input, measured, out); },
      [&](Made* out) { AddImus(input, measured, options, out); },
      [&](Made* out) { AddGnss(input, measured, out); }};
  Made made = MakeAll(kinds.size(), options.threads,
                      [&](std::size_t kind, Made* out) { kinds[kind](out); });
  Complete(measured.start_ns, &made);
  if (made.blocks.empty() && options.needs_any) {
    ThrowNothingToCompare(input, measured, made.obstacles);
  }
  CheckUnitsOf({measured.recording, input.machine}, made.blocks);
  if (not_compared != nullptr) *not_compared = std::move(made).NotCompared();
  return std::move(made.blocks);
}

std::vector<MissingInput> MissingInputOf(const DiagnosisInput& input, const Measurements& measured,
                                         const std::optional<SimulatedCourse>& course) {
  if (input.commands.columns.empty() || measured.encoders.empty()) return {};
  const double step_s = AxisStep_s(measured.encoders);
  const auto log_of = [&](const std::vector<NamedEncoders>& encoders) {
    return MakeAxisLog(*input.model, input.commands, encoders, step_s);
  };
  const AxisLog log = log_of(measured.encoders);
  if (!course) return FindMissingInput(*input.model, log);
  const AxisLog simulated = log_of(AsSimulated(*input.model, *course, measured.encoders));
  return FindMissingInput(*input.model, log, &simulated);
}

std::vector<ReplayBlock> TakeSensorBlocks(const std::string& machine,
                                          std::vector<ReplayBlock>* blocks) {
  const auto base = std::find_if(blocks->begin(), blocks->end(), [&](const ReplayBlock& block) {
    return block.name == machine + "/base";
  });
  const auto first = base == blocks->end() ? base : base + 1;
  std::vector<ReplayBlock> of_sensors(std::make_move_iterator(first),
                                      std::make_move_iterator(blocks->end()));
  blocks->erase(first, blocks->end());
  return of_sensors;
}

std::vector<ReplayBlock> SensorBlocksByArrivals(const DiagnosisInput& input, Measurements measured,
                                                const BlockOptions& options,
                                                std::vector<std::string>* not_compared) {
  if (const auto times_ns = ArrivalsOf(measured)) {
    measured.poses = AtTimes(std::move(measured.poses), *times_ns);
  }
  const std::vector<std::function<void(Made*)>> kinds = {
      [&](Made* out) { AddImus(input, measured, options, out); },
      [&](Made* out) { AddGnss(input, measured, out); }};
  Made made = MakeAll(kinds.size(), options.threads,
                      [&](std::size_t kind, Made* out) { kinds[kind](out); });
  Complete(measured.start_ns, &made);
  *not_compared = std::move(made).NotCompared();
  return std::move(made.blocks);
}

std::vector<ReplayDiscrepancy> ReplayDiscrepanciesOf(const DiagnosisInput& input,
                                                     const Measurements& measured,
                                                     const BlockOptions& options,
                                                     const SimulatedCourse& course) {
  const std::vector<NamedEncoders> encoders = AsSimulated(*input.model, course, measured.encoders);
  const auto parts =
      InParallel<std::vector<ReplayDiscrepancy>>(2, options.threads, [&](std::size_t k) {
        std::vector<ReplayDiscrepancy> discrepancy;
        std::vector<std::string> obstacles;  // BlocksOf reports them
        Try(measured.recording, &obstacles, [&] {
          if (k == 0) {
            AddRateDiscrepancies(input, measured, encoders, &discrepancy);
          } else if (auto base = RecordedBaseDiscrepancy(input, measured, encoders, course)) {
            discrepancy.push_back(std::move(*base));
          }
        });
        return discrepancy;
      });
  std::vector<ReplayDiscrepancy> all = parts[0];
  all.insert(all.end(), parts[1].begin(), parts[1].end());
  return all;
}

}  // namespace tera
