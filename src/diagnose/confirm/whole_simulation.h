#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tera {

/// Errors of a channel of the whole simulation against the recording, without and with the
/// findings.
struct SimulatedChannel {
  std::string channel, unit;
  double rmse_before = 0, rmse_after = 0;
  /// True if the findings bring the whole simulation closer to the recording.
  bool Follows() const { return rmse_after < rmse_before; }
};

struct PathLengths {
  double recorded_m = 0, before_m = 0, after_m = 0;
};

/// Comparison of the recording with simulations of the whole scenario under the recorded levers:
/// unchanged, and with the findings. It neither adds nor withdraws findings. It shows drifts, and
/// interactions between errors of joints and ground, that a replay lacks.
struct WholeSimulation {
  double from_s = 0, until_s = 0;  ///< compared interval of the recording
  /// Errors on FINAL of channels with findings or learned effects.
  std::vector<SimulatedChannel> channels;
  std::optional<PathLengths> path;  ///< if recording and simulation have poses and the base moves
  std::vector<std::string> not_simulated;  ///< channels with findings that the simulation lacks
  std::string obstacle;                    ///< reason why there is no simulation; else empty
};

}  // namespace tera
