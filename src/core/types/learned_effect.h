#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tera {

class ConfigMap;

/// An independent variable of a learned effect.
struct LearnedVariable {
  enum class Kind { kLever, kLeverWay, kPosition, kLoad, kRate, kTime };

  std::string name;  ///< name in YAML and reports: "lever/arm", "position/boom", "rate", "time"
  std::string unit;
  Kind kind = Kind::kLever;
  std::size_t axis = 0;  ///< index of the lever's axis: joints first, then gears
};

/// A learned residual of a rate that no mechanism explains, tabulated over one variable.
///
/// Model   c(x) is piecewise linear between knots. Beyond the end knots it falls linearly to 0 over
///         the length of the adjacent interval, and stays 0, since no data support it. The rate
///         gains c, or c times itself for a share. The band states the uncertainty and does not
///         affect the simulation; an absent bound equals the value.
struct LearnedEffect {
  LearnedVariable variable;
  bool is_share = false;
  std::vector<double> at;     ///< at least two knots, strictly increasing
  std::vector<double> value;  ///< one per knot; at least -1 for a share
  std::vector<double> low, high;

  double At(double x) const;
};

/// Reads `learned:` of one target, with its variable among `variables`: {variable: position/boom,
/// unit: rad, as: share, at: [..], value: [..], low: [..], high: [..]}. Returns nullopt if the key
/// is absent or `none`. `target` receives the faults.
std::optional<LearnedEffect> ReadLearnedEffect(const ConfigMap& target,
                                               std::span<const LearnedVariable> variables);

}  // namespace tera
