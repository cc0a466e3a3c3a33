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

/// Requirements for a place to count as seen.
struct SeenFrom {
  double lidar_points_per_m2 = 10;  ///< on a surface that faces the sensor, in one scan
  double camera_px_per_m = 25;      ///< across the line of sight
  double reflectance = 0.2;         ///< diffuse, of the targets of a lidar
};

/// A person to be detected: an upright or lying box.
struct Posture {
  std::string name;
  Vec3 size_m = Vec3(0.3, 0.5, 1.75);  ///< depth, breadth, height; the person faces the machine
};

struct PersonStudy {
  std::vector<Posture> postures;  ///< standing, crouching, lying, unless the study has its own
  double lidar_points = 20;       ///< least points of one scan on the person for a detection
  double camera_px = 300;         ///< least pixels of a picture on the person for a detection
  int cluster_points = 5;         ///< least points of a cluster that a detector accepts as a person
  double farthest_m = 24;
};

/// The eye of ISO 5006 and NIOSH's maps, or any other position of a light or a lens.
struct EyeStudy {
  std::string link;
  Vec3 p_B_m = Vec3::Zero();  ///< middle between the eyes
  double spacing_m = 0.205;   ///< between the two light filaments
  double circle_m = 12;       ///< radius of the visibility test circle about the eye
  double rectangle_m = 1;     ///< distance of the rectangular boundary from the machine's sides
  double height_m = 0;        ///< height of both lines above the ground
  std::optional<double> most_masking_m;  ///< widest masking that the study allows
  std::string place = "study: eye";      ///< its position in the file, for messages
};

/// Part of the ground ahead for the elevation map.
struct ElevationStudy {
  Vec2 low_H_m = Vec2(2, -2), high_H_m = Vec2(7, 2);  ///< corners, in H as in PolarGrid
  double cell_m = 0.2;
};

/// Precision of a detector as a function of m points or pixels on its target: AP = a ln(m) + b.
struct PrecisionFit {
  double a = 0, b = 0;
};

/// Weather in which the questions are asked; clear air unless stated.
struct AirStudy {
  double visibility_m = 0;  ///< Koschmieder's, of fog and haze; 0: clear
  double rain_mmph = 0, snowfall_mmph = 0;
};

/// Parameters of the entropies of a layout.
struct InformationStudy {
  double voxel_m = 0.5;  ///< edge of the voxels of the occupancy grid
  /// For automated driving, as public re-implementations quote them from Ma et al. (arXiv
  /// 2104.06615); not checked against the paper itself, nor fitted to people on a site.
  PrecisionFit lidar = {0.152, 0.659}, camera = {0.055, 0.155};
};

/// Questions to sensor layouts.
struct LayoutStudy {
  std::string machine;     ///< empty: the scenario's first
  std::string upper;       ///< link whose heading maps follow; empty: the root's first child
  double rate_hz = 5;      ///< rate of the evaluated moments
  double radius_m = 12;    ///< radius of the volume around the machine, an upright cylinder
  double height_m = 2;     ///< height of that volume, above the ground below the root's origin
  int points = 6000;       ///< in each zone and in the volume
  std::uint64_t seed = 1;  ///< seed of those points
  std::vector<double> map_heights_m = {0, 0.9, 1.5, 1.7};
  std::vector<Zone> zones;
  SeenFrom seen;
  AirStudy air;
  PersonStudy person;
  ElevationStudy elevation;
  std::optional<EyeStudy> eye;
  InformationStudy information;
  /// Positions of `machine` and `upper` in the file, for messages.
  std::string machine_place = "study: machine", upper_place = "study: upper";
  std::string resolved_yaml;  ///< complete with defaults; empty if the study was not read
};

/// Reads a study; an empty `file` gives the defaults. Throws InputError.
LayoutStudy LoadStudy(const std::filesystem::path& file);

}  // namespace tera
