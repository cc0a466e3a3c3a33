#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ball_mesh.h"
#include "generated.h"

// Balls at known places, seen by cameras on a slewing machine. The middle of each ball's label mask
// must equal the projection of the truth in the files.

namespace tera {
namespace {

namespace fs = std::filesystem;

constexpr double kRadius_m = 0.45;

/// Balls at three heights on a ring around the machine, so that slewing carries them across the
/// whole image.
std::vector<Vec3> BallCentres() {
  std::vector<Vec3> centres_m;
  for (int i = 0; i < 21; ++i) {
    const double azimuth_rad = 2 * kPi * i / 21, r_m = 4.6, height_m = 0.7 + 0.8 * (2 * i % 3);
    centres_m.emplace_back(r_m * std::cos(azimuth_rad), r_m * std::sin(azimuth_rad), height_m);
  }
  return centres_m;
}

constexpr const char* kPinhole =
    "{name: pinhole, type: camera, rate_hz: 12.5, width_px: 640, height_px: 480, "
    "horizontal_fov_deg: 60, rgb: false, link: upper, xyz_m: [-0.3, 0.86, 1.9], "
    "rpy_deg: [3, 8, 90]}";
/// The labels of a distorted picture are the nearest of a finer picture: more pixels compensate.
constexpr const char* kBarrel =
    "{name: barrel, preset: tera:config/sensors/rgb_640.yaml, rate_hz: 12.5, width_px: 960, "
    "height_px: 720, rgb: false, link: upper, xyz_m: [-0.3, 0.86, 1.8], rpy_deg: [-4, 6, 130]}";

std::string SiteWithBalls(const std::string& camera) {
  std::string yaml = R"(
name: balls
duration_s: 3
record: {poses_hz: 12.5}
terrain: {size_m: [24, 24], cell_m: 0.1, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {yaw_deg: 20, joints_deg: {boom: 60, arm: -120, bucket: -20}}
    operator: {type: dig_cycle, dig_azimuth_deg: 175, dump_azimuth_deg: -120, cycles: 1}
)";
  yaml += "    rig: {sensors: [" + camera + "]}\nobstacles:\n";
  const std::string mesh = WriteBallMesh().string();
  int i = 0;
  for (const Vec3& centre_m : BallCentres()) {
    yaml += fmt::format(
        "  - {{name: ball{}, label: rock, mesh: {}, scale: {}, xy_m: [{}, {}], "
        "height_above_ground_m: {}}}\n",
        i++, mesh, kRadius_m, centre_m.x(), centre_m.y(), centre_m.z());
  }
  return yaml;
}

/// The outline of a ball in the image: the cone of rays that touch it, projected.
struct Outline {
  Vec2 centroid_px = Vec2::Zero();
  double area_px2 = 0;
  bool inside = true;  ///< of the image, with its border's pixels kept free
};

Outline OutlineOf(const Vec3& centre_C_m, const CameraIntrinsics& lens) {
  constexpr int kCorners = 720;
  const double distance_m = centre_C_m.norm(), sine = kRadius_m / distance_m;
  const Vec3 axis = centre_C_m / distance_m, side = axis.unitOrthogonal(), up = axis.cross(side);
  std::vector<Vec2> corners_px;
  Outline outline;
  for (int k = 0; k < kCorners; ++k) {
    const double a = 2 * kPi * k / kCorners;
    const Vec3 touching =
        std::sqrt(1 - sine * sine) * axis + sine * (std::cos(a) * side + std::sin(a) * up);
    outline.inside &= touching.z() > 0.2;
    if (!outline.inside) return outline;
    const Vec2 px = lens.Project(touching);
    outline.inside &=
        px.x() > 1 && px.y() > 1 && px.x() < lens.width_px - 2 && px.y() < lens.height_px - 2;
    corners_px.push_back(px);
  }
  double twice_px2 = 0;
  for (int k = 0; k < kCorners; ++k) {
    const Vec2 &a = corners_px[k], &b = corners_px[(k + 1) % kCorners];
    const double cross = a.x() * b.y() - b.x() * a.y();
    twice_px2 += cross;
    outline.centroid_px += cross * (a + b) / 3;
  }
  outline.centroid_px /= twice_px2;
  outline.area_px2 = 0.5 * std::abs(twice_px2);
  return outline;
}

struct Mask {
  std::int64_t pixels = 0;
  Vec2 sum_px = Vec2::Zero();
};

std::vector<Mask> MasksOf(const Image<std::uint16_t>& instance, std::size_t instances) {
  std::vector<Mask> masks(instances);
  for (int y = 0; y < instance.height_px; ++y) {
    for (int x = 0; x < instance.width_px; ++x) {
      Mask& mask = masks.at(instance.at(x, y));
      ++mask.pixels;
      mask.sum_px += Vec2(x, y);
    }
  }
  return masks;
}

struct Misfit {
  int views = 0;
  Vec2 sum_px = Vec2::Zero();
  void Add(const Vec2& d_px) {
    ++views;
    sum_px += d_px;
  }
  double mean_px() const { return sum_px.norm() / views; }
};

struct CameraMisfit {
  Misfit all, quarters[2][2];
  double worst_px = 0;
};

CameraMisfit MisfitOf(const Recording& recording, const std::string& folder) {
  const std::vector<TruthPose> poses =
      recording
          .LoadPose("truth/excavator1/sensors/" + fs::path(folder).filename().string() + ".csv")
          .poses;
  const CameraIntrinsics lens = LensOf(recording, folder);
  const std::vector<Vec3> centres_m = BallCentres();
  CameraMisfit misfit;
  for (const TimeNs t_ns : recording.FrameTimes(folder)) {
    const CameraFrame frame = recording.LoadFrame(folder, t_ns);
    const auto pose = std::find_if(poses.begin(), poses.end(),
                                   [&](const TruthPose& at) { return at.t_ns == t_ns; });
    if (pose == poses.end()) {
      ADD_FAILURE() << "no pose at " << t_ns;
      continue;
    }
    const Pose X_CW = (pose->X_WB * OpticalInSensor()).inverse();
    const auto masks = MasksOf(frame.instance, recording.info().instances.size() + 1);
    for (const auto& instance : recording.info().instances) {
      if (!instance.name.starts_with("ball")) continue;
      const Mask& mask = masks[instance.id];
      const Vec3& centre_W_m = centres_m.at(std::stoi(instance.name.substr(4)));
      const Outline outline = OutlineOf(X_CW * centre_W_m, lens);
      // Whole and not behind the boom: occlusion would shift the mask's middle. A ball's edge alone
      // leaves 1 % of the area open.
      constexpr double kWhole = 0.997;
      if (!outline.inside || mask.pixels < kWhole * outline.area_px2) continue;
      const Vec2 d_px = mask.sum_px / mask.pixels - outline.centroid_px;
      const int right = outline.centroid_px.x() > 0.5 * lens.width_px;
      const int low = outline.centroid_px.y() > 0.5 * lens.height_px;
      misfit.all.Add(d_px);
      misfit.quarters[low][right].Add(d_px);
      misfit.worst_px = std::max(misfit.worst_px, d_px.norm());
    }
  }
  return misfit;
}

// A ball of radius R px has about 2 pi R pixels on its edge, each inside or outside by the place of
// its centre. Each errs by 1/sqrt(12) px2 of area at lever arm R (1/sqrt(2) of it along an axis).
// The middle thus moves by sqrt(2 pi R / 24) R / (pi R^2) = 0.16 / sqrt(R) px along each axis. For
// the pinhole's R = 60 to 80 that is 0.020 px. For the distorted picture's R = 90 to 120, whose
// edge is rounded twice, it is sqrt(2) 0.016 = 0.023 px. A single view exceeds 0.1 px at four
// deviations of the two axes' Rayleigh distribution, one in 3000; the mean of ten views has a tenth
// of that.
void ExpectTruePointsWhereTheyAreRendered(const std::string& name, const std::string& camera) {
  const Recording recording = Generated(name, SiteWithBalls(camera));
  const CameraMisfit misfit = MisfitOf(recording, "excavator1/" + name);
  fmt::print("{}: {} views, mean {:.3f} px, single worst {:.3f} px, quarters", name,
             misfit.all.views, misfit.all.mean_px(), misfit.worst_px);
  for (const auto& row : misfit.quarters) {
    for (const Misfit& quarter : row) fmt::print(" {:.3f} ({})", quarter.mean_px(), quarter.views);
  }
  fmt::print("\n");
  for (const auto& row : misfit.quarters) {
    for (const Misfit& quarter : row) {
      EXPECT_GE(quarter.views, 10);
      EXPECT_LT(quarter.mean_px(), 0.05);
    }
  }
  EXPECT_LT(misfit.worst_px, 0.1);
}

TEST(Projection, OfTruePointsIsWithinATenthOfAPixelOfWhatAPinholeCameraRenders) {
  ExpectTruePointsWhereTheyAreRendered("pinhole", kPinhole);
}

TEST(Projection, OfTruePointsIsWithinATenthOfAPixelOfWhatADistortingCameraRenders) {
  ExpectTruePointsWhereTheyAreRendered("barrel", kBarrel);
}

}  // namespace
}  // namespace tera
