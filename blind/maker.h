#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "blind/cases/benchmark_case.h"

namespace tera::blind {

struct ProveOptions;

/// Whose recordings.
enum class MakerKind {
  kOwn,    ///< equations of joints and tracks by this project: cases/, plant/
  kMujoco  ///< a whole machine with all its sensors by MuJoCo: mujoco/
};

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
