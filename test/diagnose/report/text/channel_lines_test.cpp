#include "diagnose/report/text/channel_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/report/made_diagnosis.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ChannelLines, TellWhatExplainsAChannelAndWhatIsLeftOfEach) {
  Diagnosis diagnosis{"excavator1", "excavator1", {}};
  diagnosis.blocks.push_back(BoomWithDeadBand());
  diagnosis.blocks.push_back(Block("arm", "excavator1/encoders/arm_radps", "rad/s"));
  DiagnosedBlock& arm = diagnosis.blocks.back();
  arm.diagnosis.unexplained = {{}};
  const std::vector<ChannelLine> lines = ChannelLines(diagnosis);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].channel, "excavator1/encoders/boom_radps");
  EXPECT_THAT(lines[0].explained_by, ElementsAre("dead_band"));
  EXPECT_EQ(lines[0].left, "noise");
  EXPECT_THAT(lines[1].explained_by, IsEmpty());
  EXPECT_EQ(lines[1].left, "unexplained error");
}

// A measurement of 1, 2, 3, 4 and a missing sample: RMS sqrt(30 / 4), about its mean of 2.5 sqrt(5
// / 4). The simulation is constantly 1 and errs by sqrt(14 / 4).
TEST(ChannelLines, CountWhatWasMeasuredAlone) {
  Diagnosis diagnosis{"excavator1", "excavator1", {}};
  diagnosis.blocks.push_back(Block("arm", "excavator1/encoders/arm_radps", "rad/s"));
  ReplayBlock& block = diagnosis.blocks[0].block;
  block.channels[0].measured = {0.5, {1, 2, 3, 4, 100}, {1, 1, 1, 1, 0}};
  block.replay = WholeReplay([](const Structure&) {
    return std::vector<std::vector<double>>{std::vector<double>(5, 1.0)};
  });
  const ChannelLine line = ChannelLines(diagnosis)[0];
  EXPECT_NEAR(line.rms.value(), std::sqrt(7.5), 1e-12);
  EXPECT_NEAR(line.motion.value(), std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(line.rmse.value(), std::sqrt(3.5), 1e-12);
}

TEST(ChannelLines, SayWhyAChannelWasNotJudged) {
  Diagnosis diagnosis{"excavator1", "excavator1", {}};
  diagnosis.blocks.push_back(Block("arm", "excavator1/encoders/arm_radps", "rad/s"));
  diagnosis.blocks[0].diagnosis.is_testable = false;
  EXPECT_EQ(ChannelLines(diagnosis)[0].left, "not judged: too few manoeuvres");
  diagnosis.blocks[0].diagnosis.out_of_time = true;
  EXPECT_EQ(ChannelLines(diagnosis)[0].left, "not judged: the time was over");
}

}  // namespace
}  // namespace tera
