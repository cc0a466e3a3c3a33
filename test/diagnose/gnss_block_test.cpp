#include "diagnose/blocks/gnss_block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/recorded_receivers.h"
#include "diagnose/search/block_diagnosis.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The findings point into the block.
struct DiagnosedReceivers : BlockDiagnosis {
  explicit DiagnosedReceivers(const Receivers& receivers)
      : block(*MakeGnssBlock(receivers.sensors, receivers.Log(), "m")) {
    static_cast<BlockDiagnosis&>(*this) = DiagnoseBlock(block, {}, Stream(1, "diagnose"));
  }
  ReplayBlock block;
};

/// "left gnss_lever_arm".
std::vector<std::string> NamesOf(const BlockDiagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Finding& finding : diagnosis.findings) {
    names.push_back(finding.term.suspect->target + " " +
                    std::string(finding.term.suspect->mechanism->id));
  }
  return names;
}

TEST(GnssBlock, FindsNothingOfReceiversThatAreAsDocumented) {
  const Receivers receivers({}, {});
  const DiagnosedReceivers diagnosis(receivers);
  EXPECT_TRUE(diagnosis.is_testable);
  EXPECT_THAT(NamesOf(diagnosis), IsEmpty());
  EXPECT_THAT(diagnosis.unexplained, IsEmpty());
}

TEST(GnssBlock, NamesAnAntennaThatIsNotWhereItIsDocumented) {
  const Receivers receivers({}, {Named("gnss_lever_arm", {0.3, -0.2, 0})});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(NamesOf(diagnosis), ElementsAre("right gnss_lever_arm"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 0.3, 0.02);
  EXPECT_NEAR(diagnosis.findings[0].parameters[1].value, -0.2, 0.02);
}

TEST(GnssBlock, NamesADatumThatDoesNotTurnWithTheMachine) {
  const Receivers receivers({Named("position_datum", {0.4, -0.7})}, {});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(NamesOf(diagnosis), ElementsAre("left position_datum"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 0.4, 0.02);
  EXPECT_NEAR(diagnosis.findings[0].parameters[1].value, -0.7, 0.02);
}

TEST(GnssBlock, TellsAntennasThatAreSwappedFromTwoThatSitElsewhere) {
  const Receivers receivers({}, {Named("antenna_swap", {})});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(NamesOf(diagnosis), ElementsAre("left antenna_swap"));
  EXPECT_EQ(diagnosis.findings[0].evidence.rivals.size(), 1u);
}

TEST(GnssBlock, NamesAPairThatIsTurned) {
  const Receivers receivers({Named("antenna_yaw", {7})}, {});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(NamesOf(diagnosis), ElementsAre("left antenna_yaw"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 7, 1);
}

TEST(GnssBlock, NamesReflectionsThatComeWithTheBoom) {
  const Receivers receivers({Named("multipath", {0.1, 0.2, 40})}, {});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(NamesOf(diagnosis), ElementsAre("left multipath"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[2].value, 40, 10);
}

TEST(GnssBlock, NamesAClockOfAnotherTimeScale) {
  const Receivers receivers({Named("clock_offset", {18})}, {});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(NamesOf(diagnosis), ElementsAre("left clock_offset"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 18, 0.03);
}

TEST(GnssBlock, NamesAClockThatIsLate) {
  const Receivers receivers({}, {Named("latency", {0.35, 0})});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const Finding& late = diagnosis.findings[0];
  EXPECT_EQ(late.term.suspect->target, "right");
  EXPECT_THAT(late.term.suspect->mechanism->id, ::testing::AnyOf("clock_offset", "latency"));
  EXPECT_NEAR(late.parameters[0].value, 0.35, 0.03);
}

}  // namespace
}  // namespace tera
