#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "layout/measures/figure.h"
#include "layout/measures/link_motions.h"
#include "layout/measures/motion_covariance.h"
#include "sensors/sensor.h"

namespace tera {

/// Achievable accuracy of a machine's joint positions and heading, given the IMUs, encoders and
/// GNSS antennas of a layout. The class evaluates it along the recorded motion of a cycle.
///
/// Frames  W. The heading is the direction of the upper structure's x axis, seen from above.
/// Model   Fisher information of the state in MotionCovariance. Measurements are linearised about
///         the recorded motion. The coordinates are the pose of the root (unless it is fixed) and
///         the positions of all movable joints.
///         Prior of a joint's position: uniform over its travel, so 1 sigma is travel / sqrt(12).
///         Endless rotation has 360 / sqrt(12) = 104 deg.
///         Prior of a joint's rate: uniform up to the maximum rate, so 1 sigma is max / sqrt(3).
///         Prior of the root: position `kRootPlace_m`, tilt `kTilt_rad`, any heading,
///         `kRootSpeed_mps` and `kRootRate_radps`.
///         The machine rests for a while before the cycle begins.
///         Each step of `kStep_s` has one measurement per channel. Its white noise is that of the
///         samples that fall due in the step.
///         IMUs measure the means over the step of R_SW w_S + b_g and R_SW (a_S - g) + b_a.
///         Encoders measure q, with the variance noise^2 + resolution^2 / 12, and qd. Antennas
///         measure p_WS + c.
///         The biases b start with the size in the IMU's model (root mean square over the axes) and
///         walk as in that model. c is the correlated error of the antenna's model.
///         Two antennas at the horizontal distance d give the heading at once, to sqrt(2)
///         sigma_horizontal / d. Gyroscopes maintain it.
///         No figure exceeds its prior deviation. A figure that no sensor observes equals its prior
///         deviation, and Warnings names it.
/// Omits   rounding of a noiseless encoder at rest, which leaves a constant error; sensor effects
///         except the mount; latencies; `bias_enu_m`, which the receivers of a machine share;
///         inclinometers, lidars and cameras; joint limits.
///         Also the change of an antenna's slow errors as the antenna turns. Slewing therefore
///         reduces them less than in this model.
///         Also receivers that difference phases between antennas. They beat two independent
///         solutions: 0.20 deg at 1 m against some 0.6 deg (NovAtel, OEM7 documentation,
///         "Importance of Antenna Location for ALIGN").
/// Source  Taylor 1979, "The Cramer-Rao estimation error lower bound computation for deterministic
///         nonlinear systems", IEEE Trans. Automatic Control 24(2) (information along a known
///         motion); MotionCovariance; noise: Imu, Encoder, Gnss.
class JointInformation {
 public:
  static constexpr double kStep_s = 0.02, kRest_s = 10;
  static constexpr double kRootSpeed_mps = 0.3, kRootRate_radps = 0.05, kTilt_rad = 0.17;
  static constexpr double kRootPlace_m = 10;  ///< prior of its position

  /// Keeps a reference to `model`. `upper` is the link whose heading is estimated. The machine
  /// rests in its first pose for `rest_s` before the cycle begins.
  JointInformation(const MachineModel& model, int upper,
                   const std::vector<SensorDescription>& sensors, double rest_s = kRest_s);

  /// Adds the machine's state after a step of the physics. The first call adds the initial state.
  void Add(TimeNs t_ns, const MachineState& machine);
  /// Stores the current accuracy as the next moment of the figures.
  void Keep();

  /// "state/JOINT/sigma_deg" for each revolute joint, "state/JOINT/sigma_m" for each prismatic
  /// joint, and "state/heading/sigma_deg" from all sensors. "state/heading_of_pair/sigma_deg" is
  /// the accuracy from one sample of the best pair of antennas on one link.
  std::vector<Figure> Figures() const;
  /// One sentence for each estimated quantity whose deviation never falls 10 % below its prior.
  std::vector<std::string> Warnings() const;

 private:
  /// A sensor on a link. `sigma` is the noise of one sample; `error` is the state index of its
  /// first slow error.
  struct Unit {
    int link = 0;
    Pose X_BS = Pose::Identity();
    SampleClock clock;
    std::vector<double> sigma = {};
    std::size_t error = 0;
  };
  struct EncodedJoint {
    int joint = 0;
    SampleClock clock;
    double sigma = 0, rate_sigma = 0;
  };
  /// An estimated quantity, with its prior deviation and its deviation at each moment.
  struct Asked {
    FigureId id;
    double prior = 0;
    std::vector<double> sigma = {};
  };
  struct Motion {
    BodyState root;
    JointMotions joints;
  };

  void AddImu(const SensorDescription& imu, const Mounting& mounting);
  void AddAntenna(const SensorDescription& gnss, const Mounting& mounting);
  void AddEncoders(const SensorDescription& encoders);
  MotionCovariance AtFirst() const;

  std::size_t RootCoordinates() const { return model_.fixed_base ? 0 : 6; }
  std::size_t Coordinates() const { return RootCoordinates() + moving_.size(); }
  /// `motion` with the position (order 0), rate (1) or acceleration (2) of a coordinate changed.
  Motion Moved(const Motion& motion, std::size_t coordinate, int order, double by) const;
  using Function = Eigen::VectorXd (JointInformation::*)(const Motion&) const;
  Eigen::VectorXd Inertial(const Motion& motion) const;  ///< measurements of all IMUs
  Eigen::VectorXd Placed(const Motion& motion) const;    ///< antenna positions and the heading
  /// Derivatives of `function` by the position, rate and acceleration of each coordinate; one
  /// column each.
  Eigen::MatrixXd Slopes(Function function, const Motion& motion) const;
  /// Sets the derivatives of all measurements by the entries of the state.
  void Linearise(const Motion& middle, const Motion& end, double dt_s);
  /// The motion half way through the last step.
  Motion Middle(TimeNs t_ns, const MachineState& machine) const;
  void Step(const Motion& middle, const Motion& end, TimeNs from_ns, TimeNs to_ns);
  void Learn(const std::vector<Unit>& units, const Eigen::MatrixXd& rows, TimeNs from_ns,
             TimeNs to_ns);
  /// Variance of one sample's east position; north has the same.
  double EastVariance(const Unit& antenna) const;
  double PairSigma() const;
  void LearnFromEncoders(TimeNs from_ns, TimeNs to_ns);

  const MachineModel& model_;
  int upper_;
  double rest_s_;
  std::vector<int> moving_;  ///< movable joints
  std::vector<Unit> imus_, antennas_;
  std::vector<EncodedJoint> encoded_;
  std::vector<SlowError> errors_;
  std::vector<Asked> asked_;  ///< in the order of moving_, then the two headings
  std::optional<MotionCovariance> known_;
  Eigen::MatrixXd inertial_, placed_;  ///< derivatives of Inertial and Placed at the last step
  TimeNs last_ns_ = 0;
  MachineState last_;
};

}  // namespace tera
