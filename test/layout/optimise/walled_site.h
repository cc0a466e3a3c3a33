#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"
#include "layout/looked_at_site.h"

/// A mast in front of a wall with a slit, a zone behind it, and searches there.

namespace tera {

// In H, from above: the wall, its slit, and the zone behind it. Everything relevant is as high as
// the lidar, so that sight through the slit is a plane problem.
inline constexpr double kWallNear_m = 3, kWallFar_m = 3.2, kSlit_m = 0.3;
inline constexpr double kZoneNear_m = 5, kZoneFar_m = 7, kZoneRight_m = 0.5, kZoneLeft_m = 2.5;
inline constexpr double kZoneHeight_m = 0.1, kLidarHeight_m = 1.5;

/// Part of the zone that a lidar on H's y axis does not see through the slit. A line of sight
/// passes the wall if it is within the slit at both faces.
inline double BlindThroughSlit_m3(double lidar_y_m) {
  constexpr int kSteps = 2000;
  double blind_m2 = 0;
  const double step_m = (kZoneFar_m - kZoneNear_m) / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    const double x_m = kZoneNear_m + (k + 0.5) * step_m;
    double low_m = kZoneRight_m, high_m = kZoneLeft_m;
    for (const double face_m : {kWallNear_m, kWallFar_m}) {
      low_m = std::max(low_m, lidar_y_m + (-kSlit_m - lidar_y_m) * x_m / face_m);
      high_m = std::min(high_m, lidar_y_m + (kSlit_m - lidar_y_m) * x_m / face_m);
    }
    blind_m2 += step_m * (kZoneLeft_m - kZoneRight_m - std::max(0.0, high_m - low_m));
  }
  return blind_m2 * kZoneHeight_m;
}

/// Files of a search in a separate folder.
class WalledSite {
 public:
  WalledSite() {
    WriteWholeFile(path() / "left.obj", BoxObj({kWallNear_m, kSlit_m, 0}, {kWallFar_m, 8, 3}));
    WriteWholeFile(path() / "right.obj", BoxObj({kWallNear_m, -8, 0}, {kWallFar_m, -kSlit_m, 3}));
    std::string site =
        "name: walled\nduration_s: 0.4\nsettle_s: 0\nphysics_rate_hz: 100\n"
        "terrain: {size_m: [60, 60], cell_m: 1, soil: asphalt}\n"
        "machines:\n  - {name: mast1, machine: tera:config/machines/mast.yaml,\n";
    site += fmt::format("     start: {{xy_m: [2, -3], yaw_deg: {}}}, operator: {{type: idle}}}}\n",
                        kHYaw_deg);
    site += "obstacles:\n";
    for (const char* side : {"left", "right"}) {
      const double sign = side == std::string("left") ? 1 : -1;
      site += fmt::format(
          "  - {{name: {0}, label: barrier, mesh: {0}.obj, xy_m: [2, -3], yaw_deg: {1}, collision: "
          "[{{xyz_m: [3.1, {2}, 1.5], size_m: [0.2, 7.7, 3]}}]}}\n",
          side, kHYaw_deg, sign * 4.15);
    }
    WriteWholeFile(path() / "site.yaml", site);
    WriteWholeFile(path() / "study.yaml",
                   fmt::format("points: 400\nmap_heights_m: [0.9]\nzones:\n"
                               "  - {{name: behind_wall, frame: mast, xyz_m: [{}, {}, {}], box_m: "
                               "[{}, {}, {}]}}\n",
                               0.5 * (kZoneNear_m + kZoneFar_m), 0.5 * (kZoneLeft_m + kZoneRight_m),
                               kLidarHeight_m, kZoneFar_m - kZoneNear_m, kZoneLeft_m - kZoneRight_m,
                               kZoneHeight_m));
    WriteWholeFile(path() / "keep.yaml",
                   "sensors:\n  - {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, "
                   "link: mast, xyz_m: [0, 0, 1], cost: 10, power_w: 0.5}\n");
  }

  const std::filesystem::path& path() const { return scratch_.path(); }

  /// Writes a search file: one lidar anywhere on a bar, plus `more`.
  std::filesystem::path OneLidar(const std::string& more = "generations: 12\npopulation: 16\n") {
    return Write(fmt::format(
        "cycle: site.yaml\nstudy: study.yaml\nmoments: 2\n"
        "sensors:\n  - name: lidar\n    optional: false\n"
        "    types: [{{preset: tera:config/sensors/vlp16.yaml}}]\n"
        "    mounts: [{{link: mast, low_xyz_m: [0, -4, {0}], high_xyz_m: [0, 4, {0}]}}]\n"
        "objectives: [{{figure: zone/behind_wall/blind_m3}}]\n{1}",
        kLidarHeight_m, more));
  }

  /// Two lidars on the bar, the second only if it pays, each of a cheap or an expensive type. Every
  /// layout has an inertial unit. All three at their most expensive exceed the limit.
  std::filesystem::path TwoLidars(const std::string& more = "seed: 1\n") {
    std::string sensors;
    for (const auto& [name, optional] : {std::pair("first", "false"), {"second", "true"}}) {
      sensors += fmt::format(
          "  - name: {1}\n    optional: {2}\n"
          "    types: [{{preset: tera:config/sensors/vlp16.yaml, cost: 100, power_w: 8}}, "
          "{{preset: tera:config/sensors/os1_64.yaml, cost: 300, power_w: 18}}]\n"
          "    mounts:\n"
          "      - {{link: mast, low_xyz_m: [0, -4, {0}], high_xyz_m: [0, 0, {0}], low_rpy_deg: "
          "[-5, 0, -180], high_rpy_deg: [5, 0, 180]}}\n"
          "      - {{link: mast, low_xyz_m: [0, 0, {0}], high_xyz_m: [0, 4, {0}]}}\n",
          kLidarHeight_m, name, optional);
    }
    return Write(
        "cycle: site.yaml\nstudy: study.yaml\nkeep: keep.yaml\nmoments: 2\n"
        "population: 8\ngenerations: 5\nlimits: {cost: 420}\nsensors:\n" +
        sensors + "objectives: [{figure: zone/behind_wall/blind_m3, at: worst}, {figure: cost}]\n" +
        more);
  }

 private:
  std::filesystem::path Write(const std::string& text) {
    WriteWholeFile(path() / "search.yaml", text);
    return path() / "search.yaml";
  }

  const ScratchDirectory scratch_;
};

}  // namespace tera
