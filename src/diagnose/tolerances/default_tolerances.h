#pragma once

#include <span>
#include <string_view>

namespace tera {

/// Expected deviation of a parameter of a mechanism where the owner states none.
struct DefaultTolerance {
  std::string_view mechanism, parameter;
  double neutral = 0;            ///< value without effect
  double half_width = 0;         ///< 95 % bound of the expected deviation, in the parameter's unit
  std::string_view target = {};  ///< the only target to which it applies; empty: all
};

/// Tolerance of the rate lost to dry friction of a drive, as a share of the rate at full lever.
inline constexpr double kFrictionTolerance = 0.02;

/// Tolerance of the sum of all delays between a lever and a stamp.
inline constexpr double kStampTolerance_s = 0.04;

/// All defaults. A parameter without an entry has no tolerance: it is expected at the scenario's
/// value.
///
/// Source  Rates, bands, delays, tracks and mounts: deviations that the owner of a 4 t excavator
///         expects. Eleven faultless recordings were drawn within them. The others are estimates,
///         each explained at its value.
std::span<const DefaultTolerance> DefaultTolerances();

/// The default of a parameter of a mechanism on a target. An entry for this target precedes one for
/// all targets. Null without an entry.
const DefaultTolerance* DefaultToleranceOf(std::string_view target, std::string_view mechanism,
                                           std::string_view parameter);

}  // namespace tera
