#include "diagnose/diagnosis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "diagnose/blocks/axis_block.h"
#include "diagnose/blocks/base_block.h"
#include "diagnose/blocks/imu_block.h"

namespace tera {
namespace {

constexpr double kShortest_s = 25;  ///< less leaves too little of SELECT and FINAL

/// The encoders of one machine.
std::vector<NamedEncoders> EncodersOf(const Recording& recording, const std::string& machine) {
  std::vector<NamedEncoders> encoders;
  for (const std::string& channel : recording.ChannelsOf(ChannelType::kEncoder)) {
    if (channel.starts_with(machine + "/")) {
      encoders.push_back({channel, recording.LoadEncoder(channel)});
    }
  }
  return encoders;
}

/// What lies between two times.
template <typename Sample>
void Trim(TimeNs from_ns, TimeNs to_ns, std::vector<Sample>* samples) {
  std::erase_if(*samples, [&](const Sample& s) { return s.t_ns < from_ns || s.t_ns > to_ns; });
}

bool Measures(const std::vector<NamedEncoders>& encoders, const std::string& axis) {
  for (const NamedEncoders& named : encoders) {
    for (const EncoderAxis& measured : named.recording.axes) {
      if (measured.name == axis) return true;
    }
  }
  return false;
}

/// What a recording holds of one machine, within the time that is looked at.
struct Measurements {
  std::vector<NamedEncoders> encoders;
  std::vector<TruthPose> poses;
  /// One for each of the scenario's sensors; empty of those that are none or were not recorded.
  std::vector<std::vector<ImuSample>> imus;
  TimeNs start_ns = 0;  ///< of the whole recording
};

TimeNs StartOf(const Measurements& measured) {
  TimeNs start_ns = std::numeric_limits<TimeNs>::max();
  for (const NamedEncoders& named : measured.encoders) {
    start_ns = std::min(start_ns, named.recording.samples.front().t_ns);
  }
  for (const auto& samples : measured.imus) {
    if (!samples.empty()) start_ns = std::min(start_ns, samples.front().t_ns);
  }
  return start_ns;
}

Measurements MeasurementsOf(const DiagnosisInput& input, const Recording& recording,
                            const DiagnosisOptions& options) {
  Measurements measured;
  measured.encoders = EncodersOf(recording, input.machine);
  std::erase_if(measured.encoders,
                [](const NamedEncoders& named) { return named.recording.samples.empty(); });
  const std::string poses = "truth/" + input.machine + "/pose.csv";
  if (recording.Has(poses)) measured.poses = recording.LoadPose(poses).poses;
  bool any = !measured.encoders.empty();
  for (const SensorDescription& sensor : input.sensors) {
    const std::string channel = input.machine + "/" + sensor.name;
    const bool is_imu = std::holds_alternative<ImuModel>(sensor.model) && recording.Has(channel);
    measured.imus.push_back(is_imu ? recording.LoadImu(channel) : std::vector<ImuSample>{});
    any = any || !measured.imus.back().empty();
  }
  if (!any && !options.needs_blocks) return measured;
  if (!any) {
    throw InputError(fmt::format(
        "{}: no encoder channel of {}, and no inertial unit that the scenario has; need "
        "something measured to compare",
        recording.directory().string(), input.machine));
  }
  measured.start_ns = StartOf(measured);
  const TimeNs from_ns = measured.start_ns + FromSeconds(options.from_s);
  const TimeNs to_ns = measured.start_ns + FromSeconds(options.to_s);
  for (NamedEncoders& named : measured.encoders) Trim(from_ns, to_ns, &named.recording.samples);
  for (auto& samples : measured.imus) Trim(from_ns, to_ns, &samples);
  return measured;
}

/// Encoders may have a block for each joint and gear with a lever.
void AddAxes(const DiagnosisInput& input, const Measurements& measured,
             const DiagnosisOptions& options, std::vector<ReplayBlock>* blocks) {
  if (input.commands.columns.empty() || measured.encoders.empty()) return;
  const AxisLog log = MakeAxisLog(*input.model, input.commands, measured.encoders, options.step_s);
  for (std::size_t axis = 0; axis < log.measured.size(); ++axis) {
    if (auto block = MakeAxisBlock(*input.model, log, axis)) blocks->push_back(std::move(*block));
  }
}

/// Every gear's encoder and poses make a block of the base.
void AddBase(const DiagnosisInput& input, const Measurements& measured,
             const DiagnosisOptions& options, std::vector<ReplayBlock>* blocks) {
  const auto& gears = input.model->ground_tools.gears;
  const bool all = std::all_of(gears.begin(), gears.end(), [&](const RunningGear& gear) {
    return Measures(measured.encoders, gear.name);
  });
  if (gears.empty() || !all || measured.poses.empty()) return;
  // Gears bound the time.
  const BaseLog log =
      MakeBaseLog(*input.model, measured.encoders, measured.poses, options.base_interval_s);
  if (auto block = MakeBaseBlock(*input.model, log, input.machine + "/base")) {
    blocks->push_back(std::move(*block));
  }
}

/// An inertial unit makes a block where its link's motion was measured.
void AddImus(const DiagnosisInput& input, const Measurements& measured,
             const DiagnosisOptions& options, std::vector<ReplayBlock>* blocks) {
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    const SensorDescription& sensor = input.sensors[s];
    if (measured.imus[s].empty()) continue;
    ImuLog log = MakeImuLog(*input.model, sensor, measured.imus[s], measured.encoders,
                            measured.poses, options.base_interval_s);
    if (auto block = MakeImuBlock(sensor, std::move(log), input.machine + "/" + sensor.name)) {
      blocks->push_back(std::move(*block));
    }
  }
}

/// One kind of block that cannot be made leaves the others.
void Try(const std::function<void()>& add, std::vector<std::string>* obstacles) {
  try {
    add();
  } catch (const InputError& error) {
    obstacles->push_back(error.what());
  }
}

[[noreturn]] void ThrowNothingToCompare(const DiagnosisInput& input, const Recording& recording,
                                        const std::vector<std::string>& obstacles) {
  const std::string directory = recording.directory().string();
  if (!obstacles.empty()) {
    throw InputError(fmt::format("{}: {}", directory, fmt::join(obstacles, "; ")));
  }
  throw InputError(fmt::format(
      "{}: nothing of {} can be replayed: need levers and encoders of the same joints, encoders of "
      "all tracks or wheels and poses, or an inertial unit and what tells how its link moved, over "
      "{} s at least",
      directory, input.machine, kShortest_s));
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

}  // namespace

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
  bool named = false, several = false, unexplained = false, untestable = false, judged = false;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    judged = judged || diagnosed.diagnosis.is_testable;
    untestable = untestable || !diagnosed.diagnosis.is_testable;
    for (const Finding& finding : diagnosed.diagnosis.findings) {
      (finding.evidence.rivals.size() > 1 ? several : named) = true;
    }
    unexplained = unexplained || !diagnosed.diagnosis.unexplained.empty();
    for (const Detectability& suspect : diagnosed.diagnosis.detectability) {
      untestable = untestable || !suspect.smallest;
    }
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    judged = judged || sensor.is_judged();
    untestable = untestable || !sensor.is_judged();
    for (const PerceptionFinding& finding : sensor.findings) {
      (finding.rivals.size() > 1 ? several : named) = true;
    }
  }
  std::vector<Verdict> verdicts;
  if (named) verdicts.push_back(Verdict::kNamed);
  if (several) verdicts.push_back(Verdict::kClass);
  if (unexplained) verdicts.push_back(Verdict::kUnexplained);
  if (verdicts.empty() && judged) verdicts.push_back(Verdict::kNone);
  if (untestable) verdicts.push_back(Verdict::kUntestable);
  return verdicts;
}

std::vector<ReplayBlock> BlocksOf(const DiagnosisInput& input, const Recording& recording,
                                  const DiagnosisOptions& options) {
  const Measurements measured = MeasurementsOf(input, recording, options);
  std::vector<ReplayBlock> blocks;
  std::vector<std::string> obstacles;
  Try([&] { AddAxes(input, measured, options, &blocks); }, &obstacles);
  Try([&] { AddBase(input, measured, options, &blocks); }, &obstacles);
  Try([&] { AddImus(input, measured, options, &blocks); }, &obstacles);
  std::erase_if(blocks, [](const ReplayBlock& block) {
    return static_cast<double>(block.samples()) * block.period_s() < kShortest_s;
  });
  if (blocks.empty() && options.needs_blocks) ThrowNothingToCompare(input, recording, obstacles);
  for (ReplayBlock& block : blocks) CountTimeFrom(measured.start_ns, &block);
  return blocks;
}

Stream StreamOf(const ReplayBlock& block, std::uint64_t seed) {
  return Stream(seed, "diagnose/" + block.name);
}

std::vector<DiagnosedBlock> DiagnoseBlocks(
    std::vector<ReplayBlock> blocks, SearchOptions options, std::uint64_t seed,
    const std::function<void(const std::string&)>& progress) {
  options.suspects_in_all = options.channels_in_all = 0;
  for (const ReplayBlock& block : blocks) {
    options.suspects_in_all += block.suspects.size();
    options.channels_in_all += block.channels.size();
  }
  std::vector<DiagnosedBlock> diagnosed;
  for (ReplayBlock& block : blocks) {
    progress(block.name);
    DiagnosedBlock one;
    one.block = std::move(block);
    one.diagnosis = DiagnoseBlock(one.block, options, StreamOf(one.block, seed));
    diagnosed.push_back(std::move(one));
  }
  return diagnosed;
}

Diagnosis Diagnose(const DiagnosisInput& input, const Recording& recording,
                   const DiagnosisOptions& options,
                   const std::function<void(const std::string&)>& progress) {
  return {
      input.machine,
      input.scenario,
      DiagnoseBlocks(BlocksOf(input, recording, options), options.search, options.seed, progress),
      {}};
}

}  // namespace tera
