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

/// Description of a machine: a tree of links and joints, levers, tools and visuals. It does not
/// depend on the kind of machine.

namespace tera {

/// A box fixed to a link, for collisions with obstacles and other machines.
struct CollisionBox {
  Pose X_BG = Pose::Identity();  ///< centre of the box in the link frame
  Vec3 size_m = Vec3::Zero();    ///< edge lengths
};

/// A mesh that collides by its bounding box. For simulation, SetCollisionMeshes must convert it to
/// a CollisionBox.
struct CollisionMesh {
  std::filesystem::path mesh;  ///< glTF, OBJ, STL or DAE
  std::string part;  ///< part that names the mesh, for messages: "link 'boom' of arm.urdf:12"
  Pose X_BG = Pose::Identity();
  Vec3 scale = Vec3::Ones();
};

/// A mesh node or a solid, shown in the link's frame.
struct Visual {
  std::filesystem::path mesh;  ///< glTF, OBJ, STL or DAE
  std::string node;            ///< node of the file; empty for the whole file
  std::string place;  ///< position of the mesh's name, "file:line:column: key", for messages
  Pose X_BG = Pose::Identity();
  double scale = 1.0;
  std::optional<Solid> solid;  ///< instead of a mesh
  std::optional<Paint> paint;  ///< for shapes without a colour: a solid, an STL file
  /// Label if it differs from that of the link, for example tracks on the undercarriage.
  std::optional<SemanticClass> label;
};

struct Link {
  std::string name;
  double mass_kg = 0;
  Vec3 com_B_m = Vec3::Zero();
  Mat3 inertia_B_kgm2 = Mat3::Zero();  ///< about the centre of mass, axes of B
  SemanticClass label = SemanticClass::kVehicle;
  std::vector<CollisionBox> collision;
  std::vector<CollisionMesh> collision_meshes;  ///< from a URDF, not yet converted to boxes
  std::vector<Visual> visuals;
};

enum class JointType { kFixed, kRevolute, kContinuous, kPrismatic };

/// Coupling of a joint to a leading joint: q = ratio * q(leader) + offset, in radians, or metres
/// for prismatic joints. The mechanism of the coupling has no bodies.
struct Following {
  int leader = -1;  ///< index into joints; the leader must not follow another joint
  double ratio = 1, offset = 0;

  double At(double leader_q) const { return ratio * leader_q + offset; }
};

/// Joint between two links. Angle q > 0 turns the child about `axis_J` by the right-hand rule.
///
/// Frames  P parent link, J joint frame (X_PJ: pose of the child's frame at q = 0), B child.
struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  int parent = -1, child = -1;
  Pose X_PJ = Pose::Identity();
  Vec3 axis_J = Vec3::UnitZ();
  double lower_rad = 0, upper_rad = 0;  ///< metres for prismatic joints
  double max_rate_positive_radps = 0;   ///< rate at full positive lever
  double max_rate_negative_radps = 0;   ///< magnitude of the rate at full negative lever
  /// Newtons for prismatic joints. For a joint with driving cylinders it is their limit at
  /// mid-travel, averaged over both directions.
  double max_effort_nm = 0;
  double initial_rad = 0;
  /// Oil volume per radian (or metre) of the actuator at mid-travel, averaged over both directions
  /// for cylinders; 0 if unknown.
  double displacement_m3prad = 0;
  /// A following joint has no effort and rate of its own. Its limits follow from those of its
  /// leader.
  std::optional<Following> following;
  /// Running gear that turns the joint of a wheel, by gear_ratio (1 or -1) times the gear's angle;
  /// -1 for none.
  int gear = -1;
  double gear_ratio = 1;
};

/// A hydraulic pump and its consumers.
struct Pump {
  std::string name;
  double max_flow_m3ps = 0;
  std::vector<int> joints, gears;  ///< indices into joints and ground_tools.gears
};

/// Model of travel over the ground.
enum class GroundModel {
  kTerramechanics,  ///< shear of the soil under each contact patch
  kIdeal,           ///< two tracks without slip or skid, within the ground's shear strength
  kKinematic        ///< the ideal tracks with the slip effects of the machine
};

/// Deviations of a machine from the ideal model: one list per joint, running gear and pump.
struct MachineEffects {
  std::vector<Effects> joints, gears, pumps;
  Effects base;
  /// Learned effects of the joints, then of the running gears. The list may be shorter.
  std::vector<std::optional<LearnedEffect>> learned;
};

/// Drive of one running gear (index into GroundTools::gears).
struct GearDrive {
  double max_rate_radps = 0;  ///< sprocket or wheel rate at full lever
  double max_torque_nm = 0;
  double inertia_kgm2 = 0;  ///< inertia of all parts that turn with the gear, at the sprocket
  double displacement_m3prad = 0;  ///< oil volume per radian of the sprocket; 0 if unknown
  double low_speed_ratio = 1;      ///< two-speed travel: low speed over high speed
};

/// An input of the machine, -1..+1, for one joint or one running gear.
struct Lever {
  std::string name;  ///< name in commands.csv
  int joint = -1;    ///< index into joints, or -1
  int gear = -1;     ///< index into ground_tools.gears, or -1
};

/// Rocker and coupler that turn a joint. With the two links of the joint they form a closed
/// four-bar linkage.
///
/// Frames  P is the parent link of the joint, B its child. The rocker's frame R has its origin at
///         the rocker's pin in P. Its x axis points to the knee (the pin shared with the coupler),
///         its y axis along the joint's axis. The coupler's frame C is defined likewise from the
///         coupler's pin in B.
struct FourBar {
  std::string name;
  int joint = 0;
  Vec3 rocker_pin_P_m = Vec3::Zero(), coupler_pin_B_m = Vec3::Zero();
  double rocker_m = 0, coupler_m = 0;  ///< lengths from pin to pin
  /// Side of the knee relative to the line from the rocker's pin to the coupler's pin. +1 if a
  /// positive turn of the joint leads from the line towards the knee, otherwise -1.
  int branch = 1;
  std::optional<Visual> rocker, coupler;  ///< meshes in R and C
};

/// A hydraulic cylinder between two pins, or several equal cylinders in parallel. Barrel and rod
/// point at each other in every pose.
struct Cylinder {
  std::string name;
  int joint = -1;  ///< the only joint that moves between barrel and rod
  int barrel_link = 0, rod_link = 0;
  Vec3 barrel_pin_m = Vec3::Zero();  ///< in the barrel link's frame
  Vec3 rod_pin_m = Vec3::Zero();     ///< in the frame of the rod's link, or of the rocker
  int linkage = -1;  ///< index of the four-bar whose rocker carries the rod's pin, or -1
  /// Meshes along +x. The barrel starts at its pin. The rod has its eye at the origin and extends
  /// along -x.
  std::optional<Visual> barrel, rod;
  int count = 1;  ///< number of equal cylinders, spread along the joint's axis about the pins
  double spacing_m = 0;  ///< between neighbouring cylinders
  double bore_m = 0;     ///< 0: the cylinder is only shown and does not drive the joint
  double rod_diameter_m = 0;
  double relief_pa = 0;  ///< maximum pressure in either chamber
  double return_pressure_pa = 0;
  double shortest_m = 0, longest_m = 0;  ///< between the pins over the joint's travel
};

/// Shoes of a track: instances of a mesh that move along a closed path.
struct TrackVisual {
  int gear = 0;
  Visual shoe;
  /// Closed polyline in the link frame along the outer face of the shoes, in their direction of
  /// motion when the gear drives forward.
  std::vector<Vec3> path_B_m;
  int shoe_count = 0;
};

/// A wheel that turns with its running gear. It is shown at `axle_B_m` in the link of the gear,
/// turned about +y by the gear's angle.
struct WheelVisual {
  int gear = 0;
  Visual visual;
  Vec3 axle_B_m = Vec3::Zero();
};

/// A named frame for the operator's tools, for example "bucket_tip".
struct NamedFrame {
  std::string name;
  int link = 0;
  Pose X_BF = Pose::Identity();
};

/// Constant description of a machine.
///
/// Frames  B of each link; that of the root belongs to links[0].
/// Model   A tree of rigid links and joints with one degree of freedom or none; running gear with
///         one rotating inertia each; levers that command rates.
/// Omits   Closed chains as bodies: rockers, couplers and cylinders follow their joint without
///         mass. Flexibility. `effects` holds the deviations of joints and gears from this model.
struct MachineModel {
  std::string kind;  ///< for example "tb235"
  bool fixed_base = false;
  std::vector<Link> links;    ///< links[0] is the root, links[k + 1] the child of joints[k]
  std::vector<Joint> joints;  ///< parents before children
  std::vector<Lever> levers;
  GroundTools ground_tools;
  std::vector<GearDrive> gear_drives;  ///< one per gear
  std::vector<Pump> pumps;
  GroundModel ground = GroundModel::kTerramechanics;  ///< set by a scenario
  MachineEffects effects;                             ///< set by a scenario; ideal otherwise
  std::vector<FourBar> linkages;
  std::vector<Cylinder> cylinders;
  std::vector<TrackVisual> track_visuals;
  std::vector<WheelVisual> wheel_visuals;
  std::vector<NamedFrame> frames;
  double gauge_m = 0;  ///< distance between left and right gear centres; 0 if undefined
  /// Remarks of the reader on omitted or changed input, one sentence each.
  std::vector<std::string> remarks;

  int LinkIndex(std::string_view name) const;  ///< all three return -1 if the name is absent
  int JointIndex(std::string_view name) const;
  int LeverIndex(std::string_view name) const;
  double TotalMass_kg() const;
  /// True if the machine has running gear or hull points. Without them it falls, unless its base is
  /// fixed.
  bool BearsOnGround() const {
    return !ground_tools.gears.empty() || !ground_tools.hull_points.empty();
  }
};

/// Treatment of missing meshes of a URDF.
enum class AbsentMeshes {
  kFault,
  kLeftOut  ///< omitted, with a remark
};

/// Reads a machine: TERA's own keys, or `urdf: file.urdf` with the keys that a URDF lacks (levers,
/// gear, shovels). Reports faults to `config`. The model is empty after a fault that leaves no
/// tree. The caller must convert `collision_meshes` to boxes with SetCollisionMeshes of
/// sim/scenario/collision_meshes.h.
MachineModel ReadMachine(const ConfigMap& config, AbsentMeshes absent = AbsentMeshes::kFault);

/// Pose of the child's frame in the joint frame J at position `q` (radians or metres).
Pose JointMotion(const Joint& joint, double q);

/// Leader of `joint`, or `joint` itself without one.
int LeaderOf(const MachineModel& model, int joint);

/// Sets the positions of following joints from their leaders.
void PlaceFollowers(const MachineModel& model, std::vector<double>* q_rad);

/// Poses of all links for joint positions `q_rad` (one per joint, fixed joints included) with the
/// root at X_WB.
std::vector<Pose> ForwardKinematics(const MachineModel& model, const Pose& X_WB,
                                    const std::vector<double>& q_rad);

/// Lateral offset of the centre of a gear's patches from the root's x axis, positive to the left,
/// at the initial joint positions.
double LeftOfRoot_m(const MachineModel& model, std::size_t gear);

/// State of one of several parallel cylinders. Force and rate are positive when the rod extends.
struct CylinderState {
  double length_m = 0;  ///< between the pins
  double stroke_m = 0;  ///< length minus the shortest length over the joint's travel
  double rate_mps = 0, force_n = 0;
  double head_pressure_pa = 0, rod_pressure_pa = 0;  ///< gauge pressure, above atmospheric
};

/// State of one machine after a step.
struct MachineState {
  std::vector<BodyState> links;
  std::vector<double> q_rad, qd_radps, effort_nm;  ///< one per joint
  std::vector<double> friction_nm;                 ///< one per joint, not part of the effort
  std::vector<double> gear_angle_rad, gear_rate_radps, gear_torque_nm, gear_friction_nm;
  std::vector<double> levers;  ///< as applied, one per lever
  std::vector<SoilReaction::Load> shovel_load;
  std::vector<double> gear_sinkage_m, gear_slip;
  std::vector<CylinderState> cylinders;
};

}  // namespace tera
