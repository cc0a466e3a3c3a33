#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tera {

class ConfigMap;

/// A quantity that a learned effect may be a function of.
struct LearnedVariable {
  enum class Kind { kLever, kLeverWay, kPosition, kLoad, kRate, kTime };

  std::string name;  ///< as in YAML and reports: "lever/arm", "position/boom", "rate", "time"
  std::string unit;
  Kind kind = Kind::kLever;
  std::size_t axis = 0;  ///< whose lever it is, joints first, then gears
};

/// Physics without a name: what no mechanism explains of a rate, as a table over one variable.
///
/// Model   c(x), straight between knots; beyond the first and the last knot it goes straight to 0
///         over the interval next to it, and is 0 from there on, where nothing was seen. It is
///         added to the rate, in its unit, or is a share of it. The band is how well it is known;
///         nothing is simulated by it, and one that was not told is the value.
struct LearnedEffect {
  LearnedVariable variable;
  bool is_share = false;
  std::vector<double> at;     ///< two knots at least, strictly increasing
  std::vector<double> value;  ///< at the knots, not below -1 where it is a share
  std::vector<double> low, high;

  double At(double x) const;
};

/// Reads `learned:` of one target, a function of one of `variables`: {variable: position/boom,
/// unit: rad, as: share, at: [..], value: [..], low: [..], high: [..]}. Nothing where it is absent,
/// or `none` takes it away. Faults go to `target`.
std::optional<LearnedEffect> ReadLearnedEffect(const ConfigMap& target,
                                               std::span<const LearnedVariable> variables);

}  // namespace tera
