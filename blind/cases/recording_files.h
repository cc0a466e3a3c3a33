#pragma once

#include <filesystem>
#include <string>

#include "blind/cases/benchmark_case.h"

namespace tera::blind {

/// Machine of the scenario; the case's own machine differs.
inline constexpr const char* kMachine = "tera:config/machines/tb235.yaml";
inline constexpr const char* kVehicle = "tera:config/machines/warthog.yaml";
inline constexpr const char* kRealDrive =
    "tera:examples/recordings/drive_warthog/asphalt_2024-09-20.csv";

/// Writes `folder`/scenario.yaml, without the hidden effects, and `folder`/recording in the
/// project's format: levers, encoders and, for tracks, poses.
void WriteCase(const BenchmarkCase& benchmark_case, const CaseRecording& recording,
               const std::filesystem::path& folder);

/// Hidden effects as JSON.
std::string TruthJson(const BenchmarkCase& benchmark_case, const CaseRecording& recording);

}  // namespace tera::blind
