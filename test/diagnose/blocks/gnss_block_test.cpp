#include "diagnose/blocks/gnss_block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "diagnose/replay/recorded_receivers.h"
#include "diagnose/search/block/block_diagnosis.h"

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
std::vector<std::string> GnssBlockNamesOf(const BlockDiagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Finding& finding : diagnosis.findings) {
    names.push_back(finding.term.candidate->target + " " +
                    std::string(finding.term.candidate->mechanism->id));
  }
  return names;
}

TEST(GnssBlock, FindsNothingOfReceiversThatAreAsDocumented) {
  const Receivers receivers({}, {});
  const DiagnosedReceivers diagnosis(receivers);
  EXPECT_TRUE(diagnosis.is_testable);
  EXPECT_THAT(GnssBlockNamesOf(diagnosis), IsEmpty());
  EXPECT_THAT(diagnosis.unexplained, IsEmpty());
}

TEST(GnssBlock, NamesAnAntennaThatIsNotWhereItIsDocumented) {
  const Receivers receivers({}, {Named("gnss_lever_arm", {0.3, -0.2, 0})});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(GnssBlockNamesOf(diagnosis), ElementsAre("right gnss_lever_arm"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 0.3, 0.02);
  EXPECT_NEAR(diagnosis.findings[0].parameters[1].value, -0.2, 0.02);
}

TEST(GnssBlock, NamesADatumThatDoesNotTurnWithTheMachine) {
  const Receivers receivers({Named("position_datum", {0.4, -0.7})}, {});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(GnssBlockNamesOf(diagnosis), ElementsAre("left position_datum"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 0.4, 0.02);
  EXPECT_NEAR(diagnosis.findings[0].parameters[1].value, -0.7, 0.02);
}

TEST(GnssBlock, TellsAntennasThatAreSwappedFromTwoThatSitElsewhere) {
  const Receivers receivers({}, {Named("antenna_swap", {})});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(GnssBlockNamesOf(diagnosis), ElementsAre("left antenna_swap"));
  EXPECT_EQ(diagnosis.findings[0].evidence.rivals.size(), 1u);
}

TEST(GnssBlock, NamesAPairThatIsTurned) {
  const Receivers receivers({Named("antenna_yaw", {7})}, {});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(GnssBlockNamesOf(diagnosis), ElementsAre("left antenna_yaw"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 7, 1);
}

TEST(GnssBlock, NamesReflectionsThatComeWithTheBoom) {
  const Receivers receivers({Named("multipath", {0.1, 0.2, 40})}, {});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(GnssBlockNamesOf(diagnosis), ElementsAre("left multipath"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[2].value, 40, 10);
}

TEST(GnssBlock, NamesAClockOfAnotherTimeScale) {
  const Receivers receivers({Named("clock_offset", {18})}, {});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_THAT(GnssBlockNamesOf(diagnosis), ElementsAre("left clock_offset"));
  EXPECT_NEAR(diagnosis.findings[0].parameters[0].value, 18, 0.03);
}

TEST(GnssBlock, NamesAClockThatIsLate) {
  const Receivers receivers({}, {Named("latency", {0.35, 0})});
  const DiagnosedReceivers diagnosis(receivers);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const Finding& late = diagnosis.findings[0];
  EXPECT_EQ(late.term.candidate->target, "right");
  EXPECT_THAT(late.term.candidate->mechanism->id, ::testing::AnyOf("clock_offset", "latency"));
  EXPECT_NEAR(late.parameters[0].value, 0.35, 0.03);
}

/// The samples at `times` their rate, linearly interpolated.
std::vector<GnssSample> Denser(const std::vector<GnssSample>& samples, int times) {
  std::vector<GnssSample> denser;
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    for (int i = 0; i < times; ++i) {
      const double s = static_cast<double>(i) / times;
      GnssSample sample = samples[k];
      sample.t_ns += (samples[k + 1].t_ns - samples[k].t_ns) * i / times;
      sample.enu_m = (1 - s) * samples[k].enu_m + s * samples[k + 1].enu_m;
      denser.push_back(sample);
    }
  }
  return denser;
}

TEST(GnssBlock, LeavesOutPositionsOfTheReceiverAloneThatHasTooMany) {
  Receivers receivers({}, {});
  std::vector<GnssSample> rare;
  for (std::size_t k = 0; k < receivers.samples[0].size(); k += 3) {
    rare.push_back(receivers.samples[0][k]);
  }
  receivers.samples[0] = rare;
  receivers.samples[1] = Denser(receivers.samples[1], 30);
  const auto block = MakeGnssBlock(receivers.sensors, receivers.Log(), "m");
  ASSERT_TRUE(block);
  const auto compared = [&](std::size_t channel) {
    const Mask& valid = block->channels[channel].measured.valid;
    return std::count(valid.begin(), valid.end(), 1);
  };
  // 80 s at 5/3 Hz; the first may come before the machine's first pose.
  EXPECT_NEAR(static_cast<double>(compared(0)), 134, 1);
  EXPECT_NEAR(static_cast<double>(compared(3)), 134, 1);
}

}  // namespace
}  // namespace tera
