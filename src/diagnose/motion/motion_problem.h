#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "diagnose/motion/kinematic_chain.h"
#include "diagnose/motion/raised_part.h"
#include "diagnose/motion/uniform_spline.h"

/// Input of the motion estimate: the channels with the indices of their parameters, and the
/// observations in segments.
///
/// A channel's `int` members that default to kNoParameter are indices into the parameter vector.
/// Parameters with several components are consecutive; the index is that of the first.

namespace tera {

/// Index of a parameter that a channel does not have.
inline constexpr int kNoParameter = -1;
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct UnitChannel {
  KinematicChain chain;
  Pose X_LS = Pose::Identity();
  /// Turn rates, then specific forces.
  Eigen::Matrix<double, 6, 1> signs = Eigen::Matrix<double, 6, 1>::Ones();
  /// Six components each: turn rates, then specific forces.
  int bias = kNoParameter, scale = kNoParameter;
  /// Three components each: mount angles; position.
  int mount = kNoParameter, place = kNoParameter;
  int late = kNoParameter;
  int low_pass = kNoParameter;  ///< time constant of the filter
  int noise = 0;                ///< first of six noise channels
  /// Two components, for turn rates and for specific forces: the share of a measurement beyond
  /// `limit` that the unit clips.
  int clipped = kNoParameter;
  std::array<double, 2> limit = {kNoLimit, kNoLimit};
};

/// A positioning antenna. `pair_yaw` turns both antennas of a pair about the vertical of their link
/// through `middle_L_m`, the midpoint between them.
struct ReceiverChannel {
  KinematicChain chain;
  Vec3 p_LS_m = Vec3::Zero(), middle_L_m = Vec3::Zero();
  int place = kNoParameter, datum = kNoParameter, pair_yaw = kNoParameter, late = kNoParameter;
  RaisedPart raised;              ///< part that may reflect signals to the antenna
  int reflection = kNoParameter;  ///< four components (RaisedPart)
  int noise = 0;
};

/// An encoder of one joint: reads scale q + bias.
struct AxisChannel {
  int number = kBaseNumbers;  ///< coordinate of the motion that the encoder reads
  int bias = kNoParameter, scale = kNoParameter, late = kNoParameter;
  int noise = 0;
};

/// Recorded poses of the base, in a map that is shifted and turned about a pivot.
///
/// Model   p_MB = pivot + R_ML (p_LB - pivot) + shift, R_MB = R_ML R_LB. R_ML is the transpose of
///         the rotation by the three angles `turn`.
struct MapChannel {
  Vec3 pivot_m = Vec3::Zero();
  int shift = kNoParameter, turn = kNoParameter, late = kNoParameter;
  int noise = 0;
};

enum class ObservationKind { kImu, kReceiver, kAxis, kPose, kTravel, kStill, kRest, kGround };

/// Numbers measured over a time span, in seconds of the segment's spline. Contents of `value`:
///
///   kImu: turn rates and specific forces. kReceiver: position. kAxis: angle. kPose: position, then
///   roll, pitch, yaw. kTravel: forward speed and yaw rate from the running gear. kStill: none; the
///   base is at rest. kRest: none; the coordinate `channel`, which no encoder measures, is at rest.
///   kGround: height, roll and pitch of a base on the ground.
struct Observation {
  ObservationKind kind = ObservationKind::kAxis;
  int channel = 0;
  double from_s = 0, to_s = 0;
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
  double share = 1;  ///< samples in this mean over samples of a full window
  /// 1 sigma of the part of each number that the motion model cannot represent.
  Eigen::Matrix<double, 6, 1> model_error = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Observations of a part of the recording whose motion has its own spline.
struct MotionSegment {
  TimeNs start_ns = 0;  ///< time zero of the spline
  UniformSpline spline;
  std::vector<Observation> observations;
  /// Initial coefficients of the spline. Row: coefficient; column: coordinate.
  Eigen::MatrixXd start;
};

struct NoiseChannel {
  std::string name, unit;
  double least = 0;      ///< lower limit of sigma, from the data sheet
  double at_first = 1;   ///< sigma of the first, unweighted iterations
  double sigma = 1;      ///< scale of Student's t
  double inflation = 1;  ///< variance of a mean / variance for independent errors
  double motion = 0;     ///< standard deviation of the measured signal
  double tolerance = 0;  ///< tolerated constant error
};

struct MotionProblem {
  std::vector<std::string> joints;  ///< joints whose motion is estimated
  std::vector<UnitChannel> imus;
  std::vector<ReceiverChannel> receivers;
  std::vector<AxisChannel> axes;
  std::vector<MapChannel> poses;
  std::vector<NoiseChannel> noise;
  std::vector<MotionSegment> segments;
  int parameters = 0;
  int ground_height = kNoParameter;  ///< index of the height by which the known ground is too high
  /// For each coordinate, the index of its acceleration gain: the relative excess of the
  /// acceleration that inertial units measure over the acceleration of the spline.
  std::vector<int> acceleration_gains;
  std::vector<int> delays;  ///< indices of the delay parameters
  Eigen::VectorXd wander;   ///< 1 sigma of each parameter's deviation from segment to segment

  int numbers() const { return kBaseNumbers + static_cast<int>(joints.size()); }
};

}  // namespace tera
