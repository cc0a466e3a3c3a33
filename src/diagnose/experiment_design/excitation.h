#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// Sets one lever to a value, which it keeps until its next move.
struct LeverMove {
  double t_s = 0;
  std::size_t axis = 0;  ///< joints first, then running gears
  double lever = 0;
};

/// A short sequence of lever moves that excites one axis. The axis ends near its starting position,
/// with all levers in neutral.
struct Excitation {
  std::string what;  ///< name in the description of a run: "steps of 0.25"
  std::vector<LeverMove> moves;
  double length_s = 0;  ///< including the rest at its end
};

/// Range and full rate of an axis, in rad, or in m for a prismatic joint.
struct AxisRange {
  std::size_t axis = 0;
  std::string name;
  double full_rate_radps = 0;
  std::optional<double> lower_rad, upper_rad;  ///< empty for endless rotation

  double Travel_rad() const;
  /// Middle of the range. Returns `otherwise` for an axis without limits.
  double Middle_rad(double otherwise) const;
};

/// Excitations of one axis around the middle of its range: steps and reversals of several sizes,
/// slow ramps through neutral, stairs, sweeps over the range, and waves. Further steps run while
/// one of `others` is away from its middle, which changes the load.
///
/// Model   Rates are proportional to the lever. A move from the middle covers at most 0.45 of the
///         range. Steps last 0.25 to 1.5 s. Excitations that need a wider range are left out.
std::vector<Excitation> ExcitationsFor(const AxisRange& own, const std::vector<AxisRange>& others);

/// The excitation with all moves of the lever of `axis` reversed.
Excitation Mirrored(Excitation excitation, std::size_t axis);

}  // namespace tera
