#pragma once

#include <optional>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The pose that brings points B near points A, by PCL's GICP. Gates halve from `gate_m` down to
/// `least_gate_m`; each search starts from the last pose. Returns nothing if PCL finds too few
/// partners or does not converge. Coordinates should be small, since PCL computes in floats.
///
/// Source  Segal, Haehnel, Thrun 2009, "Generalized-ICP".
std::optional<Pose> AlignByGicp(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                                double gate_m, double least_gate_m);

}  // namespace tera
