#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "sensors/encoder/encoder_slots.h"
#include "sensors/gnss/gnss_slots.h"
#include "sensors/imu/imu_slots.h"
#include "sensors/slots/frame_slots.h"
#include "sensors/slots/given_effects.h"

namespace tera {
namespace {

using testing::Given;

const SiteFrame kSensorTimingSite(46.78, -71.27, 90);

/// Stamps by each type of sensor for measurements valid at `t_ns`, in this order: imu, gnss,
/// encoder, lidar, camera. Their times of availability are 30 ms later.
struct Stamps {
  std::vector<std::vector<TimeNs>> written, available;
};

template <typename Slots, typename Sample, typename Apply>
void Pass(Slots slots, Sample sample, const std::vector<TimeNs>& t_ns, Apply apply,
          Stamps* stamps) {
  stamps->written.emplace_back();
  stamps->available.emplace_back();
  for (std::size_t k = 0; k < t_ns.size(); ++k) {
    Sample s = sample;
    s.t_ns = t_ns[k];
    s.t_available_ns = t_ns[k] + 30'000'000;
    apply(&slots, static_cast<std::int64_t>(k), &s);
    stamps->written.back().push_back(s.t_ns);
    stamps->available.back().push_back(s.t_available_ns);
  }
}

Stamps StampsOf(const std::string& yaml, const std::vector<TimeNs>& t_ns) {
  const auto given = [&](EffectTarget target) { return Given(target, yaml); };
  const auto frame = [](auto* slots, std::int64_t k, auto* s) {
    slots->Apply(k, slots->Stamp(k, s->t_ns), s);
  };
  Stamps stamps;
  Pass(
      ImuSlots(given(EffectTarget::kImu), 1, "m/imu"), ImuSample(), t_ns,
      [](auto* slots, auto, auto* s) { slots->Apply(s); }, &stamps);
  Pass(
      GnssSlots(given(EffectTarget::kGnss), 1, "m/gnss"), GnssSample(), t_ns,
      [](auto* slots, auto, auto* s) { slots->Apply({}, kSensorTimingSite, s); }, &stamps);
  Pass(
      EncoderSlots(given(EffectTarget::kEncoder), {}, {}, {}, 1, "m/e"), EncoderSample(), t_ns,
      [](auto* slots, auto, auto* s) { slots->Apply(s); }, &stamps);
  Pass(FrameSlots(given(EffectTarget::kLidar), 1, "m/l"), LidarScan(), t_ns, frame, &stamps);
  Pass(FrameSlots(given(EffectTarget::kCamera), 1, "m/c"), CameraFrame(), t_ns, frame, &stamps);
  return stamps;
}

constexpr TimeNs kSecond = kNsPerSecond;

TEST(SensorTiming, GpsTimeIsEighteenSecondsAheadOfUtc) {
  const Stamps stamps = StampsOf("{clock_offset: {offset_s: 18}}", {0, kSecond});
  for (const auto& written : stamps.written) {
    EXPECT_EQ(written, (std::vector<TimeNs>{18 * kSecond, 19 * kSecond}));
  }
  // The clock is wrong; the measurement is available as before.
  for (const auto& available : stamps.available) EXPECT_EQ(available[0], 30'000'000);
}

TEST(SensorTiming, AClockOfTwentyPpmGainsTwentyMillisecondsInAThousandSeconds) {
  const Stamps stamps = StampsOf("{clock_drift: {drift_ppm: 20}}", {0, kSecond, 1000 * kSecond});
  for (const auto& written : stamps.written) {
    EXPECT_EQ(written, (std::vector<TimeNs>{0, kSecond + 20'000, 1000 * kSecond + 20'000'000}));
  }
  LidarScan scan;
  scan.points = {{.x_m = 1, .time_offset_ns = 50'000'000}};
  FrameSlots slots(Given(EffectTarget::kLidar, "{clock_drift: {drift_ppm: -100}}"), 1, "m/l");
  slots.Apply(0, slots.Stamp(0, 0), &scan);
  EXPECT_EQ(scan.points[0].time_offset_ns, 49'995'000u);
}

TEST(SensorTiming, WhatIsStampedWhereItArrivesIsLateByItsWay) {
  const Stamps stamps = StampsOf("{latency: {delay_s: 0.12}}", {0, kSecond});
  for (const auto& written : stamps.written) {
    EXPECT_EQ(written, (std::vector<TimeNs>{120'000'000, 1'120'000'000}));
  }
  for (const auto& available : stamps.available) EXPECT_EQ(available[1], 1'150'000'000);
}

TEST(SensorTiming, JitterIsExponentialAndKeepsTheOrder) {
  std::vector<TimeNs> slow, fast;
  for (int k = 0; k < 10000; ++k) {
    slow.push_back(k * 10 * kSecond);
    fast.push_back(TimeNs{k} * 1'000'000);
  }
  const std::string effects = "{latency: {delay_s: 0.1, jitter_s: 0.02}}";
  for (const auto& written : StampsOf(effects, slow).written) {
    double sum_s = 0;
    int beyond_mean = 0;
    for (std::size_t k = 0; k < slow.size(); ++k) {
      const double late_s = ToSeconds(written[k] - slow[k]) - 0.1;
      EXPECT_GE(late_s, 0);
      sum_s += late_s;
      beyond_mean += late_s > 0.02;
    }
    // Standard error of the mean 0.02 / sqrt(10000); of the share 1 / e, 0.0048. Five of each.
    EXPECT_NEAR(sum_s / 10000, 0.02, 0.001);
    EXPECT_NEAR(beyond_mean / 10000.0, 0.3679, 0.0241);
  }
  // At 1 kHz most samples would overtake each other.
  for (const auto& written : StampsOf(effects, fast).written) {
    for (std::size_t k = 1; k < written.size(); ++k) ASSERT_GT(written[k], written[k - 1]) << k;
  }
}

/// Input and output of a filter of 0.1 s in each sensor, at 1 kHz.
struct Filtered {
  double x, imu, gnss, encoder;
};

template <typename Signal>
std::vector<Filtered> FilterOf(Signal signal, int samples) {
  const std::string effects = "{filter_delay: {time_constant_s: 0.1}}";
  ImuSlots imu(Given(EffectTarget::kImu, effects), 1, "m/imu");
  GnssSlots gnss(Given(EffectTarget::kGnss, effects), 1, "m/gnss");
  EncoderSlots encoder(Given(EffectTarget::kEncoder, effects), {}, {false}, {"boom"}, 1, "m/e");
  std::vector<Filtered> filtered;
  for (int k = 0; k < samples; ++k) {
    const TimeNs t_ns = TimeNs{k} * 1'000'000;
    const double x = signal(ToSeconds(t_ns));
    ImuSample i{t_ns, t_ns, Vec3(0, x, 0), Vec3(0, 0, -x)};
    GnssSample g;
    g.t_ns = t_ns;
    g.enu_m = {0, x, 0};
    g.fix = GnssFix::kRtkFixed;
    EncoderSample e{t_ns, t_ns, {x}, {3 * x}};
    imu.Apply(&i);
    gnss.Apply({}, kSensorTimingSite, &g);
    encoder.Apply(&e);
    EXPECT_NEAR(-i.f_S_mps2.z(), i.w_WS_S_radps.y(), 1e-12);
    EXPECT_NEAR(e.qd_radps[0], 3 * e.q_rad[0], 1e-12);
    EXPECT_NEAR(kSensorTimingSite.ToGeodetic(g.enu_m).lat_deg, g.lat_deg, 1e-12);
    EXPECT_EQ(i.t_ns, t_ns);
    filtered.push_back({x, i.w_WS_S_radps.y(), g.enu_m.y(), e.q_rad[0]});
  }
  return filtered;
}

TEST(SensorTiming, AFilterAnswersAStepWithItsTimeConstant) {
  const auto filtered = FilterOf([](double t_s) { return t_s > 0.0005 ? 1.0 : 0.0; }, 400);
  EXPECT_EQ(filtered[0].imu, 0);
  for (const double y : {filtered[100].imu, filtered[100].gnss, filtered[100].encoder}) {
    EXPECT_NEAR(y, 0.6321206, 1e-6);  // 1 - 1/e after 0.1 s
  }
  EXPECT_NEAR(filtered[300].imu, 0.9502129, 1e-6);
}

TEST(SensorTiming, AFilterIsLateOnARampByItsTimeConstantLessHalfASample) {
  const auto filtered = FilterOf([](double t_s) { return 2 + 7 * t_s; }, 3000);
  const Filtered& last = filtered.back();
  for (const double y : {last.imu, last.gnss, last.encoder}) {
    EXPECT_NEAR((last.x - y) / 7, 0.1 - 0.0005, 1e-6);
  }
}

TEST(SensorTiming, AFilterHalvesThePowerAtItsCornerAndTurnsThePhaseByAnEighth) {
  const double w_radps = 1 / 0.1;
  const auto filtered = FilterOf([&](double t_s) { return std::sin(w_radps * t_s); }, 3 * 628 + 1);
  // Over the last period: amplitudes in phase and in quadrature.
  double in_phase = 0, quadrature = 0;
  for (int k = 2 * 628; k < 3 * 628; ++k) {
    in_phase += filtered[k].imu * std::sin(w_radps * 0.001 * k) * 2 / 628;
    quadrature += filtered[k].imu * std::cos(w_radps * 0.001 * k) * 2 / 628;
  }
  EXPECT_NEAR(std::hypot(in_phase, quadrature), std::sqrt(0.5), 0.005);
  EXPECT_NEAR(std::atan2(-quadrature, in_phase), 45 * kDeg, 0.01);
}

/// Response of each sensor with a filter of 0.1 s and `more` to a pulse of 10 (rad, rad/s, m,
/// m/s^2) over the second of samples 0.1 s apart. The filter leaves 10 (1 - 1/e) = 6.321, then
/// 2.325, 0.855, 0.315.
struct Pulse {
  std::vector<double> gyro, east, angle, rate;
};

Pulse PulseThrough(const std::string& of_imu, const std::string& of_gnss,
                   const std::string& of_encoder) {
  const auto with = [](const std::string& more) {
    return "{filter_delay: {time_constant_s: 0.1}" + (more.empty() ? "" : ", " + more) + "}";
  };
  ImuSlots imu(Given(EffectTarget::kImu, with(of_imu)), 1, "m/imu");
  GnssSlots gnss(Given(EffectTarget::kGnss, with(of_gnss)), 1, "m/gnss");
  EncoderSlots encoder(Given(EffectTarget::kEncoder, with(of_encoder)), {}, {false}, {"boom"}, 1,
                       "m/e");
  Pulse pulse;
  for (int k = 0; k < 5; ++k) {
    const TimeNs t_ns = TimeNs{k} * 100'000'000;
    const double x = k == 1 ? 10 : 0;
    ImuSample i{t_ns, t_ns, Vec3(0, x, 0), Vec3::Zero()};
    GnssSample g;
    g.t_ns = t_ns;
    g.enu_m = {x, 0, 0};
    g.fix = GnssFix::kRtkFixed;
    EncoderSample e{t_ns, t_ns, {x}, {x}};
    imu.Apply(&i);
    gnss.Apply({}, kSensorTimingSite, &g);
    encoder.Apply(&e);
    pulse.gyro.push_back(i.w_WS_S_radps.y());
    pulse.east.push_back(g.enu_m.x());
    pulse.angle.push_back(e.q_rad[0]);
    pulse.rate.push_back(e.qd_radps[0]);
  }
  return pulse;
}

void ExpectAll(const std::vector<double>& found, const std::vector<double>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], wanted[k], 1e-3) << k;
}

TEST(SensorTiming, WhatTheFilterLeavesIsWhatSaturates) {
  // 286.479 deg are 5 rad: the pulse would be clipped to 5 before a filter, 3.161 behind it.
  const Pulse pulse =
      PulseThrough("saturation: {gyro_limit_degps: 286.479}", "",
                   "saturation: {angle_limit_deg: 286.479, rate_limit_degps: 286.479}");
  const std::vector<double> clipped = {0, 5, 2.325, 0.855, 0.315};
  ExpectAll(pulse.gyro, clipped);
  ExpectAll(pulse.angle, clipped);
  ExpectAll(pulse.rate, clipped);
}

TEST(SensorTiming, WhatTheFilterLeavesIsWhatIsRounded) {
  // 5.72958 deg are 0.1 rad, a step that a filter behind it would smear.
  const Pulse pulse = PulseThrough("quantisation: {gyro_step_degps: 5.72958}",
                                   "quantisation: {horizontal_step_m: 0.1}",
                                   "quantisation: {angle_step_deg: 5.72958, "
                                   "rate_step_degps: 5.72958}");
  const std::vector<double> rounded = {0, 6.3, 2.3, 0.9, 0.3};
  for (const auto& found : {pulse.gyro, pulse.east, pulse.angle, pulse.rate}) {
    ExpectAll(found, rounded);
  }
}

TEST(SensorTiming, AnOutlierStaysOneSampleBehindAFilter) {
  EncoderSlots encoder(
      Given(EffectTarget::kEncoder,
            "{filter_delay: {time_constant_s: 0.1}, outliers: {probability: 0.2}}"),
      {}, {false}, {"boom"}, 1, "m/e");
  int wild = 0;
  for (int k = 0; k < 1000; ++k) {
    EncoderSample e{TimeNs{k} * 10'000'000, 0, {1}, {0}};
    encoder.Apply(&e);
    wild += e.q_rad[0] != 1;
  }
  // Five standard errors: 5 sqrt(0.2 * 0.8 / 1000) = 0.063. A later filter would smear all.
  EXPECT_NEAR(wild / 1000.0, 0.2, 0.063);
}

}  // namespace
}  // namespace tera
