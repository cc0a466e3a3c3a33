#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// Result for one compared channel: RMS values over all of its samples, in its unit.
struct ChannelLine {
  std::string channel, unit;
  std::optional<double> rms;     ///< of the measurement; none for sensors compared with each other
  std::optional<double> motion;  ///< of the measurement about its mean
  std::optional<double> rmse;    ///< of the unchanged scenario, without any fit
  std::optional<double> noise;   ///< none where not judged
  double before = 0;             ///< error of the unchanged simulation
  double after = 0;              ///< with all findings; nuisances fitted in both
  std::vector<std::string> explained_by;  ///< mechanisms found, "dead_band"
  std::string left;                       ///< kind of residual: "noise", "unexplained error"
};

/// One line for every compared channel, in the order of the blocks.
std::vector<ChannelLine> ChannelLines(const Diagnosis& diagnosis);

}  // namespace tera
