#include "diagnose/confirm/validate_held_out.h"

#include <algorithm>
#include <string>
#include <utility>

#include "diagnose/diagnose_blocks.h"
#include "diagnose/encoder_clocks.h"
#include "diagnose/search/fit/excluded_samples.h"
#include "diagnose/sensors/late_poses.h"

namespace tera {
namespace {

/// Rebuilds the sensors' blocks from poses at their times of measurement instead of arrival.
void ReplaceSensorBlocks(const BlockOptions& options, HeldOutBlocks* held_out) {
  const DiagnosisInput& input = held_out->given.input;
  std::vector<std::string> not_compared;  // ignored: the same as in the first recording
  TakeSensorBlocks(input.machine, &held_out->blocks);
  for (ReplayBlock& block :
       SensorBlocksByArrivals(input, held_out->measured, options, &not_compared)) {
    // Without a block of the base, TakeSensorBlocks does not recognise the sensors' blocks.
    std::erase_if(held_out->blocks,
                  [&](const ReplayBlock& stamped) { return stamped.name == block.name; });
    held_out->blocks.push_back(std::move(block));
  }
}

void MakeBlocks(int threads, std::uint64_t seed, HeldOutBlocks* held_out) {
  const BlockOptions options{.threads = threads};
  const DiagnosisInput& input = held_out->given.input;
  held_out->blocks = BlocksOf(input, held_out->measured, options);
  if (held_out->as_it_is) {
    CorrectDiscrepancies(
        ReplayDiscrepanciesOf(input, held_out->measured, options, *held_out->as_it_is), seed,
        threads, &held_out->blocks);
  }
  ExcludeLaggingSamples(&held_out->blocks);
}

}  // namespace

HeldOutBlocks ReadHeldOut(const HeldOutCase& given, const SimulateMachine& simulate, int threads,
                          std::uint64_t seed) {
  HeldOutBlocks held_out{given, MeasurementsOf(given.input, *given.recording), {}, {}};
  held_out.as_it_is = SimulateAsItIs(given.input, held_out.measured, simulate);
  MakeBlocks(threads, seed, &held_out);
  return held_out;
}

void StampAnew(const SensorDiagnosis& estimate, int threads, std::uint64_t seed,
               HeldOutBlocks* held_out) {
  const bool has_late_poses = StampPosesAnew(estimate, &held_out->measured);
  const bool has_late_encoders =
      StampEncodersAnew(held_out->given.input, estimate, {.threads = threads}, &held_out->measured);
  if (has_late_poses || has_late_encoders) MakeBlocks(threads, seed, held_out);
}

HeldOutRecording ValidateHeldOut(const std::vector<DiagnosedBlock>& diagnosed,
                                 const BlockOptions& options, std::uint64_t seed,
                                 HeldOutBlocks* held_out) {
  if (FindsArrivalStamps(diagnosed)) ReplaceSensorBlocks(options, held_out);
  const std::vector<ReplayBlock>& further = held_out->blocks;
  HeldOutRecording out{held_out->given.recording->directory().string(), {}, {}};
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
