#pragma once

#include <optional>

#include "physics/description/machine.h"

namespace tera {

/// A part of a machine that rises near an antenna: a boom, a lift arm.
struct GnssReflector {
  int link = 0;
  Vec3 direction_B = Vec3::UnitX();  ///< unit vector from foot to tip, in its link's frame B
};

/// The reflecting part near an antenna on `antenna_link`, independent of names.
///
/// Model   the longest joint chain from the antenna's link or a link below it. The reflector is the
///         first part on this chain that a joint tilts. A tilting joint's axis is closer to
///         horizontal than to vertical in the machine's initial pose. The foot is this joint; the
///         tip is the next movable joint, or the part's centre of mass.
/// Omits   all other parts; size and distance of the part.
std::optional<GnssReflector> GnssReflectorOf(const MachineModel& model, int antenna_link);

}  // namespace tera
