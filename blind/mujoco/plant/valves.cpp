#include "blind/mujoco/plant/valves.h"

#include <algorithm>
#include <cmath>

namespace tera::blind::mujoco {
namespace {

constexpr double kCloses_s = 1;

/// Above 0: the load is against the motion.
double Against(double load_of_rated, double way) {
  return way > 0 ? load_of_rated : way < 0 ? -load_of_rated : 0;
}

}  // namespace

double SoftStart(double lever, double threshold, double soft) {
  const double past = std::max(0.0, std::abs(lever) - threshold);
  return std::copysign(past - soft * (1 - std::exp(-past / soft)), lever);
}

double Regeneration(double gain, double load_of_rated, double valve) {
  constexpr double kAll = 0.1, kNone = 0.33;  // of the rated load
  if (valve >= 0) return 1;
  const double open = (kNone - Against(load_of_rated, valve)) / (kNone - kAll);
  return 1 + gain * std::clamp(open, 0.0, 1.0);
}

double Counterbalance(double droop, double load_of_rated, double valve) {
  return std::clamp(1 - droop * std::max(0.0, Against(load_of_rated, valve)), 0.0, 1.0);
}

double RunsAhead::Rate(double asked, double load_of_rated, double step_s) {
  if (asked > 0) void_ = 0;
  if (asked >= 0) return asked;
  if (Against(load_of_rated, asked) < 0) {
    void_ += ahead_ * -asked * step_s;
    return (1 + ahead_) * asked;
  }
  if (void_ <= 0) return asked;
  void_ += asked * step_s;
  return 0;
}

double HoldingBrake::Share(double t_s, double valve) {
  if (valve == 0) return 1;
  if (t_s - moved_s_ > kCloses_s) opened_s_ = t_s + opens_s_;
  moved_s_ = t_s;
  return t_s < opened_s_ ? 0 : 1;
}

}  // namespace tera::blind::mujoco
