#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/motion.h"

/// What stands and moves in a scene, as a page draws it: plain data, without physics. The page
/// finds poses of bodies from those of machines and from their joints.

namespace tera {

/// Triangles of one colour, or of a colour for each corner.
struct StagePart {
  std::vector<float> positions_m, normals, colours;  ///< three numbers each; colours may be none
  std::vector<std::uint32_t> indices;
  Vec3 colour = Vec3::Constant(0.5);  ///< linear, where there are no colours
  double opacity = 1;
};

struct StageMesh {
  std::vector<StagePart> parts;
};

/// A mesh shown at a body.
struct StageNode {
  int mesh = 0, body = 0;
  Pose X_BG = Pose::Identity();
  double scale = 1;
  std::uint16_t instance = 0;
};

/// Bodies of a machine: links, wheels, shoes of tracks, rockers and couplers, barrels and rods,
/// soil in shovels, in this order from `first_body` on. Frames and laws are those of
/// physics/description/machine.h.
struct StageMachine {
  struct Joint {
    std::string name, type;  ///< "turns", "slides" or "fixed"
    int parent = 0, child = 0;
    Pose X_PJ = Pose::Identity();
    Vec3 axis_J = Vec3::UnitZ();
    double initial = 0;  ///< rad or m
  };
  struct Gear {
    std::string name;
    int link = 0;
    double radius_m = 0;
  };
  struct Wheel {
    int gear = 0;
    Vec3 axle_B_m = Vec3::Zero();
  };
  struct Track {
    int gear = 0, shoes = 0;
    std::vector<Vec3> path_B_m;
  };
  struct Linkage {
    int joint = 0;
    Vec3 rocker_pin_P_m = Vec3::Zero(), coupler_pin_B_m = Vec3::Zero();
    double rocker_m = 0, coupler_m = 0;
    int branch = 1;
  };
  struct Cylinder {
    int joint = 0, barrel_link = 0, rod_link = 0, linkage = -1, count = 1;
    Vec3 barrel_pin_m = Vec3::Zero(), rod_pin_m = Vec3::Zero();
    double spacing_m = 0;
  };

  std::string name;
  int first_body = 0;
  std::vector<std::string> links;
  std::vector<Joint> joints;
  std::vector<Gear> gears;
  std::vector<Wheel> wheels;
  std::vector<Track> tracks;
  std::vector<Linkage> linkages;
  std::vector<Cylinder> cylinders;
  std::vector<int> loads;  ///< links of shovels that carry soil
};

/// A thing of one body, with its poses over time; one of them where it stands still.
struct StageObstacle {
  std::string name;
  int body = 0;
  std::vector<std::pair<double, Pose>> X_WB_at_s;
};

struct Stage {
  std::vector<StageMesh> meshes;
  std::vector<StageNode> nodes;
  std::vector<StageMachine> machines;
  std::vector<StageObstacle> obstacles;
  int bodies = 0;
};

}  // namespace tera
