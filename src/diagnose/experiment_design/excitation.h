#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A move of one lever to a value that it holds until its next move.
struct LeverMove {
  double t_s = 0;
  std::size_t axis = 0;  ///< joints first, then gears
  double lever = 0;
};

/// A short sequence of lever moves that excites one axis. It ends near its starting position, with
/// all levers in neutral.
struct Excitation {
  std::string what;  ///< its text in a description: "steps of 0.25"
  std::vector<LeverMove> moves;
  double length_s = 0;  ///< with the rest at its end
};

/// Range and full rate of an axis, in radians, or in metres for a prismatic joint.
struct AxisRange {
  std::size_t axis = 0;
  std::string name;
  double full_rate_radps = 0;                  ///< at full lever
  std::optional<double> lower_rad, upper_rad;  ///< none for endless rotation

  double Travel_rad() const;
  /// The middle of the range; `otherwise` without ends.
  double Middle_rad(double otherwise) const;
};

/// Excitations of one axis from the middle of its range and within it. They are steps and reversals
/// of many sizes, slow ramps through neutral, stairs, sweeps over the whole range, and waves.
/// Further steps are driven with one of `others` held elsewhere, for another load.
///
/// Model   rates in proportion to the lever. Steps take up to nine twentieths of the range, from
///         0.25 to 1.5 s. Excitations that need a wider range are left out.
std::vector<Excitation> ExcitationsFor(const AxisRange& own, const std::vector<AxisRange>& others);

/// The excitation with the lever of `axis` reversed.
Excitation Mirrored(Excitation excitation, std::size_t axis);

}  // namespace tera
