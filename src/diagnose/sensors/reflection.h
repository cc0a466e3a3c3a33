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

/// The part that rises beside an antenna on a link, by GnssReflectorOf; none where its joints are
/// not among those with an estimated motion.
std::optional<RaisedPart> RaisedPartOf(const MachineModel& model, int antenna_link,
                                       const std::vector<int>& places);

/// A reflection as `multipath` has it.
struct Reflection {
  double horizontal_m = 0, vertical_m = 0, azimuth_rad = 0;
};

/// Largest error of a receiver by reflection, in each of its numbers. With fixed ambiguities a
/// reflection moves the phase of a carrier, else codes.
///
/// Model   phase errors are at most a quarter of the wavelength: 4.8 cm of L1, 6.1 cm of L2. The
///         ionosphere-free combination of both has 2.546 x 4.8 + 1.546 x 6.1 = 21.6 cm. Codes: 5 m,
///         an estimate. A reflection moves a code by up to half a chip, 147 m of C/A, and receivers
///         leave metres of that.
/// Omits   errors of a place beyond its ranges' under poor satellite geometry; the smaller error of
///         a receiver which fixes L1 alone.
/// Source  Georgiadou and Kleusberg 1988 (a quarter wavelength); IS-GPS-200, 20.3.3.3.3.3 (the
///         combination, with f1 1575.42 and f2 1227.60 MHz); van Nee 1993, "Spread-spectrum code
///         and carrier synchronization errors caused by multipath and interference".
double LargestReflection_m(GnssFix fix);

Eigen::Vector4d LinearReflection(const Reflection& reflection);
/// The reflection with the azimuth of its horizontal numbers, and its part of the vertical ones.
Reflection ReflectionOf(const Eigen::Vector4d& numbers);

}  // namespace tera
