#include "diagnose/experiment_design/next_manoeuvre.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "core/units.h"
#include "diagnose/experiment_design/greedy_design.h"
#include "diagnose/experiment_design/predicted_run.h"
#include "diagnose/report/text/confirmation_text.h"
#include "sim/drive_fixture.h"

namespace tera {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kNoise_radps = 0.2 * kDeg;
constexpr double kPeriod_s = 0.02;
/// Some of the boom's candidates, for speed.
constexpr std::string_view kCandidates[] = {"dead_band",    "rate_gain",    "lever_saturation",
                                            "valve_curve",  "actuator_lag", "backlash",
                                            "command_delay"};

/// The boom of a compact excavator, in the air, that follows its lever at once.
class Boom : public ::testing::Test {
 protected:
  Boom()
      : drive_("tb235.yaml", "{joints_deg: {boom: 40, arm: -80, bucket: -30, blade: 20}}",
               "soil: asphalt", 0, 0, "effects: {m: {boom: {actuator_ring: none}}}"),
        model_(drive_.scenario.machines[0].placement.model),
        axis_(static_cast<std::size_t>(model_.JointIndex("boom"))) {
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      model_.joints[j].initial_rad = drive_.scenario.machines[0].placement.q_rad[j];
      start_rad_.push_back(model_.joints[j].initial_rad);
    }
  }

  /// A noisy recording of these levers with a concealed effect of the boom.
  ReplayBlock Recorded(const TableRecording& commands, const std::string& id, double size) const {
    std::vector<LeverMove> moves;
    const auto column = static_cast<std::size_t>(
        std::find(commands.columns.begin(), commands.columns.end(), "boom") -
        commands.columns.begin());
    for (std::size_t r = 0; r < commands.rows.size(); ++r) {
      moves.push_back({ToSeconds(commands.t_ns[r]), axis_, commands.rows[r].at(column)});
    }
    const PredictedRun run =
        PredictRun(model_, moves, ToSeconds(commands.t_ns.back()) + 2, start_rad_, kPeriod_s);
    ReplayBlock block = BlockOf(model_, run, axis_).value();
    std::erase_if(block.candidates, [](const Candidate& candidate) {
      return std::find(std::begin(kCandidates), std::end(kCandidates), candidate.mechanism->id) ==
             std::end(kCandidates);
    });
    const auto candidate =
        std::find_if(block.candidates.begin(), block.candidates.end(),
                     [&](const Candidate& one) { return one.mechanism->id == id; });
    std::vector<double> values = candidate->starts.front();
    values[0] = size;
    const std::vector<double> truth = block.predict({{&*candidate, values}}).front();
    const Stream noise(5, "test/rate_noise");
    for (std::size_t k = 0; k < block.samples(); ++k) {
      if (!block.channels[0].measured.valid[k]) continue;
      block.channels[0].measured.value[k] = truth[k] + kNoise_radps * noise.Gaussian(k);
    }
    return block;
  }

  /// Up and down at full lever, for equal times.
  TableRecording FullSteps() const {
    std::vector<LeverMove> moves;
    double t_s = 1;
    for (int k = 0; k < 12; ++k) {
      moves.push_back({t_s, axis_, 1});
      moves.push_back({t_s + 0.8, axis_, 0});
      moves.push_back({t_s + 1.6, axis_, -1});
      moves.push_back({t_s + 2.3, axis_, 0});
      t_s += 3.2;
    }
    return PredictRun(model_, moves, t_s + 1, start_rad_, kPeriod_s).commands;
  }

  BlockDiagnosis Diagnosed(const ReplayBlock& block) const {
    return DiagnoseBlock(block, {}, Stream(3, "diagnose/boom"));
  }
  std::optional<NextManoeuvre> Next(const ReplayBlock& block,
                                    const BlockDiagnosis& diagnosis) const {
    return DesignNextManoeuvre(model_, {{&block, &diagnosis}},
                               {.total_candidates = block.candidates.size()},
                               Stream(3, "diagnose/next_manoeuvre"));
  }

  Drive drive_;
  MachineModel model_;
  std::size_t axis_;
  std::vector<double> start_rad_;
};

std::vector<std::string> ClassOf(const BlockDiagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Finding& finding : diagnosis.findings) {
    for (const Candidate* rival : finding.evidence.rivals) names.emplace_back(rival->mechanism->id);
  }
  return names;
}

TEST_F(Boom, OfWhichFullStepsLeaveAClassIsDiscriminatedByTheLeversThatAreProposed) {
  const ReplayBlock first = Recorded(FullSteps(), "dead_band", 0.12);
  const BlockDiagnosis diagnosis = Diagnosed(first);
  const std::vector<std::string> alike = ClassOf(diagnosis);
  ASSERT_THAT(alike, Contains("dead_band"));
  ASSERT_GE(alike.size(), 2u);

  const auto next = Next(first, diagnosis);
  ASSERT_TRUE(next.has_value());
  const auto discriminated = std::find_if(next->discriminated.begin(), next->discriminated.end(),
                                          [](const DiscriminatedSet& set) { return set.is_class; });
  ASSERT_NE(discriminated, next->discriminated.end());
  EXPECT_THAT(discriminated->members, ::testing::UnorderedElementsAreArray(alike));
  EXPECT_GE(discriminated->power, 0.5);
  EXPECT_LT(next->duration_s, 75);

  // Each candidate of the class, when concealed, is named alone under the proposed levers.
  for (const auto& [id, size] :
       {std::pair("dead_band", 0.12), std::pair("lever_saturation", 0.88)}) {
    const BlockDiagnosis again = Diagnosed(Recorded(next->commands, id, size));
    EXPECT_THAT(ClassOf(again), ElementsAre(id));
  }
}

TEST_F(Boom, StaysWhereTheRecordingShowedThatItCanGo) {
  const ReplayBlock first = Recorded(FullSteps(), "dead_band", 0.12);
  const BlockDiagnosis diagnosis = Diagnosed(first);
  const auto next = Next(first, diagnosis);
  ASSERT_TRUE(next.has_value());
  const std::vector<double>& went = first.channels[0].variables[1].series.value;
  const ReplayBlock driven = Recorded(next->commands, "dead_band", 0.12);
  const std::vector<double>& goes = driven.channels[0].variables[1].series.value;
  EXPECT_GE(*std::min_element(goes.begin(), goes.end()),
            *std::min_element(went.begin(), went.end()) - 1e-3);
  EXPECT_LE(*std::max_element(goes.begin(), goes.end()),
            *std::max_element(went.begin(), went.end()) + 1e-3);
}

TEST_F(Boom, ThatHardlyMovedGetsLeversThatWouldShowWhatActs) {
  const std::vector<LeverMove> once = {{2, axis_, 0.5}, {2.6, axis_, 0}};
  const ReplayBlock first =
      Recorded(PredictRun(model_, once, 30, start_rad_, kPeriod_s).commands, "dead_band", 0.1);
  const BlockDiagnosis diagnosis = Diagnosed(first);
  ASSERT_FALSE(diagnosis.is_testable);
  const auto next = Next(first, diagnosis);
  ASSERT_TRUE(next.has_value());
  EXPECT_GE(next->discriminated.size(), 4u);
  const BlockDiagnosis again = Diagnosed(Recorded(next->commands, "dead_band", 0.1));
  EXPECT_TRUE(again.is_testable);
  EXPECT_THAT(ClassOf(again), Contains("dead_band"));
}

TEST_F(Boom, WritesItsLeversAsARecordingHasThem) {
  NextManoeuvre next;
  next.description = "boom: steps of 0.5";
  next.duration_s = 7;
  next.commands.columns = {"boom", "arm"};
  next.commands.t_ns = {0, 1500000000};
  next.commands.rows = {{0, 0}, {-0.25, 1}};
  next.discriminated = {{"boom", {"dead_band", "rate_gain"}, true, 0.97},
                        {"boom", {"backlash", "nothing"}, false, 0.8}};
  next.power = 0.8;
  EXPECT_EQ(CsvOf(next), "t_ns,boom,arm\n0,0,0\n1500000000,-0.25,1\n");
  EXPECT_THAT(SentenceOf(next),
              AllOf(HasSubstr("tells dead band and rate gain of the boom apart"),
                    HasSubstr("would show backlash of the boom"), HasSubstr("Power 0.8 at least")));
}

TEST(Excitations, StayWithinTheRangeAndEndInNeutral) {
  const AxisRange range{2, "boom", 0.5, -0.2, 0.6};
  for (const Excitation& excitation : ExcitationsFor(range, {{3, "arm", 0.7, -1.0, 0.0}})) {
    std::vector<double> at_rad(4, 0.0), lever(4, 0.0);
    double t_s = 0;
    for (const LeverMove& move : excitation.moves) {
      EXPECT_GE(move.t_s, t_s - 1e-9) << excitation.what;
      for (std::size_t a = 0; a < 4; ++a) {
        at_rad[a] += lever[a] * (a == 2 ? 0.5 : 0.7) * (move.t_s - t_s);
      }
      EXPECT_LE(std::abs(at_rad[2]), 0.4 + 1e-9) << excitation.what;
      EXPECT_LE(std::abs(at_rad[3]), 0.5 + 1e-9) << excitation.what;
      lever[move.axis] = move.lever;
      t_s = move.t_s;
    }
    EXPECT_THAT(lever, ElementsAre(0, 0, 0, 0)) << excitation.what;
    EXPECT_NEAR(at_rad[2], 0, 1e-9) << excitation.what;
    EXPECT_GT(excitation.length_s, t_s);
  }
}

/// One parameter that explains a difference in two excitations if both have the same sign.
PairInformation OneNumber(double column, double difference) {
  return {Eigen::MatrixXd::Constant(1, 1, 1e6 * column * column),
          Eigen::VectorXd::Constant(1, 1e6 * column * difference), 1e6 * difference * difference};
}

TEST(ChooseExcitations, TakesTheTwoThatOneNumberCannotExplainTogether) {
  // Alone each is explained away; the second and third need opposite parameters.
  const std::vector<std::vector<PairInformation>> information = {
      {OneNumber(1, 1), OneNumber(1, 0.5), OneNumber(1, -0.5)}};
  PairInformation opposite = information[0][1];
  opposite += information[0][2];
  EXPECT_NEAR(information[0][0].Lead(), 0.5, 0.01);  // cost of the parameter's own spread
  EXPECT_NEAR(opposite.Lead(), 0.5 * 1e6 * 0.5, 10);
  const auto chosen = ChooseExcitations(information, {1}, {1, 1, 1}, 2);
  EXPECT_EQ(chosen.size(), 2u);
  EXPECT_GT(std::abs(static_cast<int>(chosen[0]) - static_cast<int>(chosen[1])), 0);
  EXPECT_THAT(chosen, Contains(2u));
}

}  // namespace
}  // namespace tera
