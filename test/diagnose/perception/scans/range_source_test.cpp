#include "diagnose/perception/scans/range_source.h"

#include <gtest/gtest.h>

#include "diagnose/perception/analytic_scene.h"

namespace tera {
namespace {

using testing::AnalyticScene;
using testing::LidarOfTest;
using testing::RecordedBy;

/// Scans of a plane without the box, so that a moved ray hits the same surface.
RangeSource ScansOfAPlane(const LidarOfTest& lidar) {
  AnalyticScene plane;
  plane.has_box = false;
  return RecordedBy(lidar, plane, plane);
}

std::vector<ScanPoints> SomePoints(const RangeSource& source) {
  std::vector<ScanPoints> some;
  for (std::size_t s = 0; s < source.scans.size(); s += 20) {
    some.push_back({s, {}});
    for (std::size_t p = 0; p < source.scans[s].points.size(); p += 50) {
      some.back().points.push_back(p);
    }
  }
  return some;
}

TEST(RangeResiduals, OfTheTrueCalibrationAreTheNoiseAlongTheNormal) {
  LidarOfTest lidar;
  lidar.is.shift_B_m = {0.1, -0.05, 0.06};
  lidar.is.rpy_deg = {2, -3, 4};
  lidar.is.range_bias_m = 0.2;
  lidar.is.range_factor = 1.02;
  lidar.is.clock_offset_s = 0.1;
  lidar.noise_m = 0;
  const RangeSource source = ScansOfAPlane(lidar);
  const auto residuals = ResidualsOf(source, SomePoints(source), lidar.is.Calibration(source.X_BS));
  ASSERT_GT(residuals.size(), 50u);
  for (const PointResidual& one : residuals) EXPECT_NEAR(one.distance, 0, 1e-6);
}

TEST(RangeResiduals, ChangeWithEachParameterOfEveryCandidateAsTheirDerivativesSay) {
  LidarOfTest lidar;
  lidar.is.range_bias_m = 0.05;
  const RangeSource source = ScansOfAPlane(lidar);
  const RegistrationBlock block = BlockOf(source);
  const auto points = SomePoints(source);
  // Away from neutral values, so that the candidates' parameters interact.
  Structure terms;
  for (const Candidate& candidate : block.candidates) {
    terms.push_back({&candidate, candidate.starts.front()});
  }
  terms[0].values = {0.05, -0.04, 0.03, 1, -2, 3};
  terms[1].values = {0.02};
  terms[2].values = {1.01};
  terms[3].values = {0.05};
  const CalibrationJacobian jacobian = JacobianOf(source.X_BS, {}, terms);
  const auto at = ResidualsOf(source, points, block.Under(terms));
  Eigen::Index column = 0;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    for (const FreeParameter& free : terms[t].candidate->free) {
      const auto moved = [&](double by) {
        Structure near = terms;
        near[t].values[free.index] += by;
        return ResidualsOf(source, points, block.Under(near));
      };
      const double step = 1e-3;  // m, deg, 1, s; a clock moves in whole nanoseconds
      const auto less = moved(-step), more = moved(step);
      double steepest = 0;
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (!less[i].is_judged() || !at[i].is_judged() || !more[i].is_judged()) continue;
        const double quotient = (more[i].distance - less[i].distance) / (2 * step);
        const double derivative = at[i].by_calibration.dot(jacobian.col(column));
        EXPECT_NEAR(derivative, quotient, 1e-3 * std::max(0.01, std::abs(quotient)))
            << terms[t].candidate->mechanism->id << " " << free.index;
        steepest = std::max(steepest, std::abs(derivative));
      }
      EXPECT_GT(steepest, 1e-3) << terms[t].candidate->mechanism->id << " " << free.index;
      ++column;
    }
  }
}

TEST(RangeResiduals, LeaveOutThePointsThatAreExcluded) {
  const RangeSource source = ScansOfAPlane({});
  const std::vector<TimeNs> t_ns(source.scans.size(), 0);
  const ScanSplit split = SplitScans(t_ns, Stream(1, "test/split"));
  PointFlags excluded = NoPoints(source.scans);
  const auto all = PointsOf(source.scans, split, {split.part[0]}, 100, excluded);
  ASSERT_EQ(all.size(), source.scans.size());
  ASSERT_GT(all[3].points.size(), 2u);
  EXPECT_LE(all[3].points.size(), 100u);
  excluded[3][all[3].points[1]] = true;
  const auto fewer = PointsOf(source.scans, split, {split.part[0]}, 100, excluded);
  EXPECT_EQ(fewer[3].points.size(), all[3].points.size() - 1);
  EXPECT_EQ(fewer[3].points[1], all[3].points[2]);
}

}  // namespace
}  // namespace tera
