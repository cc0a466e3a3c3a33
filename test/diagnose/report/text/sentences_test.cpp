#include "diagnose/report/text/sentences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "diagnose/report/made_diagnosis.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/sentence.h"

namespace tera {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Sentence, TellsWhereOnWhatWhichHowSureAndHowMuchBetter) {
  const DiagnosedBlock boom = BoomWithDeadBand();
  EXPECT_EQ(
      SentenceOf(boom, boom.diagnosis.findings[0]),
      "Boom rate, 41–63 s and 1 more interval; the error depends on |lever| < 0.2, odd: dead "
      "band 0.18 ± 0.02 (chosen with p 0.0002, confirmed with p 0.004; rivals rejected: valve "
      "curve (p 0.003)). Held-out RMSE 3.1 → 0.6 deg/s, 94 % of the excess variance removed. "
      "Left: 0.6 deg/s at a noise of 0.5 deg/s.");
}

TEST(Sentence, OfARivalThatIsTheSameMechanismSaysThatItsNumbersAreOthers) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.block.candidates[1].mechanism = boom.block.candidates[0].mechanism;
  EXPECT_THAT(SentenceOf(boom, boom.diagnosis.findings[0]),
              HasSubstr("rivals rejected: dead band by its other numbers (p 0.003)"));
}

TEST(Sentence, OfAClassNamesAllThatAreAlike) {
  DiagnosedBlock boom = BoomWithDeadBand();
  Finding& finding = boom.diagnosis.findings[0];
  finding.evidence.rivals.push_back(&boom.block.candidates[1]);
  finding.evidence.rejected.clear();
  finding.parameters[0].sigma.reset();
  finding.location.regimes[0].p = 0.3;
  finding.location.intervals.clear();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  EXPECT_EQ(
      SentenceOf(boom, finding),
      "Boom rate, the whole recording; the error depends most on |lever| < 0.2, odd (p 0.3): dead "
      "band 0.181 (chosen with p 0.0002, confirmed with p 0.004; not told apart from: valve "
      "curve). Held-out RMSE 3.1 → 0.6 deg/s, 94 % of the excess variance removed.");
}

TEST(Sentence, NamesNumbersWhereAMechanismHasSeveralAndWritesAnglesInDegrees) {
  DiagnosedBlock arm = Block("arm", "excavator1/encoders/arm_radps", "rad/s");
  arm.block.candidates = {
      {&MechanismOf("end_cushion"), "arm", {{0, 0.02, 0.6}, {1, 0.02, 0.9}}, {{0.1, 0.2}}}};
  Finding finding;
  finding.term = {&arm.block.candidates[0], {10 * kDeg, 0.25}};
  finding.parameters = {{"zone_rad", "rad", 10 * kDeg, 0.5 * kDeg},
                        {"end_ratio", "1", 0.25, 0.012}};
  finding.evidence.rivals = {finding.term.candidate};
  finding.location = {0, {{2, 3}}, {}};
  finding.location.regimes = {RegimeOf("position/arm", {.form = CurveForm::kThreshold,
                                                        .parity = CurveParity::kNotTested,
                                                        .low = 60 * kDeg,
                                                        .high = 75 * kDeg})};
  finding.held_out = {0, 2 * kDeg, 2 * kDeg, -0.01, 0.5};
  finding.evidence.p = 1e-7;
  arm.diagnosis.residual_verdicts[0].kind = ResidualVerdict::Kind::kUnknown;
  arm.diagnosis.residual_verdicts[0].flexible_regressor_predicts = false;
  arm.block.first_ns = FromSeconds(45);
  EXPECT_EQ(
      SentenceOf(arm, finding),
      "Arm rate, 46.00–46.50 s; the error depends on angle from 60 to 75 deg, growing: end "
      "cushion 10.0 ± 0.5 deg, end ratio 0.250 ± 0.012 (chosen with p < 0.0001, confirmed with p "
      "0.5). Held-out RMSE 2 → 2 deg/s, none of the excess variance removed. Left: 0.6 deg/s at a "
      "noise of 0.5 deg/s, of noise or error, which a recording without rest does not tell, and no "
      "flexible regressor that could tell whether there is more.");
}

TEST(Sentence, OfTheUnexplainedSaysOnWhatItDepends) {
  DiagnosedBlock boom = BoomWithDeadBand();
  EXPECT_EQ(
      SentenceOf(boom, GrowingBeyond12kNm()),
      "Boom rate, 12.0–20.0 s; the error depends on |arm load| > 12000 N m, growing, even: no "
      "known mechanism explains it (p 0.00041; 35 % of what a flexible regressor could explain). "
      "Left: 0.9 "
      "deg/s at a noise of 0.2 deg/s.");
  Unexplained loud = GrowingBeyond12kNm();
  loud.p.reset();
  EXPECT_THAT(
      SentenceOf(boom, loud),
      HasSubstr("no known mechanism explains it (nor does a flexible regressor). Left: 0.9 deg/s"));
}

TEST(Sentence, OfAnErrorThatIsAShareOfTheSimulatedValueSaysSo) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.findings[0].location.regimes[0].is_share = true;
  EXPECT_THAT(
      SentenceOf(boom, boom.diagnosis.findings[0]),
      HasSubstr("the error is a share of the simulated value that depends on |lever| < 0.2"));
}

TEST(Sentence, OfWhatWasNotConfirmedOrNotJudgedFollowsTheFindings) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unconfirmed = std::move(boom.diagnosis.findings);
  boom.diagnosis.findings.clear();
  boom.diagnosis.unconfirmed[0].held_out.p = 0.3;
  Diagnosis diagnosis = Of(std::move(boom));
  DiagnosedBlock arm = Block("arm", "excavator1/encoders/arm_radps", "rad/s");
  arm.diagnosis.is_testable = false;
  arm.block.candidates = {{&MechanismOf("command_delay"), "arm", {{0, 0, 1}}, {{0.1}}}};
  diagnosis.blocks.push_back(std::move(arm));
  EXPECT_THAT(
      SentencesOf(diagnosis),
      ElementsAre(
          HasSubstr("Nothing is named: what was chosen for boom rate is not confirmed."),
          "Boom rate: dead band 0.18 ± 0.02 was chosen (p 0.0002) and is not confirmed on "
          "manoeuvres kept back (p 0.3).",
          "Arm rate: not judged, for its lever moves in too few manoeuvres of the recording."));
  EXPECT_THAT(VerdictsOf(diagnosis), ElementsAre(Verdict::kNone, Verdict::kUntestable));
  // A confirming p is no reason against confirmation: a few loud manoeuvres may cause it.
  diagnosis.blocks[0].diagnosis.unconfirmed[0].held_out.p = 0.01;
  EXPECT_THAT(SentencesOf(diagnosis)[1],
              HasSubstr("not confirmed on manoeuvres kept back (too few of them gain clearly)."));
  diagnosis.blocks.erase(diagnosis.blocks.begin());
  EXPECT_THAT(VerdictsOf(diagnosis), ElementsAre(Verdict::kUntestable));
}

TEST(Sentence, OfWhatStandsInForTheUnexplainedIsNoName) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.proxies = std::move(boom.diagnosis.findings);
  boom.diagnosis.findings.clear();
  boom.diagnosis.proxies[0].held_out.excess_removed = 0.56;
  const Diagnosis diagnosis = Of(std::move(boom));
  EXPECT_THAT(
      SentencesOf(diagnosis),
      Contains("Boom rate: dead band 0.18 ± 0.02 comes nearest to what is unexplained and is "
               "no name for it (56 % of the excess variance removed)."));
  EXPECT_THAT(VerdictsOf(diagnosis), Not(Contains(Verdict::kNamed)));
}

TEST(Sentence, OfWhatAFewManoeuvresOutweighSaysThatTheErrorIsNoSmaller) {
  DiagnosedBlock boom = BoomWithDeadBand();
  Finding& finding = boom.diagnosis.findings[0];
  finding.held_out = {0, 2 * kDeg, 2.1 * kDeg, -0.1, 0.0007};
  EXPECT_THAT(SentenceOf(boom, finding),
              HasSubstr("Held-out RMSE 2 → 2.1 deg/s, none of the excess variance removed, for a "
                        "few manoeuvres outweigh the rest."));
  finding.held_out = {0, 2 * kDeg, 1.1 * kDeg, 0, 0.0007};  // of presumed noise
  EXPECT_THAT(SentenceOf(boom, finding), HasSubstr("Held-out RMSE 2 → 1.1 deg/s. "));
}

TEST(Sentence, OfNothingNamesTheChannelsAndWhatWasNotSeen) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.findings.clear();
  boom.diagnosis.residual_verdicts[0].kind = ResidualVerdict::Kind::kOfFew;
  Diagnosis diagnosis = Of(std::move(boom));
  diagnosis.blocks.push_back(Block("excavator1/base", "excavator1/base/left_mps", "m/s"));
  EXPECT_THAT(
      SentencesOf(diagnosis),
      ElementsAre("Nothing found: boom rate and sideways speed agree with the simulation, but for "
                  "noise and what nominal numbers are off by. Not so in a few manoeuvres of boom "
                  "rate. Of 3 mechanisms looked for, 1 could "
                  "not have been seen "
                  "at any size."));
  EXPECT_THAT(SentencesOf({"excavator1", "excavator1", {}}),
              ElementsAre(HasSubstr("Nothing compared")));
}

TEST(Sentence, OfASensorsFindingComesBeforeWhatAgrees) {
  Diagnosis agreeing{"excavator1", "excavator1", {}};
  agreeing.blocks.push_back(Block("boom", "excavator1/encoders/boom_radps", "rad/s"));
  agreeing.perception.push_back(LidarWithRangeBias());
  EXPECT_THAT(SentencesOf(agreeing),
              ElementsAre(HasSubstr("range bias"), HasSubstr("Nothing found: boom rate agrees")));
  // Without a judged block, the verdict of no fault is absent.
  agreeing.blocks[0].diagnosis.is_testable = false;
  EXPECT_THAT(SentencesOf(agreeing), ElementsAre(HasSubstr("range bias"), HasSubstr("not judged")));
}

TEST(Sentence, OfARecordingWithoutLeversSaysWhoseAreTaken) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  const char* of_the_scenario =
      "The recording has no levers: those that the scenario replays are taken.";
  EXPECT_THAT(SentencesOf(diagnosis), Not(Contains(of_the_scenario)));
  diagnosis.levers_are_the_scenarios = true;
  EXPECT_THAT(SentencesOf(diagnosis), Contains(of_the_scenario));
}

TEST(Sentence, OfAMachineUnderAnotherNameSaysForWhatItIsTaken) {
  EXPECT_THAT(SentencesOf({"warthog", "excavator1", {}}),
              Contains("The recording's warthog is taken for the scenario's excavator1."));
}

TEST(Sentence, OfFurtherRecordingsAndTheWholeSimulationComparesAndWarns) {
  const std::vector<std::string> sentences = SentencesOf(Complete());
  EXPECT_THAT(sentences,
              ::testing::Contains("On out/second, which nothing was fitted to: RMSE of boom rate 3 "
                                  "→ 0.5 deg/s. It says nothing of arm."));
  EXPECT_THAT(sentences, ::testing::Contains(
                             "The whole simulation as it was and with what was found, 40–130 s, "
                             "manoeuvres kept back: boom rate 2 → 0.25 deg/s and slew rate 1 → 1.5 "
                             "deg/s; path 57.39 m recorded, 50.47 → 57.2 m simulated. The whole "
                             "simulation does not follow: slew rate."));
}

TEST(Sentence, OfAWholeSimulationInWhichTheBaseGoesNowhereSaysSo) {
  Diagnosis diagnosis = Complete();
  diagnosis.whole->channels = {{"warthog/base/yaw_radps", "rad/s", 0.001, 0.001}};
  diagnosis.whole->path = {1.4, 0, 0};
  EXPECT_THAT(
      SentencesOf(diagnosis),
      Contains(::testing::EndsWith(
          "path 1.4 m recorded, 0 → 0 m simulated: the simulated base goes nowhere. The whole "
          "simulation does not follow: yaw rate.")));
}

TEST(Sentence, OfWhatReplaysLeaveOfTheSimulationNamesWhatIsJudgedAndWorthAWord) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  for (const char* axis : {"arm", "bucket", "slew", "swing"}) {
    const std::string channel = std::string("excavator1/encoders/") + axis + "_radps";
    diagnosis.blocks.push_back(Block(axis, channel, "rad/s"));
  }
  diagnosis.blocks.back().diagnosis.is_testable = false;
  diagnosis.discrepancy_corrections = {
      {"excavator1/encoders/boom_radps", "rad/s", true, 2 * kDeg, 40},
      {"excavator1/encoders/arm_radps", "rad/s", true, 0.1 * kDeg, 2},
      {"excavator1/encoders/bucket_radps", "rad/s", true, 3 * kDeg, -40},
      {"excavator1/encoders/slew_radps", "rad/s"},
      {"excavator1/encoders/swing_radps", "rad/s", true, 9 * kDeg, 90}};
  EXPECT_THAT(
      SentencesOf(diagnosis),
      ::testing::Contains("Corrected for what the replays lack of the simulation: boom rate 2 "
                          "deg/s (RMS). Lacking in "
                          "the replays, but not seen in the recording either: bucket rate 3 deg/s "
                          "(RMS). Not simulated as a whole: slew rate; what a replay lacks "
                          "counts as a difference."));
}

TEST(Sentence, OfExcludedSamplesSaysHowManyAndWhy) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.excluded_samples = {{"husky/base/yaw_radps", 0.234}};
  EXPECT_THAT(SentencesOf(diagnosis),
              Contains("Excluded: 23 % of yaw rate, where loose ground may let the machine lag "
                       "behind its tracks."));
}

TEST(Sentence, OfTheNextManoeuvreCountsMechanismsWhereTheyAreMany) {
  NextManoeuvre next;
  for (const char* mechanism : {"sag", "backlash", "dead_band", "rate_limit"}) {
    next.discriminated.push_back({"slew", {mechanism, "nothing"}, false, 0.9});
    EXPECT_THAT(
        SentenceOf(next),
        HasSubstr(next.discriminated.size() < 4 ? "sag" : "would show 4 mechanisms of the slew"));
  }
}

TEST(Sentence, OfEncodersThatRunAheadComesFirst) {
  Diagnosis diagnosis = Of(Block("boom", "excavator1/encoders/boom_radps", "rad/s"));
  diagnosis.encoder_lead_s = 0.1;
  const std::vector<std::string> sentences = SentencesOf(diagnosis);
  EXPECT_THAT(sentences[0], HasSubstr("Encoders run ahead of the levers that move them"));
  EXPECT_THAT(sentences[1], HasSubstr("Nothing found"));
}

/// A block of a delayed joint.
DiagnosedBlock Late(const std::string& joint, double delay_s) {
  DiagnosedBlock made = Block(joint, "excavator1/encoders/" + joint + "_radps", "rad/s");
  made.block.candidates = {{&MechanismOf("command_delay"), joint, {{0, 0, 1}}, {{0.1}}}};
  Finding finding;
  finding.term = {&made.block.candidates[0], {delay_s}};
  finding.parameters = {{"delay_s", "s", delay_s, 0.002}};
  finding.evidence.rivals = {finding.term.candidate};
  made.diagnosis.findings = {finding};
  return made;
}

TEST(Sentence, OfNothingTellsWhatSensorsWereCompared) {
  Diagnosis diagnosis;
  diagnosis.sensors.estimate.channels = {{.name = "m/imu/wx_radps"}, {.name = "m/imu/ax_mps2"}};
  EXPECT_THAT(SentencesOf(diagnosis).front(),
              StartsWith("Nothing found: imu measured a motion that the machine can have."));
  diagnosis.sensors.estimate.channels.push_back({.name = "m/poses/x"});
  EXPECT_THAT(SentencesOf(diagnosis).front(),
              StartsWith("Nothing found: imu and poses agree with each other."));
}

TEST(Sentence, OfASensorWhoseErrorNoNumberExplainsDoesNotSayThatItAgrees) {
  Diagnosis diagnosis;
  diagnosis.sensors.estimate.channels = {
      {.name = "m/imu_arm/wy_radps", .unit = "rad/s", .noise = 0.007, .differences = 0.006},
      {.name = "m/imu_bucket/wy_radps",
       .unit = "rad/s",
       .noise = 0.007,
       .differences = 0.006,
       .motion = 0.5,
       .tolerance = 0.002,
       .rms_after = 0.11}};
  EXPECT_THAT(VerdictsOf(diagnosis), ::testing::ElementsAre(Verdict::kUnexplained));
  EXPECT_THAT(SummaryOf(diagnosis),
              ::testing::StartsWith("In short: nothing named. Unexplained: imu bucket"));
  const std::vector<std::string> sentences = SentencesOf(diagnosis);
  EXPECT_THAT(sentences,
              ::testing::Contains(::testing::HasSubstr("no number of a sensor explains")));
  EXPECT_THAT(sentences, ::testing::Not(::testing::Contains(::testing::HasSubstr("agree with"))));
}

TEST(Sentence, OfMissingInputComesFirst) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.missing_input = {{"excavator1/encoders/arm_radps", "arm", 0.61, false}};
  EXPECT_THAT(
      SentencesOf(diagnosis).front(),
      StartsWith("61 % of the motion of the arm is while its lever rests: input is missing"));
  diagnosis.missing_input.front().is_one_sided = true;
  EXPECT_THAT(SentencesOf(diagnosis).front(),
              StartsWith("61 % of the motion of the arm is against its lever, which the recording "
                         "has to one side alone: input is missing"));
  EXPECT_EQ(VerdictsOf(diagnosis).back(), Verdict::kUntestable);
}

TEST(Sentence, OfTheSameDelayOnAllJointsSaysThatAClockDoesAsWell) {
  Diagnosis diagnosis = Of(Late("boom", 0.08));
  diagnosis.blocks.push_back(Late("arm", 0.085));
  const auto same =
      HasSubstr("All 2 joints and tracks that follow levers ask for a delay of about 0.08");
  EXPECT_THAT(SentencesOf(diagnosis), Contains(same));
  diagnosis.blocks.push_back(Late("bucket", 0.2));
  EXPECT_THAT(SentencesOf(diagnosis), Not(Contains(same)));
  diagnosis.blocks.back().diagnosis.findings.clear();
  EXPECT_THAT(SentencesOf(diagnosis), Not(Contains(same))) << "the bucket is not late";
}

TEST(Sentence, OfTheSameDelayHoldsTheShortestAgainstTheLongest) {
  const auto same = HasSubstr("that follow levers ask for a delay");
  Diagnosis apart = Of(Late("boom", 0.1));  // close to either of two that are not close to each
                                            // other
  apart.blocks.push_back(Late("arm", 0.085));
  EXPECT_THAT(SentencesOf(apart), Contains(same));
  apart.blocks.push_back(Late("bucket", 0.118));
  EXPECT_THAT(SentencesOf(apart), Not(Contains(same)));
  Diagnosis uncertain = Of(Late("boom", 0.05));
  uncertain.blocks.push_back(Late("arm", 0.2));
  for (DiagnosedBlock& block : uncertain.blocks) {
    block.diagnosis.findings[0].parameters[0].sigma = 0.1;
  }
  EXPECT_THAT(SentencesOf(uncertain), Not(Contains(same))) << "to know little is not to agree";
}

TEST(Summary, NamesWhatWasFoundByWhatItActsOnWithItsNumbersFirst) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.findings.push_back(boom.diagnosis.findings[0]);
  Finding& play = boom.diagnosis.findings[1];
  play.term = {&boom.block.candidates[2], {0.01}};
  play.parameters = {{"gap_rad", "rad", 0.01, {}}};
  play.evidence.rivals = {&boom.block.candidates[2], &boom.block.candidates[1]};
  play.held_out.rmse_before = 1 * kDeg;
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  Diagnosis diagnosis = Of(std::move(boom));
  diagnosis.perception.push_back(LidarWithRangeBias());
  for (int k = 0; k < 2; ++k) AddRegion(&diagnosis.perception[0]);
  EXPECT_EQ(SummaryOf(diagnosis),
            "In short: boom: dead band 0.18 ± 0.02 and backlash 0.573 deg (or valve curve); "
            "lidar roof: range bias 0.0500 ± 0.0010 m; ground: terrain height in 2 places. "
            "Unexplained: boom rate.");
}

TEST(Summary, SaysThatNothingIsNamedWhereAllIsUnexplained) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.findings.clear();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  EXPECT_EQ(SummaryOf(Of(std::move(boom))), "In short: nothing named. Unexplained: boom rate.");
}

TEST(Summary, IsEmptyWhereNothingIsWrong) {
  EXPECT_EQ(SummaryOf(Of(Block("boom", "excavator1/encoders/boom_radps", "rad/s"))), "");
}

}  // namespace
}  // namespace tera
