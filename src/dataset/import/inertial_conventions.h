#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// Ways in which the data of an IMU may deviate from docs/reference/dataset.md.
enum class InertialDoubt {
  kZDown,           ///< z points down: axes forward, right, down, or upside down
  kOnItsSide,       ///< x or y is vertical
  kRatesInDegrees,  ///< deg/s imported as rad/s
  kRatesInRadians,  ///< rad/s imported as deg/s
  kInG,             ///< acceleration in g imported as m/s2
  kNoGravity        ///< acceleration without gravity, as some loggers write it
};

struct InertialFinding {
  InertialDoubt doubt = InertialDoubt::kZDown;
  std::string text;  ///< observation, possible cause and remedy, without a full stop
};

/// Ratio of two rotation estimates across the vertical: by the gyro rates, and by the change of the
/// gravity direction in the unit. 0 if the gravity direction changes too little.
struct TurnRatios {
  double seen = 0;  ///< over rotations of 5 deg and more, which accelerations of the machine can
                    ///< mimic
  double sure = 0;  ///< over rotations of 20 deg and more, which accelerations cannot mimic
};
TurnRatios TurnsOverGravity(std::size_t count,
                            const std::function<ImuSample(std::size_t row)>& sample);

/// Checks raw numbers of a logger. Finds acceleration in g by a magnitude that is always about 1.
/// If the mount is unknown, also finds units whose x or y is vertical instead of z; units on arms
/// and buckets can be mounted so.
std::vector<InertialFinding> JudgeLogged(std::size_t count,
                                         const std::function<ImuSample(std::size_t row)>& sample,
                                         bool knows_mount);

/// Checks `count` samples of an IMU without known poses. `up_S` is the upward direction in the
/// sensor frame while the machine is level and its link is in the documented pose. It is z unless
/// the mount is known.
///
/// Model   z down: the median direction of the specific force is within 25 deg of down, and nine
///         tenths of the directions are within 60 deg. A unit on an undercarriage, cab or boom
///         cannot cause this, because it pitches by at most 85 deg. Units on arms and buckets point
///         down only for short times; a parked arm stays 30 deg away from down.
///
///         Unit of rates: over spans of 2 s, compares the rotation by gyro rates across the
///         specific force with the rotation of the specific force itself. The median ratio is 57
///         within a factor of 3 if deg/s were imported as rad/s; this uses rotations of 5 deg and
///         more. It is 1 / 57 in the opposite case; this uses rotations of 20 deg and more. The
///         ratio of a correct unit is at least 1; vibration raises it to 2 or 3. At least eight
///         spans are needed. With fewer, rates are deg/s if a tenth of them exceeds the speed of
///         any joint.
///
///         Gravity: missing if the median specific force is below a fifth of standard gravity. If
///         the magnitude is always about 1, the unit is g and no other check is made.
/// Omits   rotations about the vertical, which do not change the gravity direction.
std::vector<InertialFinding> JudgeInertial(std::size_t count,
                                           const std::function<ImuSample(std::size_t row)>& sample,
                                           const Vec3& up_S = Vec3::UnitZ());

}  // namespace tera
