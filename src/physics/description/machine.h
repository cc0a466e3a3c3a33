#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"
#include "core/types/effects.h"
#include "core/types/ground_tools.h"
#include "core/types/labels.h"
#include "core/types/learned_effect.h"
#include "core/types/looks.h"

/// What a machine is: a tree of links and joints, its levers, its tools and its looks. Nothing here
/// knows an excavator from a cart.

namespace tera {

/// A box fixed to a link, for collision with obstacles and other machines.
struct CollisionBox {
  Pose X_BG = Pose::Identity();  ///< centre of the box in the link frame
  Vec3 size_m = Vec3::Zero();    ///< edge lengths
};

/// A mesh whose box is to collide. Whoever can read meshes makes a CollisionBox of it before the
/// machine is simulated.
struct CollisionMesh {
  std::filesystem::path mesh;  ///< glTF, OBJ, STL or DAE
  std::string part;            ///< that has it, for messages: "link 'boom' of arm.urdf:12"
  Pose X_BG = Pose::Identity();
  Vec3 scale = Vec3::Ones();
};

/// A mesh node, or a solid, shown at the link's frame.
struct Visual {
  std::filesystem::path mesh;  ///< glTF, OBJ, STL or DAE
  std::string node;            ///< node of the file, empty for all of it
  std::string place;           ///< "file:line:column: key" that names the mesh, for messages
  Pose X_BG = Pose::Identity();
  double scale = 1.0;
  std::optional<Solid> solid;  ///< instead of a mesh
  std::optional<Paint> paint;  ///< of what has no colour of its own: a solid, an STL file
  /// Label where it differs from the link's (tracks on the undercarriage).
  std::optional<SemanticClass> label;
};

struct Link {
  std::string name;
  double mass_kg = 0;
  Vec3 com_B_m = Vec3::Zero();
  Mat3 inertia_B_kgm2 = Mat3::Zero();  ///< about the centre of mass, axes of B
  SemanticClass label = SemanticClass::kVehicle;
  std::vector<CollisionBox> collision;
  std::vector<CollisionMesh> collision_meshes;  ///< of a URDF, until they are boxes
  std::vector<Visual> visuals;
};

enum class JointType { kFixed, kRevolute, kContinuous, kPrismatic };

/// A joint that another one of the machine moves, as a mechanism that is no body here ties them:
/// q = ratio * q(leader) + offset, in radians, or metres of what slides.
struct Following {
  int leader = -1;  ///< index into joints; itself follows none
  double ratio = 1, offset = 0;

  double At(double leader_q) const { return ratio * leader_q + offset; }
};

/// Joint between two links. Angle q > 0 turns the child about `axis_J` by the right-hand rule.
///
/// Frames  P parent link, J joint frame (X_PJ at q = 0 is where the child's frame stands), B child.
struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  int parent = -1, child = -1;
  Pose X_PJ = Pose::Identity();
  Vec3 axis_J = Vec3::UnitZ();
  double lower_rad = 0, upper_rad = 0;  ///< metres for prismatic joints
  double max_rate_positive_radps = 0;   ///< rate at full positive lever
  double max_rate_negative_radps = 0;   ///< magnitude at full negative lever
  /// Newtons for prismatic joints. Where cylinders limit the effort, what they can do at
  /// mid-travel, the mean of both directions.
  double max_effort_nm = 0;
  double initial_rad = 0;
  /// Oil that the joint's actuator takes for one radian (or metre) at mid-travel, of cylinders the
  /// mean of both directions; 0 where unknown.
  double displacement_m3prad = 0;
  /// Then it has neither effort nor rate of its own; its limits are where its leader's take it.
  std::optional<Following> following;
  /// Running gear that turns it, a wheel's joint, by gear_ratio (1 or -1) of its own angle.
  int gear = -1;
  double gear_ratio = 1;
};

/// A hydraulic pump and what draws from it.
struct Pump {
  std::string name;
  double max_flow_m3ps = 0;
  std::vector<int> joints, gears;  ///< indices into joints and ground_tools.gears
};

/// What moves a machine's running gear over the ground.
enum class GroundModel {
  kTerramechanics,  ///< the soil's shear under every patch
  kIdeal,           ///< two tracks that neither slip nor skid, as far as the ground's strength goes
  kKinematic        ///< the same with the terms of slip among the machine's effects
};

/// What a machine has beyond the ideal, one list for each joint, running gear and pump.
struct MachineEffects {
  std::vector<Effects> joints, gears, pumps;
  Effects base;
  /// What has no name, of each joint and then of each running gear; may be shorter.
  std::vector<std::optional<LearnedEffect>> learned;
};

/// Drive of one running gear (index into GroundTools::gears).
struct GearDrive {
  double max_rate_radps = 0;  ///< sprocket or wheel rate at full lever
  double max_torque_nm = 0;
  double inertia_kgm2 = 0;         ///< of everything that turns with it, at the sprocket
  double displacement_m3prad = 0;  ///< oil for one radian of the sprocket; 0 where unknown
  double low_speed_ratio = 1;      ///< of two-speed travel: the low speed over the high one
};

/// One input of the machine, -1..+1: either a joint or a running gear.
struct Lever {
  std::string name;  ///< as in commands.csv
  int joint = -1;    ///< index into joints, or -1
  int gear = -1;     ///< index into ground_tools.gears, or -1
};

/// Rocker and coupler that turn a joint: a closed four-bar of the joint's two links and these.
///
/// Frames  P the joint's parent link, B its child. The rocker's own frame R has its origin at the
///         rocker's pin in P, x towards the knee (the pin that it shares with the coupler) and y
///         along the joint's axis; the coupler's frame C the same from its pin in B.
struct FourBar {
  std::string name;
  int joint = 0;
  Vec3 rocker_pin_P_m = Vec3::Zero(), coupler_pin_B_m = Vec3::Zero();
  double rocker_m = 0, coupler_m = 0;  ///< pin to pin
  /// On which side of the line from the rocker's pin to the coupler's the knee is: +1 where turning
  /// from the line towards the knee is a positive turn of the joint, else -1.
  int branch = 1;
  std::optional<Visual> rocker, coupler;  ///< meshes in R and C
};

/// A hydraulic cylinder between two pins, or several alike side by side. Barrel and rod point at
/// each other in every pose; the joint between their links moves it.
struct Cylinder {
  std::string name;
  int joint = -1;  ///< the one that moves between barrel and rod; nothing else does
  int barrel_link = 0, rod_link = 0;
  Vec3 barrel_pin_m = Vec3::Zero();  ///< in the barrel link's frame
  Vec3 rod_pin_m = Vec3::Zero();     ///< in the rod link's frame, or in the rocker's
  int linkage = -1;                  ///< four-bar whose rocker carries the rod's pin, or -1
  /// Meshes along +x: barrel from its pin, rod towards its pin (rod eye at the origin, extending
  /// along -x).
  std::optional<Visual> barrel, rod;
  int count = 1;         ///< alike, spread along the joint's axis about the pins
  double spacing_m = 0;  ///< from one to the next
  double bore_m = 0;     ///< 0: only shown, the joint's effort is not the cylinder's
  double rod_diameter_m = 0;
  double relief_pa = 0;  ///< most in either chamber
  double return_pressure_pa = 0;
  double shortest_m = 0, longest_m = 0;  ///< between the pins over the joint's travel
};

/// Shoes that run around a track: one instanced mesh along the closed path.
struct TrackVisual {
  int gear = 0;
  Visual shoe;
  std::vector<Vec3> path_B_m;  ///< closed polyline in the link frame along the shoes' outer face,
                               ///< in the direction in which they move when the gear drives forward
  int shoe_count = 0;
};

/// A wheel that turns with its running gear: shown at `axle_B_m` in the gear's link, turned about
/// the link's +y axis by the gear's angle.
struct WheelVisual {
  int gear = 0;
  Visual visual;
  Vec3 axle_B_m = Vec3::Zero();
};

/// A point and direction that tools of the operator need, by name ("bucket_tip").
struct NamedFrame {
  std::string name;
  int link = 0;
  Pose X_BF = Pose::Identity();
};

/// A machine's constant part.
///
/// Frames  B of each link; links[0]'s is the root's.
/// Model   a tree of rigid links and joints with one degree of freedom or none; running gear with
///         one rotating inertia each; levers that ask for rates.
/// Omits   closed chains as bodies (rockers, couplers and cylinders follow their joint without mass
///         of their own), flexibility. What moves joints and gears beside their limits is in
///         `effects`.
struct MachineModel {
  std::string kind;  ///< e.g. "tb235"
  bool fixed_base = false;
  std::vector<Link> links;    ///< links[0] is the root, links[k + 1] the child of joints[k]
  std::vector<Joint> joints;  ///< parents before children
  std::vector<Lever> levers;
  GroundTools ground_tools;
  std::vector<GearDrive> gear_drives;  ///< one for each gear
  std::vector<Pump> pumps;
  GroundModel ground = GroundModel::kTerramechanics;  ///< of a scenario's machine
  MachineEffects effects;  ///< of a scenario's machine; without it, ideal throughout
  std::vector<FourBar> linkages;
  std::vector<Cylinder> cylinders;
  std::vector<TrackVisual> track_visuals;
  std::vector<WheelVisual> wheel_visuals;
  std::vector<NamedFrame> frames;
  double gauge_m = 0;  ///< distance between left and right gear centres, 0 without
  /// Everything that its reader left out or changed, a sentence each.
  std::vector<std::string> remarks;

  int LinkIndex(std::string_view name) const;  ///< -1 if there is none
  int JointIndex(std::string_view name) const;
  int LeverIndex(std::string_view name) const;
  double TotalMass_kg() const;
  /// Whether it has running gear or hull points; else it falls unless its base is fixed.
  bool BearsOnGround() const {
    return !ground_tools.gears.empty() || !ground_tools.hull_points.empty();
  }
};

/// The treatment of meshes that a URDF names and that are not there.
enum class AbsentMeshes {
  kFault,
  kLeftOut  ///< with a remark
};

/// Reads TERA's keys or, with `urdf: file.urdf`, a URDF and the keys that it lacks (levers, gear,
/// shovels). Faults go to `config`; after one that leaves no tree the model is empty. Of meshes in
/// `collision_meshes` boxes must then be made, by SetCollisionMeshes of
/// sim/scenario/collision_meshes.h.
MachineModel ReadMachine(const ConfigMap& config, AbsentMeshes absent = AbsentMeshes::kFault);

/// Pose of a joint's child frame in the joint frame J at position `q` (radians or metres).
Pose JointMotion(const Joint& joint, double q);

/// The joint that `joint` follows, or itself.
int LeaderOf(const MachineModel& model, int joint);

/// Puts the joints that follow others where those take them.
void PlaceFollowers(const MachineModel& model, std::vector<double>* q_rad);

/// Poses of all links for joint angles `q_rad` (one for each joint, fixed ones included) with the
/// root at X_WB.
std::vector<Pose> ForwardKinematics(const MachineModel& model, const Pose& X_WB,
                                    const std::vector<double>& q_rad);

/// How far left of the root's x axis the middle of a gear's patches is, with joints as at first.
double LeftOfRoot_m(const MachineModel& model, std::size_t gear);

/// One cylinder of those side by side. Force and rate are positive where the rod moves out.
struct CylinderState {
  double length_m = 0;  ///< between the pins
  double stroke_m = 0;  ///< beyond the shortest length of the joint's travel
  double rate_mps = 0, force_n = 0;
  double head_pressure_pa = 0, rod_pressure_pa = 0;  ///< above that of the surroundings
};

/// State of one machine after a step.
struct MachineState {
  std::vector<BodyState> links;
  std::vector<double> q_rad, qd_radps, effort_nm;  ///< one for each joint
  std::vector<double> friction_nm;                 ///< of each joint, beside its effort
  std::vector<double> gear_angle_rad, gear_rate_radps, gear_torque_nm, gear_friction_nm;
  std::vector<double> levers;  ///< as applied, one for each lever
  std::vector<SoilReaction::Load> shovel_load;
  std::vector<double> gear_sinkage_m, gear_slip;
  std::vector<CylinderState> cylinders;
};

}  // namespace tera
