#include "sensors/imu/imu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/units.h"

namespace tera {
namespace {

const Vec3 kGravity_W_mps2(0, 0, -kStandardGravity_mps2);
constexpr TimeNs kStep_ns = 2'000'000;

BodyState AtRest(const Pose& X_WB) {
  BodyState body;
  body.X_WB = X_WB;
  return body;
}

/// Samples of a body at rest over `duration_s`.
std::vector<ImuSample> RestSamples(const ImuModel& model, double rate_hz, double duration_s,
                                   std::uint64_t seed = 1, const std::string& name = "m/imu") {
  Imu imu(model, Pose::Identity(), {.rate_hz = rate_hz}, 0, seed, name);
  const BodyState body = AtRest(MakePose({3, 2, 1}));
  std::vector<ImuSample> samples;
  const TimeNs end_ns = FromSeconds(duration_s);
  for (TimeNs t = 0; t < end_ns; t += kStep_ns) {
    imu.Advance(t, body, t + kStep_ns, body, kGravity_W_mps2, &samples);
  }
  imu.Finish(&samples);
  return samples;
}

TEST(Imu, AtRestAndLevelItReadsGravityUpwards) {
  const auto samples = RestSamples({}, 200, 0.1);
  ASSERT_EQ(samples.size(), 20u);
  for (const ImuSample& s : samples) {
    EXPECT_NEAR((s.f_S_mps2 - Vec3(0, 0, 9.80665)).norm(), 0, 1e-12);
    EXPECT_NEAR(s.w_WS_S_radps.norm(), 0, 1e-15);
  }
  EXPECT_EQ(samples[0].t_ns, 5'000'000);
  EXPECT_EQ(samples[19].t_ns, 100'000'000);
}

TEST(Imu, MountedNoseUpItReadsGravityAlongX) {
  Imu imu({}, MakePose({0.1, 0.2, 0.3}, 0, -90 * kDeg, 0), {.rate_hz = 100}, 7, 1, "imu");
  const BodyState body = AtRest(MakePose({5, 5, 5}, 0, 0, 0.7));
  std::vector<ImuSample> samples;
  imu.Advance(0, body, 10'000'000, body, kGravity_W_mps2, &samples);
  imu.Finish(&samples);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_NEAR((samples[0].f_S_mps2 - Vec3(9.80665, 0, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(samples[0].t_available_ns, 10'000'007);
}

TEST(Imu, TheLeverArmAddsCentripetalAndTangentialAcceleration) {
  // A level body spins about its own z with 2 rad/s, growing by 3 rad/s^2. The sensor sits 1.5 m
  // ahead of the axis and looks to the body's left. The centripetal 6 m/s^2 point back to the axis,
  // its left; the tangential 4.5 m/s^2 to the body's left, its front.
  Imu imu({}, MakePose({1.5, 0, 0.4}, 0, 0, 90 * kDeg), {.rate_hz = 1000}, 0, 1, "imu");
  // The middle of three samples is that of the curve's own instant.
  const auto at = [](double t_s) {
    BodyState body = AtRest(MakePose({10, -4, 2}, 0, 0, 1.1 + 2 * t_s + 1.5 * t_s * t_s));
    body.w_WB_radps = Vec3(0, 0, 2 + 3 * t_s);
    return body;
  };
  std::vector<ImuSample> samples;
  for (int k = 0; k < 3; ++k) {
    imu.Advance(k * 1'000'000, at(1e-3 * k - 0.0015), (k + 1) * 1'000'000, at(1e-3 * k - 0.0005),
                kGravity_W_mps2, &samples);
  }
  samples.erase(samples.begin());
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_NEAR((samples[0].w_WS_S_radps - Vec3(0, 0, 2)).norm(), 0, 1e-12);
  // Chords replace arcs: an error of second order in the 2 mrad of a step, 4e-6 of 6 m/s^2.
  EXPECT_NEAR((samples[0].f_S_mps2 - Vec3(4.5, 6, 9.80665)).norm(), 0, 5e-5);
}

/// Rotations about the vertical line through (2, 3), as of an accelerating slew: the angle at t,
/// its rate and its acceleration.
struct Slewing {
  static constexpr double kRate_radps = 0.9, kGrowth_radps2 = 0.35;
  static double Angle(double t_s) {
    return 0.4 + kRate_radps * t_s + 0.5 * kGrowth_radps2 * t_s * t_s;
  }
  static double Rate(double t_s) { return kRate_radps + kGrowth_radps2 * t_s; }

  /// B, tilted, 4 m from the axis, with its velocities and accelerations.
  static BodyState At(double t_s) {
    const Vec3 axis_W_m(2, 3, 0), arm_m(4, 0, 1.5);
    const Mat3 R_turn = RotationFromRpy(0, 0, Angle(t_s));
    const Vec3 r_W = R_turn * arm_m, out_W(r_W.x(), r_W.y(), 0), ahead_W(-r_W.y(), r_W.x(), 0);
    BodyState body;
    body.X_WB = MakePose(axis_W_m + r_W, R_turn * RotationFromRpy(0.2, -0.3, 0.5));
    body.v_WB_mps = Rate(t_s) * ahead_W;
    body.w_WB_radps = Vec3(0, 0, Rate(t_s));
    body.a_WB_mps2 = kGrowth_radps2 * ahead_W - Rate(t_s) * Rate(t_s) * out_W;
    body.alpha_WB_radps2 = Vec3(0, 0, kGrowth_radps2);
    return body;
  }
};

TEST(Imu, WhileABodySlewsItReadsThatCircularMotionAtItsOwnPlace) {
  // The sensor also moves on a circle about the axis: centripetal w^2 rho towards it, tangential
  // alpha rho along its path, on any body. Samples of 250 Hz are means over two steps, in which the
  // body turns by at most 6 mrad. Chords and means err by at most the square of that over 24, 2e-6
  // of 20 m/s^2.
  const Pose X_BS = MakePose({1.2, -0.7, 0.4}, 0.3, 0.2, -1.1);
  Imu imu({}, X_BS, {.rate_hz = 250}, 0, 1, "imu");
  std::vector<ImuSample> samples;
  for (int k = 0; k < 1000; ++k) {
    imu.Advance(k * kStep_ns, Slewing::At(0.002 * k), (k + 1) * kStep_ns,
                Slewing::At(0.002 * (k + 1)), kGravity_W_mps2, &samples);
  }
  imu.Finish(&samples);
  ASSERT_EQ(samples.size(), 500u);
  double greatest_mps2 = 0;
  for (const ImuSample& sample : samples) {
    // The ends have steps on one side only.
    if (sample.t_ns < 10'000'000 || sample.t_ns > 1'990'000'000) continue;
    const double t_s = ToSeconds(sample.t_ns) - 0.002, w_radps = Slewing::Rate(t_s);
    const Pose X_WS = Slewing::At(t_s).X_WB * X_BS;
    const Vec3 rho_W(X_WS.translation().x() - 2, X_WS.translation().y() - 3, 0);
    const Vec3 ahead_W(-rho_W.y(), rho_W.x(), 0);
    const Vec3 a_W = Slewing::kGrowth_radps2 * ahead_W - w_radps * w_radps * rho_W;
    const Mat3 R_SW = X_WS.linear().transpose();
    EXPECT_NEAR((sample.f_S_mps2 - R_SW * (a_W - kGravity_W_mps2)).norm(), 0, 2e-4) << t_s;
    EXPECT_NEAR((sample.w_WS_S_radps - R_SW * Vec3(0, 0, w_radps)).norm(), 0, 1e-9) << t_s;
    greatest_mps2 = std::max(greatest_mps2, a_W.norm());
    // The same from the accelerations that the state holds at that instant.
    const BodyState S = MotionOfFixedFrame(Slewing::At(t_s), X_BS);
    EXPECT_NEAR((sample.f_S_mps2 - R_SW * (S.a_WB_mps2 - kGravity_W_mps2)).norm(), 0, 2e-4) << t_s;
    EXPECT_NEAR((sample.w_WS_S_radps - R_SW * S.w_WB_radps).norm(), 0, 1e-9) << t_s;
  }
  EXPECT_GT(greatest_mps2, 10);
}

TEST(Imu, RatesAddUpToTheTurnOfThePoseWhateverTheVelocitySays) {
  // A semi-implicit step turns the pose by the rate at its end, so that rates and poses differ by
  // half a step. Sight and measurement must nevertheless have the same motion.
  Imu imu({}, MakePose({0.3, 0.2, 0.1}, 0.4, -0.2, 1.0), {.rate_hz = 200}, 0, 1, "imu");
  const Pose X_BS = MakePose({0.3, 0.2, 0.1}, 0.4, -0.2, 1.0);
  BodyState body = AtRest(MakePose({1, 2, 3}, 0.1, -0.3, 0.8));
  const Mat3 R_start = (body.X_WB * X_BS).linear();
  std::vector<ImuSample> samples;
  Mat3 R_WS = R_start;
  for (int k = 0; k < 500; ++k) {
    BodyState next = body;
    next.w_WB_radps = Vec3(0.4, -0.3, 0.9) * (k + 1) / 500.0;
    next.X_WB.linear() =
        Eigen::AngleAxisd(0.002 * next.w_WB_radps.norm(), next.w_WB_radps.normalized()) *
        body.X_WB.linear();
    imu.Advance(k * kStep_ns, body, (k + 1) * kStep_ns, next, kGravity_W_mps2, &samples);
    body = next;
  }
  imu.Finish(&samples);
  ASSERT_EQ(samples.size(), 200u);
  for (const ImuSample& s : samples) {
    const Vec3 turn = 0.005 * s.w_WS_S_radps;
    R_WS = R_WS * Eigen::AngleAxisd(turn.norm(), turn.normalized());
  }
  // The axis is constant in W, so that the samples' rotations add without coning.
  const Mat3 R_end = (body.X_WB * X_BS).linear();
  EXPECT_LT(Eigen::AngleAxisd(R_WS.transpose() * R_end).angle(), 1e-9);
  EXPECT_GT(Eigen::AngleAxisd(R_start.transpose() * R_end).angle(), 0.4);
}

TEST(Imu, RatesThatDoNotDivideTheStepAverageExactly) {
  // Acceleration 1, 2, 3, ... m/s^2 over steps of 2 ms, sampled at 300 Hz: the samples' integral
  // over whole intervals is that of the steps. Sample 3 ends at 10 ms with steps 1..5: its
  // predecessors and it add up to 15 * 2 ms. The means of neighbouring chords are the velocities
  // 2, 6, 12 and 20 mm/s that these accelerations give.
  constexpr double chords_mps[] = {0.001, 0.003, 0.009, 0.015, 0.025};
  Imu imu({}, MakePose({0, 0, 0}), {.rate_hz = 300}, 0, 1, "imu");
  std::vector<ImuSample> samples;
  BodyState body;
  for (int k = 0; k < 5; ++k) {
    BodyState end = body;
    end.X_WB.translation().x() += 0.002 * chords_mps[k];
    imu.Advance(k * kStep_ns, body, (k + 1) * kStep_ns, end, kGravity_W_mps2, &samples);
    body = end;
  }
  imu.Finish(&samples);
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[0].t_ns, 3'333'333);
  double speed_mps = 0;
  TimeNs last_ns = 0;
  for (const ImuSample& s : samples) {
    speed_mps += s.f_S_mps2.x() * ToSeconds(s.t_ns - last_ns);
    last_ns = s.t_ns;
  }
  EXPECT_NEAR(speed_mps, 15 * 0.002, 1e-12);
  EXPECT_NEAR(samples[0].f_S_mps2.x(), (2.0 * 1 + 1.333333 * 2) / 3.333333, 1e-9);
}

TEST(Imu, IntervalsBeforeTheClocksStartAreLeftOut) {
  Imu imu({}, Pose::Identity(), {.rate_hz = 100, .start_ns = 3'000'000}, 0, 1, "imu");
  // 1 m/s^2 from rest.
  BodyState still, at_3_ms, at_15_ms;
  at_3_ms.X_WB.translation().x() = 0.5 * 0.003 * 0.003;
  at_15_ms.X_WB.translation().x() = 0.5 * 0.015 * 0.015;
  std::vector<ImuSample> samples;
  imu.Advance(0, still, 3'000'000, at_3_ms, kGravity_W_mps2, &samples);
  imu.Advance(3'000'000, at_3_ms, 15'000'000, at_15_ms, kGravity_W_mps2, &samples);
  imu.Finish(&samples);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].t_ns, 13'000'000);
  EXPECT_NEAR(samples[0].f_S_mps2.x(), 1, 1e-12);
}

/// Yaw, pitch and place of a body that swings on a curve, with first and second derivatives from
/// the pose by central differences of 1e-4 s (error of the order of 1e-8).
Pose CurveAt(double t) {
  return MakePose({3 * std::sin(0.5 * t), 2 * std::cos(0.7 * t), 0.3 * std::sin(1.1 * t)},
                  0.2 * std::sin(1.3 * t), 0.15 * std::sin(0.9 * t), 0.8 * std::sin(0.6 * t));
}

TEST(Imu, IntegratedSamplesReproduceTheTrajectoryWithinOneCentimetre) {
  // A body whose accelerations are constant over each 2 ms step, chosen to follow the curve; rates
  // and pose integrated with them. The sensor sits off the origin and is turned. Its samples at
  // 200 Hz are integrated from the true start of S.
  const Pose X_BS = MakePose({0.8, -0.3, 1.2}, 0.4, -0.2, 1.0);
  Imu imu({}, X_BS, {.rate_hz = 200}, 0, 1, "imu");
  const double dt = ToSeconds(kStep_ns), h = 1e-4;
  const auto velocity = [&](double t) -> Vec3 {
    return (CurveAt(t + h).translation() - CurveAt(t - h).translation()) / (2 * h);
  };
  const auto rate = [&](double t) -> Vec3 {
    const Eigen::AngleAxisd turn(
        Mat3(CurveAt(t + h).linear() * CurveAt(t - h).linear().transpose()));
    return turn.axis() * turn.angle() / (2 * h);
  };
  BodyState body;
  body.X_WB = CurveAt(0);
  body.v_WB_mps = velocity(0);
  body.w_WB_radps = rate(0);
  const BodyState start_S = MotionOfFixedFrame(body, X_BS);
  std::vector<ImuSample> samples;
  for (int k = 0; k < 5000; ++k) {
    BodyState next = body;
    next.v_WB_mps = velocity((k + 1) * dt);
    next.w_WB_radps = rate((k + 1) * dt);
    const Vec3 mean_w = 0.5 * (body.w_WB_radps + next.w_WB_radps);
    next.X_WB.translation() += 0.5 * dt * (body.v_WB_mps + next.v_WB_mps);
    next.X_WB.linear() =
        Eigen::AngleAxisd(mean_w.norm() * dt, mean_w.normalized()) * body.X_WB.linear();
    imu.Advance(k * kStep_ns, body, (k + 1) * kStep_ns, next, kGravity_W_mps2, &samples);
    body = next;
  }
  imu.Finish(&samples);
  ASSERT_EQ(samples.size(), 2000u);

  Pose X_WS = start_S.X_WB;
  Vec3 v_WS = start_S.v_WB_mps;
  for (const ImuSample& s : samples) {
    const double T = 0.005;
    const Vec3 turn = s.w_WS_S_radps * T;
    const Mat3 R_half = X_WS.linear() * Eigen::AngleAxisd(turn.norm() / 2, turn.normalized());
    const Vec3 a_W = R_half * s.f_S_mps2 + kGravity_W_mps2;
    X_WS.translation() += v_WS * T + 0.5 * a_W * T * T;
    v_WS += a_W * T;
    X_WS.linear() = X_WS.linear() * Eigen::AngleAxisd(turn.norm(), turn.normalized());
  }
  const Pose truth = MotionOfFixedFrame(body, X_BS).X_WB;
  EXPECT_LT((X_WS.translation() - truth.translation()).norm(), 0.01);
  EXPECT_LT(Quat(X_WS.linear()).angularDistance(Quat(truth.linear())), 1e-3);
  EXPECT_GT((truth.translation() - start_S.X_WB.translation()).norm(), 1.0);
}

double Deviation(const std::vector<ImuSample>& samples,
                 const std::function<double(const ImuSample&)>& value) {
  double sum = 0, squares = 0;
  for (const ImuSample& s : samples) {
    sum += value(s);
    squares += value(s) * value(s);
  }
  const auto n = static_cast<double>(samples.size());
  return std::sqrt((squares - sum * sum / n) / (n - 1));
}

TEST(Imu, WhiteNoiseIsItsDensityOverTheRootOfTheInterval) {
  // n = 20000 samples: the standard error of a standard deviation is sigma / sqrt(2 n) = 0.5 %;
  // five of them: 2.5 %.
  ImuModel model;
  model.gyro_noise_density_radpsrthz = 0.002;
  model.accel_noise_density_mps2rthz = 0.03;
  const auto samples = RestSamples(model, 100, 200);
  ASSERT_EQ(samples.size(), 20000u);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(Deviation(samples, [&](const auto& s) { return s.w_WS_S_radps[axis]; }), 0.002 * 10,
                0.025 * 0.02);
    EXPECT_NEAR(Deviation(samples, [&](const auto& s) { return s.f_S_mps2[axis]; }), 0.03 * 10,
                0.025 * 0.3);
  }
}

TEST(Imu, SampleNoiseDoesNotDependOnTheRate) {
  // As above, 2.5 % for 20000 samples and 5 % for 5000.
  ImuModel model;
  model.gyro_sample_noise_radps = 0.01;
  model.accel_sample_noise_mps2 = 0.2;
  const auto fast = RestSamples(model, 500, 40), slow = RestSamples(model, 50, 100);
  const auto gyro_x = [](const ImuSample& s) { return s.w_WS_S_radps.x(); };
  const auto accel_z = [](const ImuSample& s) { return s.f_S_mps2.z(); };
  EXPECT_NEAR(Deviation(fast, gyro_x), 0.01, 0.025 * 0.01);
  EXPECT_NEAR(Deviation(slow, gyro_x), 0.01, 0.05 * 0.01);
  EXPECT_NEAR(Deviation(fast, accel_z), 0.2, 0.025 * 0.2);
  EXPECT_NEAR(Deviation(slow, accel_z), 0.2, 0.05 * 0.2);
}

TEST(Imu, BiasWalksWithVarianceGrowingInTime) {
  // Only the walk is on, so a sample shows the bias. Over N = 3 * 300 independent walks (axes and
  // seeds), the variance at time t is sigma^2 t with a relative standard error sqrt(2 / N) = 4.7 %;
  // five of them: 24 %.
  ImuModel model;
  model.gyro_bias_random_walk_radps2rthz = 0.01;
  model.accel_bias_random_walk_mps3rthz = 0.2;
  double gyro[2] = {}, accel[2] = {};
  constexpr int kSeeds = 300;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto samples = RestSamples(model, 10, 4, seed);
    for (int i = 0; i < 2; ++i) {
      const ImuSample& s = samples[i == 0 ? 9 : 39];  // after 1 s and 4 s
      gyro[i] += s.w_WS_S_radps.squaredNorm() / (3 * kSeeds);
      accel[i] += (s.f_S_mps2 + kGravity_W_mps2).squaredNorm() / (3 * kSeeds);
    }
  }
  EXPECT_NEAR(gyro[0], 1e-4, 0.24e-4);
  EXPECT_NEAR(gyro[1], 4e-4, 0.96e-4);
  EXPECT_NEAR(accel[0], 0.04, 0.0096);
  EXPECT_NEAR(accel[1], 0.16, 0.0384);
}

TEST(Imu, BiasesAtTheStartAreAdded) {
  ImuModel model;
  model.gyro_bias_radps = Vec3(0.1, -0.2, 0.3);
  model.accel_bias_mps2 = Vec3(1, 2, 3);
  const ImuSample s = RestSamples(model, 100, 0.01).at(0);
  EXPECT_NEAR((s.w_WS_S_radps - Vec3(0.1, -0.2, 0.3)).norm(), 0, 1e-12);
  EXPECT_NEAR((s.f_S_mps2 - Vec3(1, 2, 12.80665)).norm(), 0, 1e-12);
}

TEST(Imu, NoiseFollowsTheNameAndTheSeedAndNothingElse) {
  ImuModel model;
  model.gyro_noise_density_radpsrthz = 0.01;
  const auto a = RestSamples(model, 100, 0.1, 1, "m/imu_boom");
  const auto again = RestSamples(model, 100, 0.1, 1, "m/imu_boom");
  const auto other = RestSamples(model, 100, 0.1, 1, "m/imu_arm");
  const auto reseeded = RestSamples(model, 100, 0.1, 2, "m/imu_boom");
  EXPECT_EQ(a[3].w_WS_S_radps, again[3].w_WS_S_radps);
  EXPECT_NE(a[3].w_WS_S_radps, other[3].w_WS_S_radps);
  EXPECT_NE(a[3].w_WS_S_radps, reseeded[3].w_WS_S_radps);
}

}  // namespace
}  // namespace tera
