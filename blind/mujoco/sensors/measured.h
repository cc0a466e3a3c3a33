#pragma once

#include <optional>

#include "blind/cases/case_recording.h"
#include "blind/mujoco/sensors/readings.h"

namespace tera::blind::mujoco {

/// All files of a recording.
struct Measured {
  Table commands, joints;
  std::optional<Table> tracks, poses;
  std::array<Table, kUnits> units;
  std::array<Table, kReceivers> receivers;
};

/// Samples, stamps, disturbs and rounds. `name` is the case's, part of the stream names. Without
/// `has_tracks`, the track table is missing.
Measured Measure(const MachineNumbers& numbers, const Course& course, const SensorsForm& form,
                 double duration_s, bool has_tracks, std::uint64_t seed, const std::string& name);

/// Poses that an owner computes from both receivers' rows and the known ground.
///
/// Model   middle and direction of the antennas, with the ground's attitude there. A machine at
///         rest has one pose: mean position, nominal heading.
Table OwnersPoses(const MachineNumbers& numbers, const Measured& measured, const Start& start,
                  bool stands);

/// Latitude (deg), longitude (deg) and ellipsoidal height (m, WGS 84) of a position in W.
Vec3 Geodetic(const Vec3& east_north_up_m);

}  // namespace tera::blind::mujoco
