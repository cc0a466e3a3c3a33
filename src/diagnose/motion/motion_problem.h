#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "diagnose/motion/kinematic_chain.h"
#include "diagnose/motion/raised_part.h"
#include "diagnose/motion/uniform_spline.h"

/// Input of the estimate of a machine's motion: channels with the places of their parameters, and
/// observations cut into segments.

namespace tera {

/// The place of parameters that a channel does not have.
inline constexpr int kNoParameter = -1;
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct UnitChannel {
  KinematicChain chain;
  Pose X_LS = Pose::Identity();
  Eigen::Matrix<double, 6, 1> signs = Eigen::Matrix<double, 6, 1>::Ones();  ///< rates, then forces
  int bias = kNoParameter, scale = kNoParameter;   ///< the first of six each: rates, then forces
  int mount = kNoParameter, place = kNoParameter;  ///< of three each
  int late = kNoParameter;
  int low_pass = kNoParameter;  ///< the time constant of its filter
  int noise = 0;                ///< the first of its noise channels
  /// The first of two: the share of rates, then of forces, beyond `limit` that does not show.
  int clipped = kNoParameter;
  std::array<double, 2> limit = {kNoLimit, kNoLimit};
};

/// An antenna; the two of a pair may be turned about the vertical through the middle between them.
struct ReceiverChannel {
  KinematicChain chain;
  Vec3 p_LS_m = Vec3::Zero(), middle_L_m = Vec3::Zero();
  int place = kNoParameter, datum = kNoParameter, pair_yaw = kNoParameter, late = kNoParameter;
  RaisedPart raised;              ///< what may reflect beside it
  int reflection = kNoParameter;  ///< the first of four: RaisedPart
  int noise = 0;
};

/// An encoder of one joint: reads scale q + bias.
struct AxisChannel {
  int number = kBaseNumbers;  ///< which of the splines it reads
  int bias = kNoParameter, scale = kNoParameter, late = kNoParameter;
  int noise = 0;
};

/// Recorded poses of the base: in a map that is shifted, and turned about a pivot.
///
/// Model   p_MB = pivot + R_ML (p_LB - pivot) + shift, R_MB = R_ML R_LB, R_ML the transpose of the
///         rotation by the three angles `turn`.
struct MapChannel {
  Vec3 pivot_m = Vec3::Zero();
  int shift = kNoParameter, turn = kNoParameter, late = kNoParameter;
  int noise = 0;
};

enum class ObservationKind { kImu, kReceiver, kAxis, kPose, kTravel, kStill, kRest, kGround };

/// Numbers that were measured over a time, in seconds of their segment's spline.
///
/// An inertial unit's are rates and forces; a receiver's a place; an encoder's one angle; a pose's
/// place and roll, pitch, yaw. Travel is forward and yaw rate of running gear. Rest is that of the
/// number `channel`, which no encoder measures. Ground is the height, roll and pitch of a base on
/// it.
struct Observation {
  ObservationKind kind = ObservationKind::kAxis;
  int channel = 0;
  double from_s = 0, to_s = 0;
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
  double share = 1;  ///< samples of its mean over those of a whole window
  /// 1 sigma of what the model leaves out of each number.
  Eigen::Matrix<double, 6, 1> model_error = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Observations of a part of the recording, whose motion is estimated by itself.
struct MotionSegment {
  TimeNs start_ns = 0;  ///< of its spline
  UniformSpline spline;
  std::vector<Observation> observations;
  /// Coefficients, one row each, one column for each number, near enough to the motion to begin
  /// with.
  Eigen::MatrixXd start;
};

/// The noise of one measured number.
struct NoiseChannel {
  std::string name, unit;
  double least = 0;      ///< by the data sheet
  double at_first = 1;   ///< of residuals of a motion that is roughly known
  double sigma = 1;      ///< scale of Student's t
  double inflation = 1;  ///< variance of a mean over that of independent errors
  double motion = 0;     ///< standard deviation of what was measured
  double tolerance = 0;  ///< of an error that stays as it is
};

struct MotionProblem {
  std::vector<std::string> joints;  ///< of which the motion is estimated
  std::vector<UnitChannel> imus;
  std::vector<ReceiverChannel> receivers;
  std::vector<AxisChannel> axes;
  std::vector<MapChannel> poses;
  std::vector<NoiseChannel> noise;
  std::vector<MotionSegment> segments;
  int parameters = 0;
  int ground_height = kNoParameter;  ///< by how much the known ground is too high
  /// For each number of the motion, the share by which inertial units see its acceleration larger
  /// than the spline has it.
  std::vector<int> acceleration_gains;
  std::vector<int> delays;  ///< the parameters that say how late channels are
  Eigen::VectorXd wander;   ///< by how much each parameter differs from segment to segment, 1 sigma

  int numbers() const { return kBaseNumbers + static_cast<int>(joints.size()); }
};

}  // namespace tera
