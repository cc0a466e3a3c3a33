#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "blind/mujoco/machine/oil.h"
#include "core/random.h"

namespace tera::blind::mujoco {

/// Axes that levers move, in the order of the commands.
enum Axis : std::size_t { kLeftTrack, kRightTrack, kSlew, kBoom, kArm, kBucket, kAxisCount };
inline constexpr std::array<const char*, kAxisCount> kAxisNames = {
    "left_track", "right_track", "slew", "boom", "arm", "bucket"};

/// Bodies, from the ground to the tip.
enum Link : std::size_t { kUndercarriage, kUpper, kBoomLink, kArmLink, kBucketLink, kLinkCount };
inline constexpr std::array<const char*, kLinkCount> kLinkNames = {"undercarriage", "upper", "boom",
                                                                   "arm", "bucket"};

inline constexpr std::size_t kUnits = 4, kReceivers = 2;

template <typename T>
using PerAxis = std::array<T, kAxisCount>;

/// Numbers of a rigid body about its centre of mass.
struct LinkNumbers {
  double mass_kg = 0;
  Vec3 com_m = Vec3::Zero();
  Vec3 inertia_kgm2 = Vec3::Zero();  ///< principal, along the link's axes
};

/// Joint `axis`, between link axis - 2 and link axis - 1.
struct JointNumbers {
  Vec3 pin_m = Vec3::Zero();  ///< in the parent's frame
  Vec3 axis = Vec3::UnitZ();
  bool has_stops = false;
  double lower_rad = 0, upper_rad = 0;
};

/// A sensor's documented position; its axes are those of the link.
struct Mount {
  std::string name;
  std::size_t link = kUndercarriage;
  Vec3 xyz_m = Vec3::Zero();
};

/// An excavator from its owner's two files, the machine's and the rig's. They do not contain its
/// oil.
///
/// Frames  each link's origin is its pin; the undercarriage's is on the ground in the middle of the
///         tracks. x forward, y left, z up.
struct MachineNumbers {
  PerAxis<OilNumbers> oil;
  std::array<LinkNumbers, kLinkCount> links;
  PerAxis<JointNumbers> joints;       ///< unused for tracks
  PerAxis<double> full_rate_radps{};  ///< at full lever; for a track, its sprocket's
  double gauge_m = 0, contact_m = 0, radius_m = 0;
  std::array<Mount, kUnits> units;
  std::array<Mount, kReceivers> antennas;

  /// Throws InputError.
  static MachineNumbers Read(const std::filesystem::path& machine_yaml,
                             const std::filesystem::path& rig_yaml);
};

}  // namespace tera::blind::mujoco
