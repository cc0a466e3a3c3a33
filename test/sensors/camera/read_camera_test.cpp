#include <gtest/gtest.h>

#include "core/error.h"
#include "sensors/camera/camera.h"
#include "sensors/sensor.h"

namespace tera {
namespace {

const std::string kCamera =
    "name: s, type: camera, link: b, rate_hz: 5, width_px: 64, height_px: 48, fx_px: 60, ";

CameraModel Read(const std::string& keys, std::string* resolved = nullptr) {
  const Config config = Config::FromText("sensor: {" + keys + "}", "rig.yaml");
  const SensorDescription s = ReadSensor(config.root().Map("sensor"));
  config.Finish();
  if (resolved != nullptr) *resolved = config.ResolvedYaml();
  return std::get<CameraModel>(s.model);
}

std::string CameraRefusal(const std::string& keys, const std::string& camera = kCamera) {
  try {
    Read(camera + keys);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void ExpectRefused(const std::string& keys, const std::string& message) {
  EXPECT_NE(CameraRefusal(keys).find(message), std::string::npos) << CameraRefusal(keys);
}

TEST(ReadCamera, AnImageSensorTakesThePlaceOfAPresetsNoise) {
  const std::string over =
      "name: s, link: b, preset: tera:config/sensors/rgb_640.yaml, image_sensor: {gain_db: 6}";
  std::string resolved;
  const CameraModel model = Read(over, &resolved);
  EXPECT_EQ(model.rgb_noise, 0);
  EXPECT_EQ(model.image_sensor->gain_db, 6);
  // What was resolved reads as the same camera again.
  const Config again = Config::FromText(resolved, "resolved.yaml");
  const SensorDescription s = ReadSensor(again.root().Map("sensor"));
  again.Finish();
  EXPECT_EQ(CameraModelYaml(std::get<CameraModel>(s.model)), CameraModelYaml(model));
}

TEST(ReadCamera, NoiseThatIsGivenBesideASensorIsStillRefused) {
  ExpectRefused("image_sensor: {gain_db: 6}, rgb_noise: 1", "rgb_noise: given beside image_sensor");
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
  ExpectRefused("optics: {focus_m: 2}", "optics: changes the luminance before an image sensor");
  ExpectRefused(sensor + "{}", "optics: is empty; need some of focus_m, glare, flare and soiling");
  ExpectRefused(sensor + "{focus_m: 0}", "optics.focus_m: 0 is out of range, need 0.05 to");
  ExpectRefused(sensor + "{glare: {scattered: 0.7}}",
                "scattered: 0.7 is out of range, need 0 to 0.5");
  ExpectRefused(sensor + "{flare: {ghosts: 0}}", "ghosts: 0 is out of range, need 1 to 100");
  ExpectRefused(sensor + "{soiling: {drop_mm: 2}}", "the glass is clean; need one of them above 0");
  ExpectRefused(sensor + "{soiling: {film: 0.95}}", "film: 0.95 is out of range, need 0 to 0.9");
  ExpectRefused(sensor + "{gare: {}}", "gare: unknown key");
}

TEST(ReadCamera, DepthSensorsThatCannotBeAreRefused) {
  const std::string depth = "depth: true, ";
  ExpectRefused("stereo: {}", "stereo: makes depth, which is off; need depth: true");
  ExpectRefused(depth + "stereo: {disparities_px: 40}", "40 is no multiple of 16; need 32 or 48");
  ExpectRefused(depth + "stereo: {block_px: 4}", "4 is even; need 3 or 5");
  ExpectRefused(depth + "stereo: {disparities_px: 64}",
                "picture 64 px wide to be matched; need at most 32");
  ExpectRefused(depth + "k1: 0.1, stereo: {disparities_px: 16}", "needs pictures of a pinhole");
  ExpectRefused(depth + "disparity_noise_px: 0.1, stereo: {disparities_px: 16}",
                "disparity_noise_px: given beside stereo");
  ExpectRefused(depth + "stereo: {disparities_px: 16}, time_of_flight: {}",
                "time_of_flight: given beside stereo; keep one");
  ExpectRefused(depth + "time_of_flight: {frequency_hz: 20}", "frequency_hz: 20 is out of range");
  std::string wide = kCamera;
  wide.replace(wide.find("64"), 2, "2000");
  const std::string refusal = CameraRefusal(depth + "time_of_flight: {parts: 5}", wide);
  EXPECT_NE(refusal.find("2000 px wide or high are 10000 px; need 8192 px at most, 4 parts"),
            std::string::npos)
      << refusal;
  ExpectRefused(depth + "stereo: {disparities_px: 16, projector: {}}",
                "projector.intensity_cd: missing");
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
  ExpectRefused("object_labels: [lod]", "'lod' is no label of objects (did you mean 'load'?)");
  ExpectRefused("object_labels: [load], labels: [semantic]",
                "instance picture shows, which is off");
  ExpectRefused("object_labels: [exposure]", "'exposure' is that of an image sensor");
}

}  // namespace
}  // namespace tera
