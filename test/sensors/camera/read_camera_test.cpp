#include <gtest/gtest.h>

#include "core/faults.h"
#include "sensors/camera/camera.h"
#include "sensors/sensor.h"

namespace tera {
namespace {

using enum FaultKind;

const std::string kCamera =
    "name: s, type: camera, link: b, rate_hz: 5, width_px: 64, height_px: 48, fx_px: 60, ";

CameraModel Read(const std::string& keys, std::string* resolved = nullptr) {
  const Config config = Config::FromText("sensor: {" + keys + "}", "rig.yaml");
  const SensorDescription s = ReadSensor(config.root().Map("sensor"));
  config.Finish();
  if (resolved != nullptr) *resolved = config.ResolvedYaml();
  return std::get<CameraModel>(s.model);
}

std::vector<InputFault> CameraRefusal(const std::string& keys,
                                      const std::string& camera = kCamera) {
  return FaultsIn([&] { Read(camera + keys); });
}

void ExpectRefused(const std::string& keys, const FaultsMatcher& fault) {
  EXPECT_THAT(CameraRefusal(keys), fault);
}

TEST(ReadCamera, AnImageSensorTakesThePlaceOfAPresetsNoise) {
  const std::string over =
      "name: s, link: b, preset: tera:config/sensors/rgb_640.yaml, image_sensor: {gain_db: 6}";
  std::string resolved;
  const CameraModel model = Read(over, &resolved);
  EXPECT_EQ(model.rgb_noise, 0);
  EXPECT_EQ(model.image_sensor->gain_db, 6);
  // The resolved text gives the same camera.
  const Config again = Config::FromText(resolved, "resolved.yaml");
  const SensorDescription s = ReadSensor(again.root().Map("sensor"));
  again.Finish();
  EXPECT_EQ(CameraModelYaml(std::get<CameraModel>(s.model)), CameraModelYaml(model));
}

TEST(ReadCamera, NoiseThatIsGivenBesideASensorIsStillRefused) {
  ExpectRefused("image_sensor: {gain_db: 6}, rgb_noise: 1", HasFault(kInconsistent, "rgb_noise"));
  EXPECT_THROW(Read("name: s, link: b, preset: tera:config/sensors/rgb_global_shutter.yaml, "
                    "rgb_noise: 1"),
               InputError);
}

TEST(ReadCamera, WhatIsWrittenReadsAsTheSame) {
  const CameraModel model = Read(
      kCamera +
      "image_sensor: {gain_db: 6}, object_labels: [exposure, load], labels: [instance, "
      "lens_soiling], optics: {focus_m: 3.5, glare: {scattered: 0.03, core_deg: 0.4, slope: 2.5}, "
      "flare: {ghosts: 3, reflectance: 0.02}, soiling: {distance_mm: 9, film: 0.1, specks: 7, "
      "speck_mm: 0.5, drops: 2, drop_mm: 3}}");
  EXPECT_EQ(model.optics->focus_m, 3.5);
  EXPECT_EQ(model.optics->flare->ghosts, 3);
  EXPECT_EQ(model.optics->soiling->speck_mm, 0.5);
  EXPECT_TRUE(model.object_labels.exposure && model.object_labels.load);
  const std::string text = CameraModelYaml(model);
  const Config again = Config::FromText(
      "sensor:\n  name: s\n  type: camera\n  link: b\n  rate_hz: 5\n" + text, "again.yaml");
  const SensorDescription s = ReadSensor(again.root().Map("sensor"));
  again.Finish();
  EXPECT_EQ(CameraModelYaml(std::get<CameraModel>(s.model)), text);
}

TEST(ReadCamera, OpticsThatCannotBeAreRefused) {
  const std::string sensor = "image_sensor: {gain_db: 0}, optics: ";
  ExpectRefused("optics: {focus_m: 2}", HasFault(kInconsistent, "optics"));
  ExpectRefused(sensor + "{}", HasFault(kMissing, "optics"));
  ExpectRefused(sensor + "{focus_m: 0}", HasFault(kOutOfRange, "optics.focus_m"));
  ExpectRefused(sensor + "{glare: {scattered: 0.7}}", HasFault(kOutOfRange, "scattered"));
  ExpectRefused(sensor + "{flare: {ghosts: 0}}", HasFault(kOutOfRange, "ghosts"));
  ExpectRefused(sensor + "{soiling: {drop_mm: 2}}", HasFault(kInconsistent));
  ExpectRefused(sensor + "{soiling: {film: 0.95}}", HasFault(kOutOfRange, "film"));
  ExpectRefused(sensor + "{gare: {}}", HasFault(kUnknown, "gare"));
}

TEST(ReadCamera, DepthSensorsThatCannotBeAreRefused) {
  const std::string depth = "depth: true, ";
  ExpectRefused("stereo: {}", HasFault(kInconsistent, "stereo"));
  ExpectRefused(depth + "stereo: {disparities_px: 40}", HasFault(kOutOfRange));
  ExpectRefused(depth + "stereo: {block_px: 4}", HasFault(kOutOfRange, "block_px"));
  ExpectRefused(depth + "stereo: {disparities_px: 64}", HasFault(kOutOfRange, "disparities_px"));
  ExpectRefused(depth + "k1: 0.1, stereo: {disparities_px: 16}", HasFault(kInconsistent));
  ExpectRefused(depth + "disparity_noise_px: 0.1, stereo: {disparities_px: 16}",
                HasFault(kInconsistent, "disparity_noise_px"));
  ExpectRefused(depth + "stereo: {disparities_px: 16}, time_of_flight: {}",
                HasFault(kInconsistent, "time_of_flight"));
  ExpectRefused(depth + "time_of_flight: {frequency_hz: 20}",
                HasFault(kOutOfRange, "frequency_hz"));
  std::string wide = kCamera;
  wide.replace(wide.find("64"), 2, "2000");
  EXPECT_THAT(CameraRefusal(depth + "time_of_flight: {parts: 5}", wide),
              HasFault(kInconsistent, "parts"));
  ExpectRefused(depth + "stereo: {disparities_px: 16, projector: {}}",
                HasFault(kMissing, "projector.intensity_cd"));
}

TEST(ReadCamera, AStereoMatcherTakesThePlaceOfAPresetsNoise) {
  const CameraModel model = Read(
      "name: s, link: b, preset: tera:config/sensors/realsense_d435i.yaml, stereo: "
      "{disparities_px: "
      "64, projector: {intensity_cd: 3000}}");
  EXPECT_EQ(model.disparity_noise_px, 0);
  EXPECT_EQ(model.stereo->disparities_px, 64);
  EXPECT_EQ(model.stereo->projector->intensity_cd, 3000);
}

TEST(ReadCamera, LabelsOfObjectsThatCannotBeAreRefused) {
  ExpectRefused("object_labels: [lod]", HasFault(kNoSuchName, "object_labels"));
  ExpectRefused("object_labels: [load], labels: [semantic]",
                HasFault(kInconsistent, "object_labels"));
  ExpectRefused("object_labels: [exposure]", HasFault(kInconsistent, "object_labels"));
}

}  // namespace
}  // namespace tera
