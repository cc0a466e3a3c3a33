#include "diagnose/search/fit/flexible_regressor.h"

#include <gtest/gtest.h>

#include "diagnose/search/toy_block.h"
#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

constexpr std::size_t kSamples = 4000, kFlexibleRegressorManoeuvres = 20;

std::vector<Manoeuvre> EqualManoeuvres() {
  std::vector<Manoeuvre> manoeuvres;
  for (std::size_t m = 0; m < kFlexibleRegressorManoeuvres; ++m) {
    const std::size_t length = kSamples / kFlexibleRegressorManoeuvres;
    Manoeuvre one{{m * length, (m + 1) * length}, 1};
    one.part = m % 3 == 0 ? Part::kTrain : (m % 3 == 1 ? Part::kSelect : Part::kFinal);
    manoeuvres.push_back(one);
  }
  return manoeuvres;
}

/// A lever and an error that is a column of the flexible regressor.
class FlexibleRegressor : public ::testing::Test {
 protected:
  FlexibleRegressor() {
    measured_ = lever_;
    for (std::size_t k = 0; k < kSamples; ++k) measured_[k] += 0.3 * lever_[k] * lever_[k];
  }
  Misfit Left() const {
    const ReplayBlock block = ToyBlock(lever_, MakeSeries(0.01, measured_), {});
    const Likelihood likelihood(block, {{.ar = {0.7}, .scale = 0.05}}, Mask(kSamples, 1));
    Misfit nothing = likelihood.Evaluate(block.predict({}));
    for (std::size_t k = 0; k < kSamples; ++k) {  // no nuisances in this test
      nothing.residual[0].value[k] = measured_[k] - lever_[k];
    }
    return CrossFittedResidual(block, likelihood, nothing, manoeuvres_);
  }

  const std::vector<Manoeuvre> manoeuvres_ = EqualManoeuvres();
  const std::vector<double> lever_ = ToyLever(kSamples, 7);
  std::vector<double> measured_;
};

TEST_F(FlexibleRegressor, FollowsEveryManoeuvreOfWhateverPart) {
  const Misfit left = Left();
  for (std::size_t k = 1; k < kSamples; ++k) {
    EXPECT_NEAR(left.residual[0].value[k], 0, 0.01) << k;
    EXPECT_NEAR(left.innovation[0][static_cast<Eigen::Index>(k)], 0, 0.2) << k;
  }
}

TEST_F(FlexibleRegressor, HasNotSeenTheManoeuvreThatItIsJudgedBy) {
  const Misfit before = Left();
  const Segment& own = manoeuvres_[6].samples;
  for (std::size_t k = own.begin; k < own.end; ++k) measured_[k] += 1 + lever_[k];
  const Misfit after = Left();
  // Except for the memory of the first innovation of the next manoeuvre.
  for (std::size_t k = own.begin; k < own.end; ++k) {
    EXPECT_NEAR(after.residual[0].value[k] - before.residual[0].value[k], 1 + lever_[k], 1e-3) << k;
    if (k == own.begin) continue;  // its innovation remembers another manoeuvre
    const auto at = static_cast<Eigen::Index>(k);
    EXPECT_NEAR(after.innovation[0][at] - before.innovation[0][at],
                (1 + lever_[k] - 0.7 * (1 + lever_[k - 1])) / 0.05, 0.02)
        << k;
  }
}

}  // namespace
}  // namespace tera
