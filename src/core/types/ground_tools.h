#pragma once

#include <string>
#include <vector>

#include "core/motion.h"

/// The parts of a machine that touch soil: what the machine description knows about them and what
/// the soil needs. All geometry is fixed in the frame B of the link that carries the part
/// (x forward, y left, z up in the link's own zero pose).

namespace tera {

/// A tool with a cutting edge: bucket or blade.
///
/// Frames  B link frame. The tool is an extrusion along B's y axis, from -width/2 to +width/2.
/// Model   `profile_B_m` is the inner side profile in B's x-z plane, an open polyline that starts
///         at the cutting edge (first point; at the tips of the teeth where there are any), follows
///         the floor, then the back, and ends at the top edge. The segment from last to first point
///         is the mouth. A blade has a profile that does not enclose an area worth carrying:
///         `capacity_m3` is 0 and it only pushes.
struct Shovel {
  std::string name;
  int link = 0;
  std::vector<Vec2> profile_B_m;  ///< (x, z)
  double width_m = 0;
  double capacity_m3 = 0;  ///< struck capacity; heaped load may exceed it by the angle of repose
  int teeth = 0;
  double tooth_length_m = 0;  ///< by which the teeth stand before the edge
  double tooth_width_m = 0.06, tooth_thickness_m = 0.02;
  double edge_thickness_m = 0.012;
};

/// A small area of a track shoe or tyre that presses on the ground.
struct ContactPatch {
  Vec3 p_B_m = Vec3::Zero();
  Vec3 outward_B = -Vec3::UnitZ();  ///< unit normal, away from the machine
  /// Unit direction in which the surface moves relative to B when the gear drives forward:
  /// backwards (-x) along the bottom run of a track.
  Vec3 travel_B = -Vec3::UnitX();
  double length_m = 0;  ///< along travel
  double width_m = 0;   ///< across travel
  // Road wheels press on the track from above, so that the pressure under it has peaks.
  double wheel_pitch_m = 0;  ///< between their axles; 0: the patch presses evenly
  double past_wheel_m = 0;   ///< from the nearest axle to the patch's middle, along travel
};

/// One driven element on the ground: a track or a wheel. Its patches stand still in B while the
/// surface (shoes, tread) moves through them at the speed `ShoeRadius_m() * rate_radps`.
struct RunningGear {
  std::string name;
  int link = 0;
  double drive_radius_m = 0;   ///< sprocket pitch radius or rolling radius, as described
  double shoe_ratio = 1;       ///< what the surface moves over what that radius would
  double grouser_m = 0;        ///< height of the ribs (lugs) of its surface, which hold soil
  double grouser_pitch_m = 0;  ///< from rib to rib along travel; 0: they leave no print
  std::vector<ContactPatch> patches;

  /// What the surface moves for one radian of the drive.
  double ShoeRadius_m() const { return drive_radius_m * shoe_ratio; }
};

/// The ground as one machine meets it.
struct Footing {
  bool shears = true;    ///< false: the ground carries the running gear, but does not drive it
  double strength = 1;   ///< of cohesion, adhesion and tan(friction angle)
  double stiffness = 1;  ///< of the moduli of elasticity and of pressure and sinkage
};

/// Everything of one machine that the soil can feel.
struct GroundTools {
  double mass_kg = 0;  ///< of the whole machine, which its structure on the ground must bear
  Footing footing;
  std::vector<Shovel> shovels;
  std::vector<RunningGear> gears;
  /// Points of the structure that may touch ground when the machine digs itself in or tips over.
  struct HullPoint {
    int link = 0;
    Vec3 p_B_m = Vec3::Zero();
  };
  std::vector<HullPoint> hull_points;
};

/// Motion of those parts at one instant.
struct GroundToolsMotion {
  const std::vector<BodyState>* links = nullptr;  ///< one for each link of the machine
  std::vector<double> gear_rate_radps;            ///< one for each gear, positive drives forward
};

/// What the soil does to a machine over the next step.
struct SoilReaction {
  std::vector<Wrench> link_wrench;      ///< one for each link, about the link frame's origin
  std::vector<double> gear_traction_n;  ///< one for each gear: ground force along forward travel
  struct Load {
    double mass_kg = 0;
    Vec3 com_B_m = Vec3::Zero();
    double volume_m3 = 0;
    std::vector<double> soil_kg;  ///< of the mass, each of the site's soils
  };
  std::vector<Load> shovel_load;       ///< one for each shovel: the soil it carries
  std::vector<double> gear_sinkage_m;  ///< one for each gear: largest sinkage of its patches
  std::vector<double> gear_slip;       ///< one for each gear: 1 - v / (r w), 0 at rest
  std::vector<double> gear_grip_n;     ///< one for each gear: shear strength of the ground under it
};

}  // namespace tera
