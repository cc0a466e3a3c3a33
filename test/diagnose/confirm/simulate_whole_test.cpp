#include "diagnose/confirm/simulate_whole.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/blocks/base_block.h"
#include "diagnose/replay/base_log.h"
#include "sim/drive_fixture.h"

namespace tera {
namespace {

using testing::IsEmpty;

constexpr double kDuration_s = 30, kSpeed_mps = 0.5, kEvery_s = 0.1;

/// A machine that drives straight ahead, observed by encoders of its tracks; its simulation is a
/// tenth slower.
class StraightDrive : public testing::Test {
 protected:
  StraightDrive()
      : drive_("tb235.yaml", "{xy_m: [0, 0]}", "soil: asphalt", 0, 0, "    ground: kinematic\n"),
        model_(drive_.scenario.machines[0].placement.model) {
    input_.model = &model_;
    input_.machine = "m";
    NamedEncoders encoders{"m/sprockets", {}};
    for (const RunningGear& gear : model_.ground_tools.gears) {
      encoders.recording.axes.push_back({gear.name});
      input_.commands.columns.push_back(gear.name);
    }
    for (double t_s = 0; t_s < kDuration_s; t_s += kEvery_s) {
      const TimeNs t_ns = FromSeconds(t_s);
      const double rate_radps = kSpeed_mps / model_.ground_tools.gears[0].ShoeRadius_m();
      encoders.recording.samples.push_back({.t_ns = t_ns,
                                            .q_rad = {rate_radps * t_s, rate_radps * t_s},
                                            .qd_radps = {rate_radps, rate_radps}});
      input_.commands.t_ns.push_back(t_ns);
      input_.commands.rows.push_back({0.5, 0.5});
    }
    measured_.encoders = {encoders};
  }

  static std::vector<TruthPose> Poses() {
    std::vector<TruthPose> poses;
    for (double t_s = 0; t_s < kDuration_s; t_s += kEvery_s) {
      TruthPose pose{.t_ns = FromSeconds(t_s)};
      pose.X_WB.translation().x() = kSpeed_mps * t_s;
      poses.push_back(pose);
    }
    return poses;
  }
  SimulatedCourse Slower(const CourseSpan& span) const {
    SimulatedCourse course{.zero_ns = span.zero_ns, .step_s = kEvery_s, .steps = {}};
    const std::size_t axes = model_.joints.size() + model_.ground_tools.gears.size();
    for (double t_s = 0; t_s < span.until_s + kEvery_s; t_s += kEvery_s) {
      SimulatedCourse::Step step{std::vector<double>(axes), std::vector<double>(axes)};
      step.X_WB.translation().x() = 0.9 * kSpeed_mps * t_s;
      course.steps.push_back(std::move(step));
    }
    return course;
  }
  WholeSimulation Whole(const std::vector<TruthPose>& of_block) {
    const BaseLog log = MakeBaseLog(model_, measured_.encoders, of_block, kBaseInterval_s);
    std::vector<DiagnosedBlock> blocks(1);
    blocks[0].block = *MakeBaseBlock(model_, log, "m/base", false);
    return SimulateWhole(
        input_, measured_, blocks, std::nullopt,
        [&](const auto&, const auto&, const CourseSpan& span) { return Slower(span); });
  }

  Drive drive_;
  MachineModel model_;
  DiagnosisInput input_;
  Measurements measured_;
};

// A recording with receivers and without poses: the base's motion is estimated from all sensors.
TEST_F(StraightDrive, PathOfABaseWithoutPosesIsThatOfItsEstimate) {
  measured_.estimated_poses = Poses();
  const WholeSimulation whole = Whole(Poses());
  ASSERT_TRUE(whole.path);
  EXPECT_NEAR(whole.path->recorded_m, kSpeed_mps * kDuration_s, 0.5);
  EXPECT_NEAR(whole.path->before_m, 0.9 * kSpeed_mps * kDuration_s, 0.5);
}

// If the simulation ends before the base's first measurement, the base is not simulated; other
// results stay.
TEST_F(StraightDrive, ABaseThatIsSeenLaterThanIsSimulatedIsLeftOut) {
  std::vector<TruthPose> late = Poses();
  for (TruthPose& pose : late) pose.t_ns += FromSeconds(600);
  measured_.poses = late;
  const WholeSimulation whole = Whole(Poses());
  EXPECT_EQ(whole.obstacle, "");
  EXPECT_THAT(whole.channels, IsEmpty());
}

}  // namespace
}  // namespace tera
