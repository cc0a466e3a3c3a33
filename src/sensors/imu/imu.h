#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/motion.h"
#include "core/random.h"
#include "core/types/measurement.h"

namespace tera {

/// Noise of an inertial measurement unit, in Allan variance terms.
struct ImuModel {
  double gyro_noise_density_radpsrthz = 0;      ///< angle random walk, rad/s/sqrt(Hz)
  double gyro_bias_random_walk_radps2rthz = 0;  ///< rate random walk, rad/s^2/sqrt(Hz)
  double accel_noise_density_mps2rthz = 0;
  double accel_bias_random_walk_mps3rthz = 0;
  double gyro_sample_noise_radps = 0;  ///< 1 sigma of additional noise per sample, at any rate
  double accel_sample_noise_mps2 = 0;
  Vec3 gyro_bias_radps = Vec3::Zero();  ///< at the start
  Vec3 accel_bias_mps2 = Vec3::Zero();
};

void Serialize(ModelArchive* archive, ImuModel* model);

/// Three gyroscopes and three accelerometers fixed to a body.
///
/// Frames  W world, B body, S sensor at X_BS.
/// Model   The poses of S define the motion, so that the readings agree with a camera at the same
///         place. Over a step, w_S = log(R_0^T R_1) / dt and f_S = R_SW ((v_1 - v_0) / dt - g_W).
///         At a step boundary, v is interpolated between the mean velocities of the adjacent steps.
///         The first v is that of the state. The last v assumes constant acceleration over the last
///         step. Each sample is the mean over its own interval (t - T, t], as in a strapdown unit
///         with internal integration. White noise sigma / sqrt(T) and a bias random walk are added.
///         Sample k >= 1 is due at clock.Due(k).
///         The accelerations of the state are not used. The rates of a physics step carry one pose
///         to the next, and so belong to the middle of the step. Their change, a_WB, belongs to the
///         beginning of the step. If it were used for the whole step, readings would lag by half a
///         step (docs/evidence/accuracy.md states the error). The mean velocities come from exact
///         poses, so that their differences add no noise.
/// Omits   Earth's rotation (15 deg/h about the pole, more than the bias instability of a good
///         unit) and its Coriolis acceleration; variation of gravity with position; cross-axis and
///         g-sensitivity. ImuErrors adds scale, temperature, saturation, quantisation and
///         vibration.
/// Source  IEEE Std 952-1997 (noise terms); Titterton and Weston 2004, ch. 11 (integration).
class Imu {
 public:
  /// `stream_name` is the prefix of its noise streams, for example "excavator1/imu_boom".
  Imu(const ImuModel& model, const Pose& X_BS, const SampleClock& clock, TimeNs latency_ns,
      std::uint64_t seed, const std::string& stream_name);

  /// Processes the step of body B from `begin` at t0 to `end` at t1. Appends the samples of the
  /// previous step, whose final velocity depends on this step. Steps must be contiguous.
  void Advance(TimeNs t0_ns, const BodyState& begin, TimeNs t1_ns, const BodyState& end,
               const Vec3& gravity_W_mps2, std::vector<ImuSample>* samples);
  /// Appends the samples of the last step, assuming constant acceleration over it.
  void Finish(std::vector<ImuSample>* samples);

 private:
  struct Span {
    TimeNs t0_ns, t1_ns;
    Mat3 R_WS0, R_WS1;
    Vec3 chord_mps;  ///< mean velocity of S
    Vec3 gravity_W_mps2;
    double duration_s() const { return ToSeconds(t1_ns - t0_ns); }
  };

  /// Integrates `last_`; `v_WS_mps` is the velocity of S at its end.
  void Integrate(const Vec3& v_WS_mps, std::vector<ImuSample>* samples);
  /// Mean over the interval that ends at Due(next_), with noise.
  ImuSample CloseInterval();

  ImuModel model_;
  Pose X_BS_;
  SampleClock clock_;
  TimeNs latency_ns_;
  Stream gyro_white_, accel_white_, gyro_walk_, accel_walk_;
  Vec3 gyro_bias_radps_, accel_bias_mps2_;
  Vec3 rate_integral_rad_ = Vec3::Zero(), force_integral_mps_ = Vec3::Zero();
  std::int64_t next_ = 1;
  std::optional<Span> last_;
  Vec3 v_WS_mps_ = Vec3::Zero();  ///< at the start of `last_`
};

}  // namespace tera
