#include "diagnose/late_encoders.h"

#include <cmath>

namespace tera {
namespace {

/// The log-likelihood of the rates of all axes under their levers, but for what is the same of all
/// stamps: of each, half its samples times the logarithm of the share of its energy that no factor
/// on its prediction explains.
double LikelihoodByLevers(const std::vector<ReplayBlock>& blocks) {
  double sum = 0;
  for (const ReplayBlock& block : blocks) {
    if (!HasLever(block)) continue;
    const Series& rate = block.channels.front().measured;
    const std::vector<double> predicted = block.predict({}).front();
    double both = 0, measured = 0, expected = 0, count = 0;
    for (std::size_t k = 0; k < rate.size(); ++k) {
      if (!rate.valid[k]) continue;
      both += rate.value[k] * predicted[k];
      measured += rate.value[k] * rate.value[k];
      expected += predicted[k] * predicted[k];
      ++count;
    }
    if (both <= 0) continue;
    sum -= 0.5 * count * std::log(1 - both * both / (measured * expected));
  }
  return sum;
}

}  // namespace

bool StampEncodersAnew(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                       const BlockOptions& options, Measurements* measured) {
  BlockOptions of_axes = options;
  of_axes.needs_any = false;
  const auto likelihood = [&](const std::vector<NamedEncoders>& encoders) {
    Measurements alone{.recording = measured->recording, .encoders = encoders};
    alone.imus.resize(measured->imus.size());
    alone.gnss.resize(measured->gnss.size());
    alone.start_ns = measured->start_ns;
    return LikelihoodByLevers(BlocksOf(input, alone, of_axes));
  };
  bool has_changed = false;
  for (const SensorFinding& found : estimate.findings) {
    if (found.mechanism->id != "clock_offset" || !found.rivals.empty()) continue;
    std::vector<NamedEncoders> anew = measured->encoders;
    bool is_encoder = false;
    for (NamedEncoders& encoders : anew) {
      if (encoders.channel != input.machine + "/" + found.target) continue;
      is_encoder = true;
      for (EncoderSample& sample : encoders.recording.samples) {
        sample.t_ns -= FromSeconds(found.numbers.front().value);
      }
    }
    if (!is_encoder || likelihood(anew) <= likelihood(measured->encoders)) continue;
    measured->encoders = std::move(anew);
    has_changed = true;
  }
  return has_changed;
}

}  // namespace tera
