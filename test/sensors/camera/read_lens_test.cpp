#include "sensors/camera/read_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <string>
#include <vector>

#include "core/faults.h"
#include "core/units.h"
#include "sensors/camera/camera.h"
#include "sensors/camera/camera_view.h"

// Lenses described by cameras' keys, against OpenCV's projections.

namespace tera {
namespace {

using enum FaultKind;

CameraIntrinsics LensOf(const std::string& keys) {
  const Config config = Config::FromText("lens: {" + keys + "}", "rig.yaml");
  const CameraIntrinsics lens = ReadLens(config.root().Map("lens"));
  config.Finish();
  return lens;
}

/// Faults of refused keys.
std::vector<InputFault> LensRefusal(const std::string& keys) {
  return FaultsIn([&] { LensOf(keys); });
}

const std::string kSize = "width_px: 640, height_px: 480, cx_px: 322.4, cy_px: 236.1, ";

/// Directions all over the front, up to `widest_deg` from the axis.
std::vector<cv::Point3d> Points(double widest_deg) {
  std::vector<cv::Point3d> points;
  for (int i = 0; i <= 30; ++i) {
    const double theta = widest_deg * kDeg * i / 30;
    for (int k = 0; k < 12; ++k) {
      const double about = (30 * k + 3) * kDeg, r_m = 2 + 0.1 * k;
      points.emplace_back(r_m * std::sin(theta) * std::cos(about),
                          r_m * std::sin(theta) * std::sin(about), r_m * std::cos(theta));
    }
  }
  return points;
}

cv::Matx33d MatrixOf(const CameraIntrinsics& c) {
  return {c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1};
}

void ExpectProjects(const CameraIntrinsics& lens, const std::vector<cv::Point3d>& points,
                    const std::vector<cv::Point2d>& expected_px) {
  ASSERT_EQ(points.size(), expected_px.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p_C(points[i].x, points[i].y, points[i].z);
    const Vec2 expected(expected_px[i].x, expected_px[i].y);
    EXPECT_LT((lens.Project(p_C) - expected).norm(), 1e-6) << p_C.transpose();
    // And back again.
    if (i >= 12) {
      EXPECT_LT((lens.Unproject(expected).normalized() - p_C.normalized()).norm(), 1e-7);
    }
  }
}

TEST(Lens, OfKannalaAndBrandtIsOpenCvsFisheye) {
  const CameraIntrinsics lens =
      LensOf(kSize +
             "fx_px: 181.3, fy_px: 179.9, lens: kannala_brandt, k1: 0.031, k2: -0.012, "
             "k3: 0.004, k4: -0.0007, field_of_view_deg: 200");
  const std::vector<cv::Point3d> points = Points(88);  // OpenCV divides by Z
  std::vector<cv::Point2d> expected_px;
  cv::fisheye::projectPoints(points, expected_px, cv::Vec3d::zeros(), cv::Vec3d::zeros(),
                             MatrixOf(lens), cv::Vec4d(0.031, -0.012, 0.004, -0.0007));
  ExpectProjects(lens, points, expected_px);
}

TEST(Lens, OfTheRationalModelIsOpenCvs) {
  const CameraIntrinsics lens =
      LensOf(kSize +
             "fx_px: 420, fy_px: 418, lens: rational, k1: 0.62, k2: 0.05, p1: 0.0011, "
             "p2: -0.0007, k3: 0.002, k4: 0.93, k5: 0.19, k6: 0.01");
  const std::vector<cv::Point3d> points = Points(50);
  std::vector<cv::Point2d> expected_px;
  const std::vector<double> coefficients = {0.62, 0.05, 0.0011, -0.0007, 0.002, 0.93, 0.19, 0.01};
  cv::projectPoints(points, cv::Vec3d::zeros(), cv::Vec3d::zeros(), MatrixOf(lens), coefficients,
                    expected_px);
  ExpectProjects(lens, points, expected_px);
}

// At 100 degrees, by hand: theta = 1.7453293; f-theta: 1.7453293 + 0.01 theta^2 - 0.02 theta^3 =
// 1.7453293 + 0.0304617 - 0.1063311 = 1.6694599; Kannala and Brandt's with the same: theta (1 +
// 0.01 theta^2 - 0.02 theta^4) = 1.7453293 (1 + 0.0304617 - 0.1855835) = 1.4745907. Times 150 px,
// along 30 degrees from x.
TEST(Lens, OfAnAngleSeesBehindItself) {
  const double theta = 100 * kDeg;
  const Vec3 d_C(std::sin(theta) * std::cos(30 * kDeg), std::sin(theta) * std::sin(30 * kDeg),
                 std::cos(theta));
  const auto radius_px = [&](const std::string& law) {
    CameraIntrinsics lens;
    lens.kind = law == "f_theta" ? LensKind::kFTheta : LensKind::kKannalaBrandt;
    lens.fx_px = lens.fy_px = 150;
    lens.k1 = 0.01;
    lens.k2 = -0.02;
    lens.field_rad = 200 * kDeg;
    const Vec2 pixel = lens.Project(d_C);
    EXPECT_NEAR(std::atan2(pixel.y(), pixel.x()), 30 * kDeg, 1e-12);
    return pixel.norm();
  };
  EXPECT_NEAR(radius_px("f_theta"), 150 * 1.6694599, 1e-4);
  EXPECT_NEAR(radius_px("kannala_brandt"), 150 * 1.4745907, 1e-4);
}

TEST(Lens, EveryPixelWithinTheFieldHasTheRayThatProjectsToIt) {
  for (const std::string law : {"kannala_brandt", "f_theta"}) {
    const CameraIntrinsics lens = LensOf(kSize + "horizontal_fov_deg: 190, k1: 0.02, k2: -0.01, " +
                                         "field_of_view_deg: 200, lens: " + law);
    int with = 0, without = 0;
    for (int v = 0; v < 480; v += 5) {
      for (int u = 0; u < 640; u += 5) {
        const auto ray_C = lens.RayOf(Vec2(u, v));
        ++(ray_C ? with : without);
        if (!ray_C) continue;
        EXPECT_NEAR(ray_C->norm(), 1, 1e-12);
        EXPECT_LT((lens.Project(*ray_C) - Vec2(u, v)).norm(), 1e-6);
      }
    }
    EXPECT_GT(with, 5000);
    EXPECT_GT(without, 200);  // the corners
  }
}

TEST(Lens, HorizontalFieldIsThatOfTheKey) {
  const CameraIntrinsics lens = LensOf(
      "width_px: 640, height_px: 480, horizontal_fov_deg: 180, lens: kannala_brandt, k1: "
      "0.05");
  const Vec3 border_C = lens.Unproject(Vec2(-0.5, 239.5));
  EXPECT_NEAR(std::atan2(border_C.x(), border_C.z()), -90 * kDeg, 1e-9);
}

TEST(Lens, ThatFoldsWithinItsPictureIsRefusedWhereItSaysSo) {
  // theta - theta^3 / 2 is greatest at 0.816 rad, 0.54 focal lengths off the axis.
  const std::string folding = kSize + "fx_px: 300, lens: kannala_brandt, k1: -0.5";
  EXPECT_THAT(LensRefusal(folding), HasFault(kInconsistent, "lens.k1"));
  EXPECT_THAT(LensRefusal(folding + ", field_of_view_deg: 90"), ::testing::IsEmpty())
      << "it folds beyond its field";
  EXPECT_THAT(LensRefusal(kSize + "fx_px: 900, lens: kannala_brandt, k1: -0.5"),
              ::testing::IsEmpty())
      << "it folds beyond its picture";
  EXPECT_THAT(LensRefusal(kSize + "fx_px: 330, lens: rational, k1: -0.6"),
              ::testing::Not(::testing::IsEmpty()));
}

TEST(Lens, ThatFoldsBeforeItsFieldEndsIsRefusedByItsField) {
  // theta - 5 theta^3 is below 0 from 0.447 rad on.
  const auto refusal = LensRefusal(kSize + "horizontal_fov_deg: 120, lens: kannala_brandt, k1: -5");
  EXPECT_THAT(refusal, HasFault(kInconsistent, "lens.horizontal_fov_deg"));
}

TEST(Lens, KeysOfAnotherLawAreUnknown) {
  EXPECT_THAT(LensRefusal(kSize + "fx_px: 300, lens: kannala_brandt, p1: 0.1"),
              HasFault(kUnknown, "p1"));
  EXPECT_THAT(LensRefusal(kSize + "fx_px: 300, k4: 0.1"), HasFault(kUnknown, "k4"));
  EXPECT_THAT(LensRefusal(kSize + "fx_px: 300, lens: fisheye"), HasFault(kNoSuchName, "lens.lens"));
  EXPECT_THAT(LensRefusal(kSize + "fx_px: 300, lens: f_theta, field_of_view_deg: 210"),
              HasFault(kOutOfRange, "field_of_view_deg"));
}

TEST(Lens, IsWrittenSoThatItIsReadAgain) {
  for (const std::string keys :
       {"fx_px: 331, k1: -0.05, p2: 0.001",
        "fx_px: 331, fy_px: 330, lens: rational, k1: 0.1, k6: 0.02",
        "fx_px: 170, lens: kannala_brandt, k1: 0.03, k4: -0.001, field_of_view_deg: 170",
        "fx_px: 170, lens: f_theta, k1: 0.01, k3: 0.002, field_of_view_deg: 199"}) {
    const CameraIntrinsics lens = LensOf(kSize + keys);
    CameraIntrinsics again = ReadLens(Config::FromText(LensYaml(lens), "sensor.yaml").root());
    EXPECT_NEAR(again.field_rad, lens.field_rad, 1e-12);
    again.field_rad = lens.field_rad;
    EXPECT_EQ(again, lens) << LensYaml(lens);
  }
}

// Equidistant lens: sin(theta) / theta, at 60 degrees 0.82699, at 90 degrees 2 / pi.
TEST(Lens, IlluminationFallsWithTheSolidAngleThatAPixelSees) {
  const CameraIntrinsics lens =
      LensOf("width_px: 601, height_px: 601, fx_px: 150, lens: f_theta, field_of_view_deg: 190");
  EXPECT_NEAR(lens.Illumination(Vec2(300, 300)), 1, 1e-9);
  EXPECT_NEAR(lens.Illumination(Vec2(300 + 150 * 60 * kDeg, 300)), 0.82699, 1e-5);
  EXPECT_NEAR(lens.Illumination(Vec2(300, 300 - 150 * 90 * kDeg)), 2 / kPi, 1e-6);
  EXPECT_EQ(lens.Illumination(Vec2(300, 300 - 150 * 96 * kDeg)), 0);
  const CameraIntrinsics pinhole = LensOf("width_px: 601, height_px: 601, fx_px: 300");
  EXPECT_NEAR(pinhole.Illumination(Vec2(600, 300)), 0.25, 1e-9);  // cos^4 of 45 degrees
}

TEST(Lens, OfAnAngleHasAllItsPixelsInAllDirections) {
  CameraModel model;
  model.intrinsics = LensOf(
      "width_px: 320, height_px: 240, fx_px: 85, lens: kannala_brandt, k1: 0.02, k2: -0.01, "
      "field_of_view_deg: 200");
  int pixels = 0;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) pixels += model.intrinsics.RayOf(Vec2(u, v)).has_value();
  }
  const ViewField field = ViewOf(model, 10);
  EXPECT_FALSE(field.by_depth);
  constexpr int kRings = 1200, kAround = 500;
  double sum = 0;
  for (int r = 0; r < kRings; ++r) {
    const double off_axis = kPi * (r + 0.5) / kRings, side = std::sin(off_axis);
    for (int a = 0; a < kAround; ++a) {
      const double about = 2 * kPi * (a + 0.5) / kAround;
      sum += side * field.per_steradian(
                        Vec3(std::cos(off_axis), side * std::cos(about), side * std::sin(about)));
    }
  }
  EXPECT_NEAR(sum * kPi / kRings * 2 * kPi / kAround, pixels, 0.006 * pixels);
}

}  // namespace
}  // namespace tera
