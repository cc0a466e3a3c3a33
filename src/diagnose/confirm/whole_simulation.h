#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A channel of the whole simulation against the recording, without and with what was found.
struct SimulatedChannel {
  std::string channel, unit;
  double rmse_before = 0, rmse_after = 0;
  /// Whether the whole simulation, as the replay, comes nearer to the recording with what was
  /// found.
  bool Follows() const { return rmse_after < rmse_before; }
};

/// Lengths of the base's path over the ground.
struct PathLengths {
  double recorded_m = 0, before_m = 0, after_m = 0;
};

/// The scenario simulated as a whole under the recorded levers, as it is and with what was found,
/// against the recording. It adds no finding and withdraws none: errors of joints and ground that
/// act on each other show in it, and so do drifts that a replay does not have.
struct WholeSimulation {
  double from_s = 0, until_s = 0;          ///< the part that is compared, in the recording
  std::vector<SimulatedChannel> channels;  ///< with findings or learned effects, on FINAL
  std::optional<PathLengths> path;         ///< where both sides have poses and the base moves
  std::vector<std::string> not_simulated;  ///< channels with findings that the simulation lacks
  std::string obstacle;                    ///< why there is none at all; empty where there is one
};

}  // namespace tera
