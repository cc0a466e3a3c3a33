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

/// Samples, stamps, disturbs and rounds. `name` is the case's, for its streams. Without tracks
/// where `has_tracks` is false.
Measured Measure(const MachineNumbers& numbers, const Course& course, const SensorsForm& form,
                 double duration_s, bool has_tracks, std::uint64_t seed, const std::string& name);

/// Poses that an owner makes of both receivers' rows and of the ground that he knows.
///
/// Model   middle and direction of the antennas, attitude as the ground is there. A machine that
///         stands has one pose: the mean place, the nominal heading.
Table OwnersPoses(const MachineNumbers& numbers, const Measured& measured, const Start& start,
                  bool stands);

/// Degrees north, degrees east and metres above the ellipsoid (WGS 84) of a place in W.
Vec3 Geodetic(const Vec3& east_north_up_m);

}  // namespace tera::blind::mujoco
