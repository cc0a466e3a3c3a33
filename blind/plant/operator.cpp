#include "blind/plant/operator.h"

#include <cmath>
#include <numbers>

namespace tera::blind {
namespace {

constexpr double kRoom_rad = 0.28;  ///< before a stop, what a late drive still goes

}  // namespace

/// Away from the nearer stop where it is near, else either way.
double Operator::Direction(std::size_t axis, double q_rad) {
  const PlainAxis& a = excavator_.axis(axis);
  const double middle_rad = (a.lower_rad + a.upper_rad) / 2;
  const double half_rad = (a.upper_rad - a.lower_rad) / 2 - kRoom_rad;
  const double place = (q_rad - middle_rad) / half_rad;
  return Draw(axis) < 0.5 + 0.7 * place ? -1 : 1;
}

Operator::Manoeuvre Operator::Next(std::size_t axis, double t_s, double q_rad) {
  const double kind = Draw(axis), direction = Direction(axis, q_rad);
  if (habit_.full_steps_only) {
    if (kind < 0.4) return {Kind::kRest, t_s, t_s + Between(axis, 0.5, 1.2)};
    return {Kind::kStep, t_s, t_s + Between(axis, 0.5, 1.2), direction};
  }
  const auto up_to = [&](double share) { return direction * share * habit_.largest; };
  if (kind < 0.2) return {Kind::kRest, t_s, t_s + Between(axis, 0.3, 1.0)};
  if (kind < 0.6) {
    const double size = habit_.smallest * std::pow(habit_.largest / habit_.smallest, Draw(axis));
    return {Kind::kStep, t_s, t_s + Between(axis, 0.5, 1.6), direction * size};
  }
  if (kind < 0.8) {
    return {Kind::kRamp, t_s, t_s + Between(axis, 1.2, 2.6), up_to(Between(axis, 0.2, 1.0))};
  }
  const double period_s = Between(axis, 0.7, 2.2);
  return {Kind::kWave, t_s, t_s + 2 * period_s, up_to(Between(axis, 0.15, 0.9)), period_s};
}

AxisValues Operator::At(double t_s, const AxisValues& q_rad) {
  AxisValues lever{};
  for (std::size_t i = 0; i < kAxes; ++i) {
    if (!habit_.uses[i]) continue;
    Manoeuvre& now = now_[i];
    if (t_s >= now.to_s) now = Next(i, t_s, q_rad[i]);
    const double in_s = t_s - now.from_s, lasts_s = now.to_s - now.from_s;
    double u = 0;
    if (now.kind == Kind::kStep) u = now.size;
    if (now.kind == Kind::kRamp) u = now.size * (1 - std::abs(2 * in_s / lasts_s - 1));
    if (now.kind == Kind::kWave) {
      u = now.size * std::sin(2 * std::numbers::pi * in_s / now.period_s);
    }
    const PlainAxis& a = excavator_.axis(i);
    const bool at_end = (u > 0 && q_rad[i] > a.upper_rad - kRoom_rad) ||
                        (u < 0 && q_rad[i] < a.lower_rad + kRoom_rad);
    if (at_end) {
      u = 0;
      if (now.kind != Kind::kWave) now = {Kind::kRest, t_s, t_s + 0.3};
    }
    lever[i] = std::round(u * 250) / 250;  // of a bus message
  }
  return lever;
}

}  // namespace tera::blind
