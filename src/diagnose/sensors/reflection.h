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

/// What rises beside an antenna on a link, by GnssReflectorOf; none where its joints are not among
/// those of which the motion is estimated.
std::optional<RaisedPart> RaisedPartOf(const MachineModel& model, int antenna_link,
                                       const std::vector<int>& places);

/// A reflection as `multipath` has it.
struct Reflection {
  double horizontal_m = 0, vertical_m = 0, azimuth_rad = 0;
};

/// How far a reflection can put a receiver off, in each of its numbers: with ambiguities fixed it
/// moves the phase of a carrier, else codes.
///
/// Model   phases are off by a quarter of their wavelength at most: 4.8 cm of L1, 6.1 cm of L2, and
///         2.546 x 4.8 + 1.546 x 6.1 = 21.6 cm of the combination of both that is free of the
///         ionosphere. Codes: 5 m, an estimate; a reflection puts a code off by up to half a chip,
///         147 m of C/A, of which receivers leave metres.
/// Omits   that a place is off by more than its ranges where satellites stand badly, and that a
///         receiver which fixes L1 alone is off by less.
/// Source  Georgiadou and Kleusberg 1988 (a quarter wavelength); IS-GPS-200, 20.3.3.3.3.3 (the
///         combination, with f1 1575.42 and f2 1227.60 MHz); van Nee 1993, "Spread-spectrum code
///         and carrier synchronization errors caused by multipath and interference".
double LargestReflection_m(GnssFix fix);

Eigen::Vector4d LinearReflection(const Reflection& reflection);
/// The reflection with the azimuth of its horizontal numbers, and what it has of the vertical ones.
Reflection ReflectionOf(const Eigen::Vector4d& numbers);

}  // namespace tera
