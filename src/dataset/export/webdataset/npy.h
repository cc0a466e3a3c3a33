#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// Encodes the points of a scan as a NumPy structured array (.npy). Fields as in
/// docs/reference/dataset.md: x, y, z, intensity (float32), time (uint32), ring, instance (uint16),
/// label (uint8).
///
/// Source  NumPy's "NEP 1: a simple file format for NumPy arrays", version 1.0.
std::string NpyOf(const std::vector<LidarPoint>& points);

}  // namespace tera
