#include "layout/measures/joint_information.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/units.h"
#include "sensors/encoder/encoded_axes.h"

namespace tera {
namespace {

constexpr double kSmall = 1e-4;       ///< step of numerical derivatives, in rad, m and their rates
constexpr double kLeastSigma = 1e-6;  ///< lower bound on a measurement's noise, in SI units

/// Size of the figure's unit in SI units.
double UnitSize(const FigureId& id) { return id.measure == Measure::kAngleSigma ? kDeg : 1; }
constexpr double kOtherRate = 0.2;  ///< for joints without a maximum rate, rad/s or m/s
/// Share of the prior deviation below which a quantity counts as observed.
constexpr double kKnown = 0.9;

/// Number of samples after `from_ns` and up to `to_ns` of a sensor that samples periodically.
double Due(const SampleClock& clock, TimeNs from_ns, TimeNs to_ns) {
  const auto passed = [&](TimeNs t_ns) {
    return std::floor(ToSeconds(t_ns - clock.start_ns) * clock.rate_hz + 1e-6);
  };
  return passed(to_ns) - passed(from_ns);
}

double Variance(double sigma, double samples) {
  return (sigma * sigma + kLeastSigma * kLeastSigma) / samples;
}

double TravelOf(const Joint& joint) {
  return joint.type == JointType::kContinuous ? 2 * kPi : joint.upper_rad - joint.lower_rad;
}

}  // namespace

JointInformation::JointInformation(const MachineModel& model, int upper,
                                   const std::vector<SensorDescription>& sensors, double rest_s)
    : model_(model), upper_(upper), rest_s_(rest_s) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].type != JointType::kFixed) moving_.push_back(static_cast<int>(j));
  }
  for (const SensorDescription& sensor : sensors) {
    if (std::holds_alternative<EncoderModel>(sensor.model)) AddEncoders(sensor);
    if (std::holds_alternative<ImuModel>(sensor.model)) {
      AddImu(sensor, TrueMounting(sensor, sensors));
    }
    if (std::holds_alternative<GnssModel>(sensor.model)) {
      AddAntenna(sensor, TrueMounting(sensor, sensors));
    }
  }
  for (const int j : moving_) {
    const Joint& joint = model.joints[j];
    const bool slides = joint.type == JointType::kPrismatic;
    asked_.push_back({{slides ? Measure::kLengthSigma : Measure::kAngleSigma, joint.name},
                      EvenSigma(TravelOf(joint))});
  }
  for (const char* heading : {"heading", "heading_of_pair"}) {
    asked_.push_back({{Measure::kAngleSigma, heading}, EvenSigma(2 * kPi)});
  }
}

void JointInformation::AddImu(const SensorDescription& imu, const Mounting& mounting) {
  const auto& model = std::get<ImuModel>(imu.model);
  const double root_rate = std::sqrt(imu.clock.rate_hz);
  const double gyro_radps =
      std::hypot(model.gyro_noise_density_radpsrthz * root_rate, model.gyro_sample_noise_radps);
  const double accel_mps2 =
      std::hypot(model.accel_noise_density_mps2rthz * root_rate, model.accel_sample_noise_mps2);
  imus_.push_back({model_.LinkIndex(mounting.link),
                   mounting.X_BT,
                   imu.clock,
                   {gyro_radps, gyro_radps, gyro_radps, accel_mps2, accel_mps2, accel_mps2},
                   errors_.size()});
  const auto bias_sigma = [](const Vec3& bias) { return bias.norm() / std::sqrt(3.0); };
  const SlowError gyro{bias_sigma(model.gyro_bias_radps), model.gyro_bias_random_walk_radps2rthz};
  const SlowError accel{bias_sigma(model.accel_bias_mps2), model.accel_bias_random_walk_mps3rthz};
  errors_.insert(errors_.end(), 3, gyro);
  errors_.insert(errors_.end(), 3, accel);
}

void JointInformation::AddAntenna(const SensorDescription& gnss, const Mounting& mounting) {
  const auto& model = std::get<GnssModel>(gnss.model);
  if (model.fix == GnssFix::kNone) return;
  const double white_m = model.white_horizontal_m, slow_m = model.correlated_horizontal_m;
  antennas_.push_back({model_.LinkIndex(mounting.link),
                       mounting.X_BT,
                       gnss.clock,
                       {white_m, white_m, model.white_vertical_m},
                       errors_.size()});
  for (const double sigma_m : {slow_m, slow_m, model.correlated_vertical_m}) {
    errors_.push_back({sigma_m, 0, sigma_m, model.correlation_time_s});
  }
}

void JointInformation::AddEncoders(const SensorDescription& encoders) {
  const auto& model = std::get<EncoderModel>(encoders.model);
  for (const int j : AxesOf(model, model_).joints) {
    const bool slides = model_.joints[j].type == JointType::kPrismatic;
    const double rounding = EvenSigma(slides ? model.resolution_m : model.resolution_rad);
    encoded_.push_back({j, encoders.clock,
                        std::hypot(slides ? model.noise_m : model.noise_rad, rounding),
                        slides ? model.rate_noise_mps : model.rate_noise_radps});
  }
}

double JointInformation::EastVariance(const Unit& antenna) const {
  const double slow_m = errors_[antenna.error].stationary;
  return antenna.sigma[0] * antenna.sigma[0] + slow_m * slow_m;
}

MotionCovariance JointInformation::AtFirst() const {
  std::vector<RandomCoordinate> coordinates;
  if (!model_.fixed_base) {
    coordinates.assign(3, {kRootPlace_m, kRootSpeed_mps});
    coordinates.insert(coordinates.end(), 2, {kTilt_rad, kRootRate_radps});
    coordinates.push_back({EvenSigma(2 * kPi), kRootRate_radps});
  }
  for (std::size_t m = 0; m < moving_.size(); ++m) {
    const Joint& joint = model_.joints[moving_[m]];
    const double most = std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps);
    coordinates.push_back({asked_[m].prior, (most > 0 ? most : kOtherRate) / std::sqrt(3.0)});
  }
  return {coordinates, errors_};
}

JointInformation::Motion JointInformation::Moved(const Motion& motion, std::size_t coordinate,
                                                 int order, double by) const {
  Motion moved = motion;
  if (coordinate >= RootCoordinates()) {
    const int joint = moving_[coordinate - RootCoordinates()];
    (order == 0 ? moved.joints.q : order == 1 ? moved.joints.qd : moved.joints.qdd)[joint] += by;
    return moved;
  }
  BodyState& root = moved.root;
  const auto axis = static_cast<Eigen::Index>(coordinate % 3);
  if (coordinate < 3) {
    if (order == 0) root.X_WB.translation()[axis] += by;
    if (order == 1) root.v_WB_mps[axis] += by;
    if (order == 2) root.a_WB_mps2[axis] += by;
  } else {
    const Mat3 turn(Eigen::AngleAxisd(by, Vec3::Unit(axis)));
    if (order == 0) root.X_WB.linear() = turn * root.X_WB.linear();
    if (order == 1) root.w_WB_radps[axis] += by;
    if (order == 2) root.alpha_WB_radps2[axis] += by;
  }
  return moved;
}

Eigen::VectorXd JointInformation::Inertial(const Motion& motion) const {
  const Vec3 gravity_W_mps2(0, 0, -kStandardGravity_mps2);
  const std::vector<BodyState> links = MotionOfLinks(model_, motion.root, motion.joints);
  Eigen::VectorXd z(6 * static_cast<Eigen::Index>(imus_.size()));
  Eigen::Index row = 0;
  for (const Unit& imu : imus_) {
    const BodyState S = MotionOfFixedFrame(links[imu.link], imu.X_BS);
    z.segment<3>(row) = S.X_WB.linear().transpose() * S.w_WB_radps;
    z.segment<3>(row + 3) = S.X_WB.linear().transpose() * (S.a_WB_mps2 - gravity_W_mps2);
    row += 6;
  }
  return z;
}

Eigen::VectorXd JointInformation::Placed(const Motion& motion) const {
  const std::vector<BodyState> links = MotionOfLinks(model_, motion.root, motion.joints);
  Eigen::VectorXd z(3 * static_cast<Eigen::Index>(antennas_.size()) + 1);
  Eigen::Index row = 0;
  for (const Unit& antenna : antennas_) {
    z.segment<3>(row) = links[antenna.link].X_WB * antenna.X_BS.translation();
    row += 3;
  }
  const Vec3 x_W = links[upper_].X_WB.linear().col(0);
  z[row] = std::atan2(x_W.y(), x_W.x());
  return z;
}

Eigen::MatrixXd JointInformation::Slopes(Function function, const Motion& motion) const {
  Eigen::MatrixXd slopes((this->*function)(motion).size(), 3 * Coordinates());
  for (std::size_t c = 0; c < Coordinates(); ++c) {
    for (int order = 0; order < 3; ++order) {
      Eigen::VectorXd difference = (this->*function)(Moved(motion, c, order, kSmall)) -
                                   (this->*function)(Moved(motion, c, order, -kSmall));
      // The difference of headings may cross half a turn.
      if (function == &JointInformation::Placed) {
        difference.tail<1>()[0] = std::remainder(difference.tail<1>()[0], 2 * kPi);
      }
      slopes.col(3 * static_cast<Eigen::Index>(c) + order) = difference / (2 * kSmall);
    }
  }
  return slopes;
}

void JointInformation::Linearise(const Motion& middle, const Motion& end, double dt_s) {
  using enum MotionCovariance::Number;
  const Eigen::MatrixXd inertial = Slopes(&JointInformation::Inertial, middle);
  const Eigen::MatrixXd placed = Slopes(&JointInformation::Placed, end);
  inertial_ = Eigen::MatrixXd::Zero(inertial.rows(), known_->size());
  placed_ = Eigen::MatrixXd::Zero(placed.rows(), known_->size());
  for (std::size_t c = 0; c < Coordinates(); ++c) {
    const auto at = 3 * static_cast<Eigen::Index>(c);
    // The position at the middle of the step is the final position minus half a step of mean rate.
    inertial_.col(MotionCovariance::At(c, kPosition)) = inertial.col(at);
    inertial_.col(MotionCovariance::At(c, kMeanRate)) =
        inertial.col(at + 1) - 0.5 * dt_s * inertial.col(at);
    inertial_.col(MotionCovariance::At(c, kMeanAcceleration)) = inertial.col(at + 2);
    placed_.col(MotionCovariance::At(c, kPosition)) = placed.col(at);
  }
  const auto add_errors = [&](const std::vector<Unit>& units, Eigen::MatrixXd* rows) {
    Eigen::Index row = 0;
    for (const Unit& unit : units) {
      const auto numbers = static_cast<Eigen::Index>(unit.sigma.size());
      rows->block(row, known_->AtError(unit.error), numbers, numbers).setIdentity();
      row += numbers;
    }
  };
  add_errors(imus_, &inertial_);
  add_errors(antennas_, &placed_);
}

void JointInformation::Learn(const std::vector<Unit>& units, const Eigen::MatrixXd& rows,
                             TimeNs from_ns, TimeNs to_ns) {
  Eigen::Index row = 0;
  for (const Unit& unit : units) {
    const double samples = Due(unit.clock, from_ns, to_ns);
    for (const double sigma : unit.sigma) {
      if (samples > 0) known_->Learn(rows.row(row).transpose(), Variance(sigma, samples));
      ++row;
    }
  }
}

void JointInformation::LearnFromEncoders(TimeNs from_ns, TimeNs to_ns) {
  for (const EncodedJoint& encoder : encoded_) {
    const double samples = Due(encoder.clock, from_ns, to_ns);
    const auto at = std::find(moving_.begin(), moving_.end(), encoder.joint);
    if (samples == 0 || at == moving_.end()) continue;
    const std::size_t c = RootCoordinates() + static_cast<std::size_t>(at - moving_.begin());
    const auto learn = [&](MotionCovariance::Number number, double sigma) {
      known_->Learn(Eigen::VectorXd::Unit(known_->size(), MotionCovariance::At(c, number)),
                    Variance(sigma, samples));
    };
    learn(MotionCovariance::kPosition, encoder.sigma);
    learn(MotionCovariance::kRate, encoder.rate_sigma);
  }
}

JointInformation::Motion JointInformation::Middle(TimeNs t_ns, const MachineState& machine) const {
  const double dt_s = ToSeconds(t_ns - last_ns_);
  const BodyState &a = last_.links.front(), &b = machine.links.front();
  Motion middle{Interpolate(a, b, 0.5), {machine.q_rad, machine.qd_radps, machine.qd_radps}};
  middle.root.a_WB_mps2 = (b.v_WB_mps - a.v_WB_mps) / dt_s;
  middle.root.alpha_WB_radps2 = (b.w_WB_radps - a.w_WB_radps) / dt_s;
  for (std::size_t j = 0; j < machine.q_rad.size(); ++j) {
    middle.joints.q[j] = 0.5 * (last_.q_rad[j] + machine.q_rad[j]);
    middle.joints.qd[j] = 0.5 * (last_.qd_radps[j] + machine.qd_radps[j]);
    middle.joints.qdd[j] = (machine.qd_radps[j] - last_.qd_radps[j]) / dt_s;
  }
  return middle;
}

void JointInformation::Step(const Motion& middle, const Motion& end, TimeNs from_ns, TimeNs to_ns) {
  const double dt_s = ToSeconds(to_ns - from_ns);
  known_->Pass(dt_s);
  const Vec3 turn_rad = dt_s * middle.root.w_WB_radps;
  if (!model_.fixed_base && turn_rad.norm() > 0) {
    known_->Turn(3, Mat3(Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized())));
  }
  Linearise(middle, end, dt_s);
  Learn(imus_, inertial_, from_ns, to_ns);
  Learn(antennas_, placed_, from_ns, to_ns);
  LearnFromEncoders(from_ns, to_ns);
}

void JointInformation::Add(TimeNs t_ns, const MachineState& machine) {
  const TimeNs step_ns = FromSeconds(kStep_s);
  // Positions do not depend on accelerations.
  const std::vector<double> none(machine.q_rad.size(), 0);
  if (known_) {
    if (t_ns - last_ns_ < step_ns) return;
    const Motion end{machine.links.front(), {machine.q_rad, machine.qd_radps, none}};
    Step(Middle(t_ns, machine), end, last_ns_, t_ns);
  } else {
    known_ = AtFirst();
    Motion rest{{}, {machine.q_rad, none, none}};
    rest.root.X_WB = machine.links.front().X_WB;
    Linearise(rest, rest, kStep_s);
    for (TimeNs from_ns = t_ns - FromSeconds(rest_s_); from_ns < t_ns; from_ns += step_ns) {
      Step(rest, rest, from_ns, from_ns + step_ns);
    }
  }
  last_ns_ = t_ns;
  last_ = machine;
}

double JointInformation::PairSigma() const {
  const BodyState& root = last_.links.front();
  const std::vector<BodyState> links =
      MotionOfLinks(model_, root, {last_.q_rad, last_.qd_radps, last_.qd_radps});
  double least = asked_.back().prior;
  for (const Unit& a : antennas_) {
    for (const Unit& b : antennas_) {
      if (a.link != b.link || &a == &b) continue;
      const Vec3 way_W_m =
          links[a.link].X_WB.linear() * (b.X_BS.translation() - a.X_BS.translation());
      const double off_m = std::sqrt(EastVariance(a) + EastVariance(b));
      least = std::min(least, off_m / way_W_m.head<2>().norm());
    }
  }
  return least;
}

void JointInformation::Keep() {
  using enum MotionCovariance::Number;
  TERA_CHECK(known_, model_.kind);
  std::vector<double> sigma;
  for (std::size_t m = 0; m < moving_.size(); ++m) {
    const Eigen::Index at = MotionCovariance::At(RootCoordinates() + m, kPosition);
    sigma.push_back(std::sqrt(known_->VarianceAt(at)));
  }
  sigma.push_back(std::sqrt(known_->VarianceOf(placed_.bottomRows<1>().transpose())));
  sigma.push_back(PairSigma());
  for (std::size_t m = 0; m < asked_.size(); ++m) {
    asked_[m].sigma.push_back(std::min(sigma[m], asked_[m].prior));
  }
}

std::vector<Figure> JointInformation::Figures() const {
  std::vector<Figure> figures;
  for (const Asked& asked : asked_) {
    Figure figure{asked.id};
    for (const double sigma : asked.sigma) figure.at.push_back(sigma / UnitSize(asked.id));
    figure.error.assign(figure.at.size(), 0);  // places are not sampled
    figures.push_back(std::move(figure));
  }
  return figures;
}

std::vector<std::string> JointInformation::Warnings() const {
  std::vector<std::string> unknown;
  for (const Asked& asked : asked_) {
    const auto unobserved = [&](double sigma) { return sigma > kKnown * asked.prior; };
    if (!std::all_of(asked.sigma.begin(), asked.sigma.end(), unobserved)) continue;
    unknown.push_back(fmt::format("{} ({:.3g} {})", asked.id.of, asked.prior / UnitSize(asked.id),
                                  UnitOf(asked.id.measure)));
  }
  if (unknown.empty()) return {};
  return {
      fmt::format("state/: no inertial unit, encoder or antenna observes {}; the brackets give the "
                  "deviation of a uniform distribution over the travel",
                  fmt::join(unknown, ", "))};
}

}  // namespace tera
