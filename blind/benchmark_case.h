#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "blind/concealed.h"
#include "blind/joints_case.h"
#include "blind/tracks_case.h"

namespace tera::blind {

enum class CaseKind { kNothing, kOne, kTwo, kOutside, kConfounded, kUntestable };
std::string_view NameOf(CaseKind kind);

/// The machine's numbers as the scenario has them.
struct PlainMachine {
  Excavator excavator;
  PlainTracks tracks;
  /// Throws InputError.
  static PlainMachine Read(const std::filesystem::path& machine_yaml) {
    return {Excavator::Read(machine_yaml), PlainTracks::Read(machine_yaml)};
  }
};

/// One concealed case: what is hidden in the joints, or in the tracks.
struct BenchmarkCase {
  int number = 0;
  CaseKind kind = CaseKind::kNothing;
  Strength strength = Strength::kMedium;
  double duration_s = 45;
  std::vector<Concealed> hidden;
  std::optional<JointsCase> joints;
  std::optional<TracksCase> tracks;
};

/// Case `number` (from 0) of a benchmark.
///
/// Model   kinds as 40 % nothing wrong, 26 one effect, 12 two, 8 outside the library, 6 confounded,
///         4 untestable, each spread evenly over the numbers; the 4 % injected into a real
///         recording are shared out among them. Of the first three kinds a quarter is of tracks.
///         The real machine's numbers are off by up to 3 %.
BenchmarkCase DrawCase(std::uint64_t seed, int number, const PlainMachine& nominal,
                       double duration_s);

/// Drives and measures it. What is hidden in tracks gets its numbers by the drive.
CaseRecording Record(BenchmarkCase* benchmark_case, std::uint64_t seed);

}  // namespace tera::blind
