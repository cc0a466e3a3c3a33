#include "sensors/inclinometer/inclinometer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "dataset/format/recording.h"
#include "dataset/format/writer.h"
#include "own_folder.h"
#include "sensors/driven_sensor.h"
#include "sensors/sensor_mechanisms.h"
#include "sensors/slots/given_effects.h"

// Readings of an inclinometer on a link, from its keys to its rows.

namespace tera {
namespace {

using testing::Given;
using testing::RowsOf;
using testing::SensorOf;

/// Tilted by 25 deg about y of the link, so that the link's x points down, on a link at yaw 70 deg.
constexpr double kLean_deg = 25, kYaw_deg = 70;
const std::string kKeys = "type: inclinometer, link: upper, xyz_m: [1, 0.5, 2], rate_hz: 100";

BodyState Leaning(double pitch_deg) {
  BodyState body;
  body.X_WB = MakePose({4, -3, 2}, 0, pitch_deg * kDeg, kYaw_deg * kDeg);
  return body;
}

std::vector<InclinometerSample> Samples(const std::string& keys,
                                        const std::function<BodyState(double)>& motion,
                                        double duration_s, const Effects& effects = {}) {
  SensorDescription sensor = SensorOf(kKeys + keys);
  sensor.effects = effects;
  std::vector<InclinometerSample> samples;
  for (const RowSample& row : RowsOf(sensor, motion, duration_s)) {
    samples.push_back({row.t_ns, row.t_available_ns, row.values.at(0), row.values.at(1)});
  }
  return samples;
}

TEST(Inclinometer, ALinkAtRestReadsHowFarItsXAxisPointsDown) {
  for (const double lean_deg : {kLean_deg, -140.0}) {
    const auto samples = Samples(
        "", [&](double) { return Leaning(lean_deg); }, 0.1);
    ASSERT_EQ(samples.size(), 10u);
    EXPECT_EQ(samples.front().t_ns, 10'000'000);
    for (const InclinometerSample& sample : samples) {
      EXPECT_NEAR(sample.tilt_rad, lean_deg * kDeg, 1e-9);
      EXPECT_NEAR(sample.tilt_radps, 0, 1e-9);
    }
  }
}

TEST(Inclinometer, ItsOwnMountingAddsToTheTiltOfTheLink) {
  const auto samples = Samples(
      ", rpy_deg: [0, 10, 0]", [](double) { return Leaning(kLean_deg); }, 0.05);
  EXPECT_NEAR(samples.back().tilt_rad, (kLean_deg + 10) * kDeg, 1e-9);
}

TEST(Inclinometer, MisalignedByItsEffectItReadsTheTrueMount) {
  const auto samples = Samples(
      "", [](double) { return Leaning(kLean_deg); }, 0.05,
      Given(kInclinometerTarget, "{mount_rotation: {pitch_deg: -3}}"));
  EXPECT_NEAR(samples.back().tilt_rad, (kLean_deg - 3) * kDeg, 1e-9);
}

TEST(Inclinometer, AStepOfTiltArrivesByTwoThirdsAfterTheTimeConstant) {
  // The link jumps by 2 deg at 0.5 s, about the sensor itself, within one step of 1 ms. The jump's
  // own accelerations cancel, for the sensor sits in the axis: its place on the link is 0.
  const double tau_s = 0.2, step_deg = 2;
  SensorDescription sensor = SensorOf(
      "type: inclinometer, link: upper, rate_hz: 1000, time_constant_s: " + std::to_string(tau_s));
  const auto motion = [&](double t_s) { return Leaning(kLean_deg + (t_s > 0.5 ? step_deg : 0.0)); };
  for (const RowSample& row : RowsOf(sensor, motion, 1.5)) {
    const double t_s = ToSeconds(row.t_ns) - 0.5;
    const double lag = t_s < 0.001 ? 1 : std::exp(-t_s / tau_s);
    // A sample of 1 ms shifts the exponential by 1/200 of its height; the tolerance is two.
    EXPECT_NEAR(row.values[0], (kLean_deg + step_deg * (1 - lag)) * kDeg, 0.01 * step_deg * kDeg)
        << t_s;
  }
}

TEST(Inclinometer, ALinkThatSpeedsUpReadsTheTiltOfItsApparentPlumbLine) {
  // Level, 2 m/s^2 along its own x: the plumb line hangs back by atan(2 / g).
  const auto samples = Samples(
      "",
      [](double t_s) {
        BodyState body = Leaning(0);
        body.X_WB.translation() += body.X_WB.linear() * Vec3(t_s * t_s, 0, 0);
        body.v_WB_mps = body.X_WB.linear() * Vec3(2 * t_s, 0, 0);
        return body;
      },
      0.5);
  EXPECT_NEAR(samples.back().tilt_rad, -std::atan(2 / kStandardGravity_mps2), 1e-6);
}

TEST(Inclinometer, OnATurntableTheCentripetalAccelerationReadsAsTilt) {
  // 1 rad/s about the vertical, the sensor 1 m ahead of the axis: 1 m/s^2 towards it, along -x.
  const SensorDescription sensor =
      SensorOf("type: inclinometer, link: upper, xyz_m: [1, 0, 2], rate_hz: 100");
  const auto rows = RowsOf(
      sensor,
      [](double t_s) {
        BodyState body;
        body.X_WB = MakePose({4, -3, 2}, 0, 0, t_s);
        body.w_WB_radps = Vec3::UnitZ();
        return body;
      },
      0.5);
  EXPECT_NEAR(rows.back().values[0], std::atan(1 / kStandardGravity_mps2), 1e-4);
}

TEST(Inclinometer, TheRateIsThatAboutItsOwnYAxis) {
  const auto samples = Samples(
      ", rate_bias_degps: 0.5", [](double t_s) { return Leaning(10 * t_s); }, 0.3);
  EXPECT_NEAR(samples.back().tilt_radps, 10.5 * kDeg, 1e-9);
}

TEST(Inclinometer, NoiseHasTheStatedDeviationsAboutTheBias) {
  // n = 2000: the mean lies within 5 sigma / sqrt(n), the deviation within 5 / sqrt(2 n) of itself.
  const double n = 2000;
  const auto samples = Samples(
      ", bias_deg: 0.3, noise_deg: 0.05, rate_noise_degps: 0.2",
      [](double) { return Leaning(kLean_deg); }, n / 100);
  ASSERT_EQ(samples.size(), static_cast<std::size_t>(n));
  double sum = 0, squares = 0, rate_squares = 0;
  for (const InclinometerSample& sample : samples) {
    const double error_deg = sample.tilt_rad / kDeg - kLean_deg - 0.3;
    sum += error_deg;
    squares += error_deg * error_deg;
    rate_squares += sample.tilt_radps * sample.tilt_radps / (kDeg * kDeg);
  }
  EXPECT_NEAR(sum / n, 0, 5 * 0.05 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.05, 0.05 * 5 / std::sqrt(2 * n));
  EXPECT_NEAR(std::sqrt(rate_squares / n), 0.2, 0.2 * 5 / std::sqrt(2 * n));
}

TEST(Inclinometer, VibrationShakesTheTiltLessBehindItsFilterAndShiftsItByItsSquare) {
  // Level. Noise of rms a along x is a / g of tilt; after a first-order filter over samples T apart
  // it is sqrt(c / (2 - c)) of that, c = 1 - e^(-T / tau). The shift is k a^2 / g.
  const double n = 4000, rms_mps2 = 0.5, k_s2pm = 0.5, tau_s = 0.05;
  const auto samples = Samples(
      ", vibration_rms_mps2: 0.5, vibration_rectification_s2pm: 0.5, time_constant_s: 0.05",
      [](double) { return Leaning(0); }, n / 100);
  double sum = 0, squares = 0;
  const std::size_t settled = 100;  // 20 time constants
  for (std::size_t i = settled; i < samples.size(); ++i) sum += samples[i].tilt_rad;
  const double count = n - static_cast<double>(settled), mean_rad = sum / count;
  for (std::size_t i = settled; i < samples.size(); ++i) {
    squares += std::pow(samples[i].tilt_rad - mean_rad, 2);
  }
  const double c = 1 - std::exp(-0.01 / tau_s);
  const double sigma_rad = rms_mps2 / kStandardGravity_mps2 * std::sqrt(c / (2 - c));
  // Neighbours are correlated: (2 - c) / c samples count as one.
  const double alone = count * c / (2 - c);
  EXPECT_NEAR(mean_rad, -k_s2pm * rms_mps2 * rms_mps2 / kStandardGravity_mps2,
              5 * sigma_rad / std::sqrt(alone));
  EXPECT_NEAR(std::sqrt(squares / count), sigma_rad, 5 * sigma_rad / std::sqrt(2 * alone));
}

TEST(Inclinometer, TheTiltIsAMultipleOfTheResolution) {
  const auto samples = Samples(
      ", resolution_deg: 2, noise_deg: 3", [](double) { return Leaning(kLean_deg); }, 0.5);
  for (const InclinometerSample& sample : samples) {
    const double steps = sample.tilt_rad / (2 * kDeg);
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
}

TEST(Inclinometer, ThePresetIsWholeAndItsModelReadsBackToTheSame) {
  const SensorDescription sensor =
      SensorOf("link: upper, preset: 'tera:config/sensors/inclinometer.yaml'");
  EXPECT_EQ(TypeOf(sensor), "inclinometer");
  EXPECT_EQ(sensor.latency_ns, 10'000'000);
  const std::string text = SensorYaml(sensor);
  EXPECT_THAT(text, ::testing::HasSubstr("parent_link: upper\n"));
  const Config config = Config::FromText(text, "sensor.yaml");
  SensorDescription again = sensor;
  KindOf(sensor).read(config.root().Map("model"), &again);
  EXPECT_EQ(SensorYaml(again), text);
}

TEST(Inclinometer, ItsRowsAreReadBackFromADataset) {
  const SensorDescription sensor = SensorOf(kKeys + ", noise_deg: 0.1");
  const auto rows = RowsOf(
      sensor, [](double) { return Leaning(kLean_deg); }, 0.1);
  DatasetInfo info;
  info.scenario_name = "tilt";
  DatasetWriter writer(OwnFolder() / "run", info, {});
  const ChannelId channel = writer.AddChannel(
      {"m/tilt", TypeOf(sensor), KindOf(sensor).form, SensorYaml(sensor), ColumnsOf(sensor, {})});
  for (const RowSample& row : rows) writer.Write(channel, row);
  writer.Finish();
  const Recording recording(OwnFolder() / "run");
  ASSERT_THAT(recording.ChannelsOf("inclinometer"), ::testing::ElementsAre("m/tilt"));
  const TableRecording read = recording.LoadRows("m/tilt");
  EXPECT_THAT(read.columns, ::testing::ElementsAre("tilt_rad", "tilt_radps"));
  ASSERT_EQ(read.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(read.t_ns[i], rows[i].t_ns);
    EXPECT_EQ(read.rows[i], rows[i].values);
  }
}

TEST(Inclinometer, EachKeyChangesItsRows) {
  const auto rows_of = [](const std::string& keys) {
    std::vector<std::vector<double>> rows;
    const SensorDescription sensor = SensorOf(kKeys + keys);
    for (const RowSample& row : RowsOf(
             sensor, [](double t_s) { return Leaning(40 * t_s * t_s); }, 0.2)) {
      rows.push_back(row.values);
    }
    return rows;
  };
  const std::string vibrates = ", vibration_rms_mps2: 1";
  const auto plain = rows_of(""), shaken = rows_of(vibrates);
  for (const char* change :
       {", time_constant_s: 0.05", ", bias_deg: 0.1", ", noise_deg: 0.1", ", resolution_deg: 1",
        ", rate_bias_degps: 1", ", rate_noise_degps: 1", ", vibration_rms_mps2: 1"}) {
    EXPECT_NE(plain, rows_of(change)) << change;
  }
  EXPECT_NE(shaken, rows_of(vibrates + ", vibration_rectification_s2pm: 0.01"));
}

}  // namespace
}  // namespace tera
