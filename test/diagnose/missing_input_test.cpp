#include "diagnose/missing_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/units.h"

namespace tera {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kStep_s = 0.02;
constexpr std::size_t kSteps = 3000;  // one minute

/// A joint with a lever that repeats every ten seconds: 0.6 for three seconds, then -0.6 for three,
/// then neutral.
struct Drive {
  MachineModel model;
  AxisLog log;

  Drive() {
    Joint boom;
    boom.name = "boom";
    model.joints = {boom};
    Lever lever;
    lever.name = "boom";
    lever.joint = 0;
    lever.gear = -1;
    model.levers = {lever};
    log.step_s = kStep_s;
    log.steps = kSteps;
    log.axes = 1;
    MeasuredRate measured;
    measured.channel = "m/encoders/boom_radps";
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 0.002);
    for (std::size_t k = 0; k < kSteps; ++k) {
      const double lever_now = LeverAt(static_cast<double>(k) * kStep_s);
      log.lever.push_back(lever_now);
      measured.at_step.push_back(static_cast<double>(k));
      measured.t_ns.push_back(FromSeconds(static_cast<double>(k) * kStep_s));
      measured.rate_radps.push_back(0.5 * LeverAt(static_cast<double>(k) * kStep_s - 0.3) +
                                    noise(random));
      measured.is_free.push_back(true);
    }
    log.measured = {measured};
  }
  static double LeverAt(double t_s) {
    if (t_s < 0) return 0;
    const double in_cycle_s = std::fmod(t_s, 10);
    return in_cycle_s < 3 ? 0.6 : in_cycle_s < 6 ? -0.6 : 0;
  }
  std::vector<double>& rate() { return log.measured[0].rate_radps; }
  std::vector<MissingInput> Found() const { return FindMissingInput(model, log); }
};

TEST(MissingInput, IsNoneWhereTheRateFollowsTheLeverLate) {
  EXPECT_THAT(Drive().Found(), IsEmpty());
}

TEST(MissingInput, IsAllOfItWhereTheLeverWasNotRecorded) {
  Drive drive;
  std::fill(drive.log.lever.begin(), drive.log.lever.end(), 0);
  const auto found = drive.Found();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].axis, "boom");
  EXPECT_NEAR(found[0].share, 1, 1e-9);
  EXPECT_FALSE(found[0].is_one_sided);
}

TEST(MissingInput, IsOneSidedWhereOnlyPositiveLeversWereRecorded) {
  Drive drive;
  for (double& lever : drive.log.lever) lever = std::max(lever, 0.0);
  const auto found = drive.Found();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_TRUE(found[0].is_one_sided);
  EXPECT_NEAR(found[0].share, 0.5, 0.02);
}

TEST(MissingInput, IsNotALeverThatIsOnlyEverPushedToOneSideAndFollowed) {
  Drive drive;
  for (std::size_t k = 0; k < kSteps; ++k) {
    drive.log.lever[k] = std::max(drive.log.lever[k], 0.0);
    drive.rate()[k] = std::max(drive.rate()[k], 0.0);
  }
  EXPECT_THAT(drive.Found(), IsEmpty());
}

// A joint that sinks at a tenth of its rates while the lever rests has a leak; its input is
// complete.
TEST(MissingInput, IsNotWhatCreeps) {
  Drive drive;
  for (std::size_t k = 0; k < kSteps; ++k) {
    if (drive.log.lever[k] == 0) drive.rate()[k] -= 0.03;
  }
  EXPECT_THAT(drive.Found(), IsEmpty());
}

// Its own lever moves for three seconds of sixty. Throughout, it shakes at 2 Hz with other axes, by
// a quarter or half of its rate under the lever.
TEST(MissingInput, IsNotAShakeUnderALeverThatRests) {
  for (const double size : {0.08, 0.16}) {
    Drive drive;
    for (std::size_t k = 0; k < kSteps; ++k) {
      const double t_s = static_cast<double>(k) * kStep_s;
      if (t_s > 3) drive.log.lever[k] = 0;
      if (t_s > 4) drive.rate()[k] = 0;
      drive.rate()[k] += size * std::sin(2 * kPi * 2 * t_s);
    }
    EXPECT_THAT(drive.Found(), IsEmpty()) << size;
  }
}

TEST(MissingInput, IsNotNoiseOfAnAxisThatStands) {
  Drive drive;
  std::fill(drive.log.lever.begin(), drive.log.lever.end(), 0);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.02);
  for (double& rate : drive.rate()) rate = noise(random);
  EXPECT_THAT(drive.Found(), IsEmpty());
}

TEST(MissingInput, IsNotSoughtOfAnAxisWithoutLever) {
  Drive drive;
  std::fill(drive.log.lever.begin(), drive.log.lever.end(), 0);
  drive.model.levers.clear();
  EXPECT_THAT(drive.Found(), IsEmpty());
}

// Five seconds of motion by hand in a minute of work are less than a fifth.
TEST(MissingInput, IsNotASinglePush) {
  Drive drive;
  for (std::size_t k = 2900; k < kSteps; ++k) drive.rate()[k] = 0.3;
  EXPECT_THAT(drive.Found(), IsEmpty());
}

TEST(MissingInput, IsNoneWhereTheSimulationMovesAtRestToo) {
  Drive drive;
  for (std::size_t k = 0; k < kSteps; ++k) {
    const double in_cycle_s = std::fmod(static_cast<double>(k) * kStep_s, 10);
    if (in_cycle_s > 8) drive.rate()[k] += 0.2;  // dragged along
  }
  ASSERT_THAT(drive.Found(), SizeIs(1));
  const Drive as_simulated = drive;
  EXPECT_THAT(FindMissingInput(drive.model, drive.log, &as_simulated.log), IsEmpty());
  // Motion in the opposite direction does not count as such.
  Drive other_way = drive;
  for (double& rate : other_way.rate()) rate = -rate;
  EXPECT_THAT(FindMissingInput(drive.model, drive.log, &other_way.log), SizeIs(1));
}

}  // namespace
}  // namespace tera
