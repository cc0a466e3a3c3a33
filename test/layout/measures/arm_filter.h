#pragma once

#include <cmath>
#include <vector>

#include "layout/measures/estimated_arm.h"

namespace tera {

/// Extended Kalman filter of an arm: coordinates, rates and accelerations, biases of its inertial
/// units and slow errors of its antennas. A unit's sample is the change of pose and velocity
/// between two times, so the filter also keeps the state of the earlier time.
class ArmFilter {
 public:
  /// Starts at `start` plus random errors; coordinates have the deviation `start_sigma`.
  ArmFilter(const Arm& arm, const std::vector<SensorDescription>& rig, const ArmLaw& law,
            const ArmMotion& start, double start_sigma, std::uint64_t seed)
      : arm_(arm), n_(arm.coordinates()) {
    std::vector<double> sigma;
    for (Eigen::Index i = 0; i < n_; ++i) sigma.push_back(start_sigma);
    for (Eigen::Index i = 0; i < n_; ++i) sigma.push_back(law.rate_sigma[i]);
    for (Eigen::Index i = 0; i < n_; ++i) sigma.push_back(law.rate_sigma[i] / law.response_s);
    for (const SensorDescription& sensor : rig) {
      if (std::holds_alternative<ImuModel>(sensor.model)) imus_.push_back(sensor);
      if (std::holds_alternative<GnssModel>(sensor.model)) antennas_.push_back(sensor);
      if (std::holds_alternative<EncoderModel>(sensor.model)) encoders_ = sensor;
    }
    for (const SensorDescription& imu : imus_) {
      const auto& model = std::get<ImuModel>(imu.model);
      for (const double bias : model.gyro_bias_radps) sigma.push_back(bias);
      for (const double bias : model.accel_bias_mps2) sigma.push_back(bias);
    }
    for (const SensorDescription& antenna : antennas_) {
      const auto& model = std::get<GnssModel>(antenna.model);
      sigma.insert(sigma.end(), 2, model.correlated_horizontal_m);
      sigma.push_back(model.correlated_vertical_m);
    }
    const Stream stream(seed, "filter");
    const Eigen::VectorXd s =
        Eigen::Map<Eigen::VectorXd>(sigma.data(), static_cast<Eigen::Index>(sigma.size()));
    P_ = s.cwiseAbs2().asDiagonal();
    x_ = Eigen::VectorXd::Zero(s.size());
    x_.head(n_) = start.c;
    for (Eigen::Index i = 0; i < n_; ++i) x_[i] += start_sigma * stream.Gaussian(i);
    MakeSteps(law);
  }

  const Eigen::VectorXd& state() const { return x_; }

  void Step(const ArmSamples::Moment& moment) {
    const Eigen::Index size = x_.size(), old = 2 * n_;
    Eigen::VectorXd x(size + old);
    x << F_ * x_, x_.head(old);
    Eigen::MatrixXd P(size + old, size + old);
    P.topLeftCorner(size, size) = F_ * P_ * F_.transpose() + Q_;
    P.topRightCorner(size, old) = F_ * P_.leftCols(old);
    P.bottomLeftCorner(old, size) = P.topRightCorner(size, old).transpose();
    P.bottomRightCorner(old, old) = P_.topLeftCorner(old, old);
    const Eigen::VectorXd z = MeasuredOf(moment), r = NoiseOf(moment);
    const Eigen::VectorXd expected = Expected(x, moment);
    const Eigen::MatrixXd H = Derivatives(x, moment);
    const Eigen::MatrixXd PHt = P * H.transpose();
    Eigen::MatrixXd S = H * PHt;
    S.diagonal() += r;
    const Eigen::MatrixXd K = S.ldlt().solve(PHt.transpose()).transpose();
    x += K * (z - expected);
    P -= K * PHt.transpose();
    x_ = x.head(size);
    P_ = 0.5 * (P.topLeftCorner(size, size) + P.topLeftCorner(size, size).transpose());
  }

 private:
  /// F and Q of one sample: steps of the motion, biases and slow errors.
  void MakeSteps(const ArmLaw& law) {
    const double h = kCourseStep_s, w = 1 / law.response_s;
    Mat3 small;  // of position, rate, acceleration
    small.row(2) << 0, -w * w * h, 1 - 2 * w * h;
    small.row(1) = Vec3(0, 1, 0).transpose() + h * small.row(2);
    small.row(0) = Vec3(1, 0, 0).transpose() + h * small.row(1);
    const Vec3 push(h * h, h, 1);
    Mat3 F = Mat3::Identity(), Q = Mat3::Zero();
    for (int k = 0; k < kStepsASample; ++k) {
      F = small * F;
      Q = small * Q * small.transpose() + 4 * w * w * w * h * push * push.transpose();
    }
    F_ = Eigen::MatrixXd::Identity(x_.size(), x_.size());
    Q_ = Eigen::MatrixXd::Zero(x_.size(), x_.size());
    for (Eigen::Index i = 0; i < n_; ++i) {
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          F_(a * n_ + i, b * n_ + i) = F(a, b);
          Q_(a * n_ + i, b * n_ + i) = law.rate_sigma[i] * law.rate_sigma[i] * Q(a, b);
        }
      }
    }
    Eigen::Index at = 3 * n_;
    for (const SensorDescription& imu : imus_) {
      const auto& model = std::get<ImuModel>(imu.model);
      const double gyro = model.gyro_bias_random_walk_radps2rthz;
      const double accel = model.accel_bias_random_walk_mps3rthz;
      Q_.diagonal().segment<3>(at).setConstant(gyro * gyro * kSample_s);
      Q_.diagonal().segment<3>(at + 3).setConstant(accel * accel * kSample_s);
      at += 6;
    }
    for (const SensorDescription& antenna : antennas_) {
      const double kept =
          std::exp(-kSample_s / std::get<GnssModel>(antenna.model).correlation_time_s);
      F_.diagonal().segment<3>(at).setConstant(kept);
      Q_.diagonal().segment<3>(at) = (1 - kept * kept) * P_.diagonal().segment<3>(at);
      at += 3;
    }
  }

  static Eigen::VectorXd Stack(const std::vector<double>& numbers) {
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                             static_cast<Eigen::Index>(numbers.size()));
  }

  Eigen::VectorXd MeasuredOf(const ArmSamples::Moment& moment) const {
    std::vector<double> z;
    for (const ImuSample& imu : moment.imus) {
      z.insert(z.end(), imu.w_WS_S_radps.begin(), imu.w_WS_S_radps.end());
      z.insert(z.end(), imu.f_S_mps2.begin(), imu.f_S_mps2.end());
    }
    for (const EncoderSample& encoder : moment.encoders) {
      z.insert(z.end(), {encoder.q_rad[0], encoder.qd_radps[0]});
    }
    for (const GnssSample& gnss : moment.antennas) {
      z.insert(z.end(), gnss.enu_m.begin(), gnss.enu_m.end());
    }
    return Stack(z);
  }

  /// Variances of the white noise.
  Eigen::VectorXd NoiseOf(const ArmSamples::Moment& moment) const {
    std::vector<double> r;
    for (const SensorDescription& imu : imus_) {
      const auto& model = std::get<ImuModel>(imu.model);
      r.insert(r.end(), 3, std::pow(model.gyro_noise_density_radpsrthz, 2) / kSample_s);
      r.insert(r.end(), 3, std::pow(model.accel_noise_density_mps2rthz, 2) / kSample_s);
    }
    if (!moment.encoders.empty()) {
      const auto& model = std::get<EncoderModel>(encoders_.model);
      r.push_back(std::pow(model.noise_rad, 2) + std::pow(model.resolution_rad, 2) / 12);
      r.push_back(std::pow(model.rate_noise_radps, 2));
    }
    for (std::size_t i = 0; i < moment.antennas.size(); ++i) {
      const auto& model = std::get<GnssModel>(antennas_[i].model);
      r.insert(r.end(), 2, std::pow(model.white_horizontal_m, 2));
      r.push_back(std::pow(model.white_vertical_m, 2));
    }
    return Stack(r);
  }

  Vec3 VelocityOf(const SensorDescription& sensor, const Eigen::VectorXd& c,
                  const Eigen::VectorXd& v) const {
    constexpr double kAside_s = 1e-4;
    const auto place = [&](double t_s) -> Vec3 {
      return arm_.LinkAt(LinkOf(sensor), c + t_s * v) * sensor.X_BS.translation();
    };
    return (place(kAside_s) - place(-kAside_s)) / (2 * kAside_s);
  }

  /// Mean rate and specific force between two times, from the poses and velocities at both.
  Eigen::Matrix<double, 6, 1> Inertial(const SensorDescription& imu,
                                       const Eigen::VectorXd& x) const {
    const Eigen::VectorXd c1 = x.head(n_), v1 = x.segment(n_, n_);
    const Eigen::VectorXd c0 = x.segment(x_.size(), n_), v0 = x.tail(n_);
    const Mat3 R0 = (arm_.LinkAt(LinkOf(imu), c0) * imu.X_BS).linear();
    const Mat3 R1 = (arm_.LinkAt(LinkOf(imu), c1) * imu.X_BS).linear();
    const Eigen::AngleAxisd turn(Mat3(R0.transpose() * R1));
    const Mat3 R_middle = R0 * Mat3(Eigen::AngleAxisd(0.5 * turn.angle(), turn.axis()));
    const Vec3 a_W = (VelocityOf(imu, c1, v1) - VelocityOf(imu, c0, v0)) / kSample_s;
    Eigen::Matrix<double, 6, 1> z;
    z << turn.axis() * turn.angle() / kSample_s,
        R_middle.transpose() * (a_W + Vec3(0, 0, kStandardGravity_mps2));
    return z;
  }

  /// Prediction from the state, and from the previous coordinates and rates, in one column.
  Eigen::VectorXd Expected(const Eigen::VectorXd& x, const ArmSamples::Moment& moment) const {
    std::vector<double> z;
    Eigen::Index error = 3 * n_;
    for (const SensorDescription& imu : imus_) {
      const Eigen::Matrix<double, 6, 1> numbers = Inertial(imu, x) + x.segment<6>(error);
      z.insert(z.end(), numbers.begin(), numbers.end());
      error += 6;
    }
    if (!moment.encoders.empty()) z.insert(z.end(), {x[n_ - 3], x[2 * n_ - 3]});
    for (std::size_t i = 0; i < moment.antennas.size(); ++i, error += 3) {
      const Vec3 p_W_m =
          arm_.LinkAt(LinkOf(antennas_[i]), x.head(n_)) * antennas_[i].X_BS.translation();
      const Vec3 numbers = p_W_m + x.segment<3>(error);
      z.insert(z.end(), numbers.begin(), numbers.end());
    }
    return Stack(z);
  }

  Eigen::MatrixXd Derivatives(const Eigen::VectorXd& x, const ArmSamples::Moment& moment) const {
    constexpr double kAside = 1e-5;
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(Expected(x, moment).size(), x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      // Accelerations are not part of the result, and errors add.
      if (i >= 2 * n_ && i < x_.size()) continue;
      Eigen::VectorXd more = x, less = x;
      more[i] += kAside;
      less[i] -= kAside;
      H.col(i) = (Expected(more, moment) - Expected(less, moment)) / (2 * kAside);
    }
    const auto inertial = 6 * static_cast<Eigen::Index>(imus_.size());
    const auto placed = 3 * static_cast<Eigen::Index>(moment.antennas.size());
    H.block(0, 3 * n_, inertial, inertial).setIdentity();
    H.block(H.rows() - placed, 3 * n_ + inertial, placed, placed).setIdentity();
    return H;
  }

  const Arm arm_;
  const Eigen::Index n_;
  std::vector<SensorDescription> imus_, antennas_;
  SensorDescription encoders_;
  Eigen::VectorXd x_;
  Eigen::MatrixXd P_, F_, Q_;
};

}  // namespace tera
