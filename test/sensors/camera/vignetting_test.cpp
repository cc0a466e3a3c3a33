#include "sensors/camera/vignetting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "sensors/camera/image_sensor.h"

namespace tera {
namespace {

// Two discs of one radius, their centres that radius apart, share 2 pi / 3 - sqrt(3) / 2 of its
// square.
TEST(Vignetting, IsTheCommonAreaOfRimAndPupil) {
  const LensRim rim{.radius_mm = 5, .distance_mm = 5};
  EXPECT_NEAR(PupilShare(rim, 5, 45 * kDeg), (2 * kPi / 3 - std::sqrt(3) / 2) / kPi, 1e-12);
  EXPECT_EQ(PupilShare(rim, 5, 0), 1);
  EXPECT_EQ(PupilShare(rim, 5, std::atan(2.001)), 0);
  EXPECT_EQ(PupilShare(rim, 5, 90 * kDeg), 0);
  EXPECT_NEAR(PupilShare(rim, 10, 10 * kDeg), 0.25, 1e-12);  // all of the rim
  EXPECT_EQ(PupilShare(rim, 2, std::atan(0.59)), 1);         // all of the pupil
}

// A lens of 8 mm (fx 2000 px of 4 um): at f/2 its pupil has a radius of 2 mm, at f/8 half a
// millimetre. A rim of 2.5 mm, 4 mm in front, does not shade the smaller one where tan(angle) is
// below 1/2.
TEST(Vignetting, GoesWhereTheLensIsStoppedDown) {
  const CameraIntrinsics lens = {.width_px = 161,
                                 .height_px = 3,
                                 .fx_px = 2000,
                                 .fy_px = 2000,
                                 .cx_px = -840,
                                 .cy_px = 1};  // the last pixel is at tan 1/2
  const auto corner_over_cos4 = [&](double f_number) {
    ImageSensorModel model;
    model.filter.reset();
    model.bits = 16;
    model.full_well_e = 1e8;  // noise of a ten-thousandth
    model.black_dn = 0;
    model.pixel_um = 4;
    model.f_number = f_number;
    const auto signal = [&](const std::optional<LensRim>& rim) {
      model.rim = rim;
      const ImageSensor sensor(model, lens, 1, "m/camera");
      Image<float> flat(161, 3, 3);
      std::fill(flat.data.begin(), flat.data.end(),
                static_cast<float>(0.5 * sensor.white_cdpm2(sensor.UsualSettings())));
      return sensor.Expose(flat, 0).at(160, 1, 1);
    };
    return static_cast<double>(signal(LensRim{.radius_mm = 2.5, .distance_mm = 4})) /
           signal(std::nullopt);
  };
  // Discs of 2 and 2.5 mm, 2 mm apart: chord 0.4375 mm from the pupil's centre.
  const double pupil = 4 * (std::acos(0.21875) - 0.21875 * std::sqrt(1 - 0.21875 * 0.21875));
  const double edge = 6.25 * (std::acos(0.625) - 0.625 * std::sqrt(1 - 0.625 * 0.625));
  EXPECT_NEAR(corner_over_cos4(2), (pupil + edge) / (4 * kPi), 2e-3);
  EXPECT_NEAR(corner_over_cos4(8), 1, 2e-3);
}

}  // namespace
}  // namespace tera
