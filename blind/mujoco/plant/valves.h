#pragma once

namespace tera::blind::mujoco {

/// Opening of a spool that a spring keeps closed below the pilot pressure `threshold`, with a notch
/// for a soft start.
///
/// Model   s = lever - threshold: s - soft (1 - e^(-s / soft)), with the asymptote lever -
///         (threshold + soft). Odd in the lever.
double SoftStart(double lever, double threshold, double soft);

/// Relative rate of a joint in the negative direction while oil from the rod's side helps to fill
/// the other: all of `gain` without opposing load, none from a third of the rated load on.
double Regeneration(double gain, double load_of_rated, double valve);

/// Effect of a load with a counterbalance valve. An opposing load costs rate; an assisting load is
/// braked to the demanded rate.
double Counterbalance(double droop, double load_of_rated, double valve);

/// A joint that falls faster than its pump fills the cylinder, and waits for oil when the load
/// reverses.
///
/// Model   While the load assists a negative lever, the rate is (1 + ahead) times the demand, and
///         the void grows by ahead times the demand. Under an opposing load nothing moves until the
///         pump has filled the void at the demanded rate. A positive lever closes the void.
class RunsAhead {
 public:
  explicit RunsAhead(double ahead) : ahead_(ahead) {}
  /// Actual rate for the demanded rate, over a step.
  double Rate(double asked, double load_of_rated, double step_s);

 private:
  double ahead_, void_ = 0;
};

/// A slew's brake that closes a second after the lever came to rest, and needs `opens_s` to open.
class HoldingBrake {
 public:
  explicit HoldingBrake(double opens_s) : opens_s_(opens_s) {}
  /// Share of the valve's opening that moves the joint: 0 or 1.
  double Share(double t_s, double valve);

 private:
  double opens_s_;
  double moved_s_ = -1e9;   ///< time of the lever's last deflection
  double opened_s_ = -1e9;  ///< time at which it is open
};

}  // namespace tera::blind::mujoco
