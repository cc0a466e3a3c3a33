#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "diagnose/replay/effort_log.h"
#include "diagnose/replay/sled.h"

namespace tera {
namespace {

using ::testing::HasSubstr;

/// All three joints of the arm move simultaneously and affect each other.
RecordedEfforts RecordArm(const std::string& effects, double duration_s) {
  Drive drive("fixed_arm.yaml", "{joints_deg: {shoulder: 60, elbow: -50, wrist: -40}}",
              "soil: asphalt", 0, 0, effects);
  drive.Operate([](double t_s) {
    return NamedLevers{{"shoulder", 0.5 * std::sin(1.3 * t_s)},
                       {"elbow", 0.6 * std::sin(2.1 * t_s + 1)},
                       {"wrist", 0.7 * std::sin(1.7 * t_s + 2)}};
  });
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  RecordedEfforts recorded;
  for (const Joint& joint : model.joints) {
    recorded.encoders[0].recording.axes.push_back({joint.name});
    recorded.efforts.columns.push_back(joint.name + "_nm");
  }
  drive.Run(duration_s, [&] {
    const TimeNs t_ns = drive.simulation->state().t_ns;
    if (t_ns % 2'000'000 != 0) return;
    const MachineState& state = drive.machine();
    recorded.encoders[0].recording.samples.push_back(
        {.t_ns = t_ns, .q_rad = state.q_rad, .qd_radps = state.qd_radps});
    recorded.efforts.t_ns.push_back(t_ns);
    recorded.efforts.rows.push_back(state.effort_nm);
  });
  return recorded;
}

/// RMS of the residual over that of the effort.
double ShareLeft(const EffortLog& log, const std::vector<double>& predicted_nm) {
  double left = 0, all = 0;
  for (std::size_t k = 0; k < predicted_nm.size(); ++k) {
    if (!log.measured.valid[k]) continue;
    left += std::pow(log.measured.value[k] - predicted_nm[k], 2);
    all += std::pow(log.measured.value[k], 2);
  }
  EXPECT_GT(all, 0);
  return std::sqrt(left / all);
}

TEST(EffortReplay, NeedsWhatTheMotorsOfTheMovingArmGave) {
  const char* const kEffects =
      "effects: {m: {shoulder: {coulomb_friction: {effort_nm: 60}}, elbow: {viscous_friction: "
      "{coefficient_nmsprad: 120}, asymmetric_friction: {negative_nm: 20}}, wrist: {effort_offset: "
      "{effort_nm: 25}}}}\n";
  const RecordedEfforts recorded = RecordArm(kEffects, 6);
  const MachineModel model =
      Drive::Read("fixed_arm.yaml", "{}", "soil: asphalt", kEffects).machines[0].placement.model;
  const auto logs = MakeEffortLogs(model, "m/efforts", recorded.efforts, recorded.encoders);
  ASSERT_EQ(logs.size(), 3u);
  for (const EffortLog& log : logs) {
    const EffortReplay replay(model, log);
    const double with = ShareLeft(log, replay.Predict(model.effects.joints[log.joint]));
    const double without = ShareLeft(log, replay.Predict({}));
    EXPECT_LT(with, 0.02) << log.channel;
    EXPECT_GT(without, 4 * with) << log.channel;
  }
}

TEST(EffortLog, RefusesATorqueOfAJointThatSlides) {
  Sled sled;
  sled.recorded.efforts.columns = {"carriage_nm"};
  try {
    sled.Logs();
    FAIL() << "a torque of a sled was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("carriage_nm is of a joint that slides; need a force, _n"));
  }
}

TEST(EffortLog, HasGapsWhereTheJointRests) {
  Sled sled;
  auto& samples = sled.recorded.encoders[0].recording.samples;
  for (std::size_t k = 2500; k < 3500; ++k) samples[k].q_rad = samples[2500].q_rad;
  const EffortLog log = sled.Logs().at(0);
  // Step 3000 lies within the rest, far from both ends.
  for (std::size_t k = 0; k < log.at_fine.size(); ++k) {
    const std::size_t step = log.at_fine[k];
    if (step > 2600 && step < 3400) {
      EXPECT_FALSE(log.measured.valid[k]) << k;
    } else if (step < 2000) {
      EXPECT_TRUE(log.measured.valid[k]) << k;
    }
  }
}

}  // namespace
}  // namespace tera
