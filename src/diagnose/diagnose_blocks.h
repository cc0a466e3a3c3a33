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

/// Reports a diagnosis's progress: before each block, and after it with its diagnosis. Blocks may
/// overlap in time.
struct BlockProgress {
  std::string machine;
  std::string block;
  std::size_t number = 1, count = 1;
  const BlockDiagnosis* done = nullptr;
};
using FollowProgress = std::function<void(const BlockProgress&)>;

/// The random stream of a block's diagnosis.
Stream StreamOf(const ReplayBlock& block, std::uint64_t seed);

/// Search options that correct p-values for the tests of all these blocks together.
SearchOptions WithTotalsOf(SearchOptions options, const std::vector<ReplayBlock>& blocks);

/// Corrects the blocks that the discrepancies belong to, and returns the corrections.
std::vector<DiscrepancyCorrection> CorrectDiscrepancies(
    const std::vector<ReplayDiscrepancy>& discrepancy, std::uint64_t seed, int threads,
    std::vector<ReplayBlock>* blocks);

using Deadline = std::chrono::steady_clock::time_point;

/// Diagnoses blocks, in as many threads as given, until an optional deadline. Calls of `progress`
/// do not overlap.
std::vector<DiagnosedBlock> DiagnoseBlocks(std::vector<ReplayBlock> blocks,
                                           const SearchOptions& options, std::uint64_t seed,
                                           const FollowProgress& progress,
                                           const std::optional<Deadline>& deadline = {});

/// Whether some block's poses were found to carry arrival stamps.
bool FindsArrivalStamps(const std::vector<DiagnosedBlock>& blocks);

}  // namespace tera
