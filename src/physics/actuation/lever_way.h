#pragma once

#include <cmath>

namespace tera {

/// The way in which a lever moved last, -1 or 1; 0 at neutral.
///
/// Model   a held lever trembles: it has moved where it is more than 0.01 from where it was
///         followed to.
class LeverWay {
 public:
  double Step(double lever) {
    if (std::abs(lever - followed_) > kTremor) {
      way_ = lever > followed_ ? 1 : -1;
      followed_ = lever - way_ * kTremor;
    }
    return std::abs(lever) <= kTremor ? 0 : way_;
  }

 private:
  static constexpr double kTremor = 0.01;
  double followed_ = 0, way_ = 0;
};

}  // namespace tera
