#include "resimulate/recorded_scans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ScansOfASample : public testing::Test {
 protected:
  ScansOfASample() { WriteWholeSample(folder(), {}); }
  std::filesystem::path folder() const { return scratch_.path() / "sample"; }

  static SensorDescription Lidar(std::size_t beams) {
    LidarModel lidar;
    lidar.elevation_rad.resize(beams);
    lidar.range_noise_m = 0.02;
    SensorDescription sensor;
    sensor.model = lidar;
    return sensor;
  }
  static SensorDescription Camera(int width_px, int height_px) {
    CameraModel camera;
    camera.depth = true;
    camera.intrinsics.width_px = width_px;
    camera.intrinsics.height_px = height_px;
    camera.intrinsics.fx_px = 20;
    camera.intrinsics.fy_px = 25;
    camera.intrinsics.cx_px = 15;
    camera.intrinsics.cy_px = 9;
    camera.baseline_m = 0.1;
    SensorDescription sensor;
    sensor.model = camera;
    return sensor;
  }

  const ScratchDirectory scratch_;
};

TEST_F(ScansOfASample, PointsOfADepthPictureLieWhereTheirPixelsLook) {
  const LoadedScan loaded =
      LoadRangeScan(Recording(folder()), "digger/front", Camera(33, 17), kSamplePeriod_ns);
  EXPECT_EQ(loaded.obstacle, "");
  EXPECT_EQ(loaded.scan.t_ns, kSamplePeriod_ns);
  ASSERT_EQ(loaded.scan.points.size(), 33u * 17u);
  // Pixel (20, 11) of the frame is 1 + 20 + 1100 + 1 mm away along the axis.
  const Vec3 p_S_m = loaded.scan.points[11 * 33 + 20].p_S_m;
  constexpr double kDepth_m = 1.122;
  EXPECT_NEAR(p_S_m.x(), kDepth_m, 1e-6);
  EXPECT_NEAR(p_S_m.y(), -kDepth_m * (20 - 15) / 20, 1e-6);  // right of the axis
  EXPECT_NEAR(p_S_m.z(), -kDepth_m * (11 - 9) / 25, 1e-6);   // and below it
}

TEST_F(ScansOfASample, AnotherCameraThanTheRecordedOneIsToldWithBothSizes) {
  const Recording recording(folder());
  const auto says = AllOf(HasSubstr("33 x 17"), HasSubstr("has 34 x 17"),
                          HasSubstr("need the camera that was recorded"));
  EXPECT_THAT(LoadRangeScan(recording, "digger/front", Camera(34, 17), 0).obstacle, says);
  EXPECT_THAT(LoadGreyPicture(recording, "digger/front", Camera(34, 17), 0, 1).obstacle, says);
  EXPECT_EQ(LoadGreyPicture(recording, "digger/front", Camera(33, 17), 0, 2).grey.width_px, 16);
}

TEST_F(ScansOfASample, PointsOfALidarHaveTheirTimesAndItsNoise) {
  const LidarScan sample = SampleScan(2);
  const LoadedScan loaded =
      LoadRangeScan(Recording(folder()), "digger/lidar", Lidar(64), 2 * kSamplePeriod_ns);
  EXPECT_EQ(loaded.obstacle, "");
  ASSERT_EQ(loaded.scan.points.size(), sample.points.size());
  const LidarPoint& last = sample.points.back();
  const RangePoint& point = loaded.scan.points.back();
  EXPECT_LT((point.p_S_m - Vec3(last.x_m, last.y_m, last.z_m)).norm(), 1e-5);
  EXPECT_EQ(point.since_ns, static_cast<TimeNs>(last.time_offset_ns));
  EXPECT_EQ(point.sigma_m, 0.02);
}

TEST_F(ScansOfASample, ALidarOfFewerBeamsIsToldWithTheScanAndTheRing) {
  EXPECT_THAT(LoadRangeScan(Recording(folder()), "digger/lidar", Lidar(16), 0).obstacle,
              AllOf(HasSubstr("scan 0"), HasSubstr("of ring"), HasSubstr("has 16 beams"),
                    HasSubstr("need the lidar that was recorded")));
}

}  // namespace
}  // namespace tera
