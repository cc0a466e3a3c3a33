#pragma once

#include <filesystem>

#include "blind/cases/benchmark_case.h"
#include "blind/mujoco/cases/effect.h"
#include "blind/mujoco/hand/hand.h"
#include "blind/mujoco/sensors/measured.h"

namespace tera::blind::mujoco {

/// The owner's files of a machine and its rig, with their numbers.
struct OwnersMachine {
  std::filesystem::path machine_yaml, rig_yaml;
  MachineNumbers numbers;
};

/// One concealed case on a whole machine.
struct WholeCase {
  BenchmarkCase about;  ///< number, kind, strength, duration, hidden effects
  std::vector<Effect> effects;
  Forms within;  ///< the same machine without hidden effects
  Start start;
  Habit habit;
  bool drives = false;     ///< with track encoders; otherwise it stands
  bool has_poses = false;  ///< the owner's

  /// The machine with all effects, or with all but one of them.
  Forms With(std::size_t without = SIZE_MAX) const;
};

/// Index of case `number`'s machine among several.
std::size_t MachineOfCase(std::uint64_t seed, int number, std::size_t machines);

/// Case `number` (from 0). The shares of kinds are those of DrawCase without a real drive. A case
/// lasts 60 to 120 s, or `duration_s` if given. Forms and manoeuvres are drawn from those in
/// regular use, or with `reserve` from the reserved ones.
WholeCase DrawWholeCase(std::uint64_t seed, int number, const MachineNumbers& numbers, bool reserve,
                        std::optional<double> duration_s);

/// A driven and measured case.
struct WholeRecording {
  Measured measured;
  CaseRecording marks;  ///< input of the marking: changes and noise
};

/// Drives and measures the case. The drive sets the parameters of effects in tracks.
WholeRecording RecordWholeCase(WholeCase* whole_case, const MachineNumbers& numbers,
                               std::uint64_t seed);

/// Writes `folder`/{scenario.yaml, the owner's files, recording/}, and ground.tif unless the ground
/// is level.
void WriteWholeCase(const WholeCase& whole_case, const OwnersMachine& machine,
                    const Measured& measured, const std::filesystem::path& folder);

}  // namespace tera::blind::mujoco
