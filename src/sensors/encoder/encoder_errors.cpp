#include "sensors/encoder/encoder_errors.h"

#include <algorithm>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

/// Parameter names of one quantity, for revolute or prismatic axes.
struct Names {
  std::string_view bias, drift, outlier, limit, step, rate_bias, rate_limit, rate_step;
};
constexpr Names kTurning = {"angle_deg",      "angle_degpk", "angle_deg",        "angle_limit_deg",
                            "angle_step_deg", "rate_degps",  "rate_limit_degps", "rate_step_degps"};
constexpr Names kSliding = {"travel_m",      "travel_mpk", "travel_m",        "travel_limit_m",
                            "travel_step_m", "speed_mps",  "speed_limit_mps", "speed_step_mps"};

}  // namespace

AxisErrors::AxisErrors(const Effects& effects, bool linear, std::uint64_t seed,
                       const std::string& stream_name)
    : warm_up_(WarmUp::Of(effects)), outliers_(effects, seed, stream_name) {
  const Names& names = linear ? kSliding : kTurning;
  const double unit = linear ? 1.0 : kDeg;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto number = [&](std::string_view id, std::string_view parameter, double ideal) {
    return NumberOf(effects, id, parameter, ideal);
  };
  sign_ = FindEffect(effects, "axis_flip") ? -1 : 1;
  position_factor_ = number("scale", "position_factor", 1);
  rate_factor_ = number("scale", "rate_factor", 1);
  position_bias_ = unit * number("bias", names.bias, 0);
  rate_bias_ = unit * number("bias", names.rate_bias, 0);
  drift_per_k_ = unit * number("temperature_drift", names.drift, 0);
  outlier_ = unit * number("outliers", names.outlier, 0);
  position_limit_ = unit * number("saturation", names.limit, kNone);
  rate_limit_ = unit * number("saturation", names.rate_limit, kNone);
  position_step_ = unit * number("quantisation", names.step, 0);
  rate_step_ = unit * number("quantisation", names.rate_step, 0);
}

void AxisErrors::Sense(TimeNs t_ns, double* position, double* rate) const {
  *position =
      sign_ * position_factor_ * *position + position_bias_ + warm_up_.At(t_ns) * drift_per_k_;
  *rate = sign_ * rate_factor_ * *rate + rate_bias_;
}

void AxisErrors::ReadOut(std::int64_t k, double* position, double* rate) const {
  const auto index = static_cast<std::uint64_t>(k);
  double q = *position;
  if (outliers_.At(index)) q += outlier_ * outliers_.Gaussian(index);
  *position = Quantised(std::clamp(q, -position_limit_, position_limit_), position_step_);
  *rate = Quantised(std::clamp(*rate, -rate_limit_, rate_limit_), rate_step_);
}

Effects EffectsOfAxis(const Effects& sensor, const Effects& axis) {
  Effects all = axis;
  for (const Effect& effect : sensor) {
    if (!FindEffect(axis, effect.mechanism->id)) all.push_back(effect);
  }
  return all;
}

}  // namespace tera
