#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"
#include "diagnose/motion/raised_part.h"
#include "physics/description/machine.h"

namespace tera {

inline constexpr std::string_view kMultipath = "multipath";

/// The part that rises next to an antenna on a link (GnssReflectorOf). Empty if the motion of its
/// joints is not estimated.
std::optional<RaisedPart> RaisedPartOf(const MachineModel& model, int antenna_link,
                                       const std::vector<int>& places);

/// Numbers of the mechanism `multipath`.
struct Reflection {
  double horizontal_m = 0, vertical_m = 0, azimuth_rad = 0;
};

/// Largest error by reflection in each coordinate of a receiver. With fixed ambiguities a
/// reflection disturbs the carrier phase, else the code.
///
/// Model   a phase error is at most a quarter of the wavelength: 4.8 cm for L1, 6.1 cm for L2. The
///         ionosphere-free combination has 2.546 x 4.8 + 1.546 x 6.1 = 21.6 cm. Codes: 5 m, an
///         estimate. A reflection shifts a code by up to half a chip, 147 m for C/A, and receivers
///         leave metres of that.
/// Omits   position errors that exceed the range errors under poor satellite geometry; the smaller
///         error of receivers that fix L1 alone.
/// Source  Georgiadou and Kleusberg 1988 (a quarter wavelength); IS-GPS-200, 20.3.3.3.3.3 (the
///         combination, with f1 1575.42 and f2 1227.60 MHz); van Nee 1993, "Spread-spectrum code
///         and carrier synchronization errors caused by multipath and interference".
double LargestReflection_m(GnssFix fix);

Eigen::Vector4d LinearReflection(const Reflection& reflection);
/// Inverse of LinearReflection. The azimuth comes from the two horizontal numbers; the vertical
/// number is their component along that azimuth.
Reflection ReflectionOf(const Eigen::Vector4d& numbers);

}  // namespace tera
