#include "diagnose/confirm/held_out_recording.h"

#include <cmath>

#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/steady_gain.h"

namespace tera {

std::vector<HeldOutChannel> ValidateOnBlock(const ReplayBlock& further, const Structure& found,
                                            const Stream& stream) {
  const auto manoeuvres = ManoeuvresOf(further, stream);
  const Likelihood likelihood(further, NoiseOfBlock(further, manoeuvres),
                              Mask(further.samples(), 1));
  const Misfit before = likelihood.Evaluate(further.predict({}));
  const Misfit after = found.empty() ? before : likelihood.Evaluate(further.predict(found));
  std::vector<Segment> all;
  for (const Manoeuvre& manoeuvre : manoeuvres) all.push_back(manoeuvre.samples);
  std::vector<HeldOutChannel> channels;
  for (std::size_t c = 0; c < further.channels.size(); ++c) {
    channels.push_back(
        {further.channels[c].name, further.channels[c].unit, Rms(before.residual[c]),
         Rms(after.residual[c]),
         SteadyGainP(GainsOf(likelihood, before, after, PiecesOf(all, further.period_s()), c))});
  }
  return channels;
}

}  // namespace tera
