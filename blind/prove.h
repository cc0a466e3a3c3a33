#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "blind/marking/mark.h"
#include "blind/prove_options.h"

namespace tera::blind {

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
