#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <span>

#include "core/config/config.h"
#include "core/units.h"
#include "render/gl/rasterizer.h"
#include "render/rays/ray_scene.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

// The load of a bucket, as cameras and lidars see it.

namespace tera {
namespace {

class LoadedBucket : public ::testing::TestWithParam<const char*> {
 protected:
  LoadedBucket() : scenario_(Read(GetParam())), assembly_(scenario_) {
    Simulation simulation(scenario_);
    state_ = simulation.state();
    ground_ = simulation.ground();
    const MachineModel& machine = scenario_.machines[0].placement.model;
    bucket_ = machine.LinkIndex("bucket");
    // Only the bucket is turned mouth upwards and lifted, with slight pitch and roll.
    state_.machines[0].links[bucket_].X_WB = MakePose(
        Vec3(3, 4, 2.5), RotationFromRpy(0, 0, 0.6) * RotationFromRpy(0.07, kPi - 0.15, 0));
  }
  static Scenario Read(const std::string& machine) {
    const Config config = Config::FromText(
        "name: t\nduration_s: 1\nterrain: {size_m: [24, 24], cell_m: 0.2, soils: [clay, sand]}\n"
        "machines:\n  - {name: m, machine: tera:config/machines/" +
            machine + ".yaml, start: {xy_m: [-4, -3], yaw_deg: 30}, operator: {type: idle}}\n",
        "s.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return scenario;
  }
  void Fill(double share, double sand_share) {
    SoilReaction::Load& load = state_.machines[0].shovel_load[0];
    load.volume_m3 = share * shovel().capacity_m3;
    const double kg = 1400 * load.volume_m3;
    load.mass_kg = kg;
    load.soil_kg = {(1 - sand_share) * kg, sand_share * kg};
  }
  const Shovel& shovel() const {
    return scenario_.machines[0].placement.model.ground_tools.shovels[0];
  }
  /// From above and behind the mouth.
  Pose X_WC() const {
    const Vec3 target_W = state_.machines[0].links[bucket_].X_WB * Vec3(0.45, 0, 0.1);
    const Vec3 eye_W =
        target_W + 1.6 * std::cbrt(shovel().capacity_m3 / 0.11) * Vec3(-0.6, 0.5, 1.1).normalized();
    Mat3 R;
    R.col(2) = (target_W - eye_W).normalized();
    R.col(0) = R.col(2).cross(Vec3::UnitZ()).normalized();
    R.col(1) = R.col(2).cross(R.col(0));
    return MakePose(eye_W, R);
  }
  static CameraIntrinsics Camera() {
    return {
        .width_px = 480, .height_px = 360, .fx_px = 420, .fy_px = 420, .cx_px = 240, .cy_px = 180};
  }
  CameraFrame Shoot() {
    if (!rasterizer_) rasterizer_.emplace(assembly_.model(), EglOptions{});
    SceneState scene;
    scene.X_WB = assembly_.BodyPoses(state_);
    scene.terrain = &ground_;
    scene.shapes = assembly_.ShapesOf(state_);
    return rasterizer_->Render(Camera(), X_WC(), scene);
  }
  static const ObjectBox* SoilIn(const CameraFrame& frame) {
    for (const ObjectBox& box : frame.boxes) {
      if (box.label == SemanticClass::kSoilInBucket) return &box;
    }
    return nullptr;
  }

  Scenario scenario_;
  SceneAssembly assembly_;
  Instant state_;
  TerrainSurface ground_;
  int bucket_ = 0;
  std::optional<Rasterizer> rasterizer_;
};

TEST_P(LoadedBucket, PictureAndLidarAgreeOnItsSurfaceWithAnyNumberOfThreads) {
  Fill(0.8, 0.5);
  const CameraFrame frame = Shoot();
  const ObjectBox* soil = SoilIn(frame);
  ASSERT_NE(soil, nullptr);
  RayScene rays(assembly_.model());
  rays.Update({assembly_.BodyPoses(state_)}, ground_, assembly_.ShapesOf(state_));
  const CameraIntrinsics camera = Camera();
  const Pose X_WC = this->X_WC();
  std::vector<Ray> looks;
  std::vector<double> depth_m;
  for (int y = 1; y + 1 < camera.height_px; y += 3) {
    for (int x = 1; x + 1 < camera.width_px; x += 3) {
      bool inside = true;  // all pixels around, so that no edge is near
      for (int d = 0; d < 9; ++d) {
        inside = inside && frame.instance.at(x + d % 3 - 1, y + d / 3 - 1) == soil->instance;
      }
      if (!inside) continue;
      const Vec3 d_C((x - camera.cx_px) / camera.fx_px, (y - camera.cy_px) / camera.fy_px, 1);
      looks.push_back({.origin_W_m = X_WC.translation().cast<float>(),
                       .direction_W = (X_WC.linear() * d_C.normalized()).cast<float>()});
      depth_m.push_back(frame.depth_m.at(x, y) * d_C.norm());
    }
  }
  ASSERT_GT(looks.size(), 500u);
  std::vector<RayHit> hits(looks.size()), again(looks.size());
  rays.Trace(looks, hits, 1);
  rays.Trace(looks, again, 2);
  for (std::size_t k = 0; k < looks.size(); ++k) {
    EXPECT_EQ(hits[k].instance, soil->instance);
    EXPECT_EQ(hits[k].label, SemanticClass::kSoilInBucket);
    EXPECT_NEAR(hits[k].range_m, depth_m[k], 0.002);
    EXPECT_EQ(hits[k].range_m, again[k].range_m);
    EXPECT_EQ(hits[k].normal_W, again[k].normal_W);
  }
}

TEST_P(LoadedBucket, ShowsMoreTheFullerItIsAndNothingWhenEmpty) {
  EXPECT_EQ(SoilIn(Shoot()), nullptr);
  double before_m = 0;
  for (const double share : {0.1, 0.4, 0.8, 1.0}) {
    Fill(share, 0);
    const CameraFrame frame = Shoot();
    const ObjectBox* soil = SoilIn(frame);
    ASSERT_NE(soil, nullptr) << share;
    EXPECT_GT(soil->size_O_m.z(), before_m + 0.02) << share;
    before_m = soil->size_O_m.z();
  }
}

TEST_P(LoadedBucket, TakesTheColourOfWhatWasDug) {
  const auto brightness_of = [&](double sand_share) {
    Fill(0.9, sand_share);
    const CameraFrame frame = Shoot();
    const ObjectBox* soil = SoilIn(frame);
    EXPECT_NE(soil, nullptr);
    double brightness = 0;
    for (std::size_t p = 0; p < frame.instance.data.size(); ++p) {
      if (frame.instance.data[p] == soil->instance) brightness += frame.rgb.data[3 * p];
    }
    return brightness / static_cast<double>(soil->visible_px);
  };
  const double clay = brightness_of(0), half = brightness_of(0.5), sand = brightness_of(1);
  EXPECT_GT(half, clay + 3);
  EXPECT_GT(sand, half + 3);
}

INSTANTIATE_TEST_SUITE_P(OfTwoMachines, LoadedBucket, ::testing::Values("tb235", "excavator20t"));

}  // namespace
}  // namespace tera
