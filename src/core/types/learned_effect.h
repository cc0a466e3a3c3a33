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

/// A correction to a rate, learned from the residual that no mechanism explains. It is a table over
/// one variable.
///
/// Model   The correction c(x) is piecewise linear between knots. Beyond an end knot, c falls
///         linearly to 0 over the length of the last interval and stays 0, because there are no
///         data. The simulated rate becomes rate + c, or rate (1 + c) if `is_share` is true. `low`
///         and `high` bound the uncertainty of c for reports; the simulation ignores them.
struct LearnedEffect {
  LearnedVariable variable;
  bool is_share = false;
  std::vector<double> at;     ///< knots of the variable: at least two, strictly increasing
  std::vector<double> value;  ///< c at each knot; at least -1 if is_share
  std::vector<double> low, high;

  double At(double x) const;
};

/// Reads the key `learned` of one target: {variable: position/boom, unit: rad, as: share, at: [..],
/// value: [..], low: [..], high: [..]}. The variable must be in `variables`. Absent bounds equal
/// the value. Returns nullopt if the key is absent or `none`. Faults are reported at `target`.
std::optional<LearnedEffect> ReadLearnedEffect(const ConfigMap& target,
                                               std::span<const LearnedVariable> variables);

}  // namespace tera
