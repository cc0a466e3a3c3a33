#include "resimulate/sensor_calibration.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "dataset/format/sample_recording.h"
#include "resimulate/recorded_cart.h"

namespace tera {
namespace {

TEST(CalibrationUnder, IsTheDocumentedMountWithWhatTheEffectsAddToIt) {
  const ScratchDirectory scratch;
  const Scenario scenario = CartScenario(scratch.path(), R"(
    rig:
      sensors:
        - {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: mast, xyz_m: [0.3, -0.2, 0.9],
           rpy_deg: [0, 10, 90]}
effects:
  cart1:
    lidar:
      extrinsic: {x_m: 0.05, z_m: -0.02, yaw_deg: 3}
      range_bias: {range_m: 0.04}
      clock_offset: {offset_s: 0.2}
)");
  const SensorDescription& lidar = scenario.machines[0].sensors.at(0);
  const SensorCalibration calibration = CalibrationUnder(lidar.X_BS, lidar.effects);
  EXPECT_LT((calibration.X_BT.translation() - Vec3(0.35, -0.2, 0.88)).norm(), 1e-9);
  // A turn about the axes of S follows the documented one.
  const Mat3 R_BT = RotationFromRpy(0, 10 * kDeg, 90 * kDeg) * RotationFromRpy(0, 0, 3 * kDeg);
  EXPECT_TRUE(calibration.X_BT.linear().isApprox(R_BT, 1e-9));
  EXPECT_DOUBLE_EQ(calibration.range_bias_m, 0.04);
  EXPECT_DOUBLE_EQ(calibration.range_factor, 1);
  EXPECT_DOUBLE_EQ(calibration.clock_offset_s, 0.2);
}

}  // namespace
}  // namespace tera
