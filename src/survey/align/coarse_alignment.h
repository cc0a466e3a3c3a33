#pragma once

#include <optional>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The move that brings points B near points A, by PCL's GICP: gates are halved from `gate_m` down
/// to `least_gate_m`, each search beginning where the last one ended. Nothing where PCL finds too
/// few partners or does not converge. Points count from near by, since PCL computes in floats.
///
/// Source  Segal, Haehnel, Thrun 2009, "Generalized-ICP".
std::optional<Pose> AlignByGicp(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                                double gate_m, double least_gate_m);

}  // namespace tera
