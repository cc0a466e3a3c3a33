#pragma once

#include <filesystem>
#include <functional>

#include "blind/cases/benchmark_case.h"
#include "blind/prove_options.h"

namespace tera::blind {

/// What is to be marked of a case: what is hidden, and what that changes.
struct MadeCase {
  BenchmarkCase about;
  CaseRecording recording;
};

/// Conceals, drives and measures case `number` (from 0), and writes its scenario and recording into
/// `folder`.
using Maker = std::function<MadeCase(int number, const std::filesystem::path& folder)>;

/// Reads what the maker needs. Throws InputError.
Maker MakerFor(const ProveOptions& options);

}  // namespace tera::blind
