#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "sensors/slots/given_effects.h"
#include "sensors/slots/sensor_slots.h"

namespace tera {
namespace {

using testing::Given;

constexpr double kG_mps2 = 9.80665;

void ExpectNear(const Vec3& found, const Vec3& wanted, double tolerance) {
  EXPECT_LT((found - wanted).norm(), tolerance)
      << "found " << found.transpose() << ", wanted " << wanted.transpose();
}

ImuSlots ImuWith(const std::string& effects) {
  return ImuSlots(Given(EffectTarget::kImu, effects), 3, "m/imu");
}

ImuSample Reported(ImuSlots slots, const Vec3& w_degps, const Vec3& f_mps2, double t_s = 0) {
  ImuSample sample{FromSeconds(t_s), 0, w_degps * kDeg, f_mps2};
  slots.Apply(&sample);
  sample.w_WS_S_radps /= kDeg;
  return sample;
}

TEST(StaticErrors, AnImusScaleComesBeforeItsBias) {
  const ImuSample sample = Reported(
      ImuWith("{scale: {gyro_z_factor: 1.1, accel_x_factor: 0.5}, "
              "bias: {gyro_z_degps: 0.5, gyro_x_degps: -2, accel_x_mps2: 0.25, accel_z_mps2: 1}}"),
      {1, 2, 10}, {4, 5, 6});
  ExpectNear(sample.w_WS_S_radps, {-1, 2, 11.5}, 1e-9);
  ExpectNear(sample.f_S_mps2, {2.25, 5, 7}, 1e-12);
}

TEST(StaticErrors, AnImuSaturatesAtItsLimitsOnBothSides) {
  const ImuSlots slots = ImuWith("{saturation: {gyro_limit_degps: 250, accel_limit_mps2: 20}}");
  const ImuSample sample = Reported(slots, {249, -300, 1000}, {-25, 19.5, 21});
  ExpectNear(sample.w_WS_S_radps, {249, -250, 250}, 1e-9);
  ExpectNear(sample.f_S_mps2, {-20, 19.5, 20}, 1e-12);
  // Without numbers of its own a chip of 2000 deg/s and 16 g.
  const ImuSample usual = Reported(ImuWith("{saturation: {}}"), {2500, 0, 0}, {0, 0, 500});
  EXPECT_NEAR(usual.w_WS_S_radps.x(), 2000, 1e-9);
  EXPECT_NEAR(usual.f_S_mps2.z(), 16 * kG_mps2, 1e-9);
}

TEST(StaticErrors, AnImuSaturatesBehindItsBiasAndRoundsAfterwards) {
  const ImuSample sample =
      Reported(ImuWith("{bias: {accel_z_mps2: 3}, saturation: {accel_limit_mps2: 10.2}, "
                       "quantisation: {accel_step_mps2: 0.5, gyro_step_degps: 0.25}}"),
               {0.1, 0.13, -0.4}, {0.2, -0.3, 9});
  ExpectNear(sample.f_S_mps2, {0, -0.5, 10}, 1e-12);
  ExpectNear(sample.w_WS_S_radps, {0, 0.25, -0.5}, 1e-9);
}

TEST(StaticErrors, OutliersOfAnImuComeAsOftenAndAsLargeAsSaid) {
  ImuSlots slots = ImuWith("{outliers: {probability: 0.1, gyro_degps: 40, accel_mps2: 5}}");
  const int n = 20000;
  int wild = 0;
  double gyro_squares = 0, accel_squares = 0;
  for (int k = 0; k < n; ++k) {
    ImuSample sample{TimeNs{k} * 10'000'000, 0, Vec3(1, 0, 0), Vec3(0, 0, 9)};
    slots.Apply(&sample);
    const Vec3 w_degps = (sample.w_WS_S_radps - Vec3(1, 0, 0)) / kDeg;
    if (w_degps.norm() == 0) continue;
    ++wild;
    gyro_squares += w_degps.squaredNorm() / 3;
    accel_squares += (sample.f_S_mps2 - Vec3(0, 0, 9)).squaredNorm() / 3;
  }
  // Standard error of a share: sqrt(0.1 * 0.9 / 20000) = 0.0021; five of them.
  EXPECT_NEAR(static_cast<double>(wild) / n, 0.1, 0.0106);
  // Of an rms over 3 * 2000 draws: 1 / sqrt(2 * 6000) = 0.9 %; five of them.
  EXPECT_NEAR(std::sqrt(gyro_squares / wild), 40, 40 * 0.046);
  EXPECT_NEAR(std::sqrt(accel_squares / wild), 5, 5 * 0.046);
}

TEST(StaticErrors, AnImuThatWarmsUpDriftsAtFirstBySlopeAndThenSettles) {
  const ImuSlots slots = ImuWith(
      "{temperature_drift: {warm_up_k: 30, time_constant_s: 600, gyro_x_degpspk: 0.02, "
      "accel_z_mps2pk: -0.01}}");
  const auto at = [&](double t_s) { return Reported(slots, {0, 0, 0}, {0, 0, 9}, t_s); };
  EXPECT_EQ(at(0).w_WS_S_radps.x(), 0);
  // 30 K in 600 s are 0.05 K/s at first: 0.001 deg/s every second.
  EXPECT_NEAR(at(1).w_WS_S_radps.x(), 0.001, 1e-6);
  EXPECT_NEAR(at(600).w_WS_S_radps.x(), 0.6 * 0.6321206, 1e-6);
  EXPECT_NEAR(at(60000).w_WS_S_radps.x(), 0.6, 1e-9);
  EXPECT_NEAR(at(60000).f_S_mps2.z(), 8.7, 1e-9);
}

TEST(StaticErrors, AVibratingAccelerometerShiftsByTheVarianceOfWhatItFeels) {
  ImuSlots slots = ImuWith(
      "{vibration_rectification: {z_s2pm: 0.01, x_s2pm: -0.002, engine_rms_mps2: 3, window_s: 5}}");
  Vec3 shift = Vec3::Zero();
  for (int k = 0; k < 60000; ++k) {
    // 4 m/s^2 at 50 Hz: a variance of 8 m^2/s^4 beside the engine's 9.
    const Vec3 f_mps2(0, 0, 9 + 4 * std::sin(2 * kPi * 50 * 0.001 * k));
    ImuSample sample{TimeNs{k} * 1'000'000, 0, Vec3::Zero(), f_mps2};
    slots.Apply(&sample);
    shift = sample.f_S_mps2 - f_mps2;
    if (k == 0) {
      EXPECT_NEAR(shift.z(), 0.09, 1e-12);
    }
  }
  EXPECT_NEAR(shift.z(), 0.17, 0.002);
  EXPECT_NEAR(shift.x(), -0.034, 0.0004);
}

const SiteFrame kSite(46.78, -71.27, 90);

GnssSample FixAt(const Vec3& enu_m, double t_s = 0) {
  const SiteFrame::Geodetic place = kSite.ToGeodetic(enu_m);
  return {FromSeconds(t_s), 0,     place.lat_deg,      place.lon_deg,
          place.height_m,   enu_m, GnssFix::kRtkFixed, Vec3(1e-4, 1e-4, 4e-4)};
}

GnssSample FixReported(const std::string& effects, const Vec3& enu_m,
                       const BoomAndSlew& angles = {}) {
  GnssSlots slots(Given(EffectTarget::kGnss, effects), 3, "m/gnss");
  GnssSample sample = FixAt(enu_m);
  slots.Apply(angles, kSite, &sample);
  return sample;
}

TEST(StaticErrors, AHeightOverTheGeoidLeavesThePlaceAlone) {
  const GnssSample plain = FixAt({3, 4, 5});
  const GnssSample sample = FixReported("{height_datum: {offset_m: 28.5}}", {3, 4, 5});
  EXPECT_NEAR(sample.alt_m - plain.alt_m, 28.5, 1e-6);
  EXPECT_NEAR(sample.lat_deg, plain.lat_deg, 1e-9);
  ExpectNear(sample.enu_m, {3, 4, 33.5}, 1e-12);
}

TEST(StaticErrors, AWrongDatumShiftsLatitudeAndLongitudeByItsMetres) {
  const GnssSample plain = FixAt({3, 4, 5});
  const GnssSample sample = FixReported("{position_datum: {east_m: 10, north_m: -20}}", {3, 4, 5});
  ExpectNear(sample.enu_m, {13, -16, 5}, 1e-12);
  // WGS 84 at 46.78 deg: a degree is 111.17 km north, 76.37 km east (curvature radii 6369.4 km and
  // 6389.5 km cos 46.78).
  EXPECT_NEAR((sample.lat_deg - plain.lat_deg) * 111'170, -20, 0.02);
  EXPECT_NEAR((sample.lon_deg - plain.lon_deg) * 76'370, 10, 0.02);
}

TEST(StaticErrors, AReceiversQuantisationIsThatOfItsSteps) {
  const GnssSample sample = FixReported(
      "{quantisation: {horizontal_step_m: 0.25, vertical_step_m: 0.1}}", {1.3, -2.9, 0.449});
  ExpectNear(sample.enu_m, {1.25, -3, 0.4}, 1e-12);
  ExpectNear(kSite.ToEnu({sample.lat_deg, sample.lon_deg, sample.alt_m}), {1.25, -3, 0.4}, 1e-7);
}

TEST(StaticErrors, OutliersOfAReceiverComeAsOftenAndAsLargeAsSaid) {
  GnssSlots slots(
      Given(EffectTarget::kGnss, "{outliers: {probability: 0.25, horizontal_m: 2, vertical_m: 6}}"),
      3, "m/gnss");
  const int n = 10000;
  int wild = 0;
  double east_squares = 0, up_squares = 0;
  for (int k = 0; k < n; ++k) {
    GnssSample sample = FixAt({1, 2, 3}, 0.1 * k);
    slots.Apply({}, kSite, &sample);
    const Vec3 error_m = sample.enu_m - Vec3(1, 2, 3);
    if (error_m.norm() == 0) continue;
    ++wild;
    east_squares += error_m.x() * error_m.x();
    up_squares += error_m.z() * error_m.z();
  }
  // Five standard errors: 5 sqrt(0.25 * 0.75 / 10000); 5 / sqrt(2 * 2500).
  EXPECT_NEAR(static_cast<double>(wild) / n, 0.25, 0.0217);
  EXPECT_NEAR(std::sqrt(east_squares / wild), 2, 2 * 0.0707);
  EXPECT_NEAR(std::sqrt(up_squares / wild), 6, 6 * 0.0707);
}

TEST(StaticErrors, MultipathTurnsWithTheSlewAndGrowsAsTheBoomRises) {
  const std::string effects =
      "{multipath: {horizontal_m: 0.04, vertical_m: 0.1, slew_phase_deg: 20}}";
  const auto error = [&](double boom_deg, double slew_deg) {
    return Vec3(FixReported(effects, {1, 2, 3}, {boom_deg * kDeg, slew_deg * kDeg}).enu_m -
                Vec3(1, 2, 3));
  };
  ExpectNear(error(30, 20), {0.02, 0, 0.05}, 1e-12);  // sin 30 = 1/2, at the maximum
  ExpectNear(error(30, 110), {0, 0.02, 0}, 1e-12);    // a quarter turn on
  ExpectNear(error(30, 200), {-0.02, 0, -0.05}, 1e-12);
  ExpectNear(error(90, 20), {0.04, 0, 0.1}, 1e-12);
  ExpectNear(error(-10, 20), {0, 0, 0}, 1e-12);  // lowered below the horizon
}

TEST(StaticErrors, FloatSolutionsTakeTheirShareOfTimeAndSaySo) {
  GnssSlots slots(Given(EffectTarget::kGnss,
                        "{float_jump: {interval_s: 20, duration_s: 5, "
                        "horizontal_m: 0.3, vertical_m: 0.6}}"),
                  3, "m/gnss");
  const int n = 200000;
  int floating = 0, episodes = 0;
  double east_squares = 0, up_squares = 0;
  Vec3 last_m(0, 0, 0);
  for (int k = 0; k < n; ++k) {
    GnssSample sample = FixAt({1, 2, 3}, 0.1 * k);
    slots.Apply({}, kSite, &sample);
    const Vec3 error_m = sample.enu_m - Vec3(1, 2, 3);
    EXPECT_EQ(sample.fix == GnssFix::kRtkFloat, error_m.norm() > 0);
    if (error_m.norm() > 0) {
      ++floating;
      EXPECT_NEAR(sample.variance_enu_m2.x(), 0.0901, 1e-12);
      if (last_m.norm() == 0) {
        ++episodes;
        east_squares += error_m.x() * error_m.x();
        up_squares += error_m.z() * error_m.z();
      } else {
        ExpectNear(error_m, last_m, 1e-12);  // one place for the whole episode
      }
    }
    last_m = error_m;
  }
  // Share 5 / 25 over 20 000 s with a correlation time of 1 / (1/20 + 1/5) = 4 s: standard error
  // sqrt(0.2 * 0.8 * 2 * 4 / 20000) = 0.008. About 800 episodes: 5 / sqrt(2 * 800) = 12.5 %.
  EXPECT_NEAR(static_cast<double>(floating) / n, 0.2, 0.04);
  EXPECT_NEAR(std::sqrt(east_squares / episodes), 0.3, 0.3 * 0.125);
  EXPECT_NEAR(std::sqrt(up_squares / episodes), 0.6, 0.6 * 0.125);
}

TEST(StaticErrors, AReceiverWithoutCarrierPhaseHasNoFixedSolutionToLose) {
  GnssSlots slots(Given(EffectTarget::kGnss, "{float_jump: {interval_s: 0.1}}"), 3, "m/gnss");
  for (int k = 0; k < 50; ++k) {
    GnssSample sample = FixAt({1, 2, 3}, 0.1 * k);
    sample.fix = GnssFix::kSingle;
    slots.Apply({}, kSite, &sample);
    EXPECT_EQ(sample.fix, GnssFix::kSingle);
    EXPECT_EQ(sample.enu_m, Vec3(1, 2, 3));
  }
}

TEST(StaticErrors, AReceiverWithoutAFixHasNothingToSpoil) {
  GnssSlots slots(Given(EffectTarget::kGnss,
                        "{position_datum: {east_m: 10}, float_jump: {interval_s: 0.1}, "
                        "filter_delay: {time_constant_s: 1}}"),
                  3, "m/gnss");
  for (int k = 0; k < 20; ++k) {
    GnssSample sample;
    sample.t_ns = TimeNs{k} * 100'000'000;
    slots.Apply({}, kSite, &sample);
    EXPECT_EQ(sample.fix, GnssFix::kNone);
    EXPECT_EQ(sample.enu_m, Vec3::Zero());
    EXPECT_EQ(sample.lat_deg, 0);
  }
}

/// A boom that turns and a stick that slides.
EncoderSample AxesReported(const std::string& effects, std::vector<double> q,
                           std::vector<double> qd, double t_s = 0,
                           const std::string& of_stick = "{}") {
  EncoderSlots slots(Given(EffectTarget::kEncoder, effects),
                     {{}, Given(EffectTarget::kEncoderAxis, of_stick)}, {false, true},
                     {"boom", "stick"}, 3, "m/e");
  EncoderSample sample{FromSeconds(t_s), 0, std::move(q), std::move(qd)};
  slots.Apply(&sample);
  return sample;
}

TEST(StaticErrors, OfEncodersTakeDegreesForAnglesAndMetresForTravel) {
  EncoderSample sample = AxesReported(
      "{bias: {angle_deg: 90, rate_degps: 180, travel_m: 0.5, "
      "speed_mps: -1}}",
      {1, 1}, {1, 1});
  EXPECT_NEAR(sample.q_rad[0], 1 + kPi / 2, 1e-12);
  EXPECT_NEAR(sample.q_rad[1], 1.5, 1e-12);
  EXPECT_NEAR(sample.qd_radps[0], 1 + kPi, 1e-12);
  EXPECT_NEAR(sample.qd_radps[1], 0, 1e-12);

  sample = AxesReported(
      "{saturation: {angle_limit_deg: 90, rate_limit_degps: 180, travel_limit_m: 2, "
      "speed_limit_mps: 0.5}}",
      {-7, 7}, {-7, -7});
  EXPECT_NEAR(sample.q_rad[0], -kPi / 2, 1e-12);
  EXPECT_NEAR(sample.q_rad[1], 2, 1e-12);
  EXPECT_NEAR(sample.qd_radps[0], -kPi, 1e-12);
  EXPECT_NEAR(sample.qd_radps[1], -0.5, 1e-12);

  sample = AxesReported(
      "{quantisation: {angle_step_deg: 45, rate_step_degps: 90, travel_step_m: 0.25, "
      "speed_step_mps: 0.1}}",
      {1.6, 0.9}, {-1.5, 0.234});
  EXPECT_NEAR(sample.q_rad[0], kPi / 2, 1e-12);
  EXPECT_NEAR(sample.q_rad[1], 1, 1e-12);
  EXPECT_NEAR(sample.qd_radps[0], -kPi / 2, 1e-12);
  EXPECT_NEAR(sample.qd_radps[1], 0.2, 1e-12);

  sample = AxesReported(
      "{temperature_drift: {warm_up_k: 20, time_constant_s: 100, angle_degpk: 0.05, "
      "travel_mpk: 0.001}}",
      {0, 0}, {0, 0}, 1e5);
  EXPECT_NEAR(sample.q_rad[0], kDeg, 1e-9);
  EXPECT_NEAR(sample.q_rad[1], 0.02, 1e-9);
  sample = AxesReported("{scale: {position_factor: 1.5, rate_factor: 0.5}}", {2, -2}, {2, -2});
  EXPECT_EQ(sample.q_rad, (std::vector<double>{3, -3}));
  EXPECT_EQ(sample.qd_radps, (std::vector<double>{1, -1}));
}

TEST(StaticErrors, OfOneAxisLieOverThoseOfTheWholeSet) {
  const EncoderSample sample = AxesReported("{scale: {position_factor: 1.5}, bias: {travel_m: 1}}",
                                            {2, 2}, {1, 1}, 0, "{scale: {rate_factor: 0.5}}");
  EXPECT_EQ(sample.q_rad, (std::vector<double>{3, 3}));
  EXPECT_EQ(sample.qd_radps, (std::vector<double>{1, 0.5}));
}

TEST(StaticErrors, OutliersOfEncodersComeOnEachAxisByItself) {
  EncoderSlots slots(
      Given(EffectTarget::kEncoder, "{outliers: {probability: 0.2, angle_deg: 10, travel_m: 0.5}}"),
      {}, {false, true}, {"boom", "stick"}, 3, "m/e");
  const int n = 10000;
  int boom = 0, stick = 0, both = 0;
  double boom_squares = 0, stick_squares = 0;
  for (int k = 0; k < n; ++k) {
    EncoderSample sample{TimeNs{k} * 10'000'000, 0, {1, 1}, {0, 0}};
    slots.Apply(&sample);
    const double e = (sample.q_rad[0] - 1) / kDeg, f = sample.q_rad[1] - 1;
    boom += e != 0;
    stick += f != 0;
    both += e != 0 && f != 0;
    boom_squares += e * e;
    stick_squares += f * f;
  }
  // Five standard errors: 5 sqrt(0.2 * 0.8 / 10000), 5 sqrt(0.04 * 0.96 / 10000), 5 / sqrt(4000).
  EXPECT_NEAR(static_cast<double>(boom) / n, 0.2, 0.02);
  EXPECT_NEAR(static_cast<double>(stick) / n, 0.2, 0.02);
  EXPECT_NEAR(static_cast<double>(both) / n, 0.04, 0.01);
  EXPECT_NEAR(std::sqrt(boom_squares / boom), 10, 0.8);
  EXPECT_NEAR(std::sqrt(stick_squares / stick), 0.5, 0.04);
}

LidarScan ScanReported(const std::string& effects, LidarScan scan) {
  FrameSlots slots(Given(EffectTarget::kLidar, effects), 3, "m/lidar");
  slots.Apply(0, slots.Stamp(0, scan.t_ns), &scan);
  return scan;
}

LidarScan Points(double t_s = 0) {
  LidarScan scan;
  scan.t_ns = FromSeconds(t_s);
  scan.points = {{.x_m = 3, .y_m = 4, .z_m = 0}, {.x_m = 0, .y_m = 0, .z_m = -2}};  // 5 m and 2 m
  return scan;
}

void ExpectPoint(const LidarPoint& p, const Vec3& wanted) {
  ExpectNear({p.x_m, p.y_m, p.z_m}, wanted, 1e-5);
}

TEST(StaticErrors, OfALidarMoveItsPointsAlongTheirBeams) {
  LidarScan scan = ScanReported("{range_bias: {range_m: 0.5}}", Points());
  ExpectPoint(scan.points.at(0), {3.3, 4.4, 0});
  ExpectPoint(scan.points.at(1), {0, 0, -2.5});
  scan = ScanReported("{scale: {range_factor: 1.1}}", Points());
  ExpectPoint(scan.points.at(0), {3.3, 4.4, 0});
  ExpectPoint(scan.points.at(1), {0, 0, -2.2});
  scan = ScanReported("{range_bias: {range_m: 0.3}, quantisation: {range_step_m: 0.5}}", Points());
  ExpectPoint(scan.points.at(0), {3.3, 4.4, 0});
  ExpectPoint(scan.points.at(1), {0, 0, -2.5});
  scan = ScanReported("{temperature_drift: {warm_up_k: -50, time_constant_s: 2, range_mpk: -0.01}}",
                      Points(100));
  ExpectPoint(scan.points.at(0), {3.3, 4.4, 0});
  // What would lie behind the sensor is no return.
  scan = ScanReported("{range_bias: {range_m: -3}}", Points());
  ASSERT_EQ(scan.points.size(), 1u);
  ExpectPoint(scan.points.at(0), {1.2, 1.6, 0});
}

TEST(StaticErrors, OutliersOfALidarComeAsOftenAndAsLargeAsSaid) {
  LidarScan scan;
  scan.points.assign(20000, {.x_m = 0, .y_m = 60, .z_m = 80});  // 100 m
  scan = ScanReported("{outliers: {probability: 0.05, range_m: 4}}", std::move(scan));
  int wild = 0;
  double squares = 0;
  for (const LidarPoint& p : scan.points) {
    if (p.z_m == 80) continue;
    ++wild;
    squares += std::pow(std::hypot(p.y_m, p.z_m) - 100, 2);
  }
  // Five standard errors: 5 sqrt(0.05 * 0.95 / 20000); 5 / sqrt(2 * 1000).
  EXPECT_NEAR(wild / 20000.0, 0.05, 0.0077);
  EXPECT_NEAR(std::sqrt(squares / wild), 4, 4 * 0.112);
}

std::vector<float> DepthReported(const std::string& effects, std::vector<float> depth_m) {
  FrameSlots slots(Given(EffectTarget::kCamera, effects), 3, "m/camera");
  CameraFrame frame;
  frame.depth_m = Image<float>(static_cast<int>(depth_m.size()), 1);
  frame.depth_m.data = std::move(depth_m);
  slots.Apply(0, slots.Stamp(0, 0), &frame);
  return frame.depth_m.data;
}

TEST(StaticErrors, OfACameraChangeItsDepthButNotWhereThereIsNone) {
  using Depths = std::vector<float>;
  EXPECT_EQ(DepthReported("{range_bias: {depth_m: 0.5}}", {0, 2, 4}), (Depths{0, 2.5f, 4.5f}));
  EXPECT_EQ(DepthReported("{scale: {depth_factor: 1.25}}", {0, 2, 4}), (Depths{0, 2.5f, 5}));
  EXPECT_EQ(DepthReported("{quantisation: {depth_step_m: 0.5}}", {0, 2.2f, 4.3f}),
            (Depths{0, 2, 4.5f}));
  EXPECT_EQ(DepthReported("{range_bias: {depth_m: -3}}", {0, 2, 4}), (Depths{0, 0, 1}));
  const Depths wild = DepthReported("{outliers: {probability: 0.1, depth_m: 0.5}}",
                                    std::vector<float>(10000, 100.0f));
  int count = 0;
  double squares = 0;
  for (const float z_m : wild) {
    count += z_m != 100;
    squares += (z_m - 100.0) * (z_m - 100.0);
  }
  EXPECT_NEAR(count / 10000.0, 0.1, 0.015);  // five standard errors
  EXPECT_NEAR(std::sqrt(squares / count), 0.5, 0.5 * 0.112);
}

}  // namespace
}  // namespace tera
