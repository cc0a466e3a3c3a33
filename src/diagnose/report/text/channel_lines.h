#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// What became of one compared channel: RMS values over all of its samples, in its unit.
struct ChannelLine {
  std::string channel, unit;
  std::optional<double> rms;     ///< of the measurement; sensors beside each other have none
  std::optional<double> motion;  ///< of the measurement about its mean
  std::optional<double> rmse;    ///< of the scenario as it stands, without any fit
  std::optional<double> noise;   ///< none where it was not judged
  double before = 0;             ///< of the error of the simulation as it was
  double after = 0;              ///< with all that was found; nuisances fitted in both
  std::vector<std::string> explained_by;  ///< mechanisms that were found, "dead_band"
  std::string left;                       ///< what is left, in words: "noise", "unexplained error"
};

/// A line for every channel that was compared, in the order of the blocks.
std::vector<ChannelLine> ChannelLines(const Diagnosis& diagnosis);

}  // namespace tera
