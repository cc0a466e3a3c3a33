#pragma once

#include "core/units.h"
#include "diagnose/sensors/made_recording.h"

namespace tera {

inline constexpr double kLate_s = 0.16;

/// A machine whose joints follow their levers without lag, at 1 rad/s for full lever. Encoder
/// stamps are late; lever stamps too, if they share that clock.
struct DrivenJoints {
  explicit DrivenJoints(bool levers_share_the_clock) : made(Made{.has_poses = false}) {
    const double levers_late_s = levers_share_the_clock ? kLate_s : 0;
    DiagnosisInput& input = made.input;
    input.commands.columns = {"swing", "boom"};
    for (int k = 0; k < 2000; ++k) {
      const double t_s = 0.02 * k;
      input.commands.t_ns.push_back(FromSeconds(t_s + levers_late_s));
      input.commands.rows.push_back(RatesAt(t_s + 0.01));
    }
    for (EncoderSample& sample : made.measured.encoders[0].recording.samples) {
      sample.qd_radps = RatesAt(ToSeconds(sample.t_ns));
      sample.t_ns += FromSeconds(kLate_s);
    }
    made.measured.imus.assign(5, {});
    made.measured.gnss.assign(5, {});
  }
  std::vector<double> RatesAt(double t_s) const {
    const std::vector<double> before = made.Joints(t_s - 1e-3), after = made.Joints(t_s + 1e-3);
    return {(after[0] - before[0]) / 2e-3, (after[1] - before[1]) / 2e-3};
  }
  MadeRecording made;
};

}  // namespace tera
