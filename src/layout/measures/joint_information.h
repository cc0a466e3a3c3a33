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

/// Accuracy of a machine's joint positions and heading from the inertial units, encoders and
/// antennas of a layout. It is evaluated at each moment of a cycle's motion.
///
/// Frames  W; the heading is that of the upper structure's x axis from above.
/// Model   Fisher information of the state of MotionCovariance, with measurements linearised about
///         the recorded motion. Coordinates: position and attitude of the root (unless it is fixed)
///         and all movable joints.
///         Prior: a joint is uniform in its travel (1 sigma travel / sqrt(12); for endless rotation
///         360 / sqrt(12) = 104 deg). The root is within `kRootPlace_m` of its place, within
///         `kTilt_rad` of level, at any heading. A joint's rate has the deviation of a uniform one
///         up to its greatest (max / sqrt(3)), the root `kRootSpeed_mps` and `kRootRate_radps`. The
///         machine rests for a while before the cycle begins.
///         Measurements of a step of `kStep_s` have the white noise of the samples that fall due in
///         it. Inertial units measure the means over the step of R_SW w_S + b_g and R_SW (a_S - g)
///         + b_a. Encoders measure q, with noise^2 + resolution^2 / 12, and qd. Antennas measure
///         p_WS + c. Biases b start with the size in the unit's model (root mean square over the
///         axes) and walk by that model. c is the model's correlated error. Two antennas at the
///         horizontal distance d thus give the heading to sqrt(2) sigma_horizontal / d at once, and
///         gyroscopes carry it on.
///         No number is worse than its prior. The figure of an unobserved number is its prior
///         deviation, and Warnings names it.
/// Omits   rounding of a noiseless encoder at rest, whose error stays; sensor effects except the
///         mount; latencies; the change of an antenna's slow errors as it turns, so that slewing
///         reduces them less than here; `bias_enu_m`, which the receivers of a machine share;
///         inclinometers, lidars and cameras; joint limits; receivers that difference phases
///         between antennas, which beat two independent solutions (0.20 deg at 1 m against some 0.6
///         deg: NovAtel, OEM7 documentation, "Importance of Antenna Location for ALIGN").
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

  /// Adds the machine after each step of the physics, including the first state.
  void Add(TimeNs t_ns, const MachineState& machine);
  /// Stores the current accuracy as the figures' next moment.
  void Keep();

  /// "state/JOINT/sigma_deg" for each turning joint, "state/JOINT/sigma_m" for each sliding joint,
  /// and "state/heading/sigma_deg" from all sensors. "state/heading_of_pair/sigma_deg" is the
  /// accuracy from one sample of the best pair of antennas on one link.
  std::vector<Figure> Figures() const;
  /// A sentence for each number that never improves on its prior by 10 %.
  std::vector<std::string> Warnings() const;

 private:
  /// A sensor on a link, with the noise of one sample and the state index of its first slow error.
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
  /// An estimated number, with its deviation initially and at each moment.
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
  Eigen::VectorXd Inertial(const Motion& motion) const;  ///< measurements of all units
  Eigen::VectorXd Placed(const Motion& motion) const;    ///< antenna positions and the heading
  /// Derivatives by positions, rates and accelerations, one column each, coordinate by coordinate.
  Eigen::MatrixXd Slopes(Function function, const Motion& motion) const;
  /// Derivatives by the numbers of the state.
  void Linearise(const Motion& middle, const Motion& end, double dt_s);
  /// The motion half way through the last step.
  Motion Middle(TimeNs t_ns, const MachineState& machine) const;
  void Step(const Motion& middle, const Motion& end, TimeNs from_ns, TimeNs to_ns);
  void Learn(const std::vector<Unit>& units, const Eigen::MatrixXd& rows, TimeNs from_ns,
             TimeNs to_ns);
  /// Variance of one sample's position towards east, or north.
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
