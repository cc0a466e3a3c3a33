#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace tera::blind {

/// Whose recordings.
enum class MakerKind {
  kOwn,    ///< equations of joints and tracks by this project: cases/, plant/
  kMujoco  ///< a whole machine with all its sensors by MuJoCo: mujoco/
};

/// A machine as its owner has it.
struct OwnersFiles {
  std::filesystem::path machine_yaml, rig_yaml;
};

/// What is to be proven on.
struct ProveOptions {
  int cases = 50;
  int first = 1;  ///< number of the first case, to run a part of a benchmark again
  std::uint64_t seed = 1;
  MakerKind maker = MakerKind::kOwn;
  bool reserve = false;                ///< what the second maker keeps for the end
  std::optional<double> duration_s;    ///< of each recording; none: the maker's own
  std::filesystem::path machine_yaml;  ///< that the first maker's scenarios take
  std::filesystem::path real_csv;      ///< a RealDrive (injected_case.h); empty: none
  std::vector<OwnersFiles> machines;   ///< of the second maker, among which a case takes one by lot
  std::filesystem::path out;           ///< must not exist
};

}  // namespace tera::blind
