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

/// What must be met for a place to count as seen.
struct SeenFrom {
  double lidar_points_per_m2 = 10;  ///< on a surface that faces the sensor, in one scan
  double camera_px_per_m = 25;      ///< across the line of sight
  double reflectance = 0.2;         ///< diffuse, of what a lidar is to see
};

/// A person of whom is asked from where sensors see her: a box, upright or lying.
struct Posture {
  std::string name;
  Vec3 size_m = Vec3(0.3, 0.5, 1.75);  ///< depth, breadth, height; she faces the machine
};

struct PersonStudy {
  std::vector<Posture> postures;  ///< standing, crouching, lying, unless the study has its own
  double lidar_points = 20;       ///< on her in one scan, from which on she counts as detected
  double camera_px = 300;         ///< of a picture that she covers, from which on she does
  int cluster_points = 5;         ///< fewest that a detector of clusters takes for somebody
  double farthest_m = 24;
};

/// The eye of ISO 5006 and NIOSH's maps, or any other point that a light or a lens may be at.
struct EyeStudy {
  std::string link;
  Vec3 p_B_m = Vec3::Zero();  ///< middle between the eyes
  double spacing_m = 0.205;   ///< of the two light filaments
  double circle_m = 12;       ///< radius of the visibility test circle about the eye
  double rectangle_m = 1;     ///< distance of the rectangular boundary from the machine's sides
  double height_m = 0;        ///< of both above the ground
  std::optional<double> most_masking_m;  ///< widest masking that whoever asks allows
  std::string place = "study: eye";      ///< in its file, for messages
};

/// Part of the ground ahead of which an elevation map is wanted.
struct ElevationStudy {
  Vec2 low_H_m = Vec2(2, -2), high_H_m = Vec2(7, 2);  ///< corners, in H as in PolarGrid
  double cell_m = 0.2;
};

/// How well a detector does by what a sensor has on its target: AP = a ln(m) + b, of m points or
/// pixels.
struct PrecisionFit {
  double a = 0, b = 0;
};

/// What the entropies of a layout are computed with.
struct InformationStudy {
  double voxel_m = 0.5;  ///< edge of the voxels of the occupancy grid
  /// For automated driving, as public re-implementations quote them from Ma et al. (arXiv
  /// 2104.06615); not checked against the paper itself, nor fitted to people on a site.
  PrecisionFit lidar = {0.152, 0.659}, camera = {0.055, 0.155};
};

/// What is asked of sensor layouts.
struct LayoutStudy {
  std::string machine;     ///< empty: the scenario's first
  std::string upper;       ///< link whose heading maps are turned to; empty: the root's first child
  double rate_hz = 5;      ///< of the moments that are looked at
  double radius_m = 12;    ///< of the volume around the machine, an upright cylinder
  double height_m = 2;     ///< of that volume, above the ground below the root's origin
  int points = 6000;       ///< of each zone and of the volume
  std::uint64_t seed = 1;  ///< of those points
  std::vector<double> map_heights_m = {0, 0.9, 1.5, 1.7};
  std::vector<Zone> zones;
  SeenFrom seen;
  PersonStudy person;
  ElevationStudy elevation;
  std::optional<EyeStudy> eye;
  InformationStudy information;
  /// Of `machine` and `upper` in its file, for messages.
  std::string machine_place = "study: machine", upper_place = "study: upper";
  std::string resolved_yaml;  ///< all of it, defaults included; empty where it was not read
};

/// Reads a study; `file` empty: the defaults. Throws InputError.
LayoutStudy LoadStudy(const std::filesystem::path& file);

}  // namespace tera
