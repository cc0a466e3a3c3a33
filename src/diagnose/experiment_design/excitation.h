#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A move of one lever to a value that it keeps until its next move.
struct LeverMove {
  double t_s = 0;
  std::size_t axis = 0;  ///< joints first, then gears
  double lever = 0;
};

/// A short course of levers that excites one axis. It ends about where it began, with all levers in
/// neutral.
struct Excitation {
  std::string what;  ///< as a description lists it: "steps of 0.25"
  std::vector<LeverMove> moves;
  double length_s = 0;  ///< with the rest at its end
};

/// The range and the full rate of an axis, in radians, or in metres where it slides.
struct AxisRange {
  std::size_t axis = 0;
  std::string name;
  double full_rate_radps = 0;                  ///< at full lever
  std::optional<double> lower_rad, upper_rad;  ///< none where it may turn without end

  double Travel_rad() const;
  /// The middle of the range; `otherwise` where it has no ends.
  double Middle_rad(double otherwise) const;
};

/// Excitations of one axis from the middle of its range, within it: steps and reversals of many
/// sizes, slow ramps through neutral, stairs, sweeps over the whole range, waves, and steps while
/// one of `others` is held elsewhere, so that the load is another.
///
/// Model   rates in proportion to the lever. Steps last as long as nine twentieths of the range
///         allow, from 0.25 to 1.5 s; what needs a wider range is left out.
std::vector<Excitation> ExcitationsFor(const AxisRange& own, const std::vector<AxisRange>& others);

/// The excitation with the lever of `axis` the other way.
Excitation Mirrored(Excitation excitation, std::size_t axis);

}  // namespace tera
