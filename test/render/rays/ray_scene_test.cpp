#include "render/rays/ray_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "render/hand_made_scene.h"

namespace tera {
namespace {

using testing::CubeMesh;
using testing::Ground;
using testing::NoGround;
using testing::OneBodyEach;
using testing::WallMesh;

RayHit TraceOne(const RayScene& scene, const Ray& ray) {
  RayHit hit;
  scene.Trace({&ray, 1}, {&hit, 1}, 1);
  return hit;
}

Ray RayFrom(const Vec3& origin_m, const Vec3& direction, double time = 0) {
  return {.origin_W_m = origin_m.cast<float>(),
          .direction_W = direction.normalized().cast<float>(),
          .max_range_m = 100,
          .time = static_cast<float>(time)};
}

double Relief(double x, double y) { return 0.4 * std::sin(1.3 * x) + 0.3 * std::cos(0.9 * y + x); }

TEST(RayScene, RangeToATiltedWallIsThatOfThePlane) {
  RayScene scene(OneBodyEach({WallMesh(20, 0.6)}));
  const Pose X_WB = MakePose({12, 3, 1}, 0.1, -0.3, 0.4);
  scene.Update({{X_WB}}, NoGround());
  const Vec3 n_W = X_WB.linear().col(0);
  for (int k = 0; k < 200; ++k) {
    const Vec3 origin(0.02 * k, 1 - 0.01 * k, 0.5);
    const Vec3 d = Vec3(1, std::sin(0.1 * k) * 0.6, std::cos(0.07 * k) * 0.4).normalized();
    const RayHit hit = TraceOne(scene, RayFrom(origin, d));
    ASSERT_TRUE(hit.hit) << k;
    EXPECT_NEAR(hit.range_m, n_W.dot(X_WB.translation() - origin) / n_W.dot(d), 1e-4);
    EXPECT_NEAR((hit.normal_W.cast<double>() + n_W).norm(), 0, 1e-5);
    EXPECT_FLOAT_EQ(hit.reflectance, 0.6f);
    EXPECT_EQ(hit.label, SemanticClass::kStructure);
    EXPECT_EQ(hit.instance, 1);
  }
}

TEST(RayScene, ItsYardsticksFindTheSameRanges) {
  RayScene scene(OneBodyEach({CubeMesh(0.8)}));
  scene.Update({{MakePose({3, 1, 1}, 0.2, 0.1, 0.5)}}, Ground(81, 81, 0.1, -4, Relief));
  std::vector<Ray> rays;
  for (int k = 0; k < 1003; ++k) {
    rays.push_back(RayFrom({0, 0, 2}, {std::cos(0.1 * k), std::sin(0.1 * k), 0.2 - 1e-3 * k}));
  }
  std::vector<RayHit> hits(rays.size());
  std::vector<float> singly_m(rays.size()), in_packets_m(rays.size());
  scene.Trace(rays, hits, 1);
  scene.TraceBareSingly(rays, singly_m);
  scene.TraceBareInPackets(rays, in_packets_m);
  int met = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(std::isfinite(in_packets_m[i]), hits[i].hit);
    if (!hits[i].hit) continue;
    ++met;
    EXPECT_EQ(in_packets_m[i], hits[i].range_m);
    EXPECT_NEAR(singly_m[i], hits[i].range_m, 1e-4);
  }
  EXPECT_GT(met, 500);
  EXPECT_LT(met, 1003);
}

TEST(RayScene, ARayMeetsAMovingBodyWhereItStandsAtTheRaysTime) {
  RayScene scene(OneBodyEach({WallMesh(5, 0.5)}));
  std::vector<std::vector<Pose>> poses;
  for (int k = 0; k <= 4; ++k) poses.push_back({MakePose({10 + 0.5 * k, 0, 2})});
  scene.Update(poses, NoGround());
  for (const double s : {0.0, 0.1, 0.37, 0.5, 0.99, 1.0}) {
    const RayHit hit = TraceOne(scene, RayFrom({1, 0, 2}, Vec3::UnitX(), s));
    ASSERT_TRUE(hit.hit) << s;
    EXPECT_NEAR(hit.range_m, 9 + 2 * s, 1e-4) << s;
  }
}

TEST(RayScene, ATurningWallKeepsItsShapeBetweenKeys) {
  // A wall that turns by 60 degrees between two poses: at a fraction s it is at 60 s degrees, with
  // its face 4 m from the axis.
  SceneModel model = OneBodyEach({WallMesh(3, 0.5)});
  model.nodes[0].X_BG = MakePose({4, 0, 0});
  RayScene scene(model);
  scene.Update({{MakePose({0, 0, 0})}, {MakePose({0, 0, 0}, 0, 0, 60 * kDeg)}}, NoGround());
  for (const double s : {0.05, 0.31, 0.5, 0.77}) {
    const double yaw = 60 * kDeg * s;
    const Vec3 n_W(std::cos(yaw), std::sin(yaw), 0);
    const RayHit hit = TraceOne(scene, RayFrom({0, 0, 0.3}, n_W, s));
    ASSERT_TRUE(hit.hit);
    EXPECT_NEAR(hit.range_m, 4, 1e-4);
    EXPECT_NEAR(hit.normal_W.cast<double>().dot(-n_W), 1, 1e-4);
  }
}

TEST(RayScene, TerrainIsTheTriangleMeshOfTheSurface) {
  RayScene scene(OneBodyEach({}));
  const TerrainSurface ground = Ground(121, 83, 0.05, -2.0, Relief);
  scene.Update({{}}, ground);
  const Stream stream(7, "places");
  for (int k = 0; k < 5000; ++k) {
    const double x = -2.0 + 0.05 * 120 * stream.Uniform(k, 0);
    const double y = -2.0 + 0.05 * 82 * stream.Uniform(k, 1);
    const Ray ray = RayFrom({x, y, 5}, -Vec3::UnitZ());
    const RayHit hit = TraceOne(scene, ray);
    ASSERT_TRUE(hit.hit) << x << " " << y;
    const double height_m = ground.HeightAt(ray.origin_W_m.x(), ray.origin_W_m.y());
    EXPECT_NEAR(5 - hit.range_m, height_m, 1e-5);
    EXPECT_EQ(hit.label, SemanticClass::kTerrain);
    EXPECT_EQ(hit.instance, 0);
  }
}

TEST(RayScene, NoRayFallsThroughTheSeamsOfTheTerrain) {
  RayScene scene(OneBodyEach({}));
  const TerrainSurface ground = Ground(121, 121, 0.05, -3.0, Relief);
  scene.Update({{}}, ground);
  for (int j = 1; j < 120; ++j) {
    for (int i = 1; i < 120; ++i) {
      const Vec3 vertex(-3.0 + 0.05 * i, -3.0 + 0.05 * j, 0);
      ASSERT_TRUE(TraceOne(scene, RayFrom(vertex + Vec3(0, 0, 5), -Vec3::UnitZ())).hit);
      const Vec3 edge = vertex + Vec3(0.025, 0, 5);
      ASSERT_TRUE(TraceOne(scene, RayFrom(edge, -Vec3::UnitZ())).hit);
    }
  }
}

TEST(RayScene, OnlyDirtyTilesAreRebuilt) {
  RayScene scene(OneBodyEach({}));
  TerrainSurface ground = Ground(151, 151, 0.05, 0.0, Relief);  // 3 x 3 tiles
  scene.Update({{}}, ground);
  EXPECT_EQ(scene.tiles_rebuilt(), 9);
  scene.Update({{}}, ground);
  EXPECT_EQ(scene.tiles_rebuilt(), 9);

  ground.Set(75, 75, {ground.height_m(75, 75) + 0.5f, {}});  // in the middle tile
  scene.Update({{}}, ground);
  EXPECT_EQ(scene.tiles_rebuilt(), 10);
  const RayHit hit = TraceOne(scene, RayFrom({3.75, 3.75, 5}, -Vec3::UnitZ()));
  EXPECT_NEAR(5 - hit.range_m, ground.height_m(75, 75), 1e-5);
}

TEST(RayScene, ATerrainOfAnotherSizeReplacesTheOldOne) {
  RayScene scene(OneBodyEach({}));
  scene.Update({{}}, Ground(101, 101, 0.05, 0.0, [](double, double) { return 1.0; }), {});
  scene.Update({{}}, Ground(51, 51, 0.05, 0.0, [](double, double) { return 2.0; }), {});
  EXPECT_NEAR(TraceOne(scene, RayFrom({1.01, 1.02, 5}, -Vec3::UnitZ())).range_m, 3, 1e-5);
}

TEST(RayScene, SoilInTheAirIsMetWhereItIsAndGoneWhenItHasLanded) {
  RayScene scene(OneBodyEach({}));
  TerrainSurface ground = Ground(51, 51, 0.05, 0.0, [](double, double) { return 0.0; });
  const Ray down = RayFrom({1.01, 1.02, 5}, -Vec3::UnitZ());
  ground.SetGrains({{{1.0f, 1.0f, 2.0f}, 0.1f, 7, 0, 0}, {{2.0f, 2.0f, 2.0f}, 0.1f, 8, 0, 0}});
  scene.Update({{}}, ground);
  const RayHit hit = TraceOne(scene, down);
  EXPECT_NEAR(hit.range_m, 5 - 2.1, 0.03);  // about a radius above its middle
  EXPECT_EQ(hit.label, SemanticClass::kTerrain);
  ground.SetGrains({});
  scene.Update({{}}, ground);
  EXPECT_NEAR(TraceOne(scene, down).range_m, 5, 1e-5);
}

TEST(RayScene, WetSoilIsDarkerToTheLidar) {
  SceneModel model = OneBodyEach({});
  model.soils[0].albedo = Vec3(0.5, 0.4, 0.3);
  RayScene scene(model);
  TerrainSurface ground = Ground(51, 51, 0.05, 0.0, [](double, double) { return 0.0; });
  scene.Update({{}}, ground);
  const Ray down = RayFrom({1.01, 1.02, 2}, -Vec3::UnitZ());
  EXPECT_NEAR(TraceOne(scene, down).reflectance, 1.2 * 0.5 + 0.04, 1e-6);  // the soil line
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) ground.Set(i, j, {0, {.moisture = 255}});
  }
  scene.Update({{}}, ground);
  EXPECT_NEAR(TraceOne(scene, down).reflectance, 0.32, 1e-6);
}

TEST(RayScene, WithoutALidarReflectanceTheMeanAlbedoCounts) {
  SceneModel model = OneBodyEach({WallMesh(5, -1)});
  model.meshes[0].parts[0].material.albedo = Vec3(0.9, 0.6, 0.3);
  RayScene scene(model);
  scene.Update({{MakePose({6, 0, 0})}}, NoGround());
  EXPECT_NEAR(TraceOne(scene, RayFrom({1, 0, 0.1}, Vec3::UnitX())).reflectance, 0.6, 1e-6);
}

// Green leaves absorb four fifths of visible light and return half of the near infrared.
TEST(RayScene, LeavesAreBrightToTheLidar) {
  SceneModel model = OneBodyEach({WallMesh(5, -1)});
  model.meshes[0].parts[0].material.albedo = Vec3(0.05, 0.1, 0.03);
  model.nodes[0].label = SemanticClass::kVegetation;
  const Ray ahead = RayFrom({1, 0, 0.1}, Vec3::UnitX());
  for (const auto& [stated, expected] : {std::pair(-1.0, 0.45), {0.3, 0.3}}) {
    model.meshes[0].parts[0].material.lidar_reflectance = stated;
    RayScene scene(model);
    scene.Update({{MakePose({6, 0, 0})}}, NoGround());
    EXPECT_NEAR(TraceOne(scene, ahead).reflectance, expected, 1e-6);
  }
}

// The soil line is 1.2 red + 0.04; no surface returns more light than it receives.
TEST(RayScene, SoilInABucketFollowsTheSoilLine) {
  SceneModel model = OneBodyEach({WallMesh(5, -1)});
  model.nodes[0].label = SemanticClass::kSoilInBucket;
  const Ray ahead = RayFrom({1, 0, 0.1}, Vec3::UnitX());
  for (const auto& [red, expected] : {std::pair(0.25, 0.34), {0.9, 1.0}}) {
    model.meshes[0].parts[0].material.albedo = Vec3(red, 0.1, 0.1);
    RayScene scene(model);
    scene.Update({{MakePose({6, 0, 0})}}, NoGround());
    EXPECT_NEAR(TraceOne(scene, ahead).reflectance, expected, 1e-6);
  }
}

TEST(RayScene, RainWetsWhatStandsInItButNotMetal) {
  // (1 - 0.02) (1 - 0.472) 0.6 / (1 - 0.472 0.6) by Lekner and Dorf.
  for (const auto& [metallic, expected] : {std::pair(0.0, 0.433), {1.0, 0.6}}) {
    SceneModel model = OneBodyEach({WallMesh(5, 0.6)});
    model.meshes[0].parts[0].material.metallic = metallic;
    model.environment.weather.rain_mmph = 8;
    RayScene scene(model);
    scene.Update({{MakePose({6, 0, 0})}}, NoGround());
    EXPECT_NEAR(TraceOne(scene, RayFrom({1, 0, 0.1}, Vec3::UnitX())).reflectance, expected, 1e-3);
  }
}

TEST(RayScene, AShapeIsMetAsItIsNowOrNotAtAll) {
  SceneModel model = OneBodyEach({CubeMesh(1)});
  model.shape_count = 1;
  model.nodes[0].shape = 0;
  RayScene scene(model);
  const auto cube = [](double half_m) {
    return std::make_shared<const ShapedMesh>(ShapedMesh{
        {half_m}, CubeMesh(half_m).parts, Vec3::Constant(-half_m), Vec3::Constant(half_m)});
  };
  const Pose X_WB = MakePose({8, 1, 0}, 0, 0, 90 * kDeg);
  const Ray ray = RayFrom({0, 1.1, 0.1}, Vec3::UnitX());
  scene.Update({{X_WB}}, NoGround(), {cube(1)});
  EXPECT_NEAR(TraceOne(scene, ray).range_m, 7, 1e-4);
  EXPECT_EQ(TraceOne(scene, ray).instance, 1);
  scene.Update({{X_WB}}, NoGround(), {cube(0.5)});
  EXPECT_NEAR(TraceOne(scene, ray).range_m, 7.5, 1e-4);
  scene.Update({{X_WB}}, NoGround(), {nullptr});
  EXPECT_FALSE(TraceOne(scene, ray).hit);
  scene.Update({{X_WB}}, NoGround());
  EXPECT_FALSE(TraceOne(scene, ray).hit);
  scene.Update({{X_WB}}, NoGround(), {cube(1)});
  EXPECT_NEAR(TraceOne(scene, ray).range_m, 7, 1e-4);
}

TEST(RayScene, BodiesThatShareMeshesKeepTheirOwnInstances) {
  SceneModel model = OneBodyEach({CubeMesh(0.5), CubeMesh(0.5)});
  model.nodes[1].mesh = 0;
  model.nodes[1].label = SemanticClass::kTrack;
  RayScene scene(model);
  scene.Update({{MakePose({5, 0, 0}), MakePose({0, 5, 0})}}, NoGround());
  const RayHit first = TraceOne(scene, RayFrom({0.1, 0.1, 0.1}, Vec3::UnitX()));
  const RayHit second = TraceOne(scene, RayFrom({0.1, 0.1, 0.1}, Vec3::UnitY()));
  EXPECT_EQ(first.instance, 1);
  EXPECT_EQ(first.label, SemanticClass::kStructure);
  EXPECT_EQ(second.instance, 2);
  EXPECT_EQ(second.label, SemanticClass::kTrack);
}

TEST(RayScene, InvisibleGlassLetsRaysPass) {
  SceneModel model = OneBodyEach({WallMesh(5, 0.5), WallMesh(5, 0.5)});
  model.meshes[0].parts[0].material.opacity = 0;
  RayScene scene(model);
  scene.Update({{MakePose({6, 0, 0}), MakePose({9, 0, 0})}}, NoGround());
  const RayHit hit = TraceOne(scene, RayFrom({1, 0, 0.1}, Vec3::UnitX()));
  EXPECT_NEAR(hit.range_m, 8, 1e-4);
  EXPECT_EQ(hit.instance, 2);
}

TEST(RayScene, TellsWhetherARayGoesIntoASolidOrComesOutOfItAndThroughWhat) {
  SceneModel model = OneBodyEach({CubeMesh(0.5)});
  model.meshes[0].parts[0].material.opacity = 0.25;
  RayScene scene(model);
  const Pose X_WB = MakePose({6, 2, 1}, 0.2, -0.1, 0.4);
  scene.Update({{X_WB}}, NoGround());
  const RayHit into = TraceOne(scene, RayFrom({0, 0, 0}, X_WB.translation()));
  const RayHit out = TraceOne(scene, RayFrom(X_WB.translation(), {0.3, -1, 0.2}));
  ASSERT_TRUE(into.hit && out.hit);
  EXPECT_FALSE(into.leaves);
  EXPECT_TRUE(out.leaves);
  EXPECT_EQ(into.opacity, 0.25f);
}

TEST(RayScene, TellsTheMemoryThatItsMeshesTake) {
  // A hundred further, different walls, each of at least four vertices and two triangles, with
  // three numbers of 4 bytes each. Released memory is not counted.
  std::vector<Mesh> walls;
  for (int k = 0; k < 101; ++k) walls.push_back(WallMesh(1 + 0.01 * k, 0.5));
  const RayScene one(OneBodyEach({walls.front()})), all(OneBodyEach(walls));
  EXPECT_GT(all.bytes() - one.bytes(), 100 * (4 + 2) * 3 * 4);
  EXPECT_LT(all.bytes() - one.bytes(), 100 * 100'000);
}

TEST(RayScene, LandAroundALevelSiteGoesOnAtItsLevel) {
  RayScene scene(OneBodyEach({}));
  const double level_m = -0.7;
  scene.Update({{}}, Ground(101, 101, 0.1, -5, [&](double, double) { return level_m; }), {});
  const Vec3 eye_m(1, -2, 2.5);
  for (int k = 0; k < 100; ++k) {
    // To a point 15 m to 45 m from the middle, outside the site of 10 m and before the hills begin.
    const double azimuth = 0.37 * k, far_m = 15 + 0.3 * k;
    const Vec3 target(far_m * std::cos(azimuth), far_m * std::sin(azimuth), level_m);
    const RayHit hit = TraceOne(scene, RayFrom(eye_m, target - eye_m));
    ASSERT_TRUE(hit.hit) << k;
    EXPECT_NEAR(hit.range_m, (target - eye_m).norm(), 1e-3) << k;
    EXPECT_EQ(hit.label, SemanticClass::kTerrain);
    EXPECT_GT(hit.reflectance, 0.05f);
  }
}

TEST(RayScene, HitsBeyondTheGreatestRangeAreNone) {
  RayScene scene(OneBodyEach({WallMesh(5, 0.5)}));
  scene.Update({{MakePose({6, 0, 0})}}, NoGround());
  Ray ray = RayFrom({1, 0, 0.1}, Vec3::UnitX());
  ray.max_range_m = 4.9f;
  EXPECT_FALSE(TraceOne(scene, ray).hit);
  ray.max_range_m = 5.1f;
  EXPECT_TRUE(TraceOne(scene, ray).hit);
}

TEST(RayScene, HitsDoNotDependOnTheNumberOfThreads) {
  RayScene scene(OneBodyEach({CubeMesh(0.7), WallMesh(2, 0.4)}));
  scene.Update({{MakePose({1, 2, 0.5}, 0.2, 0.1, 0.3), MakePose({3, 3, 1})},
                {MakePose({2, 2, 0.5}, 0.2, 0.4, 0.9), MakePose({3, 2, 1}, 0, 0, 1)}},
               Ground(121, 121, 0.05, 0.0, Relief));
  const Stream stream(3, "rays");
  std::vector<Ray> rays;
  for (int k = 0; k < 20000; ++k) {
    rays.push_back(RayFrom({3, 3, 3}, stream.Gaussian3(k, 0), stream.Uniform(k, 9)));
  }
  std::vector<RayHit> one(rays.size()), three(rays.size());
  scene.Trace(rays, one, 1);
  scene.Trace(rays, three, 3);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(one[i].hit, three[i].hit);
    ASSERT_EQ(one[i].range_m, three[i].range_m);
    ASSERT_EQ(one[i].normal_W, three[i].normal_W);
    ASSERT_EQ(one[i].instance, three[i].instance);
    hits += one[i].hit;
  }
  EXPECT_GT(hits, 5000);
}

}  // namespace
}  // namespace tera
