#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/motion.h"
#include "core/random.h"
#include "core/types/measurement.h"

namespace tera {

/// Noise of an inertial measurement unit, in Allan terms.
struct ImuModel {
  double gyro_noise_density_radpsrthz = 0;      ///< angle random walk, rad/s/sqrt(Hz)
  double gyro_bias_random_walk_radps2rthz = 0;  ///< rate random walk, rad/s^2/sqrt(Hz)
  double accel_noise_density_mps2rthz = 0;
  double accel_bias_random_walk_mps3rthz = 0;
  double gyro_sample_noise_radps = 0;  ///< 1 sigma of each sample whatever the rate, on top
  double accel_sample_noise_mps2 = 0;
  Vec3 gyro_bias_radps = Vec3::Zero();  ///< at the start
  Vec3 accel_bias_mps2 = Vec3::Zero();
};

void Serialize(ModelArchive* archive, ImuModel* model);

/// Three gyroscopes and three accelerometers fixed to a body.
///
/// Frames  W world, B body, S sensor at X_BS.
/// Model   the motion of the poses of S, so that what a unit measures is what a camera beside it
///         sees: over a step w_S = log(R_0^T R_1) / dt, f_S = R_SW ((v_1 - v_0) / dt - g_W), with v
///         between two steps the mean of their chords. Each sample is the mean over its own
///         interval (t - T, t], as of a strapdown unit that integrates internally; then white noise
///         sigma / sqrt(T) and a bias random walk. Sample k >= 1 is due at clock.Due(k).
///
///         Not from the accelerations that the state holds: the physics step finds the rates that
///         carry one pose to the next, which are those of the middle of the step, so that their
///         change, a_WB, is the acceleration at the step's beginning; taken for the step it comes
///         half a step late (docs/evidence/accuracy.md has what that costs). The chords are those
///         same rates of S, between poses that are exact, neither interpolated nor rounded:
///         differences of them add no noise. At its own time a_WB agrees with them to the second
///         order in the step.
/// Omits   Earth's rotation (15 deg/h about the pole, more than the bias instability of a good
///         unit) and its Coriolis acceleration; the change of gravity with place. Cross-axis and
///         g-sensitivity. (Scale, temperature, saturation, quantisation, vibration: ImuErrors.)
/// Source  IEEE Std 952-1997 (noise terms); Titterton and Weston 2004, ch. 11 (integration).
class Imu {
 public:
  /// `stream_name` is the prefix of its noise streams, "excavator1/imu_boom".
  Imu(const ImuModel& model, const Pose& X_BS, const SampleClock& clock, TimeNs latency_ns,
      std::uint64_t seed, const std::string& stream_name);

  /// Consumes the step from `begin` at t0 to `end` at t1 (motion of body B) and appends the samples
  /// that fell due in the step before, whose end velocity is known only now. Steps follow each
  /// other without a gap.
  void Advance(TimeNs t0_ns, const BodyState& begin, TimeNs t1_ns, const BodyState& end,
               const Vec3& gravity_W_mps2, std::vector<ImuSample>* samples);
  /// Appends the samples of the last step, which takes its end velocity from its own acceleration.
  void Finish(std::vector<ImuSample>* samples);

 private:
  struct Span {
    TimeNs t0_ns, t1_ns;
    Mat3 R_WS0, R_WS1;
    Vec3 chord_mps;  ///< mean velocity of S
    Vec3 gravity_W_mps2;
    double duration_s() const { return ToSeconds(t1_ns - t0_ns); }
  };

  /// Integrates `last_`, at whose end S has the velocity `v_WS_mps`.
  void Integrate(const Vec3& v_WS_mps, std::vector<ImuSample>* samples);
  /// The mean over the interval that ends at Due(next_), with its noise.
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
