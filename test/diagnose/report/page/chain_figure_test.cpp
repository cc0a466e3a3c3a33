#include "diagnose/report/page/chain_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/report/made_diagnosis.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Entry = ChainStage::Entry;

enum { kLever, kValve, kPump, kJoint, kGround, kSensor };

TEST(ChainFigure, ACauseStandsWhereItsMechanismActs) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.perception.push_back(LidarWithRangeBias());
  AddRegion(&diagnosis.perception[0]);
  const auto chain = ChainOf(diagnosis);
  EXPECT_THAT(chain[kValve].entries, ElementsAre(Entry{true, "boom: dead band"}));
  EXPECT_THAT(chain[kGround].entries, ElementsAre(Entry{true, "ground: height of the ground"}));
  EXPECT_THAT(chain[kSensor].entries, ElementsAre(Entry{true, "lidar roof: constant range error"}));
  EXPECT_THAT(chain[kLever].entries, IsEmpty());
}

// Dead band and valve curve are of the valve, play of the joint.
TEST(ChainFigure, WhatIsNotToldApartStandsWhereItWouldAct) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  DiagnosedBlock& boom = diagnosis.blocks[0];
  std::vector<const Candidate*>& rivals = boom.diagnosis.findings[0].evidence.rivals;
  for (const int other : {1, 2}) rivals.push_back(&boom.block.candidates[other]);
  const auto chain = ChainOf(diagnosis);
  EXPECT_THAT(chain[kValve].entries, ElementsAre(Entry{true, "boom: dead band or 1 other"}));
  EXPECT_THAT(chain[kJoint].entries, ElementsAre(Entry{false, "boom: backlash"}));
}

// The candidates of the made boom are a dead band, a valve curve and play.
TEST(ChainFigure, WhatHasNoCandidateOfAJudgedBlockWasNotCompared) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  auto chain = ChainOf(diagnosis);
  EXPECT_THAT(chain[kValve].compared, ElementsAre("boom"));
  EXPECT_THAT(chain[kJoint].compared, ElementsAre("boom"));
  for (const int stage : {kLever, kPump, kGround, kSensor}) {
    EXPECT_THAT(chain[stage].compared, IsEmpty());
  }
  diagnosis.blocks[0].diagnosis.is_testable = false;
  EXPECT_THAT(ChainOf(diagnosis)[kValve].compared, IsEmpty());
}

TEST(ChainFigure, UnexplainedErrorStandsWhereItWasMeasured) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  Diagnosis diagnosis = Of(std::move(boom));
  EXPECT_THAT(ChainOf(diagnosis)[kJoint].entries,
              ElementsAre(Entry{false, "boom rate: unexplained"}));
  diagnosis.blocks[0].block.candidates = {{&MechanismOf("track_scale"), "base", {}, {}}};
  diagnosis.blocks[0].diagnosis.findings.clear();
  EXPECT_THAT(ChainOf(diagnosis)[kGround].entries,
              ElementsAre(Entry{false, "boom rate: unexplained"}));
}

TEST(ChainFigure, MissingInputStandsAtTheLeverAndAClockAtTheSensor) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.missing_input = {{"excavator1/encoders/left_arm_radps", "left_arm", 0.6, false}};
  diagnosis.encoder_lead_s = 0.104;
  const auto chain = ChainOf(diagnosis);
  EXPECT_THAT(chain[kLever].entries, ElementsAre(Entry{false, "left arm: input missing"}));
  EXPECT_THAT(chain[kSensor].entries, ElementsAre(Entry{true, "encoders: clock 0.1 s ahead"}));
}

TEST(ChainFigure, SaysByFrameAndSignWhatABoxIs) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  const std::string figure = ChainFigure(Of(std::move(boom)));
  EXPECT_THAT(figure,
              HasSubstr("<li class='wrong'><b>Valve</b><p><b class='sign wrong'>!</b> boom: "
                        "dead band</p></li>"));
  EXPECT_THAT(figure,
              HasSubstr("<li class='open'><b>Drive, joint</b><p><b class='sign open'>?</b>"));
  EXPECT_THAT(figure, HasSubstr("<li class='idle'><b>Ground</b>"));
}

TEST(ChainFigure, CutsALongListShort) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  for (int k = 0; k < 20; ++k) {
    diagnosis.missing_input.push_back({"", "axis_" + std::to_string(k), 0.5, false});
  }
  EXPECT_THAT(ChainFigure(diagnosis), HasSubstr("<p>and 16 more</p>"));
}

}  // namespace
}  // namespace tera
