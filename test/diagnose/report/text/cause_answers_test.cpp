#include "diagnose/report/text/cause_answers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/report/made_diagnosis.h"
#include "diagnose/report/text/plain_sentence.h"

namespace tera {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The dead band of Complete(), which this recording does not tell from a valve curve.
Diagnosis NotToldApart() {
  Diagnosis diagnosis = Complete();
  Finding& finding = diagnosis.blocks[0].diagnosis.findings[0];
  finding.evidence.rivals.push_back(&diagnosis.blocks[0].block.candidates[1]);
  return diagnosis;
}

TEST(CauseAnswers, OddsAreThoseOfChance) {
  EXPECT_EQ(OddsText(0.004), "1 of 250");
  EXPECT_EQ(OddsText(0.003), "1 of 330");
  EXPECT_EQ(OddsText(1e-7), "fewer than 1 of 10 000");
  EXPECT_EQ(OddsText(0.9), "more than 1 of 2");
}

TEST(CauseAnswers, ACauseWithoutRivalsIsAsSureAsItsProbabilities) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  EXPECT_EQ(HowSureText(CausesOf(diagnosis)[0]),
            "Sure. Chance alone would do as well in 1 of 5000 cases on the driving by which the "
            "cause was chosen, and in 1 of 250 on what was kept back. With its standard deviation: "
            "dead band 0.18 ± 0.02.");
  diagnosis.blocks[0].diagnosis.findings[0].held_out.p = 0.04;
  EXPECT_THAT(HowSureText(CausesOf(diagnosis)[0]), StartsWith("Fairly sure."));
  diagnosis.blocks[0].diagnosis.findings[0].held_out.p = 1e-5;
  EXPECT_THAT(HowSureText(CausesOf(diagnosis)[0]), StartsWith("Very sure."));
}

TEST(CauseAnswers, AClassIsSureOfSomethingAndNotOfWhich) {
  const Diagnosis diagnosis = NotToldApart();
  const Cause cause = CausesOf(diagnosis)[0];
  EXPECT_THAT(HowSureText(cause),
              StartsWith("Sure that something is wrong here, not which of 2 causes it is."));
  EXPECT_EQ(HeadingOf(cause), "Boom: dead band or valve curve");
  EXPECT_EQ(ClassText(cause), "Or it is valve curve: this recording does not tell.");
  EXPECT_EQ(WhatElseText(cause),
            "This recording cannot tell it from: valve curve (a valve that does not open in "
            "proportion to the lever).");
  EXPECT_EQ(WhatToDriveText(cause, diagnosis),
            "The levers in next_manoeuvre.csv (34 s; boom: steps of 0.15) tell dead band and valve "
            "curve apart in 90 of 100 recordings.");
}

TEST(CauseAnswers, SaysWhereNoLeversWouldTell) {
  Diagnosis diagnosis = NotToldApart();
  diagnosis.next.reset();
  EXPECT_THAT(WhatToDriveText(CausesOf(diagnosis)[0], diagnosis),
              HasSubstr("Levers are worked out for joints"));
  // A block has a lever if it has mechanisms of command timing.
  diagnosis.blocks[0].block.candidates[2].mechanism = &MechanismOf("command_delay");
  EXPECT_EQ(WhatToDriveText(CausesOf(diagnosis)[0], diagnosis),
            "No levers were found that would tell these causes apart.");
}

TEST(CauseAnswers, WithoutRivalsTheNearestIsSaidToBeRuledOut) {
  const Diagnosis diagnosis = Of(BoomWithDeadBand());
  const Cause cause = CausesOf(diagnosis)[0];
  EXPECT_EQ(
      WhatElseText(cause),
      "Nothing else that was tried does as well. Nearest comes valve curve (a valve that does "
      "not open in proportion to the lever), which is ruled out: chance would do that in 1 "
      "of 330 cases.");
  EXPECT_EQ(WhatToDriveText(cause, diagnosis),
            "Nothing, for this one: no other cause does as well.");
}

TEST(CauseAnswers, ErrorThatIsLeftIsAWarning) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  const Diagnosis diagnosis = Of(std::move(boom));
  EXPECT_THAT(HowSureText(CausesOf(diagnosis)[0]), HasSubstr("do not trust the number yet"));
}

}  // namespace
}  // namespace tera
