#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// The ways in which an inertial unit's numbers can differ from docs/reference/dataset.md.
enum class InertialDoubt {
  kZDown,           ///< its axes are forward, right, down, or it hangs upside down
  kOnItsSide,       ///< its x or y is upright
  kRatesInDegrees,  ///< rates that are taken as rad/s are in deg/s
  kRatesInRadians,  ///< rates that are taken as deg/s are in rad/s
  kInG,             ///< an acceleration in g that is taken as m/s2
  kNoGravity        ///< an acceleration from which gravity was taken away
};

struct InertialFinding {
  InertialDoubt doubt = InertialDoubt::kZDown;
  std::string text;  ///< what was found, what it may be, and what to do: without an end
};

/// How far rates turn a unit across the vertical, over how far gravity turns in it; 0 where that
/// turns too little.
struct TurnRatios {
  double seen =
      0;  ///< in spans of turns of 5 deg and more, which accelerations seem to be at times
  double sure = 0;  ///< of 20 deg and more, which no acceleration of a machine seems to be
};
TurnRatios TurnsOverGravity(std::size_t count,
                            const std::function<ImuSample(std::size_t row)>& sample);

/// Judges a unit as a logger wrote it: whether its acceleration is about 1 at all times, as gravity
/// is in g, and where its mount is not known whether its x or y is upright as z should be. Units on
/// arms and buckets are so too.
std::vector<InertialFinding> JudgeLogged(std::size_t count,
                                         const std::function<ImuSample(std::size_t row)>& sample,
                                         bool knows_mount);

/// Judges `count` samples of an inertial unit by themselves, without poses. `up_S` is where up is
/// in the unit where its machine stands level and its link is as documented: z, or as its mount
/// says.
///
/// Model   z down: the median direction of the specific force is within 25 deg of down, and nine
///         tenths are within 60 deg. A unit on an undercarriage, a cab or a boom, which rises by 85
///         deg at most, never comes nearer to down than 95 deg. Arms and buckets pass down as they
///         work, and an arm that is folded to 150 deg from level, as it is parked, stays 30 deg
///         from it.
///         Units of rates: over spans of 2 s the turn by the rates, across the specific force, over
///         the turn of its direction. The median of these ratios is 57, to a factor of 3, where
///         rates are in degrees, of turns of 5 deg and more; and 1 / 57 where they are in radians
///         and taken for degrees, of turns of 20 deg and more, which no acceleration of a machine
///         makes. It is never below 1 of a unit that turns, and shaking makes it 2 or 3. There are
///         eight such spans at least; without them rates are in degrees of which a tenth is faster
///         than any joint.
///         Gravity: none where the median size of the specific force is below a fifth of it. A size
///         about 1 at all times is gravity in g, and nothing else is judged.
/// Omits   turns about the vertical, which gravity does not show.
std::vector<InertialFinding> JudgeInertial(std::size_t count,
                                           const std::function<ImuSample(std::size_t row)>& sample,
                                           const Vec3& up_S = Vec3::UnitZ());

}  // namespace tera
