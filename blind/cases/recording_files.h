#pragma once

#include <filesystem>
#include <string>

#include "blind/cases/benchmark_case.h"

namespace tera::blind {

/// The machine that the scenario takes; the case's own is another.
inline constexpr const char* kMachine = "tera:config/machines/tb235.yaml";
inline constexpr const char* kVehicle = "tera:config/machines/warthog.yaml";
inline constexpr const char* kRealDrive =
    "tera:examples/recordings/drive_warthog/asphalt_2024-09-20.csv";

/// Writes `folder`/scenario.yaml, which knows of nothing that is hidden, and `folder`/recording, in
/// the project's format: levers, encoders and, of tracks, poses.
void WriteCase(const BenchmarkCase& benchmark_case, const CaseRecording& recording,
               const std::filesystem::path& folder);

/// What is hidden, as JSON.
std::string TruthJson(const BenchmarkCase& benchmark_case, const CaseRecording& recording);

}  // namespace tera::blind
