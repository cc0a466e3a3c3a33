#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Figures of docs/reference/soil.md, each computed in about a second. scripts/soil_sensitivity.py
/// measures their dependence on the soil's constants.

namespace tera::bench {

struct Figure {
  std::string name;  ///< with its unit
  double value = 0;
};
using Figures = std::vector<Figure>;

/// Blade, plate and bucket on prescribed paths.
Figures ToolFigures(std::uint64_t seed);
/// Piles, a column that collapses, a bank that fails.
Figures FlowFigures(std::uint64_t seed);
/// A block on tracks, a wheel, structure on the ground.
Figures TrackFigures();
/// The compact excavator digs three times in one place (config/scenarios/trench.yaml).
Figures DigFigures(std::uint64_t seed);

}  // namespace tera::bench
