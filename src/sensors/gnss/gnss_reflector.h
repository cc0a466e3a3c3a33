#pragma once

#include <optional>

#include "physics/description/machine.h"

namespace tera {

/// A part of a machine that rises near an antenna, for example a boom or a lift arm.
struct GnssReflector {
  int link = 0;
  Vec3 direction_B = Vec3::UnitX();  ///< unit vector from foot to tip, in its link's frame B
};

/// The reflecting part near an antenna on `antenna_link`, found without names.
///
/// Model   The longest chain of movable joints from the antenna's link or a link below it. The
///         reflector is the first part on this chain that a joint tilts. A joint tilts if its axis
///         is closer to horizontal than to vertical in the initial pose. The foot of the reflector
///         is this joint. Its tip is the next movable joint, or else the part's centre of mass.
/// Omits   All other parts; size and distance of the part.
std::optional<GnssReflector> GnssReflectorOf(const MachineModel& model, int antenna_link);

}  // namespace tera
