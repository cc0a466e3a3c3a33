#include "diagnose/perception/pictures/picture_registration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "diagnose/perception/paint.h"
#include "diagnose/perception/true_sensor.h"

namespace tera {
namespace {

constexpr int kPictureRegistrationWidth = 160, kPictureRegistrationHeight = 120;
constexpr double kPictureRegistrationFocal_px = 140;

/// A picture of a wall across the optical axis, whose paint scales with its distance: the picture
/// is constant.
///
/// Frames  W; B the link; S the sensor; C optical.
PictureSource Wall(double away_m) {
  PictureSource source;
  source.X_BS = MakePose({0.4, -0.1, 0.9}, 0.02, 0.35, 0.1);
  Mat3 R_SC;
  R_SC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  source.X_SC.linear() = R_SC;
  source.t_ns = {7'000'000'000};
  SimulatedPicture picture{
      Image<float>(kPictureRegistrationWidth, kPictureRegistrationHeight),
      Image<float>(kPictureRegistrationWidth, kPictureRegistrationHeight),
      Image<std::uint8_t>(kPictureRegistrationWidth, kPictureRegistrationHeight)};
  for (int y = 0; y < kPictureRegistrationHeight; ++y) {
    for (int x = 0; x < kPictureRegistrationWidth; ++x) {
      picture.grey.at(x, y) = static_cast<float>(PaintAt(x / 14.0, y / 14.0));
      picture.depth_m.at(x, y) = static_cast<float>(away_m);
      picture.surface.at(x, y) = static_cast<std::uint8_t>(Surface::kObstacle);
    }
  }
  source.grey = {picture.grey};
  source.render = [picture](std::size_t, const SensorCalibration&) { return picture; };
  source.link_at = [](std::size_t, const SensorCalibration&) {
    BodyState link;
    link.X_WB = MakePose({3, 0.3, 1.6}, 0.01, -0.02, 0.7);
    return link;
  };
  source.project = [](const Vec3& p_C_m) {
    return Vec2(79.5 + kPictureRegistrationFocal_px * p_C_m.x() / p_C_m.z(),
                59.5 + kPictureRegistrationFocal_px * p_C_m.y() / p_C_m.z());
  };
  source.ray = [](const Vec2& px) -> std::optional<Vec3> {
    return Vec3((px.x() - 79.5) / kPictureRegistrationFocal_px,
                (px.y() - 59.5) / kPictureRegistrationFocal_px, 1);
  };
  return source;
}

/// Residuals of all landmarks on the wall.
std::vector<PointResidual> ResidualsOf(const PictureSource& source,
                                       const testing::TrueSensor& sensor, int level) {
  const PictureRegistration pictures(source, source.calibration());
  const ScanSplit split{{0}, {Part::kTrain}, 1};
  return pictures.ResidualsOf(pictures.PointsOf(split, {Part::kTrain}),
                              sensor.Calibration(source.X_BS), level);
}

double ShareJudged(const std::vector<PointResidual>& residuals) {
  double judged = 0;
  for (const PointResidual& r : residuals) judged += r.is_judged() ? 1 : 0;
  return judged / static_cast<double>(residuals.size());
}

TEST(PictureRegistration, JudgesNoLandmarkBeyondTheBorderOfThePicture) {
  const PictureSource source = Wall(6);
  EXPECT_GT(ResidualsOf(source, {}, 0).size(), 200u);
  EXPECT_EQ(ShareJudged(ResidualsOf(source, {}, 0)), 1);
  // A turn by half of the field of view moves half of the landmarks out of it. Some of the others
  // leave it above and below, since they are nearer to the edge.
  testing::TrueSensor turned;
  turned.rpy_deg.z() =
      std::atan(0.5 * kPictureRegistrationWidth / kPictureRegistrationFocal_px) / kDeg;
  for (const PointResidual& r : ResidualsOf(source, turned, 0)) {
    EXPECT_EQ(r.out_of_picture, !r.is_judged());
  }
  EXPECT_NEAR(ShareJudged(ResidualsOf(source, turned, 0)), 0.45, 0.07);
}

TEST(PictureRegistration, MovesALandmarkAcrossThePictureAsTheCameraIsShiftedAndTurned) {
  // A point near the axis, 6 m away. A shift of the camera by 1 cm to the right moves its image
  // left by 1 cm times the focal length over the distance. A turn by 1 deg to the left moves it
  // right by the focal length times the angle.
  const PictureSource source = Wall(6);
  const auto at = ResidualsOf(source, {}, 0);
  const auto derivative = [&](std::size_t i, const Vec3& axis_S, int element) {
    const Vec3 axis_B = source.X_BS.linear() * axis_S;
    return at[i].by_calibration.segment<3>(element).dot(axis_B);
  };
  std::size_t steep = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    // An edge along the picture's rows determines neither.
    const double per_m = derivative(i, -Vec3::UnitY(), kShiftOfMount);
    if (std::abs(per_m) < 0.9 * kPictureRegistrationFocal_px / 6) continue;
    ++steep;
    const double per_rad = derivative(i, Vec3::UnitZ(), kTurnOfMount);
    // A turn moves lateral points further, by the square of the tangent, at most a third here.
    EXPECT_LT(per_rad / per_m, -6 * 0.99);
    EXPECT_GT(per_rad / per_m, -6 * 1.35);
  }
  EXPECT_GT(steep, 20u);
}

TEST(PictureRegistration, TrustsWhatIsNearInBlurredPicturesByWhatAShiftOfTheCameraWouldMoveIt) {
  // A shift by 0.1 m moves a point on the axis by 0.1 m times the focal length over the distance.
  const auto near = ResidualsOf(Wall(2), {}, 3), far = ResidualsOf(Wall(20), {}, 3);
  ASSERT_EQ(near.size(), far.size());
  const double moves_px2 = std::pow(0.1 * kPictureRegistrationFocal_px, 2) * (1 / 4.0 - 1 / 400.0);
  // Off the axis also by a shift along it: at the corner, by a quarter more of the square.
  const double corner =
      0.5 * (80.0 * 80 + 60 * 60) / (kPictureRegistrationFocal_px * kPictureRegistrationFocal_px);
  std::size_t judged = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (!near[i].is_judged()) continue;
    const double more_px2 = near[i].sigma * near[i].sigma - far[i].sigma * far[i].sigma;
    EXPECT_GT(more_px2, 0.99 * moves_px2);
    EXPECT_LT(more_px2, 1.01 * (1 + corner) * moves_px2);
    ++judged;
  }
  EXPECT_GT(judged, 100u);
}

TEST(PictureRegistration, TrustsWhatIsNearAsMuchAsWhatIsFarInSharpPictures) {
  const auto near = ResidualsOf(Wall(2), {}, 0), far = ResidualsOf(Wall(20), {}, 0);
  ASSERT_EQ(near.size(), far.size());
  for (std::size_t i = 0; i < near.size(); ++i) EXPECT_NEAR(near[i].sigma, far[i].sigma, 1e-9);
}

}  // namespace
}  // namespace tera
