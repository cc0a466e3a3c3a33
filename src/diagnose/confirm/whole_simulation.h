#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A channel of the whole simulation beside the recording, without and with what was found.
struct SimulatedChannel {
  std::string channel, unit;
  double rmse_before = 0, rmse_after = 0;
  /// With what was found the whole simulation is nearer to the recording, as the replay is.
  bool Follows() const { return rmse_after < rmse_before; }
};

/// How far the base went over the ground.
struct PathLengths {
  double recorded_m = 0, before_m = 0, after_m = 0;
};

/// The scenario simulated as a whole under the recorded levers, as it is and with what was found,
/// against the recording. It names nothing and takes nothing back: errors of joints and ground that
/// act on each other show in it, and so do drifts that a replay does not have.
struct WholeSimulation {
  double until_s = 0;                      ///< of the recording
  std::vector<SimulatedChannel> channels;  ///< of blocks with findings, on FINAL
  std::optional<PathLengths> path;         ///< where both sides have poses and the base moves
  std::vector<std::string> not_simulated;  ///< channels with findings that the simulation lacks
  std::string obstacle;                    ///< why there is none at all; empty where there is one
};

}  // namespace tera
