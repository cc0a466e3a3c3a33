#pragma once

#include <filesystem>

#include "blind/cases/benchmark_case.h"
#include "blind/mujoco/cases/effect.h"
#include "blind/mujoco/hand/hand.h"
#include "blind/mujoco/sensors/measured.h"

namespace tera::blind::mujoco {

/// The owner's files of a machine and its rig, and their numbers.
struct OwnersMachine {
  std::filesystem::path machine_yaml, rig_yaml;
  MachineNumbers numbers;
};

/// One concealed case on a whole machine.
struct WholeCase {
  BenchmarkCase about;  ///< number, kind, strength, duration, what is hidden
  std::vector<Effect> effects;
  Forms within;  ///< the same machine with nothing hidden
  Start start;
  Habit habit;
  bool drives = false;     ///< it has tracks' encoders; else it stands
  bool has_poses = false;  ///< the owner's

  /// The machine with all effects, or with all but one of them.
  Forms With(std::size_t without = SIZE_MAX) const;
};

/// On which of several machines case `number` is.
std::size_t MachineOfCase(std::uint64_t seed, int number, std::size_t machines);

/// Case `number` (from 0). Kinds come in the shares of DrawCase without a real drive; a case lasts
/// 60 to 120 s, or `duration_s` where that is given. Forms and manoeuvres are by lot all that are
/// not kept for the end, with `reserve` those that are.
WholeCase DrawWholeCase(std::uint64_t seed, int number, const MachineNumbers& numbers, bool reserve,
                        std::optional<double> duration_s);

/// A case as driven and measured.
struct WholeRecording {
  Measured measured;
  CaseRecording marks;  ///< what marking asks: changes, noise
};

/// Drives and measures. What tracks do gets its numbers by the drive.
WholeRecording RecordWholeCase(WholeCase* whole_case, const MachineNumbers& numbers,
                               std::uint64_t seed);

/// Writes `folder`/{scenario.yaml, the owner's files, recording/} and, where it is not level,
/// ground.tif.
void WriteWholeCase(const WholeCase& whole_case, const OwnersMachine& machine,
                    const Measured& measured, const std::filesystem::path& folder);

}  // namespace tera::blind::mujoco
