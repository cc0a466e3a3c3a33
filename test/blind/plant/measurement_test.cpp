#include "blind/plant/measurement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera::blind {
namespace {

/// A machine at rest, so that measurements are noise.
Motion AtRest(double duration_s, const EncoderNoise& noise, const Stream& stream) {
  Motion motion;
  motion.t_s = SampleTimes(duration_s, noise, stream);
  motion.q_rad.assign(motion.t_s.size(), {});
  motion.w_radps.assign(motion.t_s.size(), {});
  return motion;
}

TEST(Measurement, HasTheNoiseThatIsAskedFor) {
  EncoderNoise noise;
  noise.memory = 0.7, noise.engine_radps = 0, noise.outlier = 0, noise.lost = 0;
  const Stream stream(3, "noise");
  const EncoderRows rows = Measure(AtRest(600, noise, stream), {1, 2}, noise, stream);
  double energy = 0, lagged = 0, crossed = 0;
  for (std::size_t k = 1; k < rows.w_radps.size(); ++k) {
    energy += std::pow(rows.w_radps[k][1], 2);
    lagged += rows.w_radps[k][1] * rows.w_radps[k - 1][1];
    crossed += rows.w_radps[k][1] * rows.w_radps[k][2];
  }
  const double n = static_cast<double>(rows.w_radps.size());
  // 60 000 samples with memory 0.7 equal some 10 000 independent ones: 1 % of deviation.
  EXPECT_NEAR(std::sqrt(energy / n), noise.rate_radps, 0.05 * noise.rate_radps);
  EXPECT_NEAR(lagged / energy, 0.7, 0.03);
  EXPECT_NEAR(crossed / energy, 0, 0.05);
}

TEST(Measurement, LosesItsShareOfSamplesAndStampsThemInOrder) {
  EncoderNoise noise;
  noise.lost = 0.04;
  const Stream stream(5, "lost");
  const Motion motion = AtRest(600, noise, stream);
  const EncoderRows rows = Measure(motion, {0}, noise, stream);
  const double lost = 1 - static_cast<double>(rows.t_ns.size()) / motion.t_s.size();
  EXPECT_NEAR(lost, 0.04, 0.01);
  for (std::size_t k = 1; k < rows.t_ns.size(); ++k) ASSERT_GT(rows.t_ns[k], rows.t_ns[k - 1]);
}

}  // namespace
}  // namespace tera::blind
