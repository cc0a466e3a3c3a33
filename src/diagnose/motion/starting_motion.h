#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "diagnose/motion/motion_problem.h"

namespace tera {

/// Values over time, linear between, constant beyond.
struct TimeSeries {
  std::vector<double> t_s, value;

  bool empty() const { return t_s.empty(); }
  double At(double at_s) const;
};

/// Motion of running gear over a short time.
struct TravelWindow {
  double from_s = 0, to_s = 0;
  double forward_mps = 0, turning_radps = 0;
  bool is_still = false;
};

/// Positions of one antenna.
struct AntennaTrack {
  KinematicChain chain;
  Vec3 p_L_m = Vec3::Zero();
  std::vector<double> t_s;
  std::vector<Vec3> p_W_m;
};

/// The height of the ground at (x, y) in W.
using GroundHeight = std::function<double(double x_m, double y_m)>;

/// Sources of a rough motion; times count from the same second.
struct RoughSources {
  std::vector<TimeSeries> joints;  ///< one for each joint with an estimated motion
  std::vector<double> poses_t_s;
  std::vector<Pose> poses;  ///< of the base, recorded
  std::vector<AntennaTrack> antennas;
  std::vector<TravelWindow> travel;
  std::optional<Pose> start;  ///< where the scenario has the base at first
  GroundHeight ground;        ///< empty where it is not known
};

/// The motion of the base, one series for each number, near enough for an estimate to begin with.
/// Its source is recorded poses, else two antennas, else running gear laid over one antenna's
/// places, else running gear from the start.
///
/// Omits   leaning where neither poses nor ground are known; delays.
std::array<TimeSeries, kBaseNumbers> RoughBase(const RoughSources& sources);

/// Where an antenna is in the base with the joints of a time.
Vec3 AntennaInBase(const AntennaTrack& antenna, const std::vector<TimeSeries>& joints, double t_s);

/// Height, roll and pitch of a base at (x, y) with a heading on the ground, by the heights under
/// its corners.
Vec3 OnGround(const GroundHeight& ground, double x_m, double y_m, double yaw_rad);

}  // namespace tera
