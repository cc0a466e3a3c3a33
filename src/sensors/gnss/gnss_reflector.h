#pragma once

#include <optional>

#include "physics/description/machine.h"

namespace tera {

/// The part of a machine that rises beside an antenna: a boom, a lift arm.
struct GnssReflector {
  int link = 0;
  Vec3 direction_B = Vec3::UnitX();  ///< from its foot to its tip in its link's frame B, length 1
};

/// What rises beside an antenna on `antenna_link`, whatever its name.
///
/// Model   Of the chains of joints that leave the antenna's link or those below it, the one with
///         the most; on it the first part that a joint tilts (its axis nearer to the horizontal
///         than to the vertical in the machine's initial pose). Its foot is that joint, its tip the
///         next joint that moves, or its centre of mass.
/// Omits   all other parts, and how large and how near they are.
std::optional<GnssReflector> GnssReflectorOf(const MachineModel& model, int antenna_link);

}  // namespace tera
