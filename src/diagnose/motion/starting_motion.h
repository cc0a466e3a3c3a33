#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "diagnose/motion/motion_problem.h"

namespace tera {

/// A series with linear interpolation, constant beyond its ends.
struct TimeSeries {
  std::vector<double> t_s, value;

  bool empty() const { return t_s.empty(); }
  double At(double at_s) const;
};

/// Mean motion of the running gear over a short time.
struct TravelWindow {
  double from_s = 0, to_s = 0;
  double forward_mps = 0, turning_radps = 0;
  bool is_still = false;
};

struct AntennaTrack {
  KinematicChain chain;
  Vec3 p_L_m = Vec3::Zero();
  std::vector<double> t_s;
  std::vector<Vec3> p_W_m;
};

using GroundHeight = std::function<double(double x_m, double y_m)>;

/// Sources of a rough motion. All times count from the same zero.
struct RoughSources {
  std::vector<TimeSeries> joints;  ///< one per joint whose motion is estimated
  std::vector<double> poses_t_s;
  std::vector<Pose> poses;  ///< recorded poses of the base
  std::vector<AntennaTrack> antennas;
  std::vector<TravelWindow> travel;
  std::optional<Pose> start;  ///< initial pose of the base in the scenario
  GroundHeight ground;        ///< empty if the ground is unknown
};

/// A rough motion of the base as the start of an estimate: one series per coordinate. The first
/// available source is taken: recorded poses, two antennas, running gear aligned to the positions
/// of one antenna, running gear from the initial pose.
///
/// Omits   roll and pitch without poses and without known ground; delays.
std::array<TimeSeries, kBaseNumbers> RoughBase(const RoughSources& sources);

/// Position of an antenna in the base, with the joints at time `t_s`.
Vec3 AntennaInBase(const AntennaTrack& antenna, const std::vector<TimeSeries>& joints, double t_s);

/// Height, roll and pitch of a base on the ground at (x, y) with a heading, from the heights at
/// four points around its centre.
Vec3 OnGround(const GroundHeight& ground, double x_m, double y_m, double yaw_rad);

}  // namespace tera
