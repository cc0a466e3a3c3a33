#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// Possible deviations of an inertial unit from docs/reference/dataset.md.
enum class InertialDoubt {
  kZDown,           ///< axes forward, right, down, or upside down
  kOnItsSide,       ///< x or y is vertical
  kRatesInDegrees,  ///< deg/s taken for rad/s
  kRatesInRadians,  ///< rad/s taken for deg/s
  kInG,             ///< acceleration in g taken for m/s2
  kNoGravity        ///< acceleration without gravity
};

struct InertialFinding {
  InertialDoubt doubt = InertialDoubt::kZDown;
  std::string text;  ///< finding, possible cause and remedy, without a full stop
};

/// Turn of a unit across the vertical by its rates, over the turn of gravity in the unit; 0 if
/// gravity turns too little.
struct TurnRatios {
  double seen = 0;  ///< over turns of 5 deg and more, which accelerations can mimic
  double sure = 0;  ///< over turns of 20 deg and more, which no machine's acceleration mimics
};
TurnRatios TurnsOverGravity(std::size_t count,
                            const std::function<ImuSample(std::size_t row)>& sample);

/// Judges a unit with a logger's raw numbers. Tests whether its acceleration is always about 1, as
/// gravity in g, and, for an unknown mount, whether x or y is vertical instead of z. Units on arms
/// and buckets can be so too.
std::vector<InertialFinding> JudgeLogged(std::size_t count,
                                         const std::function<ImuSample(std::size_t row)>& sample,
                                         bool knows_mount);

/// Judges `count` samples of an inertial unit without poses. `up_S` is the upward direction in the
/// unit on a level machine with its link in the documented pose: z, or by its mount.
///
/// Model   z down: the median direction of the specific force is within 25 deg of down, and nine
///         tenths are within 60 deg. A unit on an undercarriage, a cab or a boom, which rises by 85
///         deg at most, stays at least 95 deg from down. Arms and buckets pass down during work. A
///         parked arm, folded to 150 deg from level, stays 30 deg from it.
///         Units of rates: over spans of 2 s, the ratio of the turn by the rates, across the
///         specific force, to the turn of its direction. The median ratio is 57, within a factor of
///         3, for rates in degrees, over turns of 5 deg and more. It is 1 / 57 for radians taken
///         for degrees, over turns of 20 deg and more, which no machine's acceleration makes. A
///         correct unit that turns never has less than 1; shaking makes it 2 or 3. At least eight
///         such spans are needed. Without them, rates are in degrees if a tenth of them is faster
///         than any joint.
///         Gravity: none if the median specific force is below a fifth of it. A magnitude of always
///         about 1 is gravity in g, and nothing else is judged.
/// Omits   turns about the vertical, which gravity does not show.
std::vector<InertialFinding> JudgeInertial(std::size_t count,
                                           const std::function<ImuSample(std::size_t row)>& sample,
                                           const Vec3& up_S = Vec3::UnitZ());

}  // namespace tera
