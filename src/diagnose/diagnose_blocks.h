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

/// The progress of a diagnosis: before a block, and after it with its diagnosis. Blocks may
/// overlap.
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

/// Corrects the blocks that the discrepancies belong to; tells how.
std::vector<DiscrepancyCorrection> CorrectDiscrepancies(
    const std::vector<ReplayDiscrepancy>& discrepancy, std::uint64_t seed, int threads,
    std::vector<ReplayBlock>* blocks);

using Deadline = std::chrono::steady_clock::time_point;

/// Diagnoses blocks, as many at a time as there are threads, until a deadline that may be set.
/// Calls of `progress` do not overlap.
std::vector<DiagnosedBlock> DiagnoseBlocks(std::vector<ReplayBlock> blocks,
                                           const SearchOptions& options, std::uint64_t seed,
                                           const FollowProgress& progress,
                                           const std::optional<Deadline>& deadline = {});

/// Whether some block was found to have poses that are stamped as they arrive.
bool FindsArrivalStamps(const std::vector<DiagnosedBlock>& blocks);

}  // namespace tera
