#include "diagnose/report/files/effects_yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dataset/files/checked_file.h"
#include "diagnose/report/made_diagnosis.h"
#include "diagnose/report/text/sentences.h"
#include "own_folder.h"
#include "physics/actuation/learned_rate.h"
#include "sim/scenario/scenario.h"

namespace tera {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// The scenario of one machine with an overlay.
Scenario Overlaid(const std::string& overlay) {
  const std::filesystem::path file = OwnFolder() / "effects.yaml";
  WriteWholeFile(file, overlay);
  const Config config =
      Config::FromFile(DataRoot() / "config/scenarios/quickstart.yaml", {}, {{file, "effects"}});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

const Effects& BoomEffects(const Scenario& scenario) {
  const MachineModel& model = scenario.machines[0].placement.model;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].name == "boom") return model.effects.joints[j];
  }
  throw std::runtime_error("no boom");
}

TEST(EffectsYaml, IsWhatGenerateReadsBack) {
  const std::string text = EffectsYaml(Of(BoomWithDeadBand()), "site\n7/run");
  EXPECT_EQ(text,
            "# What the recording site?7/run shows of excavator1 beyond its simulation.\n"
            "effects:\n"
            "  excavator1:\n"
            "    boom:\n"
            "      dead_band: {width: 0.1812}\n");
  const Scenario scenario = Overlaid(text);
  const Effect* effect = FindEffect(BoomEffects(scenario), "dead_band");
  ASSERT_NE(effect, nullptr);
  EXPECT_EQ((*effect)["width"], 0.1812);
  EXPECT_EQ((*effect)["asymmetry"], 0);
}

TEST(EffectsYaml, SaysOfAClassWhatElseItMayBe) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.findings[0].evidence.rivals.push_back(&boom.block.candidates[1]);
  EXPECT_THAT(EffectsYaml(Of(std::move(boom)), "run"),
              HasSubstr("      dead_band: {width: 0.1812}  # or valve curve: not told apart\n"));
}

TEST(EffectsYaml, OfNothingIsAnOverlayThatChangesNothing) {
  const std::string text = EffectsYaml({"excavator1", "excavator1", {}}, "run");
  EXPECT_THAT(text, HasSubstr("effects: {}\n"));
  EXPECT_EQ(FindEffect(BoomEffects(Overlaid(text)), "dead_band"), nullptr);
}

TEST(EffectsYaml, OfARegisteredSensorHasWhatItsScansMovedClearOfThePriorAndNothingOfTheScene) {
  Diagnosis diagnosis{"excavator1", "excavator1", {}};
  diagnosis.perception.push_back(LidarWithRangeBias());
  PerceptionDiagnosis& lidar = diagnosis.perception[0];
  AddRegion(&lidar);
  Finding& mount = lidar.findings[0].finding;
  // Yaw is held; x and roll are within two standard deviations of zero.
  mount.term = {&lidar.sensor_candidates[0], {0.002, 0.05, -0.04, 0.1, -0.8, 0}, {5}};
  mount.parameters = {{"x_m", "m", 0.002, 0.001},      {"y_m", "m", 0.05, 0.001},
                      {"z_m", "m", -0.04, 0.001},      {"roll_deg", "deg", 0.1, 0.05},
                      {"pitch_deg", "deg", -0.8, 0.1}, {"yaw_deg", "deg", 0, {}}};
  mount.evidence.rivals = {mount.term.candidate};
  EXPECT_THAT(EffectsYaml(diagnosis, "run"),
              HasSubstr("effects:\n"
                        "  excavator1:\n"
                        "    lidar_roof:\n"
                        "      extrinsic: {y_m: 0.05, z_m: -0.04, pitch_deg: -0.8}\n"));
  EXPECT_THAT(SentencesOf(diagnosis),
              Contains(HasSubstr("Lidar roof: extrinsic y 0.0500 ± 0.0010 m, z -0.0400 ± 0.0010 m, "
                                 "pitch -0.80 ± 0.10 deg (chosen with p < 0.0001, confirmed with p "
                                 "< 0.0001). Held-out distance to the simulated surfaces 2.4 → "
                                 "0.4 cm.")));
}

/// The boom with an unexplained residual, and what was learned of it.
DiagnosedBlock BoomWithUnexplained(std::vector<Learned> learned) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  boom.learned = std::move(learned);
  return boom;
}

TEST(EffectsYaml, HasWhatHasNoNameAsATableThatGenerateReadsBack) {
  LearnedEffect ripple{
      {"position/boom", "rad", LearnedVariable::Kind::kPosition, 0}, true, {}, {}, {}, {}};
  for (int k = 0; k < 40; ++k) {
    ripple.at.push_back(0.025 * k);
    ripple.value.push_back(0.3 * std::sin(0.2 * k));
    ripple.low.push_back(ripple.value.back() - 0.05);
    ripple.high.push_back(ripple.value.back() + 0.05);
  }
  const std::string text =
      EffectsYaml(Of(BoomWithUnexplained({{0, ripple, 3.1 * kDeg, 0.62 * kDeg}})), "run");
  EXPECT_THAT(text, HasSubstr("    boom:\n"
                              "      dead_band: {width: 0.1812}\n"
                              "      learned:  # no name: what no mechanism explains. Held-out "
                              "RMSE 3.1 -> 0.62 deg/s in the replay\n"
                              "        variable: position/boom\n"
                              "        unit: rad\n"
                              "        as: share\n"
                              "        at: [0, 0.025, 0.05, "));
  const Scenario scenario = Overlaid(text);
  const MachineModel& model = scenario.machines[0].placement.model;
  const auto boom = static_cast<std::size_t>(model.JointIndex("boom"));
  const LearnedEffect* read = LearnedAt(model.effects, boom);
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->variable.kind, LearnedVariable::Kind::kPosition);
  EXPECT_TRUE(read->is_share);
  ASSERT_EQ(read->at.size(), 40u);
  for (std::size_t k = 0; k < 40; ++k) {
    EXPECT_NEAR(read->at[k], ripple.at[k], 1e-5);
    EXPECT_NEAR(read->value[k], ripple.value[k], 1e-5);
    EXPECT_NEAR(read->high[k], ripple.high[k], 1e-5);
  }
}

TEST(EffectsYaml, SaysWhyWhatHasNoNameIsNotInIt) {
  const std::string text = EffectsYaml(Of(BoomWithUnexplained({})), "run");
  EXPECT_THAT(text, HasSubstr("\n# What is left of the boom rate is not here: a simulation learns "
                              "of joints, tracks and wheel sets alone, once each.\neffects:\n"));
  EXPECT_EQ(LearnedAt(Overlaid(text).machines[0].placement.model.effects, 0), nullptr);
  DiagnosedBlock without = BoomWithUnexplained({});
  without.block.learnable.resize(1);
  EXPECT_THAT(EffectsYaml(Of(std::move(without)), "run"),
              HasSubstr("not here: no function of one variable"));
}

TEST(EffectsYaml, LeavesOutWhatIsOfThePosesWhichNoSimulationHas) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.blocks[0].block.candidates[0].target = "poses";
  EXPECT_THAT(EffectsYaml(diagnosis, "run"), HasSubstr("\neffects: {}\n"));
  EXPECT_THAT(SentencesOf(diagnosis), Contains(HasSubstr("dead band of the poses")));
}

TEST(EffectsYaml, QuotesNamesThatYamlWouldReadAsSomethingElse) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.scenario = "digger: no 7's";
  EXPECT_THAT(EffectsYaml(diagnosis, "run"), HasSubstr("\n  'digger: no 7''s':\n"));
}

}  // namespace
}  // namespace tera
