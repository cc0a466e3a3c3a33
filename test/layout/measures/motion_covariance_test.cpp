#include "layout/measures/motion_covariance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

using enum MotionCovariance::Number;
constexpr double kResponse_s = MotionCovariance::kResponse_s;

TEST(MotionCovariance, RatesAndAccelerationsStayAsUncertainAsTheyWere) {
  MotionCovariance known({{0.2, 0.5}, {3, 1.5}}, {});
  for (const double dt_s : {0.02, 0.1, 0.002, 0.05}) known.Pass(dt_s);
  for (const auto& [c, sigma] : {std::pair<std::size_t, double>{0, 0.5}, {1, 1.5}}) {
    const double rate = known.VarianceAt(MotionCovariance::At(c, kRate));
    const double acceleration = known.VarianceAt(MotionCovariance::At(c, kAcceleration));
    EXPECT_NEAR(rate / (sigma * sigma), 1, 1e-5);
    EXPECT_NEAR(acceleration * kResponse_s * kResponse_s / (sigma * sigma), 1, 1e-5);
  }
}

TEST(MotionCovariance, APositionWandersOffByTheCorrelationOfItsRate) {
  // The rate's autocorrelation is sigma^2 (1 + s / tau) e^(-s / tau). Its integral over s >= 0 is 2
  // tau and its first moment 3 tau^2. The variance of the displacement in t >> tau is 2 sigma^2 (2
  // tau t - 3 tau^2).
  MotionCovariance known({{0.2, 0.5}}, {});
  for (int k = 0; k < 1000; ++k) known.Pass(0.02);
  const double way = 2 * 0.25 * (2 * kResponse_s * 20 - 3 * kResponse_s * kResponse_s);
  EXPECT_NEAR(known.VarianceAt(MotionCovariance::At(0, kPosition)), 0.04 + way, 1e-4 * way);
}

TEST(MotionCovariance, MeansAreThoseOfTheLastStepAlone) {
  // Over a step much shorter than the response, the mean rate is the rate, and the mean
  // acceleration the acceleration. Over a long step, the mean rate is the displacement over the
  // time, and the mean acceleration the difference of two independent rates.
  MotionCovariance known({{0.2, 0.5}}, {});
  known.Pass(1e-4);
  EXPECT_NEAR(known.VarianceAt(MotionCovariance::At(0, kMeanRate)), 0.25, 1e-3);
  EXPECT_NEAR(known.VarianceAt(MotionCovariance::At(0, kMeanAcceleration)),
              0.25 / (kResponse_s * kResponse_s), 1e-2);
  known.Learn(Eigen::VectorXd::Unit(known.size(), MotionCovariance::At(0, kPosition)), 1e-12);
  for (int k = 0; k < 1000; ++k) known.Pass(0.02);
  const double before = known.VarianceAt(MotionCovariance::At(0, kPosition));
  known.Pass(0.02);
  // x_k - x_(k-1) = T times the mean rate: variances of x that grow by 4 tau sigma^2 T.
  const double after = known.VarianceAt(MotionCovariance::At(0, kPosition));
  EXPECT_NEAR(after - before, 4 * kResponse_s * 0.25 * 0.02, 1e-6);
  EXPECT_NEAR(known.VarianceAt(MotionCovariance::At(0, kMeanRate)), 0.25, 1e-3);
}

TEST(MotionCovariance, AMeasurementAddsItsInformation) {
  MotionCovariance known({{0.2, 0.5}}, {{0.3}});
  Eigen::VectorXd h = Eigen::VectorXd::Zero(known.size());
  h[MotionCovariance::At(0, kPosition)] = 1;
  known.Learn(h, 0.01);
  EXPECT_NEAR(1 / known.VarianceAt(MotionCovariance::At(0, kPosition)), 1 / 0.04 + 1 / 0.01, 1e-9);
  // With a constant error, more samples do not determine more than the sum of both.
  h[known.AtError(0)] = 1;
  for (int k = 0; k < 10000; ++k) known.Learn(h, 0.01);
  const double position = 1 / (1 / 0.04 + 1 / 0.01);
  EXPECT_NEAR(1 / known.VarianceAt(MotionCovariance::At(0, kPosition)), 1 / position + 1 / 0.09,
              1e-2);
}

TEST(MotionCovariance, SlowErrorsWalkOrComeBack) {
  MotionCovariance known({}, {{0.3, 0.1}, {0.7, 0, 0.7, 60}, {0, 0, 0.7, 60}});
  for (int k = 0; k < 500; ++k) known.Pass(0.02);
  EXPECT_NEAR(known.VarianceAt(known.AtError(0)), 0.09 + 0.01 * 10, 1e-9);
  EXPECT_NEAR(known.VarianceAt(known.AtError(1)), 0.49, 1e-9);
  EXPECT_NEAR(known.VarianceAt(known.AtError(2)), 0.49 * (1 - std::exp(-2 * 10.0 / 60)), 1e-9);
}

TEST(MotionCovariance, ATurnCarriesAnErrorInAttitudeFromOneAxisToAnother) {
  MotionCovariance known({{0.1, 0}, {0.2, 0}, {0.3, 0}}, {});
  known.Turn(0, Mat3(Eigen::AngleAxisd(90 * kDeg, Vec3::UnitZ())));
  EXPECT_NEAR(known.VarianceAt(MotionCovariance::At(0, kPosition)), 0.04, 1e-12);
  EXPECT_NEAR(known.VarianceAt(MotionCovariance::At(1, kPosition)), 0.01, 1e-12);
  EXPECT_NEAR(known.VarianceAt(MotionCovariance::At(2, kPosition)), 0.09, 1e-12);
}

}  // namespace
}  // namespace tera
