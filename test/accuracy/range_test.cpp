#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "ball_mesh.h"
#include "generated.h"
#include "own_folder.h"

// Ranges in the files of a camera and a lidar on a mast, against planes of the scenario, and
// against each other.

namespace tera {
namespace {

constexpr double kWallThickness_m = 0.2, kWallYaw_rad = 100 * kDeg;
const Vec2 kWallCentre_m(2.0, 1.0);

/// A wall of 6 x 0.2 x 2.5 m standing on its origin, along x.
std::filesystem::path WriteWallMesh() {
  const auto file = OwnFolder() / "wall.obj";
  std::ofstream obj(file);
  obj << "o body\n";
  for (const double z : {0.0, 2.5}) {
    for (const auto& [x, y] : {std::pair{-3.0, -0.1}, {3.0, -0.1}, {3.0, 0.1}, {-3.0, 0.1}}) {
      obj << fmt::format("v {} {} {}\n", x, y, z);
    }
  }
  obj << "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\nf 4 3 2 1\n";
  return file;
}

std::string SiteWithMast() {
  return fmt::format(R"(
name: ranges
duration_s: 0.2
terrain: {{size_m: [24, 24], cell_m: 0.1, soil: dirt}}
machines:
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {{xy_m: [-4.3, 2.1], yaw_deg: -7}}
    operator: {{type: idle}}
    rig: {{sensors: [
      {{name: camera, type: camera, rate_hz: 10, width_px: 640, height_px: 480, horizontal_fov_deg: 70, link: mast, xyz_m: [0.3, 0.2, 3.1], rpy_deg: [4, 24, -3], depth: true, depth_max_m: 40}},
      {{name: lidar, preset: tera:config/sensors/os1_64.yaml, range_noise_m: 0, link: mast, xyz_m: [0.1, -0.3, 3.4], rpy_deg: [-3, 17, 12]}}]}}
obstacles:
  - {{name: wall1, label: structure, mesh: {}, xy_m: [{}, {}], yaw_deg: {}}}
  - {{name: ball1, label: rock, mesh: {}, scale: 0.8, xy_m: [-0.6, 3.4], height_above_ground_m: 0.5}}
)",
                     WriteWallMesh().string(), kWallCentre_m.x(), kWallCentre_m.y(),
                     kWallYaw_rad / kDeg, WriteBallMesh().string());
}

/// A plane n . p = offset in W.
struct Plane {
  Vec3 normal_W;
  double offset_m;
  /// Multiple of `d_W` that leads from `p_W_m` to the plane.
  double Reach(const Vec3& p_W_m, const Vec3& d_W) const {
    return (offset_m - normal_W.dot(p_W_m)) / normal_W.dot(d_W);
  }
};

Plane Ground() { return {Vec3::UnitZ(), 0.0}; }

/// The wall's long face on the mast's side.
Plane WallFace() {
  const Vec3 normal_W(-std::sin(kWallYaw_rad), std::cos(kWallYaw_rad), 0);
  const Vec3 centre_m(kWallCentre_m.x(), kWallCentre_m.y(), 0);
  return {normal_W, normal_W.dot(centre_m) + 0.5 * kWallThickness_m};
}

class Ranges : public ::testing::Test {
 protected:
  // In each test's own set-up: a failure in a suite's would count its tests as skipped.
  void SetUp() override {
    if (recording_) return;
    recording_ = new Recording(Generated("ranges", SiteWithMast()));
    const LinkTruth truth(*recording_, "mast1", "mast.yaml");
    const Pose X_WB = truth.LinkPose("mast", 0);
    X_WC_ = X_WB * MountOf(*recording_, "mast1/camera") * OpticalInSensor();
    X_WL_ = X_WB * MountOf(*recording_, "mast1/lidar");
    lens_ = LensOf(*recording_, "mast1/camera");
    frame_ = recording_->LoadFrame("mast1/camera", 0);
    scan_ = recording_->LoadScan("mast1/lidar", 0);
  }
  static void TearDownTestSuite() { delete recording_; }

  /// Instance in dataset.yaml.
  static std::uint16_t Instance(const std::string& name) {
    for (const auto& instance : recording_->info().instances) {
      if (instance.name == name) return instance.id;
    }
    ADD_FAILURE() << name;
    return 0;
  }

  /// Greatest |measured - true| depth over all pixels of an instance, whose surface is the plane.
  static double WorstDepth(SemanticClass label, const Plane& plane, int* pixels) {
    double worst_m = 0;
    *pixels = 0;
    for (int y = 0; y < lens_.height_px; ++y) {
      for (int x = 0; x < lens_.width_px; ++x) {
        if (frame_.semantic.at(x, y) != static_cast<std::uint8_t>(label)) continue;
        const Vec3 d_W = X_WC_.linear() * lens_.Unproject(Vec2(x, y));
        const double z_m = plane.Reach(X_WC_.translation(), d_W);
        const Vec3 p_W_m = X_WC_.translation() + z_m * d_W;
        if (!OnSurface(label, p_W_m)) continue;
        ++*pixels;
        worst_m = std::max(worst_m, std::abs(frame_.depth_m.at(x, y) - z_m));
      }
    }
    return worst_m;
  }

  /// Deviation of a pixel's depth from the mean of two neighbours', in inverse depth: zero on a
  /// plane.
  static double Bend(int x, int y, int dx, int dy) {
    const double z_m = frame_.depth_m.at(x, y), a_m = frame_.depth_m.at(x - dx, y - dy),
                 b_m = frame_.depth_m.at(x + dx, y + dy);
    if (z_m <= 0 || a_m <= 0 || b_m <= 0) return 1e9;
    return std::abs(z_m - 2 / (1 / a_m + 1 / b_m));
  }

  static double WorstRange(SemanticClass label, const Plane& plane, int* returns) {
    double worst_m = 0;
    *returns = 0;
    for (const LidarPoint& point : scan_.points) {
      if (point.label != static_cast<std::uint8_t>(label)) continue;
      const Vec3 p_S_m(point.x_m, point.y_m, point.z_m);
      const double range_m = p_S_m.norm();
      const Vec3 d_W = X_WL_.linear() * (p_S_m / range_m);
      const double true_m = plane.Reach(X_WL_.translation(), d_W);
      if (!OnSurface(label, X_WL_.translation() + true_m * d_W)) continue;
      ++*returns;
      worst_m = std::max(worst_m, std::abs(range_m - true_m));
    }
    return worst_m;
  }

  /// Within the site, and on the face of the wall instead of its edges, with a millimetre of
  /// margin.
  static bool OnSurface(SemanticClass label, const Vec3& p_W_m) {
    constexpr double kSiteHalf_m = 12, kClear_m = 1e-3;
    if (label == SemanticClass::kTerrain) {
      return std::max(std::abs(p_W_m.x()), std::abs(p_W_m.y())) < kSiteHalf_m - kClear_m;
    }
    const Vec2 along(std::cos(kWallYaw_rad), std::sin(kWallYaw_rad));
    const double x_m = along.dot(p_W_m.head<2>() - kWallCentre_m);
    return std::abs(x_m) < 3.0 - kClear_m && p_W_m.z() < 2.5 - kClear_m;
  }

  static inline const Recording* recording_ = nullptr;
  static inline Pose X_WC_, X_WL_;
  static inline CameraIntrinsics lens_;
  static inline CameraFrame frame_;
  static inline LidarScan scan_;
};

TEST_F(Ranges, DepthOfGroundAndWallIsThatOfThePlanesWithinAMillimetre) {
  int ground = 0, wall = 0;
  const double ground_m = WorstDepth(SemanticClass::kTerrain, Ground(), &ground);
  const double wall_m = WorstDepth(SemanticClass::kStructure, WallFace(), &wall);
  fmt::print("depth: {} pixels of ground within {:.3f} mm, {} of wall within {:.3f} mm\n", ground,
             1e3 * ground_m, wall, 1e3 * wall_m);
  EXPECT_GT(ground, 50000);
  EXPECT_GT(wall, 10000);
  // Half a millimetre of it is the file's rounding.
  EXPECT_LT(ground_m, 1e-3);
  EXPECT_LT(wall_m, 1e-3);
}

TEST_F(Ranges, LidarRangeToGroundAndWallIsThatOfThePlanesWithinAMillimetre) {
  int ground = 0, wall = 0;
  const double ground_m = WorstRange(SemanticClass::kTerrain, Ground(), &ground);
  const double wall_m = WorstRange(SemanticClass::kStructure, WallFace(), &wall);
  fmt::print("lidar: {} returns of ground within {:.3f} mm, {} of wall within {:.3f} mm\n", ground,
             1e3 * ground_m, wall, 1e3 * wall_m);
  EXPECT_GT(ground, 5000);
  EXPECT_GT(wall, 1000);
  EXPECT_LT(ground_m, 1e-3);
  EXPECT_LT(wall_m, 1e-3);
}

TEST_F(Ranges, DepthAndLidarAgreeOnSmoothSurfacesWithinFiveMillimetres) {
  const std::uint16_t ball = Instance("ball1");
  int compared = 0, on_ball = 0;
  double worst_m = 0;
  for (const LidarPoint& point : scan_.points) {
    const Vec3 p_C_m = X_WC_.inverse() * (X_WL_ * Vec3(point.x_m, point.y_m, point.z_m));
    if (p_C_m.z() <= 0) continue;
    const Vec2 pixel_px = lens_.Project(p_C_m);
    const int x = static_cast<int>(std::floor(pixel_px.x()));
    const int y = static_cast<int>(std::floor(pixel_px.y()));
    if (x < 1 || y < 1 || x + 2 >= lens_.width_px || y + 2 >= lens_.height_px) continue;
    // Inverse depth of a plane is linear in the pixel; of a ball of 0.8 m, nearly so.
    constexpr double kSteepest_m = 0.05, kCorner_m = 3e-3, kHidden_m = 0.2;
    double inverse_1pm = 0, nearest_m = 1e9, farthest_m = 0;
    bool smooth = true;
    for (int k = 0; k < 4; ++k) {
      const int u = x + k % 2, v = y + k / 2;
      const double z_m = frame_.depth_m.at(u, v);
      smooth &= z_m > 0 && frame_.instance.at(u, v) == point.instance &&
                frame_.semantic.at(u, v) == point.label && Bend(u, v, 1, 0) < kCorner_m &&
                Bend(u, v, 0, 1) < kCorner_m;
      inverse_1pm += (1 - std::abs(pixel_px.x() - u)) * (1 - std::abs(pixel_px.y() - v)) / z_m;
      nearest_m = std::min(nearest_m, z_m);
      farthest_m = std::max(farthest_m, z_m);
    }
    // Smooth: no edge (the file's millimetres bend a plane by two), no limb, and no occlusion of
    // the camera's view.
    if (!smooth || farthest_m - nearest_m > kSteepest_m) continue;
    if (std::abs(1 / inverse_1pm - p_C_m.z()) > kHidden_m) continue;
    ++compared;
    if (point.instance == ball) ++on_ball;
    worst_m = std::max(worst_m, std::abs(1 / inverse_1pm - p_C_m.z()));
  }
  fmt::print("depth against lidar: {} points ({} on the ball) within {:.3f} mm\n", compared,
             on_ball, 1e3 * worst_m);
  EXPECT_GT(compared, 5000);
  EXPECT_GT(on_ball, 300);
  EXPECT_LT(worst_m, 5e-3);
}

}  // namespace
}  // namespace tera
