#include "blind/marking/improvement.h"

#include <gtest/gtest.h>

#include <fstream>

#include "blind/marking/table.h"
#include "core/error.h"
#include "own_folder.h"

namespace tera::blind {
namespace {

constexpr const char* kBoom = "digger/encoders/boom_radps";

/// A dead band in the boom, whose encoder's noise is 3 (in any unit).
struct Hidden {
  Hidden() {
    c.kind = CaseKind::kOne;
    c.hidden = {{.target = "boom", .name = "dead_band", .channels = {"encoders/boom_radps"}}};
    recording.noise_rms[kBoom] = 3;
  }
  BenchmarkCase c;
  CaseRecording recording;
};

TEST(Improvement, IsTheShareOfMeanSquareBeyondNoiseThatGoes) {
  const Hidden hidden;
  // 5^2 - 4^2 of 5^2 - 3^2.
  EXPECT_DOUBLE_EQ(*ShareOfOracle(hidden.c, hidden.recording, {{kBoom, 5}}, {{kBoom, 4}}),
                   9.0 / 16);
  EXPECT_LT(*ShareOfOracle(hidden.c, hidden.recording, {{kBoom, 5}}, {{kBoom, 6}}), 0);
}

TEST(Improvement, IsNoneWhereNothingIsToBeGained) {
  const Hidden hidden;
  EXPECT_FALSE(ShareOfOracle(hidden.c, hidden.recording, {{kBoom, 4}}, {{kBoom, 3}}));
  EXPECT_FALSE(ShareOfOracle(hidden.c, hidden.recording, {{"digger/other", 9}}, {}));
}

TEST(Improvement, OfMethodsStandsInTheirTable) {
  const Hidden hidden;
  const BaselineAnswers answers{
      {{kBoom, 5}},
      {{"tuned", false, false, false, {}, {{kBoom, 5}}},
       {"greedy", true, true, true, {{"dead_band", "boom"}}, {{kBoom, 3}}},
       {"wrong", true, true, true, {{"dead_band", "arm"}}, {{kBoom, 4}}}}};
  Mark mark;
  mark.kind = CaseKind::kOne;
  mark.methods = MarkMethods(hidden.c, hidden.recording, answers);
  ASSERT_EQ(mark.methods.size(), 3u);
  EXPECT_TRUE(mark.methods[1].right_first);
  EXPECT_FALSE(mark.methods[2].right_first) << "the right name of another joint";
  Mark nothing;
  nothing.methods = mark.methods;
  const std::vector<MethodRow> rows = MethodsOf({mark, nothing});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_FALSE(rows[1].false_alarm) << "tuning says nothing";
  EXPECT_EQ(rows[2].false_alarm->hits, 1);
  EXPECT_EQ(rows[2].false_alarm->cases, 1);
  EXPECT_EQ(rows[2].right_first->hits, 1);
  EXPECT_EQ(rows[3].right_first->hits, 0);
  EXPECT_DOUBLE_EQ(rows[2].shares.front(), 1);
}

TEST(Improvement, NoiseIsWhatMeasuringAdds) {
  BenchmarkCase c = DrawCase(4, 1, PlainMachine::Read("config/machines/tb235.yaml"), 26);
  while (!c.joints) {
    c = DrawCase(4, c.number + 1, PlainMachine::Read("config/machines/tb235.yaml"), 26);
  }
  const EncoderNoise& noise = c.joints->noise;
  const CaseRecording recording = Record(&c, 4);
  // Coloured part, engine's line, and the outliers of ten times the coloured part; heavy tails
  // leave the variance of some thousand samples uncertain by a tenth.
  const double variance = noise.rate_radps * noise.rate_radps * (1 + 100 * noise.outlier) +
                          noise.engine_radps * noise.engine_radps / 2;
  ASSERT_EQ(recording.noise_rms.size(), c.joints->measured.size());
  for (const auto& [channel, rms] : recording.noise_rms) {
    EXPECT_NEAR(rms * rms / variance, 1, 0.3) << channel;
  }
}

TEST(BaselineAnswers, ThatAreNoneAreRefusedWithTheirPlace) {
  const auto file = OwnFolder() / "baselines.json";
  std::ofstream(file) << R"({"as_it_is": {}})";
  try {
    ReadBaselines(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("baselines.json"), std::string::npos);
  }
}

}  // namespace
}  // namespace tera::blind
