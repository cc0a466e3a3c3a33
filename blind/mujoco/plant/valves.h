#pragma once

namespace tera::blind::mujoco {

/// What a spool gives that a spring holds closed until the pilot's pressure is `threshold`, and
/// whose notch lets go softly.
///
/// Model   s = lever - threshold: s - soft (1 - e^(-s / soft)), which goes towards
///         lever - (threshold + soft). Odd in the lever.
double SoftStart(double lever, double threshold, double soft);

/// How much faster a joint goes the negative way while oil from the rod's side helps to fill the
/// other: all of `gain` where no load is against it, none from a third of the rated load on.
double Regeneration(double gain, double load_of_rated, double valve);

/// What a counterbalance valve makes of a load: it costs rate where it is against the motion; what
/// aids the motion is braked to the rate that was asked.
double Counterbalance(double droop, double load_of_rated, double valve);

/// A joint that falls faster than its pump fills the cylinder, and waits for its oil when the load
/// turns round.
///
/// Model   While the load aids a negative lever, the rate is (1 + ahead) times that asked and the
///         void grows by ahead times that asked. With the load against it nothing moves until the
///         pump has filled the void at the rate asked. A positive lever presses the void together.
class RunsAhead {
 public:
  explicit RunsAhead(double ahead) : ahead_(ahead) {}
  /// Of the rate that is asked, over a step.
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
  double moved_s_ = -1e9;   ///< when the lever was last out
  double opened_s_ = -1e9;  ///< when it is open
};

}  // namespace tera::blind::mujoco
