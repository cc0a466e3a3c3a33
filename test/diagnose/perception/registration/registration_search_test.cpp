#include "diagnose/perception/registration/registration_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/registration/registration_fit.h"
#include "diagnose/perception/true_sensor.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using testing::TrueSensor;

constexpr double kNoise_m = 0.01;
constexpr std::size_t kScans = 20, kPointsOfScan = 60;

/// Points in the sensor's frame on planes that do not move with it: in each scan, those of one
/// block of time.
struct PlanePoint {
  Vec3 p_T_m, n_B;   ///< the normal towards the sensor
  double at_m;       ///< n_B p_B of the plane
  double speed_mps;  ///< of the link, against the normal
};

/// Walls on three sides and the floor, or only the floor, seen by a misplaced sensor. `speed_mps`:
/// the link's, along each normal in turn.
class PlaneRoom {
 public:
  PlaneRoom(const TrueSensor& sensor, bool has_walls, double speed_mps = 0) {
    block_.X_BS = MakePose({0.3, 0.2, 0.7}, 0.02, 0.2, -0.4);
    block_.candidates = CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "lidar", {});
    const SensorCalibration truth = sensor.Calibration(block_.X_BS);
    const Stream noise(3, "test/planes");
    std::uint64_t draw = 0;
    for (std::size_t s = 0; s < kScans; ++s) {
      scans_.emplace_back();
      for (std::size_t i = 0; i < kPointsOfScan; ++i) {
        const std::size_t plane = has_walls ? i % 4 : 0;
        const Vec3 n_B = plane == 0   ? Vec3::UnitZ()
                         : plane == 1 ? Vec3(-1, 0, 0)
                         : plane == 2 ? Vec3(0.6, -0.8, 0)
                                      : Vec3(0, 1, 0);
        const double at_m = plane == 0 ? -1.5 : -6;
        // From the sensor to a point in the plane.
        const Vec3 aside = n_B.unitOrthogonal(), other = n_B.cross(aside);
        const Vec3 d_B =
            (-n_B + noise.Gaussian(draw) * aside + noise.Gaussian(draw + 1) * other).normalized();
        const Vec3 from_m = truth.X_BT.translation();
        const double range_m = (at_m - n_B.dot(from_m)) / n_B.dot(d_B);
        const double speed = (plane % 2 == 0 ? 1 : -1) * speed_mps;
        // With a clock that is ahead, the range is that of a later position.
        const double late_m = truth.clock_offset_s * speed / -n_B.dot(d_B);
        const double reported_m = truth.range_factor * (range_m + late_m) + truth.range_bias_m +
                                  kNoise_m * noise.Gaussian(draw + 2);
        draw += 3;
        scans_.back().push_back(
            {reported_m * (truth.X_BT.linear().transpose() * d_B), n_B, at_m, speed});
      }
    }
    block_.residuals = [this](const std::vector<ScanPoints>& points,
                              const SensorCalibration& calibration,
                              int) { return Residuals(points, calibration); };
  }
  PlaneRoom(const PlaneRoom&) = delete;
  PlaneRoom& operator=(const PlaneRoom&) = delete;

  const RegistrationBlock& block() const { return block_; }

  /// Parts by turns.
  SplitPoints Points() const {
    ScanSplit split;
    const Part parts[] = {Part::kTrain, Part::kSelect, Part::kFinal};
    for (std::size_t s = 0; s < kScans; ++s) {
      split.block.push_back(s);
      split.part.push_back(parts[s % 3]);
    }
    split.blocks = kScans;
    return PointsOfParts(split, [&](const std::vector<Part>& some) {
      std::vector<ScanPoints> chosen;
      for (std::size_t s = 0; s < kScans; ++s) {
        if (std::find(some.begin(), some.end(), split.part[s]) == some.end()) continue;
        chosen.push_back({s, {}});
        for (std::size_t p = 0; p < kPointsOfScan; ++p) chosen.back().points.push_back(p);
      }
      return chosen;
    });
  }

 private:
  std::vector<PointResidual> Residuals(const std::vector<ScanPoints>& points,
                                       const SensorCalibration& calibration) const {
    std::vector<PointResidual> residuals;
    for (const ScanPoints& of_scan : points) {
      for (const std::size_t p : of_scan.points) {
        const PlanePoint& point = scans_[of_scan.scan][p];
        const double reported_m = point.p_T_m.norm();
        const double range_m = (reported_m - calibration.range_bias_m) / calibration.range_factor;
        const Vec3 r_B_m = calibration.X_BT.linear() * (range_m / reported_m * point.p_T_m);
        const Vec3 p_B_m = calibration.X_BT.translation() + r_B_m;
        PointResidual one;
        one.scan = of_scan.scan;
        one.surface = Surface::kGround;
        // Noise along a ray with oblique incidence.
        one.sigma = kNoise_m * std::abs(point.n_B.dot(r_B_m)) / range_m;
        one.distance =
            point.at_m - point.n_B.dot(p_B_m) - calibration.clock_offset_s * point.speed_mps;
        one.by_calibration.segment<3>(kShiftOfMount) = -point.n_B;
        one.by_calibration.segment<3>(kTurnOfMount) = -r_B_m.cross(point.n_B);
        one.by_calibration[kRangeBias] = point.n_B.dot(r_B_m) / range_m / calibration.range_factor;
        one.by_calibration[kRangeFactor] = point.n_B.dot(r_B_m) / calibration.range_factor;
        one.by_calibration[kClockOffset] = -point.speed_mps;
        residuals.push_back(one);
      }
    }
    return residuals;
  }

  RegistrationBlock block_;
  std::vector<std::vector<PlanePoint>> scans_;
};

TEST(RegistrationSearch, FindsAMountBetweenWallsAsATermOfTheSensorsMechanism) {
  TrueSensor askew;
  askew.shift_B_m = {0.04, -0.06, 0.05};
  askew.rpy_deg = {1.2, -0.8, 2};
  const PlaneRoom room(askew, true);
  const RegistrationSearch search = SearchRegistration(room.block(), room.Points());
  ASSERT_EQ(search.findings.size(), 1u);
  const Finding& finding = search.findings[0];
  EXPECT_EQ(finding.term.candidate, &room.block().candidates[0]);
  EXPECT_EQ(finding.evidence.rivals, std::vector<const Candidate*>{finding.term.candidate});
  EXPECT_TRUE(finding.is_confirmed);
  EXPECT_TRUE(finding.term.held.empty());
  const double truth[] = {0.04, -0.06, 0.05, 1.2, -0.8, 2};
  for (std::size_t i = 0; i < 6; ++i) {
    // Five standard deviations, each of 1 cm over some hundred points.
    ASSERT_TRUE(finding.parameters[i].sigma);
    EXPECT_NEAR(finding.parameters[i].value, truth[i], 5 * *finding.parameters[i].sigma) << i;
    EXPECT_EQ(finding.parameters[i].name, finding.term.candidate->mechanism->parameters[i].name);
  }
  const SensorCalibration is = askew.Calibration(room.block().X_BS);
  EXPECT_NEAR((search.calibration.X_BT.translation() - is.X_BT.translation()).norm(), 0, 0.01);
  // The noise equals the stated one, and the excess is gone.
  EXPECT_NEAR(search.scale, 1, 0.25);
  EXPECT_GT(finding.held_out.excess_removed, 0.98);
}

TEST(RegistrationSearch, HoldsWhatAFloorAloneDoesNotTell) {
  TrueSensor askew;
  askew.rpy_deg = {1.2, -0.8, 0};
  const PlaneRoom room(askew, false);
  const Structure mount = {{&room.block().candidates[0], {0, 0, 0, 0, 0, 0}}};
  const RegistrationFit fit = FitRegistration(room.block(), room.Points().seen, mount, 1);
  // Neither the position along the plane nor the turn about its normal, which is no axis of S.
  EXPECT_FALSE(fit.precision[0][0].is_determined());
  EXPECT_FALSE(fit.precision[0][1].is_determined());
  EXPECT_FALSE(fit.precision[0][5].is_determined());
  EXPECT_THAT(fit.terms[0].held, ElementsAre(0, 1, 5));
  EXPECT_EQ(fit.terms[0].values[0], 0);
  EXPECT_EQ(fit.terms[0].values[5], 0);
  EXPECT_TRUE(fit.precision[0][2].is_determined());
  EXPECT_NEAR(fit.terms[0].values[3], 1.2, 5 * fit.precision[0][3].sigma);
  EXPECT_NEAR(fit.terms[0].values[4], -0.8, 5 * fit.precision[0][4].sigma);
}

TEST(RegistrationSearch, FindsAClockFarFromWhereItBegins) {
  TrueSensor late;
  late.clock_offset_s = 18.05;
  const PlaneRoom room(late, true, 0.1);
  const RegistrationSearch search = SearchRegistration(room.block(), room.Points());
  ASSERT_EQ(search.findings.size(), 1u);
  EXPECT_EQ(search.findings[0].term.candidate->mechanism->id, "clock_offset");
  EXPECT_NEAR(search.findings[0].term.values[0], 18.05, 0.02);
  EXPECT_NEAR(search.calibration.clock_offset_s, 18.05, 0.02);
}

TEST(RegistrationSearch, OfASensorAsDescribedFindsNothingAndTellsWhatItWouldHaveSeen) {
  const PlaneRoom room({}, true);
  const RegistrationSearch search = SearchRegistration(room.block(), room.Points());
  EXPECT_TRUE(search.findings.empty());
  EXPECT_TRUE(search.unconfirmed.empty());
  EXPECT_TRUE(search.found.empty());
  ASSERT_EQ(search.detectability.size(), 9u);
  for (const ParameterDetectability& one : search.detectability) {
    const bool is_clock = one.candidate->mechanism->id == "clock_offset";
    EXPECT_EQ(one.smallest.has_value(), !is_clock)
        << one.candidate->mechanism->id;  // nothing moves
  }
  // A bias b adds (b cos theta)^2 to the squared distance, whose noise is that of the range times
  // cos theta. The mean square grows by (b / noise)^2, of which 2 * 2 % suffice.
  const double smallest_m = *search.detectability[6].smallest;
  EXPECT_NEAR(smallest_m, search.scale * kNoise_m * std::sqrt(2 * 0.02), 0.01 * smallest_m);
}

TEST(RegistrationSearch, BeginsAtWhatWasFoundBefore) {
  TrueSensor askew;
  askew.rpy_deg = {0, 0, 2};
  const PlaneRoom room(askew, true);
  const Structure found = {{&room.block().candidates[0], {0, 0, 0, 0, 0, 2}}};
  const RegistrationSearch search = SearchRegistration(room.block(), room.Points(), found);
  ASSERT_EQ(search.findings.size(), 1u);
  EXPECT_NEAR(search.findings[0].term.values[5], 2, 5 * *search.findings[0].parameters[5].sigma);
}

}  // namespace
}  // namespace tera
