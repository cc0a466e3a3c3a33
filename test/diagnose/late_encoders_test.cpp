#include "diagnose/late_encoders.h"

#include <gtest/gtest.h>

#include "diagnose/sensors/made_recording.h"

namespace tera {
namespace {

constexpr double kLate_s = 0.16;

/// A machine whose joints go as fast as their levers say, at rates of 1 rad/s at full lever.
/// Encoders are stamped late, and levers too where their clock is the same.
struct Driven {
  explicit Driven(bool levers_share_the_clock) : made(Made{.has_poses = false}) {
    const double levers_late_s = levers_share_the_clock ? kLate_s : 0;
    DiagnosisInput& input = made.input;
    input.commands.columns = {"swing", "boom"};
    for (int k = 0; k < 2000; ++k) {
      const double t_s = 0.02 * k;
      input.commands.t_ns.push_back(FromSeconds(t_s + levers_late_s));
      input.commands.rows.push_back(RatesAt(t_s + 0.01));
    }
    for (EncoderSample& sample : made.measured.encoders[0].recording.samples) {
      sample.qd_radps = RatesAt(ToSeconds(sample.t_ns));
      sample.t_ns += FromSeconds(kLate_s);
    }
    made.measured.imus.assign(5, {});
    made.measured.gnss.assign(5, {});
  }
  std::vector<double> RatesAt(double t_s) const {
    const std::vector<double> before = made.Joints(t_s - 1e-3), after = made.Joints(t_s + 1e-3);
    return {(after[0] - before[0]) / 2e-3, (after[1] - before[1]) / 2e-3};
  }
  /// By how much the stamps of the encoders are changed.
  double StampedEarlierBy_s(const SensorDiagnosis& estimate) {
    Measurements measured = made.measured;
    StampEncodersAnew(made.Input(), estimate, {.threads = 1}, &measured);
    const auto first = [](const Measurements& one) {
      return one.encoders[0].recording.samples.front().t_ns;
    };
    return ToSeconds(first(made.measured) - first(measured));
  }

  MadeRecording made;
};

SensorDiagnosis ClockOf(const std::string& target, double offset_s) {
  SensorDiagnosis estimate;
  SensorFinding found;
  found.target = target;
  found.mechanism = "clock_offset";
  found.numbers = {{"offset_s", "s", offset_s, 0.01, 0, 0.04, true}};
  estimate.findings = {found};
  return estimate;
}

TEST(LateEncoders, AreStampedAnewWhereTheLeversBearItOut) {
  EXPECT_NEAR(Driven(false).StampedEarlierBy_s(ClockOf("encoders", kLate_s)), kLate_s, 1e-9);
}

// Then all other sensors are early, and joints answer at once by the stamps as they are.
TEST(LateEncoders, KeepTheirStampsWhereTheLeversShareTheirClock) {
  EXPECT_EQ(Driven(true).StampedEarlierBy_s(ClockOf("encoders", kLate_s)), 0);
}

TEST(LateEncoders, KeepTheirStampsWhereSomethingElseMayBeLateOrIs) {
  SensorDiagnosis either = ClockOf("encoders", kLate_s);
  either.findings[0].rivals = {"imu_boom/clock_offset"};
  EXPECT_EQ(Driven(false).StampedEarlierBy_s(either), 0);
  EXPECT_EQ(Driven(false).StampedEarlierBy_s(ClockOf("imu_boom", kLate_s)), 0);
}

}  // namespace
}  // namespace tera
