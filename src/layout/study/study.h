#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "layout/study/zone.h"
#include "physics/description/machine.h"

namespace tera {

/// Minimum sampling for a place to count as seen.
struct SeenFrom {
  double lidar_points_per_m2 = 10;  ///< of one scan, on a surface that faces the sensor
  double camera_px_per_m = 25;      ///< across the line of sight
  double reflectance = 0.2;         ///< diffuse reflectance of lidar targets
};

/// A person to be detected, as a box.
struct Posture {
  std::string name;
  Vec3 size_m = Vec3(0.3, 0.5, 1.75);  ///< depth, breadth, height; the person faces the machine
};

struct PersonStudy {
  std::vector<Posture> postures;  ///< the default study has standing, crouching and lying
  double lidar_points = 20;       ///< least points of one scan on the person's box for a detection
  double camera_px = 300;         ///< least pixels of one picture on the person for a detection
  int cluster_points = 5;         ///< smallest cluster that the detector accepts as a person
  double farthest_m = 24;
};

/// An eye point of the operator, for the visibility lines of ISO 5006.
struct EyeStudy {
  std::string link;
  Vec3 p_B_m = Vec3::Zero();  ///< midpoint between the eyes
  double spacing_m = 0.205;   ///< between the two lights that stand for the eyes
  double circle_m = 12;       ///< radius of the visibility test circle
  double rectangle_m = 1;     ///< distance of the rectangular boundary from the machine's sides
  double height_m = 0;        ///< height of both test lines above the ground
  std::optional<double> most_masking_m;  ///< widest masking that the study allows
  std::string place = "study: eye";      ///< its position in the study file, for messages
};

/// Part of the ground ahead for the elevation map.
struct ElevationStudy {
  Vec2 low_H_m = Vec2(2, -2), high_H_m = Vec2(7, 2);  ///< corners; frame H as in PolarGrid
  double cell_m = 0.2;
};

/// Average precision of a detector with m points or pixels on its target: AP = a ln(m) + b.
struct PrecisionFit {
  double a = 0, b = 0;
};

/// Weather of the study. The default is clear air.
struct AirStudy {
  double visibility_m = 0;  ///< meteorological visibility of fog and haze (Koschmieder); 0: clear
  double rain_mmph = 0, snowfall_mmph = 0;
};

/// Parameters of the entropies of a layout.
struct InformationStudy {
  double voxel_m = 0.5;  ///< edge of the voxels of the occupancy grid
  /// Fits for automated driving, as public re-implementations quote them from Ma et al. (arXiv
  /// 2104.06615). Not checked against the paper itself, and not fitted to people on a site.
  PrecisionFit lidar = {0.152, 0.659}, camera = {0.055, 0.155};
};

/// The settings of a layout evaluation.
struct LayoutStudy {
  std::string machine;     ///< empty: the scenario's first
  std::string upper;       ///< link whose heading the maps follow; empty: the root's first child
  double rate_hz = 5;      ///< rate of evaluated moments
  double radius_m = 12;    ///< radius of the zone around the machine, an upright cylinder
  double height_m = 2;     ///< height of that zone, from the ground below the root's origin
  int points = 6000;       ///< number of test points in each zone
  std::uint64_t seed = 1;  ///< seed of the test points
  std::vector<double> map_heights_m = {0, 0.9, 1.5, 1.7};
  std::vector<Zone> zones;
  SeenFrom seen;
  AirStudy air;
  PersonStudy person;
  ElevationStudy elevation;
  std::optional<EyeStudy> eye;
  InformationStudy information;
  /// Positions of `machine` and `upper` in the study file, for messages.
  std::string machine_place = "study: machine", upper_place = "study: upper";
  /// YAML of the study, complete with defaults. Empty if the study was not read from a file.
  std::string resolved_yaml;
};

/// Reads a study; an empty `file` gives the defaults. Throws InputError.
LayoutStudy LoadStudy(const std::filesystem::path& file);

}  // namespace tera
