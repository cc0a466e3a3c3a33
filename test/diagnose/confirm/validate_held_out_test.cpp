#include "diagnose/confirm/validate_held_out.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/driven_joints.h"
#include "diagnose/sensors/named_clock.h"

namespace tera {
namespace {

/// RMS difference between the boom's measured rate and its lever's.
double BoomError_radps(const HeldOutBlocks& held_out) {
  for (const ReplayBlock& block : held_out.blocks) {
    if (block.name != "boom") continue;
    const Series& rate = block.channels.front().measured;
    const std::vector<double> predicted = block.predict({}).front();
    double sum = 0, count = 0;
    for (std::size_t k = 0; k < rate.size(); ++k) {
      if (!rate.valid[k]) continue;
      sum += std::pow(rate.value[k] - predicted[k], 2);
      ++count;
    }
    return std::sqrt(sum / count);
  }
  ADD_FAILURE() << "there is no block of the boom";
  return 0;
}

/// A second recording of the machine with the same encoder delay.
HeldOutBlocks RecordedOnceMore(DrivenJoints* driven) {
  const DiagnosisInput& input = driven->made.Input();
  return {{input, nullptr},
          driven->made.measured,
          {},
          BlocksOf(input, driven->made.measured, {.threads = 1})};
}

// Sines of 0.1 to 1 rad/s delayed by 0.16 s err by several hundredths of a rad/s.
TEST(ValidateHeldOut, ClockThatIsNamedInTheFirstRecordingIsThatOfTheNext) {
  DrivenJoints driven(false);
  HeldOutBlocks held_out = RecordedOnceMore(&driven);
  const double before_radps = BoomError_radps(held_out);
  StampAnew(NamedClock("encoders", kLate_s), 1, 1, &held_out);
  EXPECT_LT(BoomError_radps(held_out), 0.2 * before_radps);
}

TEST(ValidateHeldOut, OtherClocksLeaveItsBlocksAsTheyAre) {
  DrivenJoints driven(false);
  HeldOutBlocks held_out = RecordedOnceMore(&driven);
  const double before_radps = BoomError_radps(held_out);
  StampAnew(NamedClock("imu_boom", kLate_s), 1, 1, &held_out);
  EXPECT_EQ(BoomError_radps(held_out), before_radps);
}

}  // namespace
}  // namespace tera
