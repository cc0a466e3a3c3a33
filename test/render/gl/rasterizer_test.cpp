#include "render/gl/rasterizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.h"
#include "core/units.h"
#include "rasterizer_stage.h"

namespace tera {
namespace {

using enum FaultKind;

TEST(Rasterizer, SendsOnlyChangedTiles) {
  Stage stage;
  stage.SetTerrain(Ground(200, 0.1, Waves));
  Rasterizer rasterizer(stage.model, EglOptions{});
  const Pose X_WC = LookAt(kEye, kTarget);
  rasterizer.Render(Pinhole(), X_WC, stage.state);
  EXPECT_EQ(rasterizer.uploaded_tiles(), 16);
  rasterizer.Render(Pinhole(), X_WC, stage.state);
  EXPECT_EQ(rasterizer.uploaded_tiles(), 16);
  // A hill in the middle of tile (1, 1), which spans (-5, -5) to (0, 0).
  stage.terrain.Set(75, 75, {stage.terrain.height_m(75, 75) + 0.5f, {}});
  const CameraFrame after = rasterizer.Render(Pinhole(), X_WC, stage.state);
  EXPECT_EQ(rasterizer.uploaded_tiles(), 17);
  EXPECT_EQ(after.rgb.data, stage.Shoot(Pinhole(), X_WC).rgb.data)
      << "a picture must not depend on which pictures came before";
}

TEST(Rasterizer, SoilInTheAirIsSeenWhereItIs) {
  Stage stage;
  stage.SetTerrain(Ground(200, 0.1, Level));
  stage.terrain.SetGrains({{{0.0f, 0.0f, 1.0f}, 0.2f, 3, 0, 0}});
  const CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0, -5, 1), Vec3(0, 0, 1));
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  const Vec2 p = camera.Project(X_WC.inverse() * Vec3(0, 0, 1));
  const int u = static_cast<int>(std::lround(p.x())), v = static_cast<int>(std::lround(p.y()));
  EXPECT_NEAR(frame.depth_m.at(u, v), 5 - 0.2, 0.06);
  EXPECT_EQ(frame.semantic.at(u, v), static_cast<int>(SemanticClass::kTerrain));
  const int beside = static_cast<int>(0.4 / 5 * camera.fx_px);
  EXPECT_GT(frame.depth_m.at(u + beside, v), 5.5);
}

TEST(Rasterizer, CoarserTilesStayWithinTheirHeightError) {
  Stage stage;
  stage.SetTerrain(Ground(400, 0.1, Waves));
  const CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(2, -18, 6), Vec3(0, 5, 0));
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  int checked = 0;
  for (int v = 20; v < 240; v += 6) {
    for (int u = 10; u < 310; u += 6) {
      const double z_m = frame.depth_m.at(u, v);
      if (z_m <= 0) continue;
      const Vec3 p_W = X_WC * Vec3(camera.Unproject(Vec2(u, v)) * z_m);
      if (p_W.head<2>().cwiseAbs().maxCoeff() > 19) continue;
      EXPECT_NEAR(p_W.z(), stage.terrain.HeightAt(p_W.x(), p_W.y()), 0.02 + 1e-3);
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(Rasterizer, ABoxShadesTheGroundAwayFromTheSun) {
  Stage stage;
  stage.SetTerrain(Ground(200, 0.1, Level));
  stage.model.environment.to_sun_W = Vec3(1, 0, 1).normalized();
  stage.AddBox(MakePose(Vec3(0, 0, 1)), Vec3(0.5, 0.5, 1.0), SemanticClass::kRock);
  const CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0.2, -8, 7), Vec3(0, 0, 0));
  const auto grey = [&](const CameraFrame& f, double x, double y) {
    const Vec2 p = camera.Project(X_WC.inverse() * Vec3(x, y, 0));
    double sum = 0;
    for (int v = -2; v <= 2; ++v) {
      for (int u = -2; u <= 2; ++u) sum += Grey(f, std::lround(p.x()) + u, std::lround(p.y()) + v);
    }
    return sum / 25;
  };
  // Sun at 45 degrees from +x, box 2 m high: the shadow reaches from x = -0.5 to -2.5 m.
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  EXPECT_LT(grey(frame, -1.5, 0), 0.75 * grey(frame, 1.8, 0));
  EXPECT_LT(grey(frame, -2.2, 0), 0.75 * grey(frame, 1.8, 0));
  EXPECT_NEAR(grey(frame, -3.2, 0), grey(frame, 2.4, 0), 0.15 * grey(frame, 2.4, 0));
  // With the sun on the other side, the shadow changes sides.
  stage.model.environment.to_sun_W = Vec3(-1, 0, 1).normalized();
  const CameraFrame other = stage.Shoot(camera, X_WC);
  EXPECT_LT(grey(other, 1.5, 0), 0.75 * grey(other, -1.8, 0));
}

TEST(Rasterizer, TheGroundShadesItself) {
  Stage stage;
  // A wall of earth 1 m high along y at x = 0; sun at 45 degrees from +x.
  stage.SetTerrain(
      Ground(200, 0.1, [](double x, double) { return std::abs(x) < 0.25 ? 1.0 : 0.0; }));
  stage.model.environment.to_sun_W = Vec3(1, 0, 1).normalized();
  const CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0.2, -6, 8), Vec3(0, 0, 0));
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  const auto grey = [&](double x) {
    double sum = 0;
    for (int k = -10; k <= 10; ++k) {
      const Vec2 p = camera.Project(X_WC.inverse() * Vec3(x, 0.1 * k, 0));
      sum += Grey(frame, std::lround(p.x()), std::lround(p.y()));
    }
    return sum / 21;
  };
  EXPECT_LT(grey(-0.8), 0.8 * grey(1.5));
  EXPECT_NEAR(grey(-2.0), grey(2.0), 0.12 * grey(2.0));
}

TEST(Rasterizer, AShapeIsDrawnAsItIsNowWithItsOwnBoxOrNotAtAll) {
  Stage stage;
  stage.AddBox(MakePose(kTarget), Vec3(0.4, 0.4, 0.4), SemanticClass::kSoilInBucket);
  stage.model.shape_count = 1;
  stage.model.nodes.back().shape = 0;
  stage.model.instances.back().shape = 0;
  Rasterizer rasterizer(stage.model, EglOptions{});
  const Pose X_WC = LookAt(kEye, kTarget);
  const auto boxes = [&](double half_m) {
    const Vec3 half = Vec3::Constant(half_m);
    stage.state.shapes = {nullptr};
    if (half_m > 0) {
      stage.state.shapes[0] = std::make_shared<const ShapedMesh>(
          ShapedMesh{{half_m}, BoxMesh(half, Vec3(0.3, 0.2, 0.1)).parts, -half, half});
    }
    return rasterizer.Render(Pinhole(), X_WC, stage.state).boxes;
  };
  const auto whole = boxes(0.4), half = boxes(0.2);
  ASSERT_EQ(whole.size(), 1u);
  ASSERT_EQ(half.size(), 1u);
  // Half the size is a quarter of the area, a little less as the near side recedes.
  EXPECT_NEAR(static_cast<double>(half[0].visible_px) / static_cast<double>(whole[0].visible_px),
              0.25, 0.03);
  EXPECT_NEAR(half[0].visibility, 1, 0.02);
  EXPECT_TRUE(half[0].size_O_m.isApprox(Vec3::Constant(0.4)));
  EXPECT_TRUE(boxes(0).empty());
  EXPECT_EQ(boxes(0.4)[0].visible_px, whole[0].visible_px);
}

TEST(Rasterizer, AWholeHasTheBoxAndThePixelsOfItsParts) {
  Stage stage;
  stage.AddBox(MakePose(kTarget), Vec3(0.4, 0.4, 0.4), SemanticClass::kUpperStructure);
  // Rotated, so that its box along the first one's axes exceeds its own.
  const Pose X_W2 = MakePose(kTarget + Vec3(0.9, 0, 0.3), 0, 0, 45 * kDeg);
  stage.AddBox(X_W2, Vec3(0.2, 0.2, 0.2), SemanticClass::kBoom);
  stage.AddBox(MakePose(kTarget + Vec3(-2, 0, 0)), Vec3(0.1, 0.1, 0.1), SemanticClass::kCone);
  const auto whole = static_cast<std::uint16_t>(stage.model.instances.size());
  stage.model.instances[1].parent = stage.model.instances[2].parent = whole;
  stage.model.instances.push_back({.name = "machine",
                                   .label = SemanticClass::kVehicle,
                                   .body = stage.model.instances[1].body,
                                   .is_whole = true});
  Rasterizer rasterizer(stage.model, EglOptions{});
  const Pose X_WC = LookAt(kEye, kTarget);
  for (const CameraIntrinsics& camera : {Pinhole(), WideLens()}) {
    const auto boxes = rasterizer.Render(camera, X_WC, stage.state).boxes;
    ASSERT_EQ(boxes.size(), 4u);
    const ObjectBox &a = boxes[0], &b = boxes[1], &machine = boxes[3];
    EXPECT_EQ(machine.instance, whole);
    EXPECT_EQ(machine.name, "machine");
    EXPECT_EQ(machine.parent, 0);
    EXPECT_EQ(a.parent, whole);
    EXPECT_EQ(boxes[2].parent, 0);
    EXPECT_EQ(machine.visible_px, a.visible_px + b.visible_px);
    EXPECT_EQ(machine.x_min_px, std::min(a.x_min_px, b.x_min_px));
    EXPECT_EQ(machine.y_max_px, std::max(a.y_max_px, b.y_max_px));
    EXPECT_NEAR(machine.visibility, 1, 0.02);  // one part in front of the other occludes nothing of
                                               // the whole
    // From -0.4 to 0.9 + 0.2 sqrt(2) along x, 0.4 to both sides, from -0.4 to 0.5 upwards.
    EXPECT_TRUE(machine.size_O_m.isApprox(Vec3(1.3 + 0.2 * std::sqrt(2.0), 0.8, 0.9), 1e-5))
        << machine.size_O_m.transpose();
    const Vec3 centre_W = X_WC * machine.X_CO.translation();
    EXPECT_TRUE(centre_W.isApprox(kTarget + Vec3(0.25 + 0.1 * std::sqrt(2.0), 0, 0.05), 1e-5));
  }
}

TEST(Rasterizer, VerticesMayHaveColoursOfTheirOwn) {
  Stage stage;
  stage.AddBox(MakePose(kTarget), Vec3(0.4, 0.4, 0.4), SemanticClass::kStructure);
  MeshPart& part = stage.model.meshes.back().parts[0];
  part.material.albedo = Vec3(0.9, 0.9, 0.9);
  part.albedos.assign(part.positions_m.size(), Eigen::Vector3f(0.5f, 0.05f, 0.05f));
  Rasterizer rasterizer(stage.model, EglOptions{});
  const CameraFrame frame = rasterizer.Render(Pinhole(), LookAt(kEye, kTarget), stage.state);
  EXPECT_GT(frame.rgb.at(163, 118, 0), 2 * frame.rgb.at(163, 118, 1));
}

TEST(Rasterizer, NothingNearerThanNearOrDeeperThanFarIsMeasured) {
  Stage stage;
  stage.AddBox(MakePose(Vec3(0, 3, 1)), Vec3(5, 0.05, 5), SemanticClass::kStructure);
  CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0, 0, 1), Vec3(0, 3, 1));
  EXPECT_NEAR(stage.Shoot(camera, X_WC).depth_m.at(160, 120), 2.95, 1e-3);
  camera.far_m = 2.5;
  EXPECT_EQ(stage.Shoot(camera, X_WC).depth_m.at(160, 120), 0.0f);
  camera = Pinhole();
  camera.near_m = 4.0;
  EXPECT_EQ(stage.Shoot(camera, X_WC).instance.at(160, 120), 0);
}

TEST(Rasterizer, TheSameSceneGivesTheSameBytes) {
  Stage stage;
  stage.SetTerrain(Ground(100, 0.1, Waves));
  stage.AddBox(MakePose(kTarget, 0.1, 0.2, 0.3), Vec3(0.4, 0.5, 0.6), SemanticClass::kRock);
  const Pose X_WC = LookAt(kEye, kTarget);
  const CameraFrame a = stage.Shoot(WideLens(), X_WC), b = stage.Shoot(WideLens(), X_WC);
  EXPECT_EQ(a.rgb.data, b.rgb.data);
  EXPECT_EQ(a.depth_m.data, b.depth_m.data);
  EXPECT_EQ(a.instance.data, b.instance.data);
}

TEST(Rasterizer, FogLeavesTwoPercentContrastAtTheVisibility) {
  // A black and a white plate at range V. In fog, the difference of their radiances falls to 2 % of
  // that in clear air. The exposure keeps the tone curve from saturation. The comparison uses the
  // sRGB difference, below 6 % of full scale for so small a contrast.
  Stage stage;
  const Vec3 half_m(20, 0.1, 20);
  stage.AddBox(MakePose(Vec3(-25, 200, 25)), half_m, SemanticClass::kStructure, Vec3::Zero());
  stage.AddBox(MakePose(Vec3(25, 200, 25)), half_m, SemanticClass::kStructure, Vec3(1, 1, 1));
  stage.model.environment.to_sun_W = Vec3(0, -1, 1).normalized();
  CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0, 0, 25), Vec3(0, 200, 25));
  const auto contrast = [&](double visibility_m) {
    stage.model.environment.fog_visibility_m = visibility_m;
    const CameraFrame frame = stage.Shoot(camera, X_WC);
    return Grey(frame, 163 + 32, 118) - Grey(frame, 163 - 32, 118);
  };
  EXPECT_GT(contrast(1e6), 100);
  EXPECT_LT(contrast(200), 0.06 * 255);
  EXPECT_GT(contrast(200), 0);
  EXPECT_GT(contrast(2000), contrast(500));
}

TEST(Rasterizer, RefusesALensThatFoldsThePicture) {
  Stage stage;
  CameraIntrinsics camera = Pinhole();
  camera.k1 = -2.0;
  EXPECT_THROW(stage.Shoot(camera, LookAt(kEye, kTarget)), InputError);
}

TEST(Rasterizer, RefusesAnEglDeviceThatIsNotThere) {
  Stage stage;
  EglOptions options;
  options.device = 31;
  EXPECT_THAT([&] { Rasterizer rasterizer(stage.model, options); }, ThrowsFault(kUnsupported));
}

}  // namespace
}  // namespace tera
