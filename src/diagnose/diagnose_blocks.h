#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/diagnosed_block.h"
#include "diagnose/discrepancy/discrepancy_correction.h"

namespace tera {

/// Progress of a diagnosis, reported before each block, and after each block with its diagnosis.
/// Several blocks may be in progress at once.
struct BlockProgress {
  std::string machine;
  std::string block;
  std::size_t number = 1, count = 1;
  const BlockDiagnosis* done = nullptr;
};
using FollowProgress = std::function<void(const BlockProgress&)>;

/// Random stream for the diagnosis of a block.
Stream StreamOf(const ReplayBlock& block, std::uint64_t seed);

/// Options with p-values corrected for the tests of all `blocks` together.
SearchOptions WithTotalsOf(SearchOptions options, const std::vector<ReplayBlock>& blocks);

/// Corrects the replays of the blocks for their discrepancies. Returns the corrections.
std::vector<DiscrepancyCorrection> CorrectDiscrepancies(
    const std::vector<ReplayDiscrepancy>& discrepancy, std::uint64_t seed, int threads,
    std::vector<ReplayBlock>* blocks);

using Deadline = std::chrono::steady_clock::time_point;

/// Diagnoses blocks in parallel until an optional deadline. Calls of `progress` do not overlap.
std::vector<DiagnosedBlock> DiagnoseBlocks(std::vector<ReplayBlock> blocks,
                                           const SearchOptions& options, std::uint64_t seed,
                                           const FollowProgress& progress,
                                           const std::optional<Deadline>& deadline = {});

/// True if some block found that its poses have arrival stamps.
bool FindsArrivalStamps(const std::vector<DiagnosedBlock>& blocks);

}  // namespace tera
