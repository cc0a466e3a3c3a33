#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "sensors/slots/frame_slots.h"
#include "sensors/slots/given_effects.h"

namespace tera {
namespace {

using testing::ExpectNear, testing::Given;

LidarScan ScanReported(const std::string& effects, LidarScan scan) {
  FrameSlots slots(Given(EffectTarget::kLidar, effects), 3, "m/lidar");
  slots.Apply(0, slots.Stamp(0, scan.t_ns), &scan);
  return scan;
}

LidarScan Points(double t_s = 0) {
  LidarScan scan;
  scan.t_ns = FromSeconds(t_s);
  scan.points = {{.x_m = 3, .y_m = 4, .z_m = 0}, {.x_m = 0, .y_m = 0, .z_m = -2}};  // 5 m and 2 m
  return scan;
}

void ExpectPoint(const LidarPoint& p, const Vec3& wanted) {
  ExpectNear({p.x_m, p.y_m, p.z_m}, wanted, 1e-5);
}

TEST(RangeErrors, OfALidarMoveItsPointsAlongTheirBeams) {
  LidarScan scan = ScanReported("{range_bias: {range_m: 0.5}}", Points());
  ExpectPoint(scan.points.at(0), {3.3, 4.4, 0});
  ExpectPoint(scan.points.at(1), {0, 0, -2.5});
  scan = ScanReported("{scale: {range_factor: 1.1}}", Points());
  ExpectPoint(scan.points.at(0), {3.3, 4.4, 0});
  ExpectPoint(scan.points.at(1), {0, 0, -2.2});
  scan = ScanReported("{range_bias: {range_m: 0.3}, quantisation: {range_step_m: 0.5}}", Points());
  ExpectPoint(scan.points.at(0), {3.3, 4.4, 0});
  ExpectPoint(scan.points.at(1), {0, 0, -2.5});
  scan = ScanReported("{temperature_drift: {warm_up_k: -50, time_constant_s: 2, range_mpk: -0.01}}",
                      Points(100));
  ExpectPoint(scan.points.at(0), {3.3, 4.4, 0});
  // A range behind the sensor is no return.
  scan = ScanReported("{range_bias: {range_m: -3}}", Points());
  ASSERT_EQ(scan.points.size(), 1u);
  ExpectPoint(scan.points.at(0), {1.2, 1.6, 0});
}

TEST(RangeErrors, OutliersOfALidarComeAsOftenAndAsLargeAsSaid) {
  LidarScan scan;
  scan.points.assign(20000, {.x_m = 0, .y_m = 60, .z_m = 80});  // 100 m
  scan = ScanReported("{outliers: {probability: 0.05, range_m: 4}}", std::move(scan));
  int wild = 0;
  double squares = 0;
  for (const LidarPoint& p : scan.points) {
    if (p.z_m == 80) continue;
    ++wild;
    squares += std::pow(std::hypot(p.y_m, p.z_m) - 100, 2);
  }
  // Five standard errors: 5 sqrt(0.05 * 0.95 / 20000); 5 / sqrt(2 * 1000).
  EXPECT_NEAR(wild / 20000.0, 0.05, 0.0077);
  EXPECT_NEAR(std::sqrt(squares / wild), 4, 4 * 0.112);
}

std::vector<float> DepthReported(const std::string& effects, std::vector<float> depth_m) {
  FrameSlots slots(Given(EffectTarget::kCamera, effects), 3, "m/camera");
  CameraFrame frame;
  frame.depth_m = Image<float>(static_cast<int>(depth_m.size()), 1);
  frame.depth_m.data = std::move(depth_m);
  slots.Apply(0, slots.Stamp(0, 0), &frame);
  return frame.depth_m.data;
}

TEST(RangeErrors, OfACameraChangeItsDepthButNotWhereThereIsNone) {
  using Depths = std::vector<float>;
  EXPECT_EQ(DepthReported("{range_bias: {depth_m: 0.5}}", {0, 2, 4}), (Depths{0, 2.5f, 4.5f}));
  EXPECT_EQ(DepthReported("{scale: {depth_factor: 1.25}}", {0, 2, 4}), (Depths{0, 2.5f, 5}));
  EXPECT_EQ(DepthReported("{quantisation: {depth_step_m: 0.5}}", {0, 2.2f, 4.3f}),
            (Depths{0, 2, 4.5f}));
  EXPECT_EQ(DepthReported("{range_bias: {depth_m: -3}}", {0, 2, 4}), (Depths{0, 0, 1}));
  const Depths wild = DepthReported("{outliers: {probability: 0.1, depth_m: 0.5}}",
                                    std::vector<float>(10000, 100.0f));
  int count = 0;
  double squares = 0;
  for (const float z_m : wild) {
    count += z_m != 100;
    squares += (z_m - 100.0) * (z_m - 100.0);
  }
  EXPECT_NEAR(count / 10000.0, 0.1, 0.015);  // five standard errors
  EXPECT_NEAR(std::sqrt(squares / count), 0.5, 0.5 * 0.112);
}

}  // namespace
}  // namespace tera
