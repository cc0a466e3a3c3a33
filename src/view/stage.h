#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/motion.h"

/// Objects of a scene for the page, as plain data. The page computes the poses of bodies from
/// machine poses and joint positions.

namespace tera {

/// Triangles with one colour, or with a colour per vertex.
struct StagePart {
  std::vector<float> positions_m, normals, colours;  ///< three numbers per vertex; colours may be
                                                     ///< empty
  std::vector<std::uint32_t> indices;
  Vec3 colour = Vec3::Constant(0.5);  ///< linear RGB, used if `colours` is empty
  double opacity = 1;
};

struct StageMesh {
  std::vector<StagePart> parts;
};

struct StageNode {
  int mesh = 0, body = 0;
  Pose X_BG = Pose::Identity();
  double scale = 1;
  std::uint16_t instance = 0;
};

/// Bodies of a machine, numbered from `first_body` in this order: links, wheels, track shoes,
/// rockers and couplers, barrels and rods, soil in shovels. Frames and formulas are those of
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
  std::vector<int> loads;  ///< links of the shovels that can carry soil
};

/// An object with one body, and its poses over time. A fixed object has one pose.
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
