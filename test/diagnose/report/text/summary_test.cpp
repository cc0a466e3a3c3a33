#include "diagnose/report/text/summary.h"

#include <gtest/gtest.h>

#include "diagnose/report/made_diagnosis.h"

namespace tera {
namespace {

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
