#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "own_folder.h"
#include "render/gl/rasterizer_stage.h"
#include "render/meshes/png_bytes.h"
#include "render/rays/ray_scene.h"
#include "sim/scenario/scenario_text.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

// Sites as cameras and lidars see them: a textured mesh with obstacles, and ground in the rain.

namespace tera {
namespace {

TEST(SiteMeshPicture, GroundAndWallShowTheirTexturesColours) {
  const std::filesystem::path& folder = OwnFolder();
  // Level ground, red to the west and green to the east, and a blue wall.
  const auto write = [&](const char* file, const std::string& text) {
    std::ofstream(folder / file, std::ios::binary) << text;
  };
  write("ground.png", testing_mesh::PngBytes({{{200, 30, 30}, {30, 200, 30}}}));
  write("wall.png", testing_mesh::PngBytes({{{30, 30, 200}}}));
  write("site.mtl", "newmtl ground\nmap_Kd ground.png\nnewmtl wall\nmap_Kd wall.png\n");
  write(
      "site.obj",
      "mtllib site.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "o ground\nv -8 -8 0\nv 8 -8 0\nv 8 8 0\nv -8 8 0\nusemtl ground\nf 1/1 2/2 3/3\n"
      "f 1/1 3/3 4/4\n"
      "o wall\nv -3 6 0\nv 3 6 0\nv 3 6 3\nv -3 6 3\nusemtl wall\nf 5/1 6/2 7/3\nf 5/1 7/3 8/4\n");
  const Config config = Config::FromText(
      "name: t\nduration_s: 1\nsettle_s: 0\nterrain: {cell_m: 0.1, soil: dirt}\n"
      "environment: {sun_azimuth_deg: 180, mesh: {file: " +
          (folder / "site.obj").string() +
          ", ground: {node: ground, cell_m: 0.2}, parts: [{node: wall, label: barrier}]}}\n"
          "machines:\n  - {name: m, machine: tera:config/machines/tb235.yaml, start: {xy_m: [0, "
          "-6]}, operator: {type: idle}}\n",
      "s.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const Simulation simulation(scenario);
  const SceneAssembly assembly(scenario);
  Rasterizer rasterizer(assembly.model(), {});
  SceneState state;
  state.X_WB = assembly.BodyPoses(simulation.state());
  state.terrain = &simulation.ground();
  const Pose X_WC = LookAt(Vec3(0, -2.5, 4), Vec3(0, 4.5, 0));
  const CameraFrame frame = rasterizer.Render(Pinhole(), X_WC, state);
  const auto strongest_at = [&](const Vec3& p_W_m, SemanticClass label) {
    const Vec2 px = Pinhole().Project(X_WC.inverse() * p_W_m);
    const int x = static_cast<int>(std::lround(px.x())), y = static_cast<int>(std::lround(px.y()));
    EXPECT_EQ(frame.semantic.at(x, y), static_cast<std::uint8_t>(label)) << p_W_m.transpose();
    int strongest = 0;
    for (int c = 1; c < 3; ++c) {
      if (frame.rgb.at(x, y, c) > frame.rgb.at(x, y, strongest)) strongest = c;
    }
    for (int c = 0; c < 3; ++c) {
      if (c == strongest) continue;
      EXPECT_GT(frame.rgb.at(x, y, strongest), 1.4 * frame.rgb.at(x, y, c)) << p_W_m.transpose();
    }
    return strongest;
  };
  EXPECT_EQ(strongest_at(Vec3(-3, 3, 0), SemanticClass::kTerrain), 0);
  EXPECT_EQ(strongest_at(Vec3(3, 3, 0), SemanticClass::kTerrain), 1);
  EXPECT_EQ(strongest_at(Vec3(1, 6, 1.5), SemanticClass::kBarrier), 2);
}

// Saturated soil reflects half as much lidar light as dry soil.
TEST(GroundInTheRain, DarkensForCamerasAndLidars) {
  const Config config = Config::FromText(
      "name: t\nduration_s: 1\nsettle_s: 0\nenvironment: {rain_mmph: 12, cloud_cover: 1}\n"
      "terrain: {size_m: [16, 16], cell_m: 0.1, soil: dirt, weather_before: [{hours: 9}]}\n"
      "machines:\n  - {name: m, machine: tera:config/machines/tb235.yaml, start: {xy_m: [0, "
      "-6]}, operator: {type: idle}}\n",
      "s.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const Simulation simulation(scenario);
  const SceneAssembly assembly(scenario);
  const auto soil = MakeSoil(*scenario.site, 1);
  Rasterizer rasterizer(assembly.model(), {});
  RayScene rays(assembly.model());
  SceneState state;
  state.X_WB = assembly.BodyPoses(simulation.state());
  state.terrain = &soil->surface();
  const Pose X_WC = LookAt(Vec3(0, -2.5, 4), Vec3(0, 4.5, 0));
  const Vec2 px = Pinhole().Project(X_WC.inverse() * Vec3(0, 3, 0));
  struct Look {
    double grey = 0, reflectance = 0, moisture = 0;
  };
  const auto look = [&] {
    const CameraFrame frame = rasterizer.Render(Pinhole(), X_WC, state);
    rays.Update({state.X_WB}, soil->surface());
    Look seen;
    for (int y = -5; y <= 5; ++y) {
      for (int x = -5; x <= 5; ++x) {
        for (int c = 0; c < 3; ++c) {
          seen.grey += frame.rgb.at(static_cast<int>(px.x()) + x, static_cast<int>(px.y()) + y, c);
        }
      }
    }
    const Ray ray{.origin_W_m = {0.03f, 3.02f, 3}, .direction_W = {0, 0, -1}};
    RayHit hit;
    rays.Trace({&ray, 1}, {&hit, 1}, 1);
    seen.reflectance = hit.reflectance;
    seen.moisture = soil->surface().at(80, 110).cover.moisture / 255.0;
    return seen;
  };
  const Look dry = look();
  soil->LetWeatherAct(1'800'000'000'000);
  const Look wet = look();
  EXPECT_LT(wet.grey, 0.85 * dry.grey);
  EXPECT_GT(wet.moisture, 0.8);
  EXPECT_NEAR(wet.reflectance / dry.reflectance,
              (1 - 0.5 * wet.moisture) / (1 - 0.5 * dry.moisture), 1e-3);
}

}  // namespace
}  // namespace tera
