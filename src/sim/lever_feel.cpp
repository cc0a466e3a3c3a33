#include "sim/lever_feel.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kSoft = 0.05;     // of the lever: below it d is applied in part
constexpr double kHeld = 0.5;      // of the lever: from here on a slow joint is held by its load
constexpr double kWidest = 0.5;    // of the lever: the largest d
constexpr double kWait_s = 0.4;    // longer than a joint's run-up
constexpr double kPush_1ps = 0.5;  // how fast a hand feels its way
constexpr double kSlow = 0.7, kFast = 3.0;  // of the rate asked for

}  // namespace

double LeverFeel::Lever(double wanted, double moving, double dt_s) {
  const bool positive = wanted >= 0;
  const double sign = positive ? 1 : -1;
  const double v = std::abs(wanted), v_moving = sign * moving;
  const bool felt = v > kSoft && v < kHeld;
  if (!felt || positive != positive_ || v_moving >= v) pushing_ = false;
  slow_s_ = felt && positive == positive_ && v_moving < kSlow * v ? slow_s_ + dt_s : 0;
  pushing_ |= slow_s_ > kWait_s;
  positive_ = positive;

  double& band = band_[positive];
  if (pushing_) band = std::min(band + kPush_1ps * dt_s, kWidest);
  if (felt && v_moving > kFast * v) band = std::max(band - kPush_1ps * dt_s, 0.0);
  return std::clamp(wanted + sign * band * std::min(1.0, v / kSoft), -1.0, 1.0);
}

}  // namespace tera
