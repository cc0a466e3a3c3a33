#include "diagnose/recordings/shared_causes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/report/files/recordings_report.h"
#include "diagnose/report/made_diagnosis.h"

namespace tera {
namespace {

using Kind = CauseInRecording::Kind;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A boom with the three candidates of BoomWithDeadBand. One is named with `number`, others are
/// rivals, and all are detectable at their single start.
Diagnosis Naming(std::size_t named, double number, double sigma,
                 const std::vector<std::size_t>& alike = {}) {
  DiagnosedBlock made = BoomWithDeadBand();
  Finding& finding = made.diagnosis.findings[0];
  finding.term = {&made.block.candidates[named], {number, 0}};
  finding.term.values.resize(made.block.candidates[named].mechanism->parameters.size());
  finding.parameters[0] = {std::string(finding.term.candidate->mechanism->parameters[0].name), "1",
                           number, sigma};
  finding.parameters.resize(finding.term.values.size());
  finding.evidence.rivals = {finding.term.candidate};
  for (const std::size_t one : alike) {
    finding.evidence.rivals.push_back(&made.block.candidates[one]);
  }
  return Of(std::move(made));
}

constexpr std::size_t kDeadBand = 0, kValveCurve = 1, kBacklash = 2;

Diagnosis NamingNothing() {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.blocks[0].diagnosis.findings.clear();
  return diagnosis;
}

std::vector<SharedCause> CausesOfAll(const std::vector<Diagnosis>& all) {
  std::vector<const Diagnosis*> each;
  for (const Diagnosis& one : all) each.push_back(&one);
  return SharedCausesOf(each);
}

std::vector<Diagnosis> Three(Diagnosis a, Diagnosis b, Diagnosis c) {
  std::vector<Diagnosis> all;
  all.push_back(std::move(a));
  all.push_back(std::move(b));
  all.push_back(std::move(c));
  return all;
}

TEST(SharedCauses, OfOneMechanismAreToldOnceWithOneNumber) {
  const auto all = Three(Naming(kDeadBand, 0.10, 0.01), Naming(kDeadBand, 0.11, 0.01),
                         Naming(kDeadBand, 0.12, 0.01));
  const auto causes = CausesOfAll(all);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].mechanism().id, "dead_band");
  EXPECT_EQ(causes[0].Found(), 3u);
  EXPECT_TRUE(causes[0].IsShared());
  ASSERT_EQ(causes[0].numbers.size(), 1u);
  EXPECT_NEAR(causes[0].numbers[0].pooled.value, 0.11, 1e-12);
  EXPECT_FALSE(causes[0].numbers[0].differs);
  EXPECT_THAT(SentenceOf(causes[0]), HasSubstr("Boom: dead band in all 3 recordings, width 0.11"));
  EXPECT_THAT(AnswerText(causes, 3), HasSubstr("1 cause that they share"));
}

TEST(SharedCauses, WithNumbersThatDifferAreNotShared) {
  const auto all = Three(Naming(kDeadBand, 0.10, 0.01), Naming(kDeadBand, 0.30, 0.01),
                         Naming(kDeadBand, 0.12, 0.01));
  const auto causes = CausesOfAll(all);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_TRUE(causes[0].numbers[0].differs);
  EXPECT_GT(causes[0].numbers[0].pooled.between, 0.08);
  EXPECT_FALSE(causes[0].IsShared());
  EXPECT_THAT(SentenceOf(causes[0]), HasSubstr("differs from one to another"));
  EXPECT_THAT(AnswerText(causes, 3), HasSubstr("1 cause that differs from one to another"));
}

TEST(SharedCauses, OfClassesKeepWhatFitsEveryRecording) {
  const auto all = Three(Naming(kDeadBand, 0.10, 0.01, {kValveCurve, kBacklash}),
                         Naming(kValveCurve, 1.4, 0.1, {kDeadBand}),
                         Naming(kDeadBand, 0.12, 0.01, {kValveCurve}));
  const auto causes = CausesOfAll(all);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].mechanism().id, "dead_band");
  ASSERT_EQ(causes[0].rivals.size(), 2u);
  EXPECT_EQ(causes[0].rivals[1]->mechanism->id, "valve_curve");
  EXPECT_EQ(causes[0].recordings[1].kind, Kind::kAsRival);
  EXPECT_THAT(SentenceOf(causes[0]),
              AllOf(HasSubstr("Boom: dead band or valve curve"),
                    HasSubstr("Recording 2: does as well as what is named")));
}

// Each recording names a different mechanism; only a third one fits both.
TEST(SharedCauses, MayBeWhatNoRecordingNames) {
  std::vector<Diagnosis> all;
  all.push_back(Naming(kDeadBand, 0.10, 0.01, {kBacklash}));
  all.push_back(Naming(kValveCurve, 1.4, 0.1, {kBacklash}));
  const auto causes = CausesOfAll(all);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].mechanism().id, "backlash");
  EXPECT_EQ(causes[0].CountOf(Kind::kAsRival), 2u);
  EXPECT_TRUE(causes[0].numbers.empty());
}

TEST(SharedCauses, OfNothingInCommonAreTwo) {
  std::vector<Diagnosis> all;
  all.push_back(Naming(kDeadBand, 0.10, 0.01));
  all.push_back(Naming(kValveCurve, 1.4, 0.1));
  EXPECT_EQ(CausesOfAll(all).size(), 2u);
}

// A dead band is detectable from 0.03 on, with a ladder of 0.1 and 0.3. A band of 0.3 would have
// been detected if the smallest detectable start is 0.1. It would not if that is 0.3 and the number
// 0.1.
TEST(SharedCauses, AreAbsentOnlyWhereTheyWouldHaveShown) {
  const auto kind_of = [](double number, std::optional<double> smallest) {
    Diagnosis without = NamingNothing();
    Candidate& dead_band = without.blocks[0].block.candidates[kDeadBand];
    dead_band.starts = {{0.1, 0}, {0.3, 0}};
    without.blocks[0].diagnosis.detectability = {{&dead_band, smallest}};
    std::vector<Diagnosis> all;
    all.push_back(Naming(kDeadBand, number, 0.01));
    all.push_back(std::move(without));
    return CausesOfAll(all)[0].recordings[1].kind;
  };
  EXPECT_EQ(kind_of(0.3, 0.1), Kind::kAbsent);
  EXPECT_EQ(kind_of(0.1, 0.3), Kind::kTooFaint);
  EXPECT_EQ(kind_of(0.1, std::nullopt), Kind::kTooFaint);
}

TEST(SharedCauses, OfABlockThatWasNotJudgedAreNotCompared) {
  Diagnosis without = NamingNothing();
  without.blocks[0].diagnosis.is_testable = false;
  std::vector<Diagnosis> all;
  all.push_back(Naming(kDeadBand, 0.1, 0.01));
  all.push_back(std::move(without));
  EXPECT_EQ(CausesOfAll(all)[0].recordings[1].kind, Kind::kNotCompared);
}

TEST(SharedCauses, WithinToleranceInOneRecordingAreNotShared) {
  Diagnosis within = Naming(kDeadBand, 0.01, 0.002);
  BlockDiagnosis& block = within.blocks[0].diagnosis;
  block.within_tolerance = std::move(block.findings);
  block.findings.clear();
  std::vector<Diagnosis> all;
  all.push_back(Naming(kDeadBand, 0.2, 0.01));
  all.push_back(std::move(within));
  const auto causes = CausesOfAll(all);
  EXPECT_EQ(causes[0].recordings[1].kind, Kind::kWithinTolerance);
  EXPECT_FALSE(causes[0].IsShared());
}

TEST(SharedCauses, LeaveOutWhatDiffersInTheScene) {
  Diagnosis seen = NamingNothing();
  seen.perception.push_back(LidarWithRangeBias());
  AddRegion(&seen.perception[0]);
  std::vector<Diagnosis> all;
  all.push_back(std::move(seen));
  const auto causes = CausesOfAll(all);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].target(), "lidar_roof");
}

TEST(RecordingsPage, SaysTheAnswerFirstAndEscapesNames) {
  const auto all = Three(Naming(kDeadBand, 0.10, 0.01), NamingNothing(), NamingNothing());
  const auto causes = CausesOfAll(all);
  const std::string page = RecordingsPage(
      "a<b", {{"one & only", "x", &all[0]}, {"2", "y", &all[1]}, {"3", "z", &all[2]}}, causes);
  EXPECT_THAT(page, AllOf(HasSubstr("a&lt;b"), HasSubstr("one &amp; only"), Not(HasSubstr("a<b"))));
  EXPECT_LT(page.find("class='answer'"), page.find("<table"));
}

}  // namespace
}  // namespace tera
