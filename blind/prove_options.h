#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace tera::blind {

/// Source of the recordings.
enum class MakerKind {
  kOwn,    ///< equations of joints and tracks by this project: cases/, plant/
  kMujoco  ///< a whole machine with all its sensors by MuJoCo: mujoco/
};

/// The owner's files of a machine.
struct OwnersFiles {
  std::filesystem::path machine_yaml, rig_yaml;
};

/// Options of a proof.
struct ProveOptions {
  int cases = 50;
  int first = 1;  ///< number of the first case, to run a part of a benchmark again
  std::uint64_t seed = 1;
  MakerKind maker = MakerKind::kOwn;
  bool reserve = false;                ///< uses the second maker's reserved forms
  std::optional<double> duration_s;    ///< of each recording; none: the maker's own
  std::filesystem::path machine_yaml;  ///< machine of the first maker's scenarios
  std::filesystem::path real_csv;      ///< a RealDrive (injected_case.h); empty: none
  std::vector<OwnersFiles> machines;   ///< of the second maker; each case draws one
  std::filesystem::path out;           ///< must not exist
};

}  // namespace tera::blind
