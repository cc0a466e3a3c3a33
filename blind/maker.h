#pragma once

#include <filesystem>
#include <functional>

#include "blind/cases/benchmark_case.h"
#include "blind/prove_options.h"

namespace tera::blind {

/// A case for the marking: hidden effects, and the changes they cause.
struct MadeCase {
  BenchmarkCase about;
  CaseRecording recording;
};

/// Conceals, drives and measures case `number` (from 0). Writes its scenario and recording into
/// `folder`.
using Maker = std::function<MadeCase(int number, const std::filesystem::path& folder)>;

/// Reads what the maker needs. Throws InputError.
Maker MakerFor(const ProveOptions& options);

}  // namespace tera::blind
