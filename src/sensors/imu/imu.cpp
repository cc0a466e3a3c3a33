#include "sensors/imu/imu.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/units.h"

namespace tera {
namespace {

double WhiteSigma(double density, double per_sample, double interval_s) {
  return std::sqrt(density * density / interval_s + per_sample * per_sample);
}

/// Normal noise with standard deviation `sigma` on each axis; draws nothing if `sigma` is 0.
Vec3 Noise(double sigma, const Stream& stream, std::int64_t k) {
  return sigma == 0 ? Vec3(Vec3::Zero()) : Vec3(sigma * stream.Gaussian3(k));
}

}  // namespace

void Serialize(ModelArchive* archive, ImuModel* m) {
  archive->Visit("gyro_noise_density_degpsrthz", &m->gyro_noise_density_radpsrthz,
                 AtLeast(0, "deg/s/sqrt(Hz)"), kDeg);
  archive->Visit("gyro_bias_random_walk_degps2rthz", &m->gyro_bias_random_walk_radps2rthz,
                 AtLeast(0, "deg/s^2/sqrt(Hz)"), kDeg);
  archive->Visit("gyro_bias_degps", &m->gyro_bias_radps, Any("deg/s"), kDeg);
  archive->Visit("gyro_sample_noise_degps", &m->gyro_sample_noise_radps, AtLeast(0, "deg/s"), kDeg);
  archive->Visit("accel_noise_density_ugrthz", &m->accel_noise_density_mps2rthz,
                 AtLeast(0, "ug/sqrt(Hz)"), kMicroG_mps2);
  archive->Visit("accel_bias_random_walk_mps3rthz", &m->accel_bias_random_walk_mps3rthz,
                 AtLeast(0, "m/s^3/sqrt(Hz)"));
  archive->Visit("accel_bias_mps2", &m->accel_bias_mps2, Any("m/s^2"));
  archive->Visit("accel_sample_noise_mps2", &m->accel_sample_noise_mps2, AtLeast(0, "m/s^2"));
}

Imu::Imu(const ImuModel& model, const Pose& X_BS, const SampleClock& clock, TimeNs latency_ns,
         std::uint64_t seed, const std::string& stream_name)
    : model_(model),
      X_BS_(X_BS),
      clock_(clock),
      latency_ns_(latency_ns),
      gyro_white_(seed, stream_name + "/gyro_white"),
      accel_white_(seed, stream_name + "/accel_white"),
      gyro_walk_(seed, stream_name + "/gyro_walk"),
      accel_walk_(seed, stream_name + "/accel_walk"),
      gyro_bias_radps_(model.gyro_bias_radps),
      accel_bias_mps2_(model.accel_bias_mps2) {}

void Imu::Advance(TimeNs t0_ns, const BodyState& begin, TimeNs t1_ns, const BodyState& end,
                  const Vec3& gravity_W_mps2, std::vector<ImuSample>* samples) {
  TERA_CHECK(t1_ns > t0_ns, t0_ns, t1_ns);
  const BodyState S0 = MotionOfFixedFrame(begin, X_BS_);
  const Pose X_WS1 = end.X_WB * X_BS_;
  const Vec3 chord_mps = (X_WS1.translation() - S0.X_WB.translation()) / ToSeconds(t1_ns - t0_ns);
  const Span now{t0_ns, t1_ns, S0.X_WB.linear(), X_WS1.linear(), chord_mps, gravity_W_mps2};
  if (last_) {
    TERA_CHECK(last_->t1_ns == t0_ns, last_->t1_ns, t0_ns);
    // Each mean velocity belongs to the middle of its step; between the middles, velocity is
    // linear.
    const double s = last_->duration_s() / (last_->duration_s() + now.duration_s());
    Integrate((1 - s) * last_->chord_mps + s * chord_mps, samples);
  } else {
    v_WS_mps_ = S0.v_WB_mps;
  }
  last_ = now;
}

void Imu::Finish(std::vector<ImuSample>* samples) {
  if (last_) Integrate(2 * last_->chord_mps - v_WS_mps_, samples);
  last_.reset();
}

void Imu::Integrate(const Vec3& v_WS_mps, std::vector<ImuSample>* samples) {
  const Span& span = *last_;
  const double dt_s = span.duration_s();
  const Eigen::AngleAxisd turn_S(Mat3(span.R_WS0.transpose() * span.R_WS1));
  const Vec3 w_S_radps = turn_S.angle() / dt_s * turn_S.axis();
  const Vec3 f_W_mps2 = (v_WS_mps - v_WS_mps_) / dt_s - span.gravity_W_mps2;
  v_WS_mps_ = v_WS_mps;
  TimeNs from_ns = std::max(span.t0_ns, clock_.start_ns);
  while (from_ns < span.t1_ns) {
    const TimeNs due_ns = clock_.Due(next_);
    const TimeNs to_ns = std::min(due_ns, span.t1_ns);
    const double middle_s = 0.5 * (ToSeconds(from_ns - span.t0_ns) + ToSeconds(to_ns - span.t0_ns));
    const Eigen::AngleAxisd to_middle_S(turn_S.angle() * middle_s / dt_s, turn_S.axis());
    const Mat3 R_WS = span.R_WS0 * to_middle_S;
    const double part_s = ToSeconds(to_ns - from_ns);
    rate_integral_rad_ += part_s * w_S_radps;
    force_integral_mps_ += part_s * (R_WS.transpose() * f_W_mps2);
    if (to_ns == due_ns) samples->push_back(CloseInterval());
    from_ns = to_ns;
  }
}

ImuSample Imu::CloseInterval() {
  const std::int64_t k = next_++;
  const double T_s = ToSeconds(clock_.Due(k) - clock_.Due(k - 1));
  const double walk_s = std::sqrt(T_s);
  gyro_bias_radps_ += Noise(model_.gyro_bias_random_walk_radps2rthz * walk_s, gyro_walk_, k);
  accel_bias_mps2_ += Noise(model_.accel_bias_random_walk_mps3rthz * walk_s, accel_walk_, k);
  const double gyro_sigma_radps =
      WhiteSigma(model_.gyro_noise_density_radpsrthz, model_.gyro_sample_noise_radps, T_s);
  const double accel_sigma_mps2 =
      WhiteSigma(model_.accel_noise_density_mps2rthz, model_.accel_sample_noise_mps2, T_s);

  ImuSample sample;
  sample.t_ns = clock_.Due(k);
  sample.t_available_ns = sample.t_ns + latency_ns_;
  sample.w_WS_S_radps =
      rate_integral_rad_ / T_s + gyro_bias_radps_ + Noise(gyro_sigma_radps, gyro_white_, k);
  sample.f_S_mps2 =
      force_integral_mps_ / T_s + accel_bias_mps2_ + Noise(accel_sigma_mps2, accel_white_, k);
  rate_integral_rad_.setZero();
  force_integral_mps_.setZero();
  return sample;
}

}  // namespace tera
