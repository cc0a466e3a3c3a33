#pragma once

#include <array>

namespace tera::blind::mujoco {

/// A long pilot hose between lever and spool: it resists and it swells.
///
/// Model   a ladder of n sections, each a resistance R and a capacity C:
///         R C p_k' = p_(k-1) - 2 p_k + p_(k+1), the last one closed. It is late by Elmore's
///         n (n + 1) / 2 R C, the area between a step and its answer, and ends as an exponential of
///         the time R C / (2 - 2 cos(pi / (2 n + 1))).
/// Omits   the oil's inertia; turbulence.
/// Source  Elmore 1948, J. Appl. Phys. 19; Merritt 1967 for the line.
class PilotLine {
 public:
  explicit PilotLine(double elmore_s)
      : section_s_(elmore_s / (kSections * (kSections + 1) / 2.0)) {}

  /// What arrives after a step with `lever` at the beginning.
  double After(double step_s, double lever);

 private:
  static constexpr std::size_t kSections = 5;
  double section_s_;
  std::array<double, kSections> pressure_{};  ///< in levers
};

}  // namespace tera::blind::mujoco
