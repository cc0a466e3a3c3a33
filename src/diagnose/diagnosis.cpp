#include "diagnose/diagnosis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/error.h"
#include "diagnose/blocks/axis_block.h"
#include "diagnose/blocks/base_block.h"
#include "diagnose/blocks/effort_block.h"
#include "diagnose/blocks/gnss_block.h"
#include "diagnose/blocks/imu_block.h"
#include "diagnose/input_checks.h"

namespace tera {
namespace {

constexpr double kStepOfPeriod = 0.2;  ///< of an encoder's, that a replay steps over at most
constexpr double kShortest_s = 20;     ///< less leaves too little of SELECT and FINAL

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

void Trim(TimeNs from_ns, TimeNs to_ns, TableRecording* table) {
  const auto first = std::lower_bound(table->t_ns.begin(), table->t_ns.end(), from_ns);
  const auto end = std::upper_bound(first, table->t_ns.end(), to_ns);
  const auto rows = table->rows.begin();
  table->rows = {rows + (first - table->t_ns.begin()), rows + (end - table->t_ns.begin())};
  table->t_ns = {first, end};
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
  bool poses_were_measured = false;  ///< not simulated
  TableRecording efforts;            ///< of drives
  /// One for each of the scenario's sensors; empty of those that are none or were not recorded.
  std::vector<std::vector<ImuSample>> imus;
  std::vector<std::vector<GnssSample>> gnss;  ///< likewise
  TimeNs start_ns = 0;                        ///< of the whole recording
};

TimeNs StartOf(const Measurements& measured) {
  TimeNs start_ns = std::numeric_limits<TimeNs>::max();
  for (const NamedEncoders& named : measured.encoders) {
    start_ns = std::min(start_ns, named.recording.samples.front().t_ns);
  }
  for (const auto& samples : measured.imus) {
    if (!samples.empty()) start_ns = std::min(start_ns, samples.front().t_ns);
  }
  if (start_ns < std::numeric_limits<TimeNs>::max()) return start_ns;
  // Receivers count only where nothing else was measured: their clocks are not the machine's.
  for (const auto& samples : measured.gnss) {
    if (!samples.empty()) start_ns = std::min(start_ns, samples.front().t_ns);
  }
  return start_ns;
}

void CheckMeasurements(const DiagnosisInput& input, const Recording& recording,
                       const Measurements& measured) {
  const RecordedPlace place{recording.directory().string(), input.machine};
  CheckLevers(place, input.commands, *input.model);
  CheckClocks(place, input.commands, measured.encoders, measured.imus, measured.gnss,
              measured.poses);
  CheckEncoders(place, input.commands, measured.encoders, *input.model);
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    const std::string channel = input.machine + "/" + input.sensors[s].name;
    CheckImu(place, channel, measured.imus[s]);
    CheckGnss(place, channel, measured.gnss[s], measured.poses);
  }
}

Measurements MeasurementsOf(const DiagnosisInput& input, const Recording& recording,
                            const DiagnosisOptions& options) {
  Measurements measured;
  measured.encoders = EncodersOf(recording, input.machine);
  std::erase_if(measured.encoders,
                [](const NamedEncoders& named) { return named.recording.samples.empty(); });
  const std::string poses = "truth/" + input.machine + "/pose.csv";
  if (recording.Has(poses)) measured.poses = recording.LoadPose(poses).poses;
  measured.poses_were_measured = !measured.poses.empty() && !recording.info().simulated;
  const std::string efforts = input.machine + "/efforts.csv";
  if (recording.Has(efforts)) measured.efforts = recording.LoadTable(efforts);
  bool any = !measured.encoders.empty();
  for (const SensorDescription& sensor : input.sensors) {
    const std::string channel = input.machine + "/" + sensor.name;
    const bool is_imu = std::holds_alternative<ImuModel>(sensor.model) && recording.Has(channel);
    measured.imus.push_back(is_imu ? recording.LoadImu(channel) : std::vector<ImuSample>{});
    const bool is_gnss = std::holds_alternative<GnssModel>(sensor.model) && recording.Has(channel);
    measured.gnss.push_back(is_gnss ? recording.LoadGnss(channel) : std::vector<GnssSample>{});
    any = any || !measured.imus.back().empty() || !measured.gnss.back().empty();
  }
  if (!any && !options.needs_blocks) return measured;
  if (!any) {
    throw InputError(
        fmt::format("{}: no encoder channel of {}, and no inertial unit or receiver that the "
                    "scenario has; need something measured to compare",
                    recording.directory().string(), input.machine));
  }
  CheckMeasurements(input, recording, measured);
  measured.start_ns = StartOf(measured);
  const TimeNs from_ns = measured.start_ns + FromSeconds(options.from_s);
  const TimeNs to_ns = measured.start_ns + FromSeconds(options.to_s);
  for (NamedEncoders& named : measured.encoders) Trim(from_ns, to_ns, &named.recording.samples);
  for (auto& samples : measured.imus) Trim(from_ns, to_ns, &samples);
  for (auto& samples : measured.gnss) Trim(from_ns, to_ns, &samples);
  Trim(from_ns, to_ns, &measured.efforts);
  return measured;
}

/// Fine enough for the encoder that samples fastest, and no finer than wanted.
double AxisStep_s(const std::vector<NamedEncoders>& encoders, double wanted_s) {
  double shortest_s = std::numeric_limits<double>::max();
  for (const NamedEncoders& named : encoders) {
    const std::vector<EncoderSample>& samples = named.recording.samples;
    if (samples.size() < 2) continue;
    const double length_s = ToSeconds(samples.back().t_ns - samples.front().t_ns);
    shortest_s = std::min(shortest_s, length_s / static_cast<double>(samples.size() - 1));
  }
  const bool any = shortest_s < std::numeric_limits<double>::max();
  return any ? std::max(wanted_s, kStepOfPeriod * shortest_s) : wanted_s;
}

/// What cannot be compared leaves the rest, and is told with its place.
void Try(const std::string& place, std::vector<std::string>* obstacles,
         const std::function<void()>& add) {
  try {
    add();
  } catch (const InputError& error) {
    obstacles->push_back(place + error.what());
  }
}

/// Encoders may have a block for each joint and gear with a lever.
void AddAxes(const DiagnosisInput& input, const Measurements& measured,
             const DiagnosisOptions& options, std::vector<ReplayBlock>* blocks,
             std::vector<std::string>* obstacles) {
  if (input.commands.columns.empty() || measured.encoders.empty()) return;
  const AxisLog log = MakeAxisLog(*input.model, input.commands, measured.encoders,
                                  AxisStep_s(measured.encoders, options.step_s));
  for (std::size_t axis = 0; axis < log.measured.size(); ++axis) {
    Try(log.measured[axis].channel + ": ", obstacles, [&] {
      auto block = MakeAxisBlock(*input.model, log, axis);
      if (block) blocks->push_back(std::move(*block));
    });
  }
}

/// A joint whose drive's effort was measured, and its position, makes a block.
void AddEfforts(const DiagnosisInput& input, const Measurements& measured,
                std::vector<ReplayBlock>* blocks) {
  for (EffortLog& log : MakeEffortLogs(*input.model, input.machine + "/efforts", measured.efforts,
                                       measured.encoders)) {
    if (auto block = MakeEffortBlock(*input.model, std::move(log))) {
      blocks->push_back(std::move(*block));
    }
  }
}

bool HasBase(const DiagnosisInput& input, const Measurements& measured) {
  const auto& gears = input.model->ground_tools.gears;
  const bool all = std::all_of(gears.begin(), gears.end(), [&](const RunningGear& gear) {
    return Measures(measured.encoders, gear.name);
  });
  return !gears.empty() && all && !measured.poses.empty();
}

/// Every gear's encoder and poses make a block of the base.
void AddBase(const DiagnosisInput& input, const Measurements& measured,
             const DiagnosisOptions& options, std::vector<ReplayBlock>* blocks) {
  if (!HasBase(input, measured)) return;
  // Gears bound the time.
  const BaseLog log =
      MakeBaseLog(*input.model, measured.encoders, measured.poses, options.base_interval_s);
  if (auto block =
          MakeBaseBlock(*input.model, log, input.machine + "/base", measured.poses_were_measured)) {
    blocks->push_back(std::move(*block));
  }
}

/// What the replays of joints and gears leave of what they do in a simulation.
void AddUnreplayedRates(const DiagnosisInput& input, const Measurements& measured,
                        const std::vector<NamedEncoders>& simulated,
                        const DiagnosisOptions& options, std::vector<Unreplayed>* out) {
  if (input.commands.columns.empty() || measured.encoders.empty()) return;
  const double step_s = AxisStep_s(measured.encoders, options.step_s);
  const AxisLog log = MakeAxisLog(*input.model, input.commands, measured.encoders, step_s);
  const AxisLog course = MakeAxisLog(*input.model, input.commands, simulated, step_s);
  for (std::size_t axis = 0; axis < log.measured.size(); ++axis) {
    std::vector<double> left = UnreplayedRate(*input.model, log, course, axis);
    if (!left.empty()) out->push_back({log.measured[axis].channel, {left}});
  }
}

/// What the replay of the base leaves of what it does in a simulation.
void AddUnreplayedMotion(const DiagnosisInput& input, const Measurements& measured,
                         const std::vector<NamedEncoders>& simulated, const SimulatedCourse& course,
                         const DiagnosisOptions& options, std::vector<Unreplayed>* out) {
  if (!HasBase(input, measured)) return;
  const auto log_of = [&](const auto& encoders, const auto& poses) {
    return MakeBaseLog(*input.model, encoders, poses, options.base_interval_s);
  };
  auto left = UnreplayedMotion(*input.model, log_of(measured.encoders, measured.poses),
                               log_of(simulated, AsSimulated(course, measured.poses)));
  if (!left.empty()) out->push_back({input.machine + "/base/forward_mps", std::move(left)});
}

/// An inertial unit makes a block where its link's motion was measured.
void AddImus(const DiagnosisInput& input, const Measurements& measured,
             const DiagnosisOptions& options, std::vector<ReplayBlock>* blocks) {
  const double interval_s = std::max(options.base_interval_s, ImuInterval_s(measured.poses));
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    const SensorDescription& sensor = input.sensors[s];
    if (measured.imus[s].empty()) continue;
    ImuLog log = MakeImuLog(*input.model, sensor, measured.imus[s], measured.encoders,
                            measured.poses, interval_s);
    if (auto block = MakeImuBlock(sensor, std::move(log), input.machine + "/" + sensor.name,
                                  measured.poses_were_measured)) {
      blocks->push_back(std::move(*block));
    }
  }
}

/// Some of the scenario's receivers, by their numbers among its sensors, make a block where poses
/// and joints tell how their antennas moved.
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

/// Two receivers make one block where both have enough to say; else, and where one of them cannot
/// be compared, each has its own.
void AddGnss(const DiagnosisInput& input, const Measurements& measured,
             std::vector<ReplayBlock>* blocks, std::vector<std::string>* obstacles) {
  std::vector<std::size_t> which;
  std::size_t in_all = 0;
  for (std::size_t s = 0; s < input.sensors.size(); ++s) {
    in_all += std::holds_alternative<GnssModel>(input.sensors[s].model) ? 1 : 0;
    if (!measured.gnss[s].empty()) which.push_back(s);
  }
  const auto add = [&](const std::vector<std::size_t>& receivers) {
    auto block = GnssBlockOf(input, measured, receivers);
    if (block) blocks->push_back(std::move(*block));
    return block.has_value();
  };
  if (which.size() == 2 && in_all == 2) {
    bool is_made = false;
    std::vector<std::string> of_one;  // whose own block will tell it again
    Try("", &of_one, [&] { is_made = add(which); });
    if (is_made) return;
  }
  for (const std::size_t s : which) {
    const std::string channel = input.machine + "/" + input.sensors[s].name;
    Try(channel + ": ", obstacles, [&] { add({s}); });
  }
}

[[noreturn]] void ThrowNothingToCompare(const DiagnosisInput& input, const Recording& recording,
                                        const std::vector<std::string>& obstacles) {
  const std::string directory = recording.directory().string();
  if (!obstacles.empty()) {
    throw InputError(fmt::format("{}: {}", directory, fmt::join(obstacles, "; ")));
  }
  throw InputError(fmt::format(
      "{}: nothing of {} can be replayed: need levers and encoders of the same joints, efforts and "
      "encoders of the same joints, encoders of all tracks or wheels and poses, "
      "a receiver and poses, or an inertial unit and what tells how its link moved, over {} s at "
      "least",
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

/// Thrown out of a search whose time is over.
struct OutOfTime {};

class Deadline {
 public:
  explicit Deadline(double limit_s)
      : at_(std::chrono::steady_clock::now() +
            std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                std::chrono::duration<double>(limit_s))) {}
  void Keep() const {
    if (std::chrono::steady_clock::now() >= at_) throw OutOfTime();
  }

 private:
  std::chrono::steady_clock::time_point at_;
};

/// Every prediction looks at the clock: nothing that a search does goes without one for long.
BlockDiagnosis DiagnoseInTime(ReplayBlock* block, const SearchOptions& options,
                              const Stream& stream, const std::optional<Deadline>& deadline) {
  if (!deadline) return DiagnoseBlock(*block, options, stream);
  const auto predict = block->predict;
  const auto predict_beginning = block->predict_beginning;
  block->predict = [predict, deadline](const Structure& terms) {
    deadline->Keep();
    return predict(terms);
  };
  if (predict_beginning) {
    block->predict_beginning = [predict_beginning, deadline](const Structure& terms,
                                                             std::size_t samples) {
      deadline->Keep();
      return predict_beginning(terms, samples);
    };
  }
  BlockDiagnosis diagnosis;
  try {
    diagnosis = DiagnoseBlock(*block, options, stream);
  } catch (const OutOfTime&) {
    diagnosis = {};
    diagnosis.is_testable = false;
    diagnosis.out_of_time = true;
  }
  block->predict = predict;
  block->predict_beginning = predict_beginning;
  return diagnosis;
}

void Propose(std::uint64_t seed, DiagnosedBlock* diagnosed) {
  for (const Unexplained& left : diagnosed->diagnosis.unexplained) {
    const std::size_t channel = left.location.channel;
    const Stream stream(seed, "diagnose/proposal/" + diagnosed->block.channels[channel].name);
    if (auto proposal = ProposeTerms(diagnosed->block, diagnosed->diagnosis, channel, stream)) {
      diagnosed->proposals.push_back(std::move(*proposal));
    }
  }
}

std::optional<NextManoeuvre> NextManoeuvreOf(const MachineModel& model,
                                             const std::vector<DiagnosedBlock>& blocks,
                                             const DiagnosisOptions& options) {
  NextManoeuvreOptions next{.step_s = options.step_s, .alpha = options.search.alpha};
  std::vector<DiagnosedAxis> axes;
  for (const DiagnosedBlock& diagnosed : blocks) {
    axes.push_back({&diagnosed.block, &diagnosed.diagnosis});
    next.suspects_in_all += diagnosed.block.suspects.size();
  }
  return DesignNextManoeuvre(model, axes, next, Stream(options.seed, "diagnose/next_manoeuvre"));
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
  bool named = false, several = false, unexplained = false, judged = false;
  bool untestable = !diagnosis.not_compared.empty();
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
                                  const DiagnosisOptions& options,
                                  std::vector<std::string>* not_compared) {
  const Measurements measured = MeasurementsOf(input, recording, options);
  std::vector<ReplayBlock> blocks;
  std::vector<std::string> obstacles;
  Try("", &obstacles, [&] { AddAxes(input, measured, options, &blocks, &obstacles); });
  Try("", &obstacles, [&] { AddEfforts(input, measured, &blocks); });
  Try("", &obstacles, [&] { AddBase(input, measured, options, &blocks); });
  Try("", &obstacles, [&] { AddImus(input, measured, options, &blocks); });
  AddGnss(input, measured, &blocks, &obstacles);
  std::erase_if(blocks, [](const ReplayBlock& block) {
    return static_cast<double>(block.samples()) * block.period_s() < kShortest_s;
  });
  if (blocks.empty() && options.needs_blocks) ThrowNothingToCompare(input, recording, obstacles);
  CheckUnitsOf({recording.directory().string(), input.machine}, blocks);
  for (ReplayBlock& block : blocks) CountTimeFrom(measured.start_ns, &block);
  if (not_compared != nullptr) *not_compared = std::move(obstacles);
  return blocks;
}

std::vector<Unreplayed> UnreplayedOf(const DiagnosisInput& input, const Recording& recording,
                                     const DiagnosisOptions& options,
                                     const SimulatedCourse& course) {
  const MachineModel& model = *input.model;
  const Measurements measured = MeasurementsOf(input, recording, options);
  std::vector<Unreplayed> unreplayed;
  const std::string place = recording.directory().string();
  std::vector<std::string> obstacles;  // told by BlocksOf
  const std::vector<NamedEncoders> encoders = AsSimulated(model, course, measured.encoders);
  Try(place, &obstacles,
      [&] { AddUnreplayedRates(input, measured, encoders, options, &unreplayed); });
  Try(place, &obstacles,
      [&] { AddUnreplayedMotion(input, measured, encoders, course, options, &unreplayed); });
  return unreplayed;
}

std::vector<TakenOff> TakeOffAll(const std::vector<Unreplayed>& unreplayed, std::uint64_t seed,
                                 std::vector<ReplayBlock>* blocks) {
  std::vector<TakenOff> taken;
  for (ReplayBlock& block : *blocks) {
    for (const Unreplayed& one : unreplayed) {
      if (one.first_channel != block.channels.front().name) continue;
      const auto of_block = TakeOff(one, StreamOf(block, seed), &block);
      taken.insert(taken.end(), of_block.begin(), of_block.end());
    }
  }
  return taken;
}

/// The channels of joints, gears and the base, without a simulation.
std::vector<TakenOff> NotTakenOff(const DiagnosisInput& input,
                                  const std::vector<ReplayBlock>& blocks) {
  const MachineModel& model = *input.model;
  const auto has_gear = [&](const std::string& name) {
    const auto& gears = model.ground_tools.gears;
    return std::any_of(gears.begin(), gears.end(),
                       [&](const RunningGear& gear) { return gear.name == name; });
  };
  std::vector<TakenOff> none;
  for (const ReplayBlock& block : blocks) {
    const bool is_one = model.JointIndex(block.name) >= 0 || has_gear(block.name) ||
                        block.name == input.machine + "/base";
    const std::string& unit = block.channels.front().unit;
    if (!is_one || (unit != "m/s" && unit != "rad/s")) continue;  // else effort
    for (const Channel& channel : block.channels) none.push_back({channel.name, channel.unit});
  }
  return none;
}

Stream StreamOf(const ReplayBlock& block, std::uint64_t seed) {
  return Stream(seed, "diagnose/" + block.name);
}

TimeNs StartOf(const DiagnosisInput& input, const Recording& recording) {
  return MeasurementsOf(input, recording, {}).start_ns;
}

std::vector<DiagnosedBlock> DiagnoseBlocks(std::vector<ReplayBlock> blocks, SearchOptions options,
                                           std::uint64_t seed, const FollowProgress& progress,
                                           std::optional<double> time_limit_s) {
  options.suspects_in_all = options.channels_in_all = 0;
  for (const ReplayBlock& block : blocks) {
    options.suspects_in_all += block.suspects.size();
    options.channels_in_all += block.channels.size();
  }
  std::optional<Deadline> deadline;
  if (time_limit_s) deadline = Deadline(*time_limit_s);
  std::vector<DiagnosedBlock> diagnosed;
  for (ReplayBlock& block : blocks) {
    const std::size_t number = diagnosed.size() + 1;
    progress({block.name, number, blocks.size(), nullptr});
    DiagnosedBlock one;
    one.block = std::move(block);
    one.diagnosis = DiagnoseInTime(&one.block, options, StreamOf(one.block, seed), deadline);
    diagnosed.push_back(std::move(one));
    const DiagnosedBlock& done = diagnosed.back();
    progress({done.block.name, number, blocks.size(), &done.diagnosis});
  }
  return diagnosed;
}

Diagnosis Diagnose(const DiagnosisInput& input, const Recording& recording,
                   const DiagnosisOptions& options, const SimulateMachine& simulate,
                   const FollowProgress& progress) {
  Diagnosis diagnosis;
  std::vector<ReplayBlock> blocks = BlocksOf(input, recording, options, &diagnosis.not_compared);
  if (options.library) ApplyLibrary(*options.library, *input.model, &blocks);
  const std::optional<SimulatedCourse> course = simulate ? simulate() : std::nullopt;
  diagnosis.taken_off =
      course ? TakeOffAll(UnreplayedOf(input, recording, options, *course), options.seed, &blocks)
             : NotTakenOff(input, blocks);
  diagnosis.machine = input.machine;
  diagnosis.scenario = input.scenario;
  diagnosis.blocks = DiagnoseBlocks(std::move(blocks), options.search, options.seed, progress,
                                    options.time_limit_s);
  for (DiagnosedBlock& diagnosed : diagnosis.blocks) Propose(options.seed, &diagnosed);
  diagnosis.next = NextManoeuvreOf(*input.model, diagnosis.blocks, options);
  return diagnosis;
}

HeldOutRecording JudgeHeldOut(const std::vector<DiagnosedBlock>& diagnosed,
                              const std::vector<ReplayBlock>& further, const std::string& recording,
                              std::uint64_t seed) {
  HeldOutRecording out{recording, {}, {}};
  for (const DiagnosedBlock& one : diagnosed) {
    const auto same = std::find_if(further.begin(), further.end(), [&](const ReplayBlock& block) {
      return block.name == one.block.name;
    });
    if (same == further.end()) {
      if (!one.diagnosis.findings.empty()) out.missing.push_back(one.block.name);
      continue;
    }
    const auto channels = JudgeOnBlock(*same, one.diagnosis.search.found.terms,
                                       Stream(seed, "diagnose/held_out/" + same->name));
    out.channels.insert(out.channels.end(), channels.begin(), channels.end());
  }
  return out;
}

}  // namespace tera
