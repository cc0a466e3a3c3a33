#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types/labels.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "layout/euclidean_clusters.h"
#include "layout/resense.h"
#include "sim/scenario/load_scenario.h"

/// People around a machine at rest, scans of them, and a simple detector of people.

namespace tera {

inline constexpr double kPeopleDuration_s = 10;
inline constexpr int kPeopleOfRing = 3;

/// Radii about the machine for people, from its immediate vicinity to the end of the near zone.
inline std::vector<double> PeopleRings_m() { return {3.5, 5, 7, 9, 11, 13}; }

/// Upright and without a step, along a third of a ring. The inner two rings exclude the bucket's
/// area in front of the machine.
inline std::string PersonOnRing(int ring, int one) {
  constexpr double kThird_deg = 360.0 / kPeopleOfRing, kShift_deg = 17, kSide_deg = 30;
  const double radius_m = PeopleRings_m()[static_cast<std::size_t>(ring)];
  const std::string name = fmt::format("person_{}_{}", ring, one);
  std::string path, first;
  for (double along = 0; along <= 1 + 1e-9; along += 0.1) {
    double azimuth_deg = (one + along) * kThird_deg;
    azimuth_deg = ring < 2 ? kSide_deg + azimuth_deg * (1 - 2 * kSide_deg / 360)
                           : azimuth_deg + ring * kShift_deg;
    const double x_m = radius_m * std::cos(azimuth_deg * kDeg);
    const double y_m = radius_m * std::sin(azimuth_deg * kDeg);
    if (path.empty()) first = fmt::format("[{:.4f}, {:.4f}]", x_m, y_m);
    path += fmt::format("{}{{t_s: {:.3f}, xy_m: [{:.4f}, {:.4f}]}}", path.empty() ? "" : ", ",
                        along * kPeopleDuration_s, x_m, y_m);
  }
  return fmt::format(
      "  - {{name: {}, label: person, mesh: tera:assets/person.glb, node: body, xy_m: {}, path: "
      "[{}]}}\n",
      name, first, path);
}

/// The dataset of the people; each rig has its own.
class PeopleAround {
 public:
  PeopleAround() {
    std::string scene = fmt::format(R"(
name: people
seed: 5
duration_s: {}
settle_s: 0.5
terrain: {{size_m: [40, 40], cell_m: 0.2, soil: dirt, relief: {{amplitude_m: 0.05, wavelength_m: 5}}}}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {{joints_deg: {{boom: 40, arm: -95, bucket: -20}}}}
    operator: {{type: idle}}
    rig: none.yaml
obstacles:
)",
                                    kPeopleDuration_s);
    for (std::size_t ring = 0; ring < PeopleRings_m().size(); ++ring) {
      for (int one = 0; one < kPeopleOfRing; ++one) {
        scene += PersonOnRing(static_cast<int>(ring), one);
      }
    }
    WriteWholeFile(folder() / "none.yaml", "sensors: []\n");
    WriteWholeFile(folder() / "scene.yaml", scene);
    const LoadedScenario loaded = LoadScenario(folder() / "scene.yaml", {});
    Generate(loaded.scenario, loaded.resolved_yaml, {.out = base(), .keep_state = true});
  }

  std::filesystem::path base() const { return folder() / "base"; }
  std::filesystem::path RigFile(const std::string& name) const {
    return folder() / (name + ".yaml");
  }
  std::filesystem::path Data(const std::string& name) const { return folder() / ("data_" + name); }

  /// Measures the scene with one lidar on the upper structure.
  void Resense(const std::string& name, const std::string& preset, const std::string& mount) const {
    WriteWholeFile(RigFile(name),
                   fmt::format("sensors: [{{name: lidar, preset: tera:config/sensors/{}.yaml, "
                               "link: upper, {}}}]\n",
                               preset, mount));
    tera::Resense(base(), {RigFile(name), ""}, {}, {.out = Data(name)});
  }

 private:
  const std::filesystem::path& folder() const { return scratch_.path(); }

  const ScratchDirectory scratch_;
};

inline bool IsOfMachine(const LidarPoint& point) {
  switch (SemanticClass{point.label}) {
    case SemanticClass::kUndercarriage:
    case SemanticClass::kUpperStructure:
    case SemanticClass::kBoom:
    case SemanticClass::kArm:
    case SemanticClass::kBucket:
    case SemanticClass::kBlade:
    case SemanticClass::kTrack:
    case SemanticClass::kSoilInBucket:
      return true;
    default:
      return false;
  }
}

/// A simple detector of people in one scan.
///
/// Frames  H stands on the ground below the machine, level.
/// Model   the machine's own points, points below 0.2 m (ground) and points above 2.2 m are
///         removed. Each Euclidean cluster of the rest is a person.
/// Source  height limits and clusters of 5 points and more as in Yan, Duckett and Bellotto (IROS
///         2017). Their tolerance grows with the range by 0.1 m about every three metres; here it
///         is a constant 0.5 m. Rows of 2 deg are 0.45 m apart at 13 m.
struct PeopleDetector {
  double ground_m = 0.2, highest_m = 2.2, tolerance_m = 0.5;
  std::size_t least = 5;

  /// Points on neither the machine nor the ground, in H.
  std::vector<Vec3> Standing(const LidarScan& scan, const Pose& X_HS) const {
    std::vector<Vec3> points_H_m;
    for (const LidarPoint& point : scan.points) {
      if (IsOfMachine(point)) continue;
      const Vec3 p_H_m = X_HS * Vec3(point.x_m, point.y_m, point.z_m);
      if (p_H_m.z() > ground_m && p_H_m.z() < highest_m) points_H_m.push_back(p_H_m);
    }
    return points_H_m;
  }

  /// Centroids of clusters, in H.
  std::vector<Vec3> Detect(const LidarScan& scan, const Pose& X_HS) const {
    const std::vector<Vec3> points_H_m = Standing(scan, X_HS);
    std::vector<Vec3> centroids_H_m;
    for (const Cluster& cluster : EuclideanClusters(points_H_m, tolerance_m, least)) {
      Vec3 sum_m = Vec3::Zero();
      for (const std::size_t i : cluster) sum_m += points_H_m[i];
      centroids_H_m.emplace_back(sum_m / static_cast<double>(cluster.size()));
    }
    return centroids_H_m;
  }
};

}  // namespace tera
