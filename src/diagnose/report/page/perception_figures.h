#pragma once

#include <string>

#include "diagnose/diagnosis.h"

// Findings of lidars and depth cameras, as a part of the report.

namespace tera {

/// A section for each sensor that was judged: its numbers, and the map of the ground where any of
/// it differs.
std::string PerceptionSections(const Diagnosis& diagnosis);

/// The squares of a map as CSV: x_m, y_m of their middles, above_m, sigma_m, region (-1: none),
/// seen.
std::string GroundCsv(const GroundMap& map);

}  // namespace tera
