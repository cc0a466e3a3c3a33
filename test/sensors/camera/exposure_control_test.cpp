#include "sensors/camera/exposure_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/config/config.h"
#include "core/config/model_archive.h"
#include "core/faults.h"
#include "core/units.h"
#include "sensors/camera/image_sensor.h"

namespace tera {
namespace {

using enum FaultKind;

constexpr int kWidth = 80, kHeight = 60;

CameraIntrinsics LongLens() {
  return {.width_px = kWidth,
          .height_px = kHeight,
          .fx_px = 1e5,
          .fy_px = 1e5,
          .cx_px = 39.5,
          .cy_px = 29.5};
}

/// Almost without noise, and linear over many stops.
ImageSensorModel ExposureControlPlain() {
  ImageSensorModel model;
  model.exposure_s = 0.001;
  model.full_well_e = 1e8;
  model.read_noise_e = 0;
  model.dark_current_eps = 0;
  model.bits = 16;
  model.black_dn = 0;
  return model;
}

Image<float> Flat(const Vec3& luminance_cdpm2) {
  Image<float> picture(kWidth, kHeight, 3);
  for (std::size_t i = 0; i < picture.data.size(); ++i) {
    picture.data[i] = static_cast<float>(luminance_cdpm2[static_cast<Eigen::Index>(i % 3)]);
  }
  return picture;
}

/// A camera's sensor with its control, taking successive pictures.
class Controlled {
 public:
  explicit Controlled(const ImageSensorModel& model)
      : model_(model),
        sensor_(model, LongLens(), 1, "m/camera"),
        control_(model.auto_exposure, model.auto_white_balance, sensor_.UsualSettings()) {}

  PictureSettings Take(const Image<float>& luminance) {
    const PictureSettings used = control_.Settings();
    raw_ = sensor_.Expose(luminance, k_++, used);
    const MeteringZone all;
    control_.Take(
        sensor_.Meter(raw_, model_.auto_exposure ? model_.auto_exposure->zone : all),
        sensor_.Meter(raw_, model_.auto_white_balance ? model_.auto_white_balance->zone : all));
    return used;
  }
  double Signal() const { return sensor_.Meter(raw_, {}).signal; }
  /// The luminance that fills this share of the range at the start.
  double LuminanceFor(double signal) const {
    return signal * sensor_.white_cdpm2(sensor_.UsualSettings());
  }
  const ImageSensor& sensor() const { return sensor_; }
  const Image<std::uint16_t>& raw() const { return raw_; }

 private:
  ImageSensorModel model_;
  ImageSensor sensor_;
  ExposureControl control_;
  Image<std::uint16_t> raw_;
  std::int64_t k_ = 0;
};

// The error in EV of picture j is that of the start times (1 - rate)^floor(j / delay): from 0.02 to
// the target 0.16 are three stops.
TEST(ExposureControl, AnErrorDecaysByItsRateEachDelay) {
  ImageSensorModel model = ExposureControlPlain();
  model.auto_exposure = AutomaticExposure{};
  model.auto_exposure->target = 0.16;
  model.auto_exposure->rate = 0.4;
  model.auto_exposure->delay_pictures = 3;
  Controlled camera(model);
  const Image<float> scene = Flat(Vec3::Constant(camera.LuminanceFor(0.02)));
  for (int j = 0; j < 24; ++j) {
    const PictureSettings used = camera.Take(scene);
    const double error_ev = 3 * std::pow(0.6, j / 3);
    EXPECT_NEAR(std::log2(used.exposure_s / 0.001), 3 - error_ev, 0.01) << j;
    EXPECT_NEAR(std::log2(0.16 / camera.Signal()), error_ev, 0.01) << j;
    EXPECT_EQ(used.gain_db, 0) << j;
  }
}

// Eight stops too dark: five of exposure, up to 0.032 s, and 18.06 dB of the gain's 20.
TEST(ExposureControl, GainHelpsWhereTheLongestExposureIsNotEnough) {
  ImageSensorModel model = ExposureControlPlain();
  model.auto_exposure = AutomaticExposure{};
  model.auto_exposure->target = 0.256;
  model.auto_exposure->rate = 1;
  model.auto_exposure->delay_pictures = 1;
  model.auto_exposure->longest_s = 0.032;
  model.auto_exposure->most_gain_db = 20;
  Controlled camera(model);
  const Image<float> dark = Flat(Vec3::Constant(camera.LuminanceFor(0.001)));
  PictureSettings used;
  for (int j = 0; j < 6; ++j) used = camera.Take(dark);
  EXPECT_NEAR(used.exposure_s, 0.032, 1e-12);
  EXPECT_NEAR(used.gain_db, 20 * std::log10(8), 0.1);
  EXPECT_NEAR(camera.Signal(), 0.256, 0.004);
  // Too bright for its shortest exposure: it stays saturated.
  for (int j = 0; j < 12; ++j) used = camera.Take(Flat(Vec3::Constant(camera.LuminanceFor(400))));
  EXPECT_NEAR(used.exposure_s, model.auto_exposure->shortest_s, 1e-12);
  EXPECT_EQ(used.gain_db, 0);
}

TEST(ExposureControl, OnlyItsZoneIsMetered) {
  ImageSensorModel model = ExposureControlPlain();
  model.auto_exposure = AutomaticExposure{};
  model.auto_exposure->zone = {.left = 0.5, .top = 0, .right = 1, .bottom = 1};
  Controlled camera(model);
  Image<float> scene = Flat(Vec3::Constant(camera.LuminanceFor(0.05)));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth / 2; ++x) {
      for (int c = 0; c < 3; ++c) scene.at(x, y, c) *= 50;
    }
  }
  PictureSettings used;
  for (int j = 0; j < 30; ++j) used = camera.Take(scene);
  EXPECT_NEAR(used.exposure_s, 0.001 * 0.18 / 0.05, 2e-5);
}

// Under light of twice the red and half the blue of daylight, grey becomes grey again.
TEST(ExposureControl, WhiteBalanceMakesGreyOfALightsColour) {
  ImageSensorModel model = ExposureControlPlain();
  model.quantum_efficiency = Vec3(0.4, 0.6, 0.5);
  model.auto_white_balance = AutomaticWhiteBalance{};
  Controlled camera(model);
  const double green = camera.LuminanceFor(0.1);
  const Image<float> warm = Flat(Vec3(2 * green, green, 0.5 * green));
  PictureSettings used = camera.Take(warm);
  EXPECT_NEAR(used.balance[0], 0.6 / 0.4, 1e-12);  // of daylight, before the first picture
  for (int j = 0; j < 30; ++j) used = camera.Take(warm);
  EXPECT_NEAR(used.balance[0], 0.6 / 0.4 / 2, 2e-3);
  EXPECT_NEAR(used.balance[2], 0.6 / 0.5 * 2, 5e-3);
  const Image<std::uint8_t> rgb = camera.sensor().Develop(camera.raw(), used);
  EXPECT_NEAR(rgb.at(40, 30, 0), rgb.at(40, 30, 1), 1);
  EXPECT_NEAR(rgb.at(40, 30, 2), rgb.at(40, 30, 1), 1);
}

TEST(ExposureControl, BalanceStaysWithinItsLimits) {
  ImageSensorModel model = ExposureControlPlain();
  model.auto_white_balance = AutomaticWhiteBalance{};
  model.auto_white_balance->most = 1.5;
  Controlled camera(model);
  const double green = camera.LuminanceFor(0.1);
  PictureSettings used;
  for (int j = 0; j < 30; ++j) used = camera.Take(Flat(Vec3(4 * green, green, 0.2 * green)));
  EXPECT_NEAR(used.balance[0], 1 / 1.5, 1e-12);
  EXPECT_NEAR(used.balance[2], 1.5, 1e-12);
}

/// Faults of an image sensor's keys; empty if accepted.
std::vector<InputFault> Refusal(const std::string& keys) {
  return FaultsIn([&] {
    const Config config = Config::FromText("image_sensor: {" + keys + "}", "rig.yaml");
    ReadModel<ImageSensorModel>(config.root().Map("image_sensor"));
    config.Finish();
  });
}

TEST(ExposureControl, KeysReachTheModelAndItsFile) {
  const std::string exposure =
      "{zone: [0.1, 0.2, 0.8, 0.9], delay_pictures: 4, rate: 0.25, target: 0.2, shortest_s: "
      "0.0001, longest_s: 0.008, least_gain_db: 2, most_gain_db: 12}";
  const Config config = Config::FromText(
      "image_sensor: {auto_exposure: " + exposure +
          ", auto_white_balance: {zone: [0, 0.5, 1, 1], delay_pictures: 5, rate: 0.1, most: 3}}",
      "rig.yaml");
  const std::string file =
      ModelYaml(ReadModel<ImageSensorModel>(config.root().Map("image_sensor")), 4);
  config.Finish();
  for (const std::string line :
       {"zone: [0.1, 0.2, 0.8, 0.9]", "delay_pictures: 4", "rate: 0.25", "target: 0.2",
        "shortest_s: 0.0001", "longest_s: 0.008", "least_gain_db: 2", "most_gain_db: 12",
        "zone: [0, 0.5, 1, 1]", "delay_pictures: 5", "rate: 0.1", "most: 3"}) {
    EXPECT_NE(file.find("      " + line + "\n"), std::string::npos) << line << "\n" << file;
  }
}

TEST(ExposureControl, WhatCannotBeIsRefusedWithTheRemedy) {
  EXPECT_THAT(Refusal("auto_exposure: {zone: [0.5, 0, 0.5, 1]}"),
              HasOnlyFault(kMissing, "auto_exposure.zone"));
  EXPECT_THAT(Refusal("auto_exposure: {shortest_s: 0.01, longest_s: 0.001}"),
              HasOnlyFault(kInconsistent, "image_sensor.auto_exposure.longest_s"));
  EXPECT_THAT(Refusal("auto_exposure: {delay_pictures: 0}"),
              HasOnlyFault(kOutOfRange, "auto_exposure.delay_pictures"));
  EXPECT_THAT(Refusal("auto_exposure: {least_gain_db: 10, most_gain_db: 5}"),
              HasOnlyFault(kInconsistent, "auto_exposure.most_gain_db"));
  EXPECT_THAT(Refusal("auto_white_balance: {rate: 0}"),
              HasOnlyFault(kOutOfRange, "auto_white_balance.rate"));
  EXPECT_THAT(Refusal("auto_white_balance: {most: 0.5}"),
              HasOnlyFault(kOutOfRange, "auto_white_balance.most"));
  EXPECT_THAT(Refusal("auto_exposure: {}"), ::testing::IsEmpty());
}

}  // namespace
}  // namespace tera
