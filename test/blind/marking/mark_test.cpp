#include "blind/marking/mark.h"

#include <gtest/gtest.h>

#include "blind/marking/table.h"

namespace tera::blind {
namespace {

/// A case with a dead band of 0.1 hidden in the boom, which shows from 10 s to 20 s.
struct HiddenDeadBand {
  HiddenDeadBand() {
    c.kind = CaseKind::kOne;
    c.strength = Strength::kStrong;
    c.duration_s = 40;
    c.hidden = {{.target = "boom",
                 .name = "dead_band",
                 .form = "overlap",
                 .truth = {{"width", 0.1}},
                 .variables = {"lever/boom"},
                 .channels = {"encoders/boom_radps"}}};
    Change change;
    for (int k = 0; k < 4000; ++k) {
      change.t_s.push_back(0.01 * k);
      change.over_noise.push_back(k >= 1000 && k < 2000 ? 20 : 0);
    }
    recording.changes = {change};
  }
  Mark Of(const Finding& finding) const { return MarkAnswer(c, recording, {{}, {finding}, {}}); }

  BenchmarkCase c;
  CaseRecording recording;
};

Finding DeadBandOfBoom() {
  return {.channel = "digger/encoders/boom_radps",
          .mechanism = "dead_band",
          .target = "boom",
          .names = {"dead_band"},
          .confidence = 0.97,
          .parameters = {{"width", {0.11, 0.008}}},
          .variable = "lever/boom",
          .intervals_s = {{10, 20}}};
}

TEST(Mark, OfTheRightAnswer) {
  const Mark mark = HiddenDeadBand().Of(DeadBandOfBoom());
  EXPECT_TRUE(mark.right_first && mark.right_channel && mark.right_variable);
  EXPECT_FALSE(mark.confident_wrong || mark.spurious);
  // 10 s of the 11 s in which it shows, with half a second on either side.
  EXPECT_NEAR(mark.overlap, 10.0 / 11, 0.02);
  ASSERT_EQ(mark.parameters.size(), 1u);
  EXPECT_NEAR(mark.parameters[0].RelativeError(), 0.1, 1e-9);
  EXPECT_TRUE(mark.parameters[0].Covered());
}

TEST(Mark, OfAUnitIsOfAnyOfItsAxes) {
  HiddenDeadBand late;
  late.c.hidden[0] = {.target = "imu_arm", .name = "clock_offset", .channels = {"imu_arm"}};
  Finding finding = DeadBandOfBoom();
  finding.mechanism = "clock_offset", finding.names = {"clock_offset"};
  finding.target = "imu_arm", finding.channel = "digger/imu_arm/wy_radps";
  EXPECT_TRUE(late.Of(finding).right_channel);
  finding.channel = "digger/imu_arm_2/wy_radps";
  EXPECT_FALSE(late.Of(finding).right_channel);
}

TEST(Mark, OfOneNameForTwoThatDoTheSameAsksForNoNumber) {
  HiddenDeadBand two;
  two.c.kind = CaseKind::kTwo;
  Concealed same = two.c.hidden[0];
  same.name = "lever_saturation", same.alike = {"dead_band"};
  two.c.hidden.push_back(same);
  two.recording.changes.push_back(two.recording.changes[0]);
  const Mark mark = two.Of(DeadBandOfBoom());
  EXPECT_EQ(mark.named, 2);
  EXPECT_TRUE(mark.parameters.empty());

  // Each has its own finding, though either name fits both.
  two.c.hidden[0].alike = {"lever_saturation"};
  Finding other = DeadBandOfBoom();
  other.names = {"lever_saturation"}, other.mechanism = "lever_saturation";
  const Mark apart = MarkAnswer(two.c, two.recording, {{}, {other, DeadBandOfBoom()}, {}});
  EXPECT_EQ(apart.named, 2);
  EXPECT_EQ(apart.parameters.size(), 2u);
}

TEST(Mark, AVariableIsThatOfWhatIsNamed) {
  // A lag that is found first depends on no variable, regardless of the dead band.
  HiddenDeadBand two;
  two.c.kind = CaseKind::kTwo;
  Concealed lag = two.c.hidden[0];
  lag.name = "actuator_lag", lag.variables = {}, lag.truth = {};
  two.c.hidden.push_back(lag);
  two.recording.changes.push_back(two.recording.changes[0]);
  Finding first = DeadBandOfBoom();
  first.names = {"actuator_lag"}, first.mechanism = "actuator_lag", first.variable = "time";
  EXPECT_FALSE(two.Of(first).has_variable);
  first.names = {"unexplained"}, first.mechanism = "unexplained";
  EXPECT_TRUE(two.Of(first).has_variable);
  EXPECT_FALSE(two.Of(first).right_variable);
}

TEST(Mark, OfTwoEffectsTellsHowLongTheLesserShowsInEitherOrder) {
  for (const bool first_never_shows : {false, true}) {
    HiddenDeadBand two;
    Change never = two.recording.changes[0];
    for (double& x : never.over_noise) x = 0;
    two.c.hidden.push_back(two.c.hidden[0]);
    two.recording.changes.insert(
        first_never_shows ? two.recording.changes.begin() : two.recording.changes.end(), never);
    EXPECT_EQ(two.Of(DeadBandOfBoom()).shows_s, 0);
  }
  EXPECT_NEAR(HiddenDeadBand().Of(DeadBandOfBoom()).shows_s, 10, 0.02);
}

TEST(Mark, OfAnswersThatAreWrong) {
  const HiddenDeadBand hidden;
  Finding wrong = DeadBandOfBoom();
  wrong.names = {"actuator_lag"}, wrong.mechanism = "actuator_lag";
  EXPECT_TRUE(hidden.Of(wrong).confident_wrong);
  EXPECT_TRUE(hidden.Of(wrong).spurious);
  wrong.confidence = 0.5;
  EXPECT_FALSE(hidden.Of(wrong).confident_wrong);
  Finding elsewhere = DeadBandOfBoom();
  elsewhere.target = "arm", elsewhere.channel = "digger/encoders/arm_radps";
  EXPECT_TRUE(hidden.Of(elsewhere).confident_wrong);
  EXPECT_FALSE(hidden.Of(elsewhere).right_first);
  Finding vague = DeadBandOfBoom();
  vague.names = {"valve_curve", "rate_gain", "dead_band", "lever_saturation"};
  EXPECT_FALSE(hidden.Of(vague).right_first) << "a class of four is no name";
  EXPECT_FALSE(hidden.Of(vague).confident_wrong) << "but it is not wrong";
}

TEST(Mark, OfWhatTheFormHasInItBesidesIsNeitherRightNorWrong) {
  HiddenDeadBand hidden;
  Finding besides = DeadBandOfBoom();
  besides.names = {"actuator_ring"}, besides.mechanism = "actuator_ring";
  EXPECT_TRUE(hidden.Of(besides).confident_wrong && hidden.Of(besides).spurious);
  hidden.c.hidden[0].besides = {"actuator_ring"};
  EXPECT_FALSE(hidden.Of(besides).confident_wrong || hidden.Of(besides).spurious);
  EXPECT_EQ(hidden.Of(besides).named, 0);
  besides.target = "arm";
  EXPECT_TRUE(hidden.Of(besides).confident_wrong && hidden.Of(besides).spurious);
}

TEST(Mark, OfWhatARealDriveHasOfItsOwnIsNeitherRightNorWrong) {
  HiddenDeadBand hidden;
  Finding own = DeadBandOfBoom();
  own.target = "poses", own.names = {"arrival_stamps"}, own.mechanism = "arrival_stamps";
  EXPECT_TRUE(hidden.Of(own).confident_wrong && hidden.Of(own).spurious);
  hidden.c.injected.emplace();
  EXPECT_FALSE(hidden.Of(own).confident_wrong || hidden.Of(own).spurious);
  own.names = {"latency", "clock_offset"}, own.mechanism = "latency";
  EXPECT_FALSE(hidden.Of(own).confident_wrong || hidden.Of(own).spurious);
  own.target = "base";
  EXPECT_TRUE(hidden.Of(own).confident_wrong);
  own.names = {"track_asymmetry"}, own.mechanism = "track_asymmetry";
  EXPECT_FALSE(hidden.Of(own).confident_wrong || hidden.Of(own).spurious);
}

TEST(Mark, OfAnEffectThatHasNoName) {
  HiddenDeadBand hidden;
  hidden.c.kind = CaseKind::kOutside;
  hidden.c.hidden[0].name.clear();
  EXPECT_TRUE(hidden.Of(DeadBandOfBoom()).misnamed);
  Finding unexplained = DeadBandOfBoom();
  unexplained.mechanism = "unexplained", unexplained.target.clear();
  unexplained.names = {"unexplained"};
  const Mark mark = hidden.Of(unexplained);
  EXPECT_TRUE(mark.flagged && mark.right_variable_flagged);
  EXPECT_FALSE(mark.misnamed || mark.confident_wrong);
}

TEST(Table, HasWilsonsInterval) {
  // 0 in 10: 0 to 27.8 %; 8 in 10: 49.0 % to 94.3 %. Brown, Cai and DasGupta 2001.
  EXPECT_NEAR((Share{0, 10}.high()), 0.278, 0.001);
  EXPECT_EQ((Share{0, 10}.low()), 0);
  EXPECT_NEAR((Share{8, 10}.low()), 0.490, 0.001);
  EXPECT_NEAR((Share{8, 10}.high()), 0.943, 0.001);
}

TEST(Table, CountsCasesOfTheirKindAlone) {
  Mark alarm, quiet, right;
  alarm.found_something = true;
  right.kind = CaseKind::kOne, right.strength = Strength::kFaint, right.right_first = true;
  Mark unanswered = alarm;
  unanswered.fault = "disk full";
  const std::vector<Row> rows = TableOf({alarm, quiet, right, unanswered});
  EXPECT_EQ(rows[0].share.hits, 1);
  EXPECT_EQ(rows[0].share.cases, 2);
  EXPECT_EQ(rows[1].share.cases, 0);  // strong
  EXPECT_EQ(rows[3].share.hits, 1);   // faint
}

}  // namespace
}  // namespace tera::blind
