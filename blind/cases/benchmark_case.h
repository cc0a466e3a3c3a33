#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "blind/cases/injected_case.h"
#include "blind/cases/joints_case.h"
#include "blind/cases/tracks_case.h"
#include "blind/plant/concealed.h"

namespace tera::blind {

enum class CaseKind { kNothing, kOne, kTwo, kOutside, kConfounded, kUntestable, kInjected };
std::string_view NameOf(CaseKind kind);
/// Whether cases of this kind are drawn by strength.
inline bool HasStrength(CaseKind kind) {
  return kind == CaseKind::kOne || kind == CaseKind::kTwo || kind == CaseKind::kInjected;
}

/// The machine's nominal numbers, from the scenario.
struct PlainMachine {
  Excavator excavator;
  PlainTracks tracks;
  std::optional<RealDrive> real;  ///< drive for injected cases; none: no such cases
  /// Throws InputError.
  static PlainMachine Read(const std::filesystem::path& machine_yaml) {
    return {Excavator::Read(machine_yaml), PlainTracks::Read(machine_yaml), {}};
  }
};

/// One concealed case: an effect in the joints, in the tracks, or in a real drive.
struct BenchmarkCase {
  int number = 0;
  CaseKind kind = CaseKind::kNothing;
  Strength strength = Strength::kMedium;
  double duration_s = 45;
  std::vector<Concealed> hidden;
  std::optional<JointsCase> joints;
  std::optional<TracksCase> tracks;
  std::optional<InjectedCase> injected;
};

/// Kind of case `number` (from 0). Kinds are spread evenly over the numbers, in the shares of
/// DrawCase.
CaseKind KindOfCase(std::uint64_t seed, int number, bool has_real);

/// Case `number` (from 0) of a benchmark.
///
/// Model   shares of the kinds: 40 % without fault, 26 one effect, 12 two, 8 outside the library, 6
///         confounded, 4 untestable, 4 injected into a real recording. Each kind is spread evenly
///         over the numbers. Without a real drive, the other kinds share the last 4 %. Tracks are a
///         quarter of the first three kinds. The simulated machine's numbers are off by up to 3 %.
BenchmarkCase DrawCase(std::uint64_t seed, int number, const PlainMachine& nominal,
                       double duration_s);

/// Drives and measures the case. The drive sets the parameters of effects hidden in tracks.
CaseRecording Record(BenchmarkCase* benchmark_case, std::uint64_t seed);

}  // namespace tera::blind
