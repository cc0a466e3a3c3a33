#include "diagnose/diagnose_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

#include "app/hand_made_recording.h"
#include "core/config/config.h"
#include "core/error.h"
#include "dataset/format/sample_recording.h"
#include "diagnose/measurements.h"
#include "diagnose/recorded_blocks.h"
#include "sim/scenario/scenario.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Response of the hand-made boom to its lever, on a machine whose other axes stand still.
SimulatedCourse CourseOf(const MachineModel& model, const std::function<double(double)>& valve,
                         const CourseSpan& span) {
  constexpr double kStep_s = 0.02;
  SimulatedCourse course{.zero_ns = span.zero_ns, .step_s = kStep_s, .steps = {}};
  const std::size_t axes = model.joints.size() + model.ground_tools.gears.size();
  const auto boom = static_cast<std::size_t>(model.JointIndex("boom"));
  double q_rad = model.joints[boom].initial_rad;
  for (double t_s = 0; t_s < span.until_s; t_s += kStep_s) {
    const double moved = valve(t_s > 0 ? HandMadeLever(t_s - kStep_s) : 0);
    SimulatedCourse::Step step{std::vector<double>(axes), std::vector<double>(axes)};
    step.rate_radps[boom] = moved * (moved > 0 ? kUp_radps : kDown_radps);
    q_rad += step.rate_radps[boom] * kStep_s;
    step.position_rad[boom] = q_rad;
    course.steps.push_back(std::move(step));
  }
  return course;
}

/// A boom with a dead band of 0.1 that the scenario lacks.
class DiagnosisOfABoom : public testing::Test {
 protected:
  DiagnosisOfABoom() {
    const Config config = Config::FromText(kHandMadeScenario, "boom.yaml");
    scenario_ = ReadScenario(config.root());
    config.Finish();
    WriteHandMade(path("real"), {.valve = DeadTo0_1});
    WriteHandMade(path("further"), {.valve = DeadTo0_1, .seed = 2});
    WriteWholeFile(path("library.yaml"), "only: [dead_band, rate_gain]\n");
  }
  std::filesystem::path path(const std::string& name) const { return scratch_.path() / name; }
  const MachineModel& model() const { return scenario_.machines[0].placement.model; }

  DiagnosisInput InputOf(const Recording& recording) const {
    return {.model = &model(),
            .machine = "excavator1",
            .scenario = "digger",
            .commands = recording.LoadTable("excavator1/commands.csv")};
  }
  DiagnosisCase Case(const Recording& recording) const {
    DiagnosisCase asked{.input = InputOf(recording), .recording = &recording};
    asked.origin.lat_deg = 46.5;
    return asked;
  }
  DiagnosisOptions Options() const {
    DiagnosisOptions options;
    options.library = ReadCandidateLibrary(path("library.yaml"));
    return options;
  }

  const ScratchDirectory scratch_;
  Scenario scenario_;
  StageClock clock_;
};

TEST_F(DiagnosisOfABoom, HoldsWhatEveryPartOfItFound) {
  const Recording real(path("real"));
  DiagnosisCase asked = Case(real);
  const auto further = std::make_shared<const Recording>(path("further"));
  asked.held_out.push_back({InputOf(*further), further});
  asked.perception.push_back(NotJudged("excavator1/lidar", "lidar", "it was covered"));
  asked.simulate = [&](const SimulatedFindings& found, const TableRecording&,
                       const CourseSpan& span) {
    return found.empty() ? CourseOf(
                               model(), [](double lever) { return lever; }, span)
                         : CourseOf(model(), DeadTo0_1, span);
  };
  std::map<std::string, int> told;
  const Diagnosis diagnosis = Diagnose(
      std::move(asked), Options(),
      [&](const BlockProgress& progress) {
        EXPECT_EQ(progress.machine, "excavator1");
        ++told[progress.block + (progress.done == nullptr ? " begins" : " ends")];
      },
      &clock_);

  EXPECT_EQ(diagnosis.machine, "excavator1");
  EXPECT_EQ(diagnosis.scenario, "digger");
  EXPECT_FALSE(diagnosis.levers_are_the_scenarios);
  EXPECT_EQ(diagnosis.origin.lat_deg, 46.5);
  ASSERT_EQ(diagnosis.blocks.size(), 1u);
  EXPECT_EQ(told, (std::map<std::string, int>{{"boom begins", 1}, {"boom ends", 1}}));
  const std::vector<Finding>& findings = diagnosis.blocks[0].diagnosis.findings;
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].term.candidate->mechanism->id, "dead_band");
  EXPECT_NEAR(findings[0].term.values[0], 0.1, 0.01);
  EXPECT_THAT(VerdictsOf(diagnosis), testing::Contains(Verdict::kNamed));

  ASSERT_EQ(diagnosis.held_out.size(), 1u);
  EXPECT_EQ(diagnosis.held_out[0].recording, path("further").string());
  ASSERT_EQ(diagnosis.held_out[0].channels.size(), 1u);
  EXPECT_LT(diagnosis.held_out[0].channels[0].rmse_after,
            0.3 * diagnosis.held_out[0].channels[0].rmse_before);

  ASSERT_EQ(diagnosis.discrepancy_corrections.size(), 1u);
  EXPECT_TRUE(diagnosis.discrepancy_corrections[0].is_simulated);
  ASSERT_TRUE(diagnosis.whole);
  EXPECT_EQ(diagnosis.whole->obstacle, "");
  ASSERT_EQ(diagnosis.whole->channels.size(), 1u);
  EXPECT_LT(diagnosis.whole->channels[0].rmse_after,
            0.3 * diagnosis.whole->channels[0].rmse_before);

  ASSERT_EQ(diagnosis.perception.size(), 1u);
  EXPECT_EQ(diagnosis.perception[0].not_judged, "it was covered");
  EXPECT_THAT(clock_.Table(), AllOf(HasSubstr("further recordings"), HasSubstr("simulation as it"),
                                    HasSubstr("whole simulation")));
}

TEST_F(DiagnosisOfABoom, WithoutASimulationNothingOfOneIsInIt) {
  const Recording real(path("real"));
  const Diagnosis diagnosis = Diagnose(
      Case(real), Options(), [](const BlockProgress&) {}, &clock_);
  EXPECT_EQ(diagnosis.blocks[0].diagnosis.findings.size(), 1u);
  EXPECT_FALSE(diagnosis.whole);
  ASSERT_EQ(diagnosis.discrepancy_corrections.size(), 1u);
  EXPECT_FALSE(diagnosis.discrepancy_corrections[0].is_simulated);
}

TEST_F(DiagnosisOfABoom, AFurtherRecordingThatIsTooShortIsToldBeforeAnythingIsSearched) {
  WriteHandMade(path("short"), {.duration_s = 12});
  const Recording real(path("real"));
  DiagnosisCase asked = Case(real);
  const auto further = std::make_shared<const Recording>(path("short"));
  asked.held_out.push_back({InputOf(*further), further});
  bool is_searched = false;
  try {
    Diagnose(
        std::move(asked), Options(), [&](const BlockProgress&) { is_searched = true; }, &clock_);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr(path("short").string()), HasSubstr("need 20 s at least")));
  }
  EXPECT_FALSE(is_searched);
}

TEST_F(DiagnosisOfABoom, AnAxisOfWhichTooLittleWasMeasuredIsTold) {
  const Recording real(path("real"));
  const DiagnosisInput input = InputOf(real);
  Measurements measured = MeasurementsOf(input, real);
  std::vector<EncoderSample>& samples = measured.encoders[0].recording.samples;
  const TimeNs until_ns = samples.front().t_ns + FromSeconds(12);
  std::erase_if(samples, [&](const EncoderSample& one) { return one.t_ns > until_ns; });
  std::vector<std::string> not_compared;
  BlockOptions options = Options().blocks;
  options.needs_any = false;
  EXPECT_TRUE(BlocksOf(input, measured, options, &not_compared).empty());
  EXPECT_THAT(not_compared, testing::Contains(AllOf(HasSubstr("boom: 12.0 s can be compared"),
                                                    HasSubstr("need 20 s at least"))));
}

}  // namespace
}  // namespace tera
