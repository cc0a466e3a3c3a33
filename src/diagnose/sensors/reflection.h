#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

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

Eigen::Vector4d LinearReflection(const Reflection& reflection);
/// The reflection with the azimuth of its horizontal numbers, and what it has of the vertical ones.
Reflection ReflectionOf(const Eigen::Vector4d& numbers);

}  // namespace tera
