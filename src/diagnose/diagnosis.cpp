#include "diagnose/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "diagnose/blocks/axis_block.h"
#include "diagnose/blocks/base_block.h"

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

TimeNs StartOf(const std::vector<NamedEncoders>& encoders) {
  TimeNs start_ns = std::numeric_limits<TimeNs>::max();
  for (const NamedEncoders& named : encoders) {
    if (named.recording.samples.empty()) continue;
    start_ns = std::min(start_ns, named.recording.samples.front().t_ns);
  }
  return start_ns;
}

bool Measures(const std::vector<NamedEncoders>& encoders, const std::string& axis) {
  for (const NamedEncoders& named : encoders) {
    for (const EncoderAxis& measured : named.recording.axes) {
      if (measured.name == axis) return true;
    }
  }
  return false;
}

/// Encoders may have a block for each joint and gear with a lever.
void AddAxes(const DiagnosisInput& input, const std::vector<NamedEncoders>& encoders, double step_s,
             std::vector<ReplayBlock>* blocks) {
  const AxisLog log = MakeAxisLog(*input.model, input.commands, encoders, step_s);
  for (std::size_t measured = 0; measured < log.measured.size(); ++measured) {
    if (auto block = MakeAxisBlock(*input.model, log, measured)) {
      blocks->push_back(std::move(*block));
    }
  }
}

/// Every gear's encoder and poses make a block of the base.
void AddBase(const DiagnosisInput& input, const Recording& recording,
             const std::vector<NamedEncoders>& encoders, const DiagnosisOptions& options,
             std::vector<ReplayBlock>* blocks) {
  const std::string poses = "truth/" + input.machine + "/pose.csv";
  const auto& gears = input.model->ground_tools.gears;
  const bool measured = std::all_of(gears.begin(), gears.end(), [&](const RunningGear& gear) {
    return Measures(encoders, gear.name);
  });
  if (gears.empty() || !measured || !recording.Has(poses)) return;
  // Gears bound the time.
  const BaseLog log =
      MakeBaseLog(*input.model, encoders, recording.LoadPose(poses).poses, options.base_interval_s);
  if (auto block = MakeBaseBlock(*input.model, log, input.machine + "/base")) {
    blocks->push_back(std::move(*block));
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
  bool named = false, several = false, unexplained = false, untestable = false;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.findings) {
      (finding.evidence.rivals.size() > 1 ? several : named) = true;
    }
    unexplained = unexplained || !diagnosed.diagnosis.unexplained.empty();
    for (const Detectability& suspect : diagnosed.diagnosis.detectability) {
      untestable = untestable || !suspect.smallest;
    }
  }
  std::vector<Verdict> verdicts;
  if (named) verdicts.push_back(Verdict::kNamed);
  if (several) verdicts.push_back(Verdict::kClass);
  if (unexplained) verdicts.push_back(Verdict::kUnexplained);
  if (verdicts.empty()) verdicts.push_back(Verdict::kNone);
  if (untestable) verdicts.push_back(Verdict::kUntestable);
  return verdicts;
}

Diagnosis Diagnose(const DiagnosisInput& input, const Recording& recording,
                   const DiagnosisOptions& options,
                   const std::function<void(const std::string&)>& progress) {
  std::vector<NamedEncoders> encoders = EncodersOf(recording, input.machine);
  std::erase_if(encoders,
                [](const NamedEncoders& named) { return named.recording.samples.empty(); });
  if (encoders.empty()) {
    throw InputError(fmt::format(
        "{}: no encoder channel of {}; need rates of joints or of tracks and wheels to compare",
        recording.directory().string(), input.machine));
  }
  const TimeNs start_ns = StartOf(encoders);
  for (NamedEncoders& named : encoders) {
    Trim(start_ns + FromSeconds(options.from_s), start_ns + FromSeconds(options.to_s),
         &named.recording.samples);
  }
  std::vector<ReplayBlock> blocks;
  if (!input.commands.columns.empty()) AddAxes(input, encoders, options.step_s, &blocks);
  AddBase(input, recording, encoders, options, &blocks);
  std::erase_if(blocks, [](const ReplayBlock& block) {
    return static_cast<double>(block.samples()) * block.period_s() < kShortest_s;
  });
  if (blocks.empty()) {
    throw InputError(fmt::format(
        "{}: nothing of {} can be replayed: need levers and encoders of the same joints, or "
        "encoders of all tracks or wheels and poses, over {} s at least",
        recording.directory().string(), input.machine, kShortest_s));
  }
  Diagnosis diagnosis{input.machine, input.scenario, {}};
  for (ReplayBlock& block : blocks) {
    progress(block.name);
    DiagnosedBlock diagnosed;
    diagnosed.block = std::move(block);
    diagnosed.diagnosis = DiagnoseBlock(diagnosed.block, options.search,
                                        Stream(options.seed, "diagnose/" + diagnosed.block.name));
    diagnosis.blocks.push_back(std::move(diagnosed));
  }
  return diagnosis;
}

}  // namespace tera
