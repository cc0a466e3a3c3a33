#include "diagnose/diagnosis.h"

#include <algorithm>
#include <iterator>
#include <mutex>

#include "core/in_parallel.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/encoder_lead.h"

namespace tera {
namespace {

/// Ends a search whose time is over.
struct OutOfTime {};

/// Diagnoses a block until a deadline. Every prediction checks it, since no part of a search goes
/// without predictions for long.
BlockDiagnosis DiagnoseInTime(ReplayBlock* block, const SearchOptions& options,
                              const Stream& stream, const std::optional<Deadline>& deadline) {
  if (!deadline) return DiagnoseBlock(*block, options, stream);
  const Replay replay = block->replay;
  block->replay = [replay, deadline](const Structure& terms, std::size_t samples) {
    if (std::chrono::steady_clock::now() >= *deadline) throw OutOfTime();
    return replay(terms, samples);
  };
  BlockDiagnosis diagnosis;
  try {
    diagnosis = DiagnoseBlock(*block, options, stream);
  } catch (const OutOfTime&) {
    diagnosis = {};
    diagnosis.is_testable = false;
    diagnosis.out_of_time = true;
  }
  block->replay = replay;
  return diagnosis;
}

std::vector<Proposal> ProposalsFor(const DiagnosedBlock& diagnosed, std::uint64_t seed) {
  std::vector<Proposal> proposals;
  for (const Unexplained& left : diagnosed.diagnosis.unexplained) {
    const std::size_t channel = left.location.channel;
    const Stream stream(seed, "diagnose/proposal/" + diagnosed.block.channels[channel].name);
    if (auto proposal = Propose(diagnosed.block, diagnosed.diagnosis, channel, stream)) {
      proposals.push_back(std::move(*proposal));
    }
  }
  return proposals;
}

std::optional<NextManoeuvre> NextManoeuvreOf(const MachineModel& model,
                                             const std::vector<DiagnosedBlock>& blocks,
                                             const DiagnosisOptions& options) {
  NextManoeuvreOptions next{.step_s = options.blocks.step_s, .alpha = options.search.alpha};
  std::vector<DiagnosedAxis> axes;
  for (const DiagnosedBlock& diagnosed : blocks) {
    axes.push_back({&diagnosed.block, &diagnosed.diagnosis});
    next.total_candidates += diagnosed.block.candidates.size();
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
    for (const Detectability& candidate : diagnosed.diagnosis.detectability) {
      untestable = untestable || !candidate.smallest;
    }
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    judged = judged || sensor.is_judged();
    untestable = untestable || !sensor.is_judged();
    for (const PerceptionFinding& found : sensor.findings) {
      (found.finding.evidence.rivals.size() > 1 ? several : named) = true;
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

std::vector<DiscrepancyCorrection> CorrectDiscrepancies(
    const std::vector<ReplayDiscrepancy>& discrepancy, std::uint64_t seed, int threads,
    std::vector<ReplayBlock>* blocks) {
  const auto parts =
      InParallel<std::vector<DiscrepancyCorrection>>(blocks->size(), threads, [&](std::size_t b) {
        ReplayBlock& block = (*blocks)[b];
        std::vector<DiscrepancyCorrection> corrections;
        for (const ReplayDiscrepancy& one : discrepancy) {
          if (one.first_channel != block.channels.front().name) continue;
          const auto of_block = CorrectDiscrepancy(one, StreamOf(block, seed), &block);
          corrections.insert(corrections.end(), of_block.begin(), of_block.end());
        }
        return corrections;
      });
  std::vector<DiscrepancyCorrection> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The channels of joints, gears and the base, marked as not corrected.
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
    if (!is_one || (unit != "m/s" && unit != "rad/s")) continue;  // others are efforts
    for (const Channel& channel : block.channels) none.push_back({channel.name, channel.unit});
  }
  return none;
}

bool FindsArrivalStamps(const std::vector<DiagnosedBlock>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [](const DiagnosedBlock& diagnosed) {
    return HasArrivalStamps(diagnosed.diagnosis.search.found.terms);
  });
}

Stream StreamOf(const ReplayBlock& block, std::uint64_t seed) {
  return Stream(seed, "diagnose/" + block.name);
}

SearchOptions WithTotalsOf(SearchOptions options, const std::vector<ReplayBlock>& blocks) {
  options.total_candidates = options.total_channels = 0;
  for (const ReplayBlock& block : blocks) {
    options.total_candidates += block.candidates.size();
    options.total_channels += block.channels.size();
  }
  return options;
}

std::vector<DiagnosedBlock> DiagnoseBlocks(std::vector<ReplayBlock> blocks,
                                           const SearchOptions& options, std::uint64_t seed,
                                           const FollowProgress& progress,
                                           const std::optional<Deadline>& deadline) {
  std::mutex progress_mutex;
  const auto tell = [&](const BlockProgress& told) {
    const std::lock_guard lock(progress_mutex);
    progress(told);
  };
  return InParallel<DiagnosedBlock>(blocks.size(), options.threads, [&](std::size_t b) {
    DiagnosedBlock one;
    one.block = std::move(blocks[b]);
    tell({"", one.block.name, b + 1, blocks.size(), nullptr});
    one.diagnosis = DiagnoseInTime(&one.block, options, StreamOf(one.block, seed), deadline);
    tell({"", one.block.name, b + 1, blocks.size(), &one.diagnosis});
    return one;
  });
}

namespace {

/// Diagnoses the machine's own blocks, then those of its sensors. The block of the base shows
/// whether poses were stamped as they arrive, which the sensors' blocks depend on.
std::vector<DiagnosedBlock> DiagnoseInTurn(const DiagnosisInput& input,
                                           const Measurements& measured,
                                           std::vector<ReplayBlock> blocks,
                                           const DiagnosisOptions& options,
                                           const FollowProgress& progress,
                                           std::vector<std::string>* not_compared) {
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
    for (std::string& obstacle : obstacles) {  // most of them were noted with the stamps already
      const auto same = std::find(not_compared->begin(), not_compared->end(), obstacle);
      if (same == not_compared->end()) not_compared->push_back(std::move(obstacle));
    }
    if (options.library) ApplyLibrary(*options.library, *input.model, &carried);
  }
  std::vector<DiagnosedBlock> of_carried =
      DiagnoseBlocks(std::move(carried), search, options.seed, tell(diagnosed.size()), deadline);
  std::move(of_carried.begin(), of_carried.end(), std::back_inserter(diagnosed));
  return diagnosed;
}

/// A further recording's measurements and blocks of the machine.
struct Further {
  const HeldOutCase& given;
  Measurements measured;
  std::vector<ReplayBlock> blocks;
};

/// Reads the further recordings before the search, so that faults in them stop it at once.
std::vector<Further> FurtherRecordings(const DiagnosisCase& asked,
                                       const DiagnosisOptions& options) {
  std::vector<Further> further;
  const BlockOptions as_given{.threads = options.blocks.threads};
  for (const HeldOutCase& one : asked.held_out) {
    Measurements measured = MeasurementsOf(one.input, *one.recording);
    std::vector<ReplayBlock> blocks = BlocksOf(one.input, measured, as_given);
    if (const auto course = SimulateAsItIs(one.input, measured, asked.simulate)) {
      CorrectDiscrepancies(ReplayDiscrepanciesOf(one.input, measured, as_given, *course),
                           options.seed, as_given.threads, &blocks);
    }
    ExcludeLaggingSamples(&blocks);
    further.push_back({one, std::move(measured), std::move(blocks)});
  }
  return further;
}

/// Validates a diagnosis on a further recording, whose sensors are compared as those of the first
/// were.
HeldOutRecording JudgeFurther(const std::vector<DiagnosedBlock>& diagnosed,
                              const DiagnosisOptions& options, Further* further) {
  const DiagnosisInput& input = further->given.input;
  if (FindsArrivalStamps(diagnosed)) {
    std::vector<std::string> not_compared;  // as in the recording that is searched
    TakeSensorBlocks(input.machine, &further->blocks);
    for (ReplayBlock& block :
         SensorBlocksByArrivals(input, further->measured, options.blocks, &not_compared)) {
      // Without a block of the base they were not told from the machine's own.
      std::erase_if(further->blocks,
                    [&](const ReplayBlock& stamped) { return stamped.name == block.name; });
      further->blocks.push_back(std::move(block));
    }
  }
  return ValidateHeldOut(diagnosed, further->blocks, further->given.recording->directory().string(),
                         options.seed);
}

/// Whether there are findings that a simulation can have; it has no pose terms.
bool HasFindingsToSimulate(const std::vector<DiagnosedBlock>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [](const DiagnosedBlock& diagnosed) {
    return !WithoutPoseTerms(diagnosed.diagnosis.search.found.terms).empty();
  });
}

bool IsOutOfTime(const std::vector<DiagnosedBlock>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [](const DiagnosedBlock& diagnosed) {
    return diagnosed.diagnosis.out_of_time;
  });
}

/// The whole simulation with what was found, where it is wanted and something was found.
std::optional<WholeSimulation> WholeOf(const DiagnosisCase& asked, const DiagnosisOptions& options,
                                       TimeNs start_ns, const std::vector<DiagnosedBlock>& blocks,
                                       const std::optional<SimulatedCourse>& as_it_is,
                                       StageClock* clock) {
  if (!asked.simulate || !HasFindingsToSimulate(blocks)) return std::nullopt;
  if (IsOutOfTime(blocks)) return WholeSimulation{.obstacle = "the time was over"};
  return clock->Time("whole simulation", [&] {
    return SimulateWhole(asked.input, *asked.recording, start_ns, options.blocks.base_interval_s,
                         blocks, as_it_is, asked.simulate);
  });
}

}  // namespace

Diagnosis Diagnose(DiagnosisCase asked, DiagnosisOptions options, const FollowProgress& progress,
                   StageClock* clock) {
  options.measurements.needs_any = options.blocks.needs_any = asked.perception.empty();
  std::vector<Further> further =
      clock->Time("further recordings", [&] { return FurtherRecordings(asked, options); });
  const DiagnosisInput& input = asked.input;
  const Measurements measured = MeasurementsOf(input, *asked.recording, options.measurements);
  Diagnosis diagnosis;
  diagnosis.machine = input.machine;
  diagnosis.scenario = input.scenario;
  diagnosis.origin = asked.origin;
  diagnosis.start_ns = measured.start_ns;
  diagnosis.levers_are_the_scenarios = input.commands_are_the_scenarios;
  std::vector<ReplayBlock> blocks =
      BlocksOf(input, measured, options.blocks, &diagnosis.not_compared);
  if (options.library) {
    ApplyLibrary(*options.library, *input.model, &blocks);
    RequireCandidates(*options.library, blocks);
  }
  const std::optional<SimulatedCourse> course = clock->Time(
      "simulation as it is", [&] { return SimulateAsItIs(input, measured, asked.simulate); });
  diagnosis.discrepancy_corrections =
      course ? CorrectDiscrepancies(ReplayDiscrepanciesOf(input, measured, options.blocks, *course),
                                    options.seed, options.search.threads, &blocks)
             : UncorrectedChannels(input, blocks);
  diagnosis.excluded_samples = ExcludeLaggingSamples(&blocks);
  diagnosis.encoder_lead_s = EncoderLead_s(blocks);
  diagnosis.blocks = DiagnoseInTurn(input, measured, std::move(blocks), options, progress,
                                    &diagnosis.not_compared);
  std::vector<std::vector<Proposal>> proposals = InParallel<std::vector<Proposal>>(
      diagnosis.blocks.size(), options.search.threads,
      [&](std::size_t b) { return ProposalsFor(diagnosis.blocks[b], options.seed); });
  for (std::size_t b = 0; b < proposals.size(); ++b) {
    diagnosis.blocks[b].proposals = std::move(proposals[b]);
  }
  diagnosis.next = NextManoeuvreOf(*input.model, diagnosis.blocks, options);
  for (Further& one : further) {
    diagnosis.held_out.push_back(JudgeFurther(diagnosis.blocks, options, &one));
  }
  diagnosis.whole = WholeOf(asked, options, measured.start_ns, diagnosis.blocks, course, clock);
  diagnosis.perception = std::move(asked.perception);
  return diagnosis;
}

HeldOutRecording ValidateHeldOut(const std::vector<DiagnosedBlock>& diagnosed,
                                 const std::vector<ReplayBlock>& further,
                                 const std::string& recording, std::uint64_t seed) {
  HeldOutRecording out{recording, {}, {}};
  for (const DiagnosedBlock& one : diagnosed) {
    const auto same = std::find_if(further.begin(), further.end(), [&](const ReplayBlock& block) {
      return block.name == one.block.name;
    });
    if (same == further.end()) {
      if (!one.diagnosis.findings.empty()) out.missing.push_back(one.block.name);
      continue;
    }
    const auto channels = ValidateOnBlock(*same, one.diagnosis.search.found.terms,
                                          Stream(seed, "diagnose/held_out/" + same->name));
    out.channels.insert(out.channels.end(), channels.begin(), channels.end());
  }
  return out;
}

}  // namespace tera
