#pragma once

#include <string>
#include <vector>

#include "core/motion.h"

/// Machine parts in contact with soil, from the machine description. All geometry is fixed in the
/// frame B of the link that carries the part: x forward, y left, z up in the link's zero pose.

namespace tera {

/// A tool with a cutting edge: bucket or blade.
///
/// Frames  B link frame. The tool is an extrusion along B's y axis, from -width/2 to +width/2.
/// Model   `profile_B_m` is the inner side profile in B's x-z plane, an open polyline. It starts at
///         the cutting edge, or at the tips of the teeth. It follows the floor and the back and
///         ends at the top edge. The segment from last to first point is the mouth. A blade only
///         pushes: its profile encloses no useful area, and `capacity_m3` is 0.
struct Shovel {
  std::string name;
  int link = 0;
  std::vector<Vec2> profile_B_m;  ///< (x, z)
  double width_m = 0;
  double capacity_m3 = 0;  ///< struck capacity; the angle of repose allows additional heaped load
  int teeth = 0;
  double tooth_length_m = 0;  ///< length of the teeth in front of the edge
  double tooth_width_m = 0.06, tooth_thickness_m = 0.02;
  double edge_thickness_m = 0.012;
};

/// A small area of a track shoe or tyre that presses on the ground.
struct ContactPatch {
  Vec3 p_B_m = Vec3::Zero();
  Vec3 outward_B = -Vec3::UnitZ();  ///< unit normal, away from the machine
  /// Unit direction of the surface's motion relative to B in forward drive: backwards (-x) along
  /// the bottom run of a track.
  Vec3 travel_B = -Vec3::UnitX();
  double length_m = 0;  ///< along travel
  double width_m = 0;   ///< across travel
  // Road wheels load the track from above and cause pressure peaks under it.
  double wheel_pitch_m = 0;  ///< distance between axles; 0: uniform pressure
  double past_wheel_m = 0;   ///< from the nearest axle to the patch centre, along travel
};

/// A driven track or wheel on the ground. Its patches are fixed in B. The surface (shoes, tread)
/// moves through them at the speed `ShoeRadius_m() * rate_radps`.
struct RunningGear {
  std::string name;
  int link = 0;
  double drive_radius_m = 0;   ///< sprocket pitch radius or rolling radius, as described
  double shoe_ratio = 1;       ///< surface travel relative to travel of the drive radius
  double grouser_m = 0;        ///< height of the grousers (lugs), which hold soil
  double grouser_pitch_m = 0;  ///< grouser spacing along travel; 0: grousers leave no print
  std::vector<ContactPatch> patches;

  /// Surface travel per radian of the drive.
  double ShoeRadius_m() const { return drive_radius_m * shoe_ratio; }
};

/// Ground properties under one machine.
struct Footing {
  bool shears = true;    ///< false: the ground carries the running gear without traction
  double strength = 1;   ///< factor on cohesion, adhesion and tan(friction angle)
  double stiffness = 1;  ///< factor on the moduli of elasticity and of pressure and sinkage
};

/// All parts of one machine that interact with the soil.
struct GroundTools {
  double mass_kg = 0;  ///< mass of the whole machine, which structural ground contact must carry
  Footing footing;
  std::vector<Shovel> shovels;
  std::vector<RunningGear> gears;
  /// Points of the structure that may touch the ground when the machine digs in or tips over.
  struct HullPoint {
    int link = 0;
    Vec3 p_B_m = Vec3::Zero();
  };
  std::vector<HullPoint> hull_points;
};

/// Motion of the soil-contact parts at one instant.
struct GroundToolsMotion {
  const std::vector<BodyState>* links = nullptr;  ///< one for each link of the machine
  std::vector<double> gear_rate_radps;            ///< one per gear; positive drives forward
};

/// Soil forces on a machine over the next step.
struct SoilReaction {
  std::vector<Wrench> link_wrench;      ///< one per link, about the link frame's origin
  std::vector<double> gear_traction_n;  ///< one per gear: ground force along forward travel
  struct Load {
    double mass_kg = 0;
    Vec3 com_B_m = Vec3::Zero();
    double volume_m3 = 0;
    std::vector<double> soil_kg;       ///< mass of each of the site's soils
    Vec3 surface_up_B = Vec3::Zero();  ///< normal of the plane its surface lies about; zero: level
  };
  std::vector<Load> shovel_load;       ///< one per shovel: carried soil
  std::vector<double> gear_sinkage_m;  ///< one per gear: largest sinkage of its patches
  std::vector<double> gear_slip;       ///< one per gear: 1 - v / (r w); 0 at rest
  std::vector<double> gear_grip_n;     ///< one per gear: shear strength of the ground under it
};

}  // namespace tera
