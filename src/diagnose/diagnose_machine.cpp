#include "diagnose/diagnose_machine.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "core/in_parallel.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/encoder_clocks.h"
#include "diagnose/search/fit/excluded_samples.h"
#include "diagnose/sensors/estimated_poses.h"
#include "diagnose/sensors/late_poses.h"
#include "diagnose/tolerances/lever_interval.h"
#include "diagnose/tolerances/within_tolerance.h"

namespace tera {
namespace {

std::vector<Learned> LearnAll(const DiagnosedBlock& diagnosed, std::uint64_t seed) {
  std::vector<Learned> all;
  for (const Unexplained& left : diagnosed.diagnosis.unexplained) {
    const std::size_t channel = left.location.channel;
    const Stream stream(seed, "diagnose/learned/" + diagnosed.block.channels[channel].name);
    if (auto learned = Learn(diagnosed.block, diagnosed.diagnosis, channel, stream)) {
      all.push_back(std::move(*learned));
    }
  }
  return all;
}

std::optional<NextManoeuvre> NextManoeuvreOf(const MachineModel& model,
                                             const std::vector<DiagnosedBlock>& blocks,
                                             const DiagnosisOptions& options) {
  NextManoeuvreOptions next{.alpha = options.search.alpha};
  std::vector<DiagnosedAxis> axes;
  for (const DiagnosedBlock& diagnosed : blocks) {
    axes.push_back({&diagnosed.block, &diagnosed.diagnosis});
    next.total_candidates += diagnosed.block.candidates.size();
  }
  return DesignNextManoeuvre(model, axes, next, Stream(options.seed, "diagnose/next_manoeuvre"));
}

/// Channels of joints, running gears and the base, marked as not corrected.
std::vector<DiscrepancyCorrection> UncorrectedChannels(const DiagnosisInput& input,
                                                       const std::vector<ReplayBlock>& blocks) {
  const MachineModel& model = *input.model;
  const auto has_gear = [&](const std::string& name) {
    const auto& gears = model.ground_tools.gears;
    return std::any_of(gears.begin(), gears.end(),
                       [&](const RunningGear& gear) { return gear.name == name; });
  };
  std::vector<DiscrepancyCorrection> none;
  for (const ReplayBlock& block : blocks) {
    const bool is_one = model.JointIndex(block.name) >= 0 || has_gear(block.name) ||
                        block.name == input.machine + "/base";
    const std::string& unit = block.channels.front().unit;
    if (!is_one || (unit != "m/s" && unit != "rad/s")) continue;  // efforts have no correction
    for (const Channel& channel : block.channels) none.push_back({channel.name, channel.unit});
  }
  return none;
}

/// Diagnoses the machine's own blocks first, then those of its sensors. The base's block shows
/// whether poses have arrival stamps, and the sensors' blocks depend on this.
std::vector<DiagnosedBlock> DiagnoseInTurn(
    const DiagnosisInput& input, const SensorDiagnosis& estimate, const Measurements& measured,
    std::vector<ReplayBlock> blocks, const DiagnosisOptions& options,
    const FollowProgress& progress, std::vector<std::string>* not_compared) {
  const SearchOptions search = WithTotalsOf(options.search, blocks);
  const std::size_t in_all = blocks.size();
  std::optional<Deadline> deadline;
  if (options.time_limit_s) {
    deadline = std::chrono::steady_clock::now() +
               std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                   std::chrono::duration<double>(*options.time_limit_s));
  }
  std::vector<ReplayBlock> carried = TakeSensorBlocks(input.machine, &blocks);
  const auto tell = [&](std::size_t before) {
    return [&, before](BlockProgress told) {
      told.machine = input.machine;
      told.number += before;
      told.count = in_all;
      progress(told);
    };
  };
  std::vector<DiagnosedBlock> diagnosed =
      DiagnoseBlocks(std::move(blocks), search, options.seed, tell(0), deadline);
  if (FindsArrivalStamps(diagnosed)) {
    std::vector<std::string> obstacles;
    carried = SensorBlocksByArrivals(input, measured, options.blocks, &obstacles);
    for (std::string& obstacle : obstacles) {  // most were found before
      const auto same = std::find(not_compared->begin(), not_compared->end(), obstacle);
      if (same == not_compared->end()) not_compared->push_back(std::move(obstacle));
    }
    RemoveEstimated(input, estimate, &carried);
    if (options.library) ApplyLibrary(*options.library, *input.model, &carried);
    StateTolerances(input.tolerances, &carried, LeverInterval_s(input.commands));
  }
  std::vector<DiagnosedBlock> of_carried =
      DiagnoseBlocks(std::move(carried), search, options.seed, tell(diagnosed.size()), deadline);
  std::move(of_carried.begin(), of_carried.end(), std::back_inserter(diagnosed));
  return diagnosed;
}

/// Reads the further recordings before the search, so that faults in them end the diagnosis at
/// once.
std::vector<HeldOutBlocks> ReadAll(const DiagnosisCase& asked, const DiagnosisOptions& options) {
  std::vector<HeldOutBlocks> held_out;
  for (const HeldOutCase& one : asked.held_out) {
    held_out.push_back(ReadHeldOut(one, asked.simulate, options.blocks.threads, options.seed));
  }
  return held_out;
}

bool IsOutOfTime(const std::vector<DiagnosedBlock>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [](const DiagnosedBlock& diagnosed) {
    return diagnosed.diagnosis.out_of_time;
  });
}

SensorDiagnosisOptions SensorOptionsOf(const DiagnosisCase& asked,
                                       const DiagnosisOptions& options) {
  SensorDiagnosisOptions of_sensors;
  of_sensors.place = asked.place;
  of_sensors.judge.alpha = options.search.alpha;
  of_sensors.library = options.library;
  of_sensors.threads = options.search.threads;
  return of_sensors;
}

/// The whole simulation with the findings; none if not requested or without findings.
std::optional<WholeSimulation> WholeOf(const DiagnosisCase& asked, const Measurements& measured,
                                       const std::vector<DiagnosedBlock>& blocks,
                                       const std::optional<SimulatedCourse>& as_it_is,
                                       StageClock* clock) {
  if (!asked.simulate || FindingsToSimulate(blocks).empty()) return std::nullopt;
  if (IsOutOfTime(blocks)) return WholeSimulation{.obstacle = "the time was over"};
  return clock->Time("whole simulation", [&] {
    return SimulateWhole(asked.input, measured, blocks, as_it_is, asked.simulate);
  });
}

}  // namespace

Diagnosis Diagnose(DiagnosisCase asked, DiagnosisOptions options, const FollowProgress& progress,
                   StageClock* clock) {
  options.measurements.needs_any = options.blocks.needs_any = asked.perception.empty();
  std::vector<HeldOutBlocks> held_out =
      clock->Time("further recordings", [&] { return ReadAll(asked, options); });
  const DiagnosisInput& input = asked.input;
  const Measurements measured = MeasurementsOf(input, *asked.recording, options.measurements);
  Diagnosis diagnosis;
  diagnosis.machine = input.machine;
  diagnosis.scenario = input.scenario;
  diagnosis.origin = asked.origin;
  diagnosis.start_ns = measured.start_ns;
  diagnosis.levers_are_the_scenarios = input.commands_are_the_scenarios;
  diagnosis.sensors = DiagnosedOf(
      DiagnoseSensors(input, measured, SensorOptionsOf(asked, options), clock), input.machine);
  AddReversed(measured.reversed, &diagnosis.sensors);
  AddOffsetReceivers(measured.offset_receivers, input.machine, &diagnosis.sensors);
  options.blocks.needs_any =
      options.blocks.needs_any && diagnosis.sensors.estimate.channels.empty();
  Measurements left = WithoutExplained(input, diagnosis.sensors.estimate, measured);
  StampPosesAnew(diagnosis.sensors.estimate, &left);
  StampEncodersAnew(input, diagnosis.sensors.estimate, options.blocks, &left);
  if (left.poses.empty()) left.estimated_poses = EstimatedPoses(diagnosis.sensors.estimate);
  std::vector<ReplayBlock> blocks = BlocksOf(input, left, options.blocks, &diagnosis.not_compared);
  RemoveEstimated(input, diagnosis.sensors.estimate, &blocks);
  const std::optional<SimulatedCourse> course = clock->Time(
      "simulation as it is", [&] { return SimulateAsItIs(input, measured, asked.simulate); });
  diagnosis.missing_input = MissingInputOf(input, left, course);
  std::erase_if(blocks, [&](const ReplayBlock& block) {
    return std::any_of(diagnosis.missing_input.begin(), diagnosis.missing_input.end(),
                       [&](const MissingInput& one) { return one.axis == block.name; });
  });
  if (options.library) {
    ApplyLibrary(*options.library, *input.model, &blocks);
    if (diagnosis.sensors.estimate.candidates == 0) RequireCandidates(*options.library, blocks);
  }
  StateTolerances(input.tolerances, &blocks, LeverInterval_s(input.commands));
  // With missing input, the simulated drive differs from the recorded one, and does not show what
  // the replays lack.
  const bool is_same_drive = course && diagnosis.missing_input.empty();
  diagnosis.discrepancy_corrections =
      is_same_drive
          ? CorrectDiscrepancies(ReplayDiscrepanciesOf(input, left, options.blocks, *course),
                                 options.seed, options.search.threads, &blocks)
          : UncorrectedChannels(input, blocks);
  diagnosis.excluded_samples = ExcludeLaggingSamples(&blocks);
  diagnosis.encoder_lead_s = EncoderLead_s(blocks);
  diagnosis.blocks = DiagnoseInTurn(input, diagnosis.sensors.estimate, left, std::move(blocks),
                                    options, progress, &diagnosis.not_compared);
  std::vector<std::vector<Learned>> learned = InParallel<std::vector<Learned>>(
      diagnosis.blocks.size(), options.search.threads,
      [&](std::size_t b) { return LearnAll(diagnosis.blocks[b], options.seed); });
  for (std::size_t b = 0; b < learned.size(); ++b) {
    diagnosis.blocks[b].learned = std::move(learned[b]);
  }
  diagnosis.next = NextManoeuvreOf(*input.model, diagnosis.blocks, options);
  for (HeldOutBlocks& one : held_out) {
    StampAnew(diagnosis.sensors.estimate, options.blocks.threads, options.seed, &one);
    diagnosis.held_out.push_back(
        ValidateHeldOut(diagnosis.blocks, options.blocks, options.seed, &one));
  }
  diagnosis.whole = WholeOf(asked, left, diagnosis.blocks, course, clock);
  diagnosis.perception = std::move(asked.perception);
  return diagnosis;
}

}  // namespace tera
