#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "core/random.h"

namespace tera::blind {

/// The joints that are driven, from the undercarriage outwards.
inline constexpr std::array<const char*, 4> kJoints = {"slew", "boom", "arm", "bucket"};
inline constexpr std::size_t kAxes = kJoints.size();
using AxisValues = std::array<double, kAxes>;

/// One driven joint and the link that it moves.
struct PlainAxis {
  Eigen::Vector3d place_m;  ///< of the joint in the link before
  Eigen::Matrix3d turned;   ///< axes of the joint at 0 in the link before
  Eigen::Vector3d axis;     ///< in the link that it moves
  double lower_rad = 0, upper_rad = 0, initial_rad = 0;
  double rate_positive_radps = 0, rate_negative_radps = 0;  ///< at full lever
  double effort_nm = 0;                                     ///< limit of its motor or cylinder
  double mass_kg = 0;
  Eigen::Vector3d com_m;
  Eigen::Vector3d inertia_kgm2;  ///< about the centre of mass, principal
  // Pins of the cylinder: barrel in the link before, rod in the link that it moves; for boom, arm.
  bool has_pins = false;
  Eigen::Vector3d barrel_m, rod_m;
};

/// An excavator as plain numbers: four links in a row on an undercarriage that stands level.
///
/// Frames  as in the file: each link's frame lies on its joint. A joint between two of the row that
///         is not driven (the boom's swing) is welded at 0, its link's mass added where it is.
/// Source  the machine's YAML, of which only these numbers are read, here.
class Excavator {
 public:
  /// Throws InputError where the file lacks one of the numbers.
  static Excavator Read(const std::filesystem::path& machine_yaml);

  /// Every number off by up to `share` of itself, as on a machine in the field.
  Excavator Off(double share, const Stream& stream) const;

  const PlainAxis& axis(std::size_t i) const { return axes_[i]; }

  /// Effort that carries the weight beyond each joint: the slope of the potential energy.
  AxisValues Loads_nm(const AxisValues& q_rad) const;
  /// Moment of inertia beyond each joint, about it.
  AxisValues Inertias_kgm2(const AxisValues& q_rad) const;
  /// Derivative of the distance between the pins of a joint's cylinder by the joint's angle, m/rad.
  double PinSlope_mprad(std::size_t axis, double q_rad) const;

 private:
  struct Placed;
  std::array<Placed, kAxes> Place(const AxisValues& q_rad) const;

  std::array<PlainAxis, kAxes> axes_;
};

}  // namespace tera::blind
