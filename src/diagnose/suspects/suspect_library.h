#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

namespace tera {

/// Where a number of a mechanism is looked for; held where both ends are the same.
struct NumberRange {
  std::size_t index = 0;  ///< among the mechanism's parameters
  double lower = 0, upper = 0;
};

/// Which mechanisms a user suspects: limits or extends what the blocks suspect by themselves.
struct SuspectLibrary {
  std::string file;
  std::vector<std::string> only;     ///< nothing else, where there are any
  std::vector<std::string> without;  ///< not these
  /// Mechanisms with ranges of their own. One that a block does not suspect by itself becomes a
  /// suspect wherever it can act.
  std::vector<std::pair<const Mechanism*, std::vector<NumberRange>>> ranges;
};

/// Reads strict YAML:
///
///     only: [dead_band, backlash]
///     without: [valve_curve]
///     suspects:
///       dead_band: {width: [0.02, 0.3], asymmetry: 0}
///
/// Throws InputError with every fault: an identifier or number that is none, a range that is
/// empty or beyond the mechanism's own.
SuspectLibrary ReadSuspectLibrary(const std::filesystem::path& file);

/// Gives blocks the suspects of a library. What a suspect begins its search with is brought within
/// the ranges. Throws InputError where a mechanism that a block does not suspect by itself lacks a
/// range for a number that has no default.
void ApplyLibrary(const SuspectLibrary& library, const MachineModel& model,
                  std::vector<ReplayBlock>* blocks);

/// Throws InputError where a library left none of the blocks a suspect.
void RequireSuspects(const SuspectLibrary& library, const std::vector<ReplayBlock>& blocks);

}  // namespace tera
