#pragma once

#include <span>
#include <string_view>

namespace tera {

/// Expected deviation of one parameter of a mechanism, unless the owner states another.
struct DefaultTolerance {
  std::string_view mechanism, parameter;
  double neutral = 0;            ///< value at which the mechanism has no effect
  double half_width = 0;         ///< 95 % bound of the expected deviation, in the parameter's unit
  std::string_view target = {};  ///< the only target that it applies to; empty: all
};

/// Dry friction of a drive, as a share of its rate at full lever: the tolerance of the loss.
inline constexpr double kFrictionTolerance = 0.02;

/// All delays from a lever to a stamp together.
inline constexpr double kStampTolerance_s = 0.04;

/// The defaults, by kind of sensor and slot. A parameter without an entry is expected only at the
/// scenario's value.
///
/// Source  Rates, bands, delays, tracks and mounts: deviations that the owner of a 4 t excavator
///         would expect, and within which eleven faultless recordings were drawn. The others are
///         estimates, each explained at its value.
std::span<const DefaultTolerance> DefaultTolerances();

/// The default of a parameter of a mechanism on a target. An entry for this target takes precedence
/// over one for all; null without either.
const DefaultTolerance* DefaultToleranceOf(std::string_view target, std::string_view mechanism,
                                           std::string_view parameter);

}  // namespace tera
