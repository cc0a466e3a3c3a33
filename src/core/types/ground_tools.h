#pragma once

#include <string>
#include <vector>

#include "core/motion.h"

/// Machine parts that touch soil, read from the machine description. Geometry is fixed in frame B
/// of the part's link: x forward, y left, z up when all joints are at zero.

namespace tera {

/// A tool with a cutting edge, such as a bucket or a blade.
///
/// Frames  B link frame. The tool is a profile extruded along B's y axis from -width/2 to +width/2.
/// Model   `profile_B_m` is the inner side profile in B's x-z plane, as an open polyline. It starts
///         at the cutting edge, or at the tooth tips. It follows the floor and the back to the top
///         edge. The mouth is the segment from the last point to the first. A blade only pushes
///         soil and holds none, so its `capacity_m3` is 0.
struct Shovel {
  std::string name;
  int link = 0;
  std::vector<Vec2> profile_B_m;  ///< points (x, z) in B
  double width_m = 0;
  double capacity_m3 = 0;  ///< struck capacity; a heap above it may add more
  int teeth = 0;
  double tooth_length_m = 0;  ///< length of the teeth in front of the edge
  double tooth_width_m = 0.06, tooth_thickness_m = 0.02;
  double edge_thickness_m = 0.012;
};

/// A small area of a track shoe or tyre tread that presses on the ground.
struct ContactPatch {
  Vec3 p_B_m = Vec3::Zero();
  Vec3 outward_B = -Vec3::UnitZ();  ///< unit normal, away from the machine
  /// Unit direction in which the surface moves relative to B in forward drive. On the bottom run of
  /// a track it points backwards (-x).
  Vec3 travel_B = -Vec3::UnitX();
  double length_m = 0;  ///< size along travel_B
  double width_m = 0;   ///< size across travel_B
  // Road wheels press on the track from above and cause peaks of ground pressure below each axle.
  double wheel_pitch_m = 0;  ///< distance between axles; 0 gives uniform pressure
  double past_wheel_m = 0;   ///< distance along travel_B from the nearest axle to the patch centre
};

/// A driven track or wheel on the ground. Its contact patches are fixed in B. The shoes or the
/// tread move through the patches at the speed `ShoeRadius_m() * rate_radps`.
struct RunningGear {
  std::string name;
  int link = 0;
  double drive_radius_m = 0;   ///< sprocket pitch radius or rolling radius from the machine
                               ///< description
  double shoe_ratio = 1;       ///< travel of the shoe surface divided by travel at the drive radius
  double grouser_m = 0;        ///< height of the grousers (lugs), which enclose soil between them
  double grouser_pitch_m = 0;  ///< grouser spacing along travel; 0 if the grousers leave no print
  std::vector<ContactPatch> patches;

  /// Travel of the shoe surface per radian of the drive.
  double ShoeRadius_m() const { return drive_radius_m * shoe_ratio; }
};

/// Ground properties below one machine.
struct Footing {
  bool shears = true;    ///< false: the ground supports the running gear but transmits no traction
  double strength = 1;   ///< factor on cohesion, adhesion and tan(friction angle)
  double stiffness = 1;  ///< factor on the elastic moduli and on the pressure-sinkage moduli
};

/// All parts of one machine that touch soil.
struct GroundTools {
  double mass_kg = 0;  ///< mass of the whole machine, for contact of its structure with the ground
  Footing footing;
  std::vector<Shovel> shovels;
  std::vector<RunningGear> gears;
  /// Points of the structure that touch the ground when the machine tips over or the structure digs
  /// in.
  struct HullPoint {
    int link = 0;
    Vec3 p_B_m = Vec3::Zero();
  };
  std::vector<HullPoint> hull_points;
};

/// Motion of these parts at one instant.
struct GroundToolsMotion {
  const std::vector<BodyState>* links = nullptr;  ///< one per link of the machine
  std::vector<double> gear_rate_radps;            ///< one per gear; positive drives forward
};

/// Soil forces on a machine, valid for the next step.
struct SoilReaction {
  std::vector<Wrench> link_wrench;      ///< one per link, about the link frame's origin
  std::vector<double> gear_traction_n;  ///< one per gear: ground force in the direction of forward
                                        ///< travel
  struct Load {
    double mass_kg = 0;
    Vec3 com_B_m = Vec3::Zero();
    double volume_m3 = 0;
    std::vector<double> soil_kg;       ///< mass per soil of the site
    Vec3 surface_up_B = Vec3::Zero();  ///< normal of the load's mean surface plane; zero vector:
                                       ///< level surface
  };
  std::vector<Load> shovel_load;       ///< one per shovel: the soil that it carries
  std::vector<double> gear_sinkage_m;  ///< one per gear: largest sinkage among its patches
  std::vector<double> gear_slip;       ///< one per gear: slip 1 - v / (r w); 0 at rest
  std::vector<double> gear_grip_n;     ///< one per gear: shear force that the ground below it can
                                       ///< transmit
};

}  // namespace tera
