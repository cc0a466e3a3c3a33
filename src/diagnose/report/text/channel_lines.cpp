#include "diagnose/report/text/channel_lines.h"

#include <cmath>
#include <numeric>

#include "diagnose/diagnosis.h"
#include "diagnose/report/text/sentence.h"

namespace tera {
namespace {

/// RMS of the valid samples about their mean.
double MotionOf(Series series) {
  const std::vector<double> values = ValidValues(series);
  const double mean = values.empty() ? 0
                                     : std::accumulate(values.begin(), values.end(), 0.0) /
                                           static_cast<double>(values.size());
  for (double& value : series.value) value -= mean;
  return Rms(series);
}

std::string LeftOf(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const BlockDiagnosis& diagnosis = diagnosed.diagnosis;
  if (diagnosis.out_of_time) return "not judged: the time was over";
  if (!diagnosis.is_testable) return "not judged: too few manoeuvres";
  if (IsLeft(diagnosed, channel)) return "unexplained error";
  if (IsUnconfirmed(diagnosed, channel)) return "a mechanism that was chosen and not confirmed";
  for (const ResidualVerdict& verdict : diagnosis.residual_verdicts) {
    if (verdict.channel != channel) continue;
    switch (verdict.kind) {
      case ResidualVerdict::Kind::kNoise:
        return "noise";
      case ResidualVerdict::Kind::kUnknown:
        return "noise or error: a recording without rest does not tell";
      case ResidualVerdict::Kind::kOfFew:
        return "error of a few manoeuvres";
      case ResidualVerdict::Kind::kError:
        return "error that no regressor follows";
    }
  }
  return "noise";
}

ChannelLine LineOf(const DiagnosedBlock& diagnosed, std::size_t c,
                   const std::vector<double>& simulated) {
  const Channel& channel = diagnosed.block.channels[c];
  const BlockDiagnosis& diagnosis = diagnosed.diagnosis;
  ChannelLine line{.channel = channel.name, .unit = channel.unit};
  Series error_as_it_is = channel.measured;
  for (std::size_t k = 0; k < simulated.size(); ++k) error_as_it_is.value[k] -= simulated[k];
  line.rmse = Rms(error_as_it_is);
  line.rms = Rms(channel.measured);
  line.motion = MotionOf(channel.measured);
  const auto error = [&](const FittedStructure& fitted) {
    return c < fitted.misfit.residual.size() ? Rms(fitted.misfit.residual[c]) : 0.0;
  };
  line.before = error(diagnosis.search.nothing);
  line.after = error(diagnosis.search.found);
  if (c < diagnosis.noise.size()) line.noise = std::sqrt(VarianceOf(diagnosis.noise[c]));
  for (const Finding* finding : RankedFindings(diagnosed)) {
    if (finding->held_out.channel != c && finding->location.channel != c) continue;
    line.explained_by.emplace_back(finding->term.candidate->mechanism->id);
  }
  line.left = LeftOf(diagnosed, c);
  return line;
}

/// Line of a sensor that is compared with other sensors instead of with a replay.
ChannelLine LineOf(const DiagnosedSensors& sensors, const ChannelError& error) {
  ChannelLine line{.channel = error.name, .unit = error.unit, .noise = error.noise};
  line.before = error.rms_before;
  line.after = error.rms_after;
  for (const SensorFound& found : sensors.findings) {
    if (found.channel != error.name) continue;
    line.explained_by.emplace_back(found.finding.term.candidate->mechanism->id);
  }
  line.left = IsNoise(error)       ? "noise"
              : IsExplained(error) ? "no more than is as expected"
                                   : "error that no parameter of a sensor explains";
  return line;
}

}  // namespace

std::vector<ChannelLine> ChannelLines(const Diagnosis& diagnosis) {
  std::vector<ChannelLine> lines;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    const std::vector<std::vector<double>> simulated = diagnosed.block.predict({});
    for (std::size_t c = 0; c < simulated.size(); ++c) {
      lines.push_back(LineOf(diagnosed, c, simulated[c]));
    }
  }
  for (const ChannelError& error : diagnosis.sensors.estimate.channels) {
    lines.push_back(LineOf(diagnosis.sensors, error));
  }
  return lines;
}

}  // namespace tera
