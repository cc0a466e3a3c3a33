#pragma once

#include <optional>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Pose of B in A that aligns B's points with A's, by PCL's GICP. Runs several searches, each from
/// the result of the last. The largest partner distance is halved from `gate_m` to `least_gate_m`.
/// Returns nullopt if PCL finds too few partners or does not converge. Coordinates should be small,
/// because PCL computes in single precision.
///
/// Source  Segal, Haehnel, Thrun 2009, "Generalized-ICP".
std::optional<Pose> AlignByGicp(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                                double gate_m, double least_gate_m);

}  // namespace tera
