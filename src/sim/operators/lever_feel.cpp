#include "sim/operators/lever_feel.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kHeld = 0.5;    // of the lever: from here on a slow joint is held by its load
constexpr double kWidest = 0.5;  // of the lever: the largest d

}  // namespace

double LeverFeel::Lever(double wanted, double moving, double dt_s) {
  const bool positive = wanted >= 0;
  const double sign = positive ? 1 : -1;
  const double v = std::abs(wanted), v_moving = sign * moving;
  const bool felt = v > touch_.soft && v < kHeld;
  if (!felt || positive != positive_ || v_moving >= v) pushing_ = false;
  const bool follows = v_moving >= touch_.slow * v || v_moving <= -touch_.back * v;
  slow_s_ = felt && positive == positive_ && !follows ? slow_s_ + dt_s : 0;
  pushing_ |= slow_s_ > touch_.wait_s;
  positive_ = positive;

  double& band = band_[positive];
  if (pushing_) band = std::min(band + touch_.push_1ps * dt_s, kWidest);
  if (felt && v_moving > touch_.fast * v) band = std::max(band - touch_.push_1ps * dt_s, 0.0);
  return std::clamp(wanted + sign * band * std::min(1.0, v / touch_.soft), -1.0, 1.0);
}

}  // namespace tera
