#include "diagnose/diagnose_blocks.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/in_parallel.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/tolerances/within_tolerance.h"

namespace tera {
namespace {

/// Thrown at the deadline to end a search.
struct OutOfTime {};

/// Diagnoses a block until a deadline. Every prediction checks the deadline, because all parts of a
/// search make predictions often.
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

}  // namespace

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
    MoveExpected(&one.diagnosis);
    tell({"", one.block.name, b + 1, blocks.size(), &one.diagnosis});
    return one;
  });
}

}  // namespace tera
