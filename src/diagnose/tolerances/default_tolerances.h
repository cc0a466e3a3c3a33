#pragma once

#include <span>
#include <string_view>

namespace tera {

/// What is as expected of one number of a mechanism where an owner says nothing else.
struct DefaultTolerance {
  std::string_view mechanism, parameter;
  double neutral = 0;     ///< the number with which the mechanism has no effect
  double half_width = 0;  ///< 95 % of what is as expected lies so near; in the parameter's unit
  std::string_view target = {};  ///< the only one that it is of; of all where it is empty
};

/// Dry friction of a drive, in shares of its rate at full lever: the tolerance of what it loses.
inline constexpr double kFrictionTolerance = 0.02;

/// All delays from a lever to a stamp together.
inline constexpr double kStampTolerance_s = 0.04;

/// The defaults, by kind of sensor and slot. A number that is not among them is expected nowhere
/// but where the scenario has it.
///
/// Source  Rates, bands, delays, tracks and places: what the owner of a 4 t excavator would call
///         as expected, within which eleven recordings of nothing wrong were drawn. Others are
///         estimates, each beside its number.
std::span<const DefaultTolerance> DefaultTolerances();

/// The default of a number of a mechanism of a target, one that is of this target before one that
/// is of all; null where it is not among them.
const DefaultTolerance* DefaultToleranceOf(std::string_view target, std::string_view mechanism,
                                           std::string_view parameter);

}  // namespace tera
