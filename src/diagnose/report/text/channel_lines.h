#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// Result for one compared channel. RMS values are over all its samples, in its unit.
struct ChannelLine {
  std::string channel, unit;
  /// RMS of the measurement; empty for sensors compared with each other.
  std::optional<double> rms;
  std::optional<double> motion;           ///< RMS of the measurement about its mean
  std::optional<double> rmse;             ///< error of the unchanged scenario, without any fit
  std::optional<double> noise;            ///< empty if not judged
  double before = 0;                      ///< error without findings, after a fit of the nuisances
  double after = 0;                       ///< error with all findings, after a fit of the nuisances
  std::vector<std::string> explained_by;  ///< found mechanisms: "dead_band"
  std::string left;                       ///< kind of residual: "noise", "unexplained error"
};

/// One line per compared channel, in the order of the blocks.
std::vector<ChannelLine> ChannelLines(const Diagnosis& diagnosis);

}  // namespace tera
