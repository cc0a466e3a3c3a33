#pragma once

#include <array>

namespace tera::blind::mujoco {

/// A long pilot hose between lever and spool, with resistance and capacity.
///
/// Model   a ladder of n sections, each a resistance R and a capacity C: R C p_k' = p_(k-1) - 2 p_k
///         + p_(k+1), closed at the end. Its delay, the area between a step and the response, is
///         Elmore's n (n + 1) / 2 R C. The response ends as an exponential with the time constant R
///         C / (2 - 2 cos(pi / (2 n + 1))).
/// Omits   the oil's inertia; turbulence.
/// Source  Elmore 1948, J. Appl. Phys. 19; Merritt 1967 for the line.
class PilotLine {
 public:
  explicit PilotLine(double elmore_s)
      : section_s_(elmore_s / (kSections * (kSections + 1) / 2.0)) {}

  /// Output after a step with `lever` at its beginning.
  double After(double step_s, double lever);

 private:
  static constexpr std::size_t kSections = 5;
  double section_s_;
  std::array<double, kSections> pressure_{};  ///< in levers
};

}  // namespace tera::blind::mujoco
