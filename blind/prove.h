#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "blind/maker.h"
#include "blind/marking/mark.h"

namespace tera::blind {

struct ProveOptions {
  int cases = 50;
  int first = 1;  ///< number of the first case, to run a part of a benchmark again
  std::uint64_t seed = 1;
  MakerKind maker = MakerKind::kOwn;
  bool reserve = false;                ///< what the second maker keeps for the end
  std::optional<double> duration_s;    ///< of each recording; none: the maker's own
  std::filesystem::path machine_yaml;  ///< that the scenarios take
  std::filesystem::path rig_yaml;      ///< and the rig, of the second maker
  std::filesystem::path real_csv;      ///< a RealDrive (injected_case.h); empty: none
  std::filesystem::path out;           ///< must not exist
};

/// The tool under test: diagnoses `recording` by `scenario` and writes its report into `out`, as
/// the command `tera diagnose` does. All it is told is in these files.
using Tool =
    std::function<void(const std::filesystem::path& scenario,
                       const std::filesystem::path& recording, const std::filesystem::path& out)>;

/// The tool, and one that writes what simpler methods answer into baselines.json of the same
/// folder; empty: none.
struct Tools {
  Tool diagnose, baselines;
};

/// Conceals effects, has them diagnosed, opens the truth, marks the answers.
///
/// Writes into `out`, for each case, case_0001/{scenario.yaml, recording/, report/, seal.txt,
/// truth.json}; after each case anew table.md, table.json and cases.md of all so far. `progress` is
/// told each case's mark.
std::vector<Mark> Prove(const ProveOptions& options, const Tools& tools,
                        const std::function<void(const Mark&)>& progress);

}  // namespace tera::blind
