#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A lever that goes somewhere and stays there until its next move.
struct LeverMove {
  double t_s = 0;
  std::size_t axis = 0;  ///< joints first, then gears
  double lever = 0;
};

/// A short course of levers that ends about where it began, all levers in neutral.
struct LeverPiece {
  std::string what;  ///< as a description lists it: "steps of 0.25"
  std::vector<LeverMove> moves;
  double length_s = 0;  ///< with the rest at its end
};

/// How far and how fast an axis can be taken. Radians, or metres where it slides.
struct AxisRoom {
  std::size_t axis = 0;
  std::string name;
  double full_rate_radps = 0;                  ///< at full lever
  std::optional<double> lower_rad, upper_rad;  ///< none where it may turn as far as it likes

  double Travel_rad() const;
  /// The middle of its room; `otherwise` where it has no ends.
  double Middle_rad(double otherwise) const;
};

/// What one axis may be asked to do from the middle of its room, within it: steps and reversals of
/// many sizes, slow ramps through neutral, stairs, sweeps over all of its room, waves, and steps
/// while one of `others` is held elsewhere, so that the load is another.
///
/// Model   rates in proportion to the lever. Steps last 0.25 to 1.5 s, as long as nine twentieths
///         of the room allow; what needs more room than there is is left out.
std::vector<LeverPiece> LeverPiecesFor(const AxisRoom& own, const std::vector<AxisRoom>& others);

/// The same with the own lever the other way.
LeverPiece Mirrored(LeverPiece piece, std::size_t axis);

}  // namespace tera
