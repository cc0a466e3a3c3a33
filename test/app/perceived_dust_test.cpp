#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/perceived_site.h"
#include "core/random.h"
#include "core/units.h"
#include "dataset/format/pcd.h"
#include "dataset/format/recording.h"

namespace tera {
namespace {

using Json = nlohmann::json;

/// A ball of dust that a ray traverses with a probability that falls with its path length.
///
/// Frames  S of the lidar.
struct Ball {
  Vec3 centre_S_m = Vec3(4.5, -1.5, 0.2);
  double radius_m = 1.2;
  double mean_path_m = 3;  ///< to where a ray ends
  double from_s = 0, to_s = 1e9;
};

/// Range at which the ray ends; infinite if it passes.
double Stop_m(const Ball& ball, const Vec3& d_S, double draw) {
  const double along_m = d_S.dot(ball.centre_S_m);
  const double aside_m = (along_m * d_S - ball.centre_S_m).norm();
  const double never_m = std::numeric_limits<double>::infinity();
  if (along_m < 0 || aside_m > ball.radius_m) return never_m;
  const double half_m = std::sqrt(ball.radius_m * ball.radius_m - aside_m * aside_m);
  const double depth_m = -ball.mean_path_m * std::log(draw);
  return depth_m < 2 * half_m ? along_m - half_m + depth_m : never_m;
}

/// Puts dust into the scans of the mast's lidar.
void BlowDust(const std::filesystem::path& recording, const Ball& ball) {
  const std::string channel = "mast1/lidar";
  const Recording read(recording);
  const Stream dust(7, "test/dust");
  std::uint64_t draw = 0;
  for (const TimeNs t_ns : read.FrameTimes(channel)) {
    const double t_s = ToSeconds(t_ns - read.FrameTimes(channel).front());
    if (t_s < ball.from_s || t_s > ball.to_s) continue;
    std::vector<LidarPoint> points = read.LoadScan(channel, t_ns).points;
    for (LidarPoint& point : points) {
      const Vec3 p_S_m(point.x_m, point.y_m, point.z_m);
      const double stop_m = Stop_m(ball, p_S_m.normalized(), dust.Uniform(draw++));
      if (stop_m >= p_S_m.norm()) continue;
      const Vec3 stopped_S_m = stop_m * p_S_m.normalized();
      point.x_m = static_cast<float>(stopped_S_m.x());
      point.y_m = static_cast<float>(stopped_S_m.y());
      point.z_m = static_cast<float>(stopped_S_m.z());
    }
    std::ofstream(recording / channel / fmt::format("scans/{}.pcd", t_ns), std::ios::binary)
        << EncodePcd(points);
  }
}

/// The ball's centre on the site: the mast stands at (-1, 0.5), turned by 20 deg, its lidar 3 m
/// above, tilted by rpy 4, 20, 0 deg.
Vec2 CentreOf(const Ball& ball) {
  const Vec3 p_B_m = RotationFromRpy(4 * kDeg, 20 * kDeg, 0) * ball.centre_S_m;
  return Vec2(-1, 0.5) + Eigen::Rotation2Dd(20 * kDeg) * p_B_m.head<2>();
}

TEST_F(PerceivedSite, DustIsNamedWithItsPlace) {
  Record();
  const Ball ball;
  BlowDust(scratch_.path() / "real", ball);
  const Json json = Diagnosed();
  ASSERT_EQ(json["findings"].size(), 1u) << json["findings"];
  const Json& finding = json["findings"][0];
  EXPECT_EQ(finding["mechanism"], "dust");
  EXPECT_EQ(finding["target"], "air");
  EXPECT_NEAR(finding["place"]["centre_m"][0].get<double>(), CentreOf(ball).x(), 0.4);
  EXPECT_NEAR(finding["place"]["centre_m"][1].get<double>(), CentreOf(ball).y(), 0.4);
}

TEST_F(PerceivedSite, DustForAFewSecondsIsNamedWithItsTime) {
  Write("site.yaml", Edited(kSite, "duration_s: 14", "duration_s: 24"));
  Record();
  Ball ball;
  ball.from_s = 9;
  ball.to_s = 16;
  BlowDust(scratch_.path() / "real", ball);
  const Json json = Diagnosed();
  ASSERT_EQ(json["findings"].size(), 1u) << json["findings"];
  const Json& finding = json["findings"][0];
  EXPECT_EQ(finding["mechanism"], "dust");
  ASSERT_EQ(finding["intervals_s"].size(), 1u);
  EXPECT_NEAR(finding["intervals_s"][0][0].get<double>(), 9, 1);
  EXPECT_NEAR(finding["intervals_s"][0][1].get<double>(), 16, 1);
}

TEST_F(PerceivedSite, DustThatNothingIsLeftToConfirmIsToldAsThat) {
  Record();
  Ball ball;
  ball.from_s = 7;
  BlowDust(scratch_.path() / "real", ball);
  const Json json = Diagnosed();
  EXPECT_TRUE(json["findings"].empty()) << json["findings"];
  ASSERT_EQ(json["unconfirmed"].size(), 1u);
  EXPECT_EQ(json["unconfirmed"][0]["mechanism"], "dust");
}

}  // namespace
}  // namespace tera
