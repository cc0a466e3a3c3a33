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

/// How well the inertial units, encoders and antennas of a layout tell the angles of a machine's
/// joints and its heading, moment by moment under the motion of a cycle.
///
/// Frames  W; the heading is that of the upper structure's x axis from above.
/// Model   Fisher information of the state of MotionCovariance, with measurements linearised about
///         the recorded motion. Coordinates: place and attitude of the root (unless it is fixed)
///         and all joints that move.
///         At first a joint is anywhere in its travel (1 sigma travel / sqrt(12), of one that turns
///         without end 360 / sqrt(12) = 104 deg), the root anywhere about within `kRootPlace_m`,
///         within `kTilt_rad` of level and turned anyhow. A joint's rate has the deviation of one
///         that is anything up to its greatest (max / sqrt(3)), the root's `kRootSpeed_mps` and
///         `kRootRate_radps`. When the cycle begins the machine has stood for a while.
///         Measurements of a step of `kStep_s`, each with the white noise of as many samples as
///         fall due in it: of inertial units the means over the step of R_SW w_S + b_g and
///         R_SW (a_S - g) + b_a; of encoders q, with noise^2 + resolution^2 / 12, and qd; of
///         antennas p_WS + c. Biases b start with the size that the unit's model gives them (root
///         mean square over the axes) and walk as it says; c is the model's correlated error. So
///         two antennas at the horizontal distance d tell the heading at once to
///         sqrt(2) sigma_horizontal / d, and gyroscopes carry it on.
///         Nothing is known worse than at first: of what no sensor observes the figure is the
///         deviation at first, and Warnings names it.
/// Omits   rounding of an encoder that stands still without noise, whose error stays; effects of
///         sensors but for where they sit; latencies; that an antenna's slow errors
///         change as it turns, so that slewing tells them less than here; `bias_enu_m`, which
///         receivers of a machine share; inclinometers, lidars and cameras; that joints stop at
///         their limits; receivers that difference phases between antennas and so do better than
///         two that solve alone (0.20 deg at 1 m against some 0.6 deg: NovAtel, OEM7 documentation,
///         "Importance of Antenna Location for ALIGN").
/// Source  Taylor 1979, "The Cramer-Rao estimation error lower bound computation for deterministic
///         nonlinear systems", IEEE Trans. Automatic Control 24(2) (information along a known
///         motion); MotionCovariance; noise: Imu, Encoder, Gnss.
class JointInformation {
 public:
  static constexpr double kStep_s = 0.02, kRest_s = 10;
  static constexpr double kRootSpeed_mps = 0.3, kRootRate_radps = 0.05, kTilt_rad = 0.17;
  static constexpr double kRootPlace_m = 10;  ///< of its place at first

  /// Keeps a reference to `model`. `upper` is the link whose heading is asked for. The machine has
  /// stood in its first pose for `rest_s` when the cycle begins.
  JointInformation(const MachineModel& model, int upper,
                   const std::vector<SensorDescription>& sensors, double rest_s = kRest_s);

  /// Takes in the machine after each step of the physics, the first state included.
  void Add(TimeNs t_ns, const MachineState& machine);
  /// What is known now becomes the figures' next moment.
  void Keep();

  /// "state/JOINT/sigma_deg" of each joint that turns, "state/JOINT/sigma_m" of each that slides,
  /// "state/heading/sigma_deg" by all sensors, and "state/heading_of_pair/sigma_deg" by one sample
  /// of the two antennas of a link that tell it best.
  std::vector<Figure> Figures() const;
  /// A sentence for each of these that is at no moment known better than by 10 % of its prior.
  std::vector<std::string> Warnings() const;

 private:
  /// A sensor on a link, with the noise of the numbers of one sample and where the first of their
  /// slow errors stands.
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
  /// A number that is asked for, with its deviation at first and at each moment.
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
  Eigen::VectorXd Inertial(const Motion& motion) const;  ///< what all units would measure
  Eigen::VectorXd Placed(const Motion& motion) const;    ///< antennas' places, and the heading
  /// Derivatives by positions, rates and accelerations, one column each, coordinate by coordinate.
  Eigen::MatrixXd Slopes(Function function, const Motion& motion) const;
  /// The same by the state's numbers.
  void Linearise(const Motion& middle, const Motion& end, double dt_s);
  /// Half way through the last step.
  Motion Middle(TimeNs t_ns, const MachineState& machine) const;
  void Step(const Motion& middle, const Motion& end, TimeNs from_ns, TimeNs to_ns);
  void Learn(const std::vector<Unit>& units, const Eigen::MatrixXd& rows, TimeNs from_ns,
             TimeNs to_ns);
  /// Variance of one sample's place towards east, or north.
  double EastVariance(const Unit& antenna) const;
  double PairSigma() const;
  void LearnFromEncoders(TimeNs from_ns, TimeNs to_ns);

  const MachineModel& model_;
  int upper_;
  double rest_s_;
  std::vector<int> moving_;  ///< joints that move
  std::vector<Unit> imus_, antennas_;
  std::vector<EncodedJoint> encoded_;
  std::vector<SlowError> errors_;
  std::vector<Asked> asked_;  ///< of moving_, and last the two headings
  std::optional<MotionCovariance> known_;
  Eigen::MatrixXd inertial_, placed_;  ///< derivatives of Inertial and Placed at the last step
  TimeNs last_ns_ = 0;
  MachineState last_;
};

}  // namespace tera
