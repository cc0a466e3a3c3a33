#pragma once

#include <string>

#include "diagnose/diagnosis.h"

// Findings of lidars and depth cameras, as a part of the report.

namespace tera {

/// A section for each judged sensor: its parameters, and its map of the ground where it differs
/// from the simulation.
std::string PerceptionSections(const Diagnosis& diagnosis);

/// The cells of a map as CSV: x_m, y_m of their centres, above_m, sigma_m, region (-1: none), seen.
std::string GroundCsv(const GroundMap& map);

}  // namespace tera
