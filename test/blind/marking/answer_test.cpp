#include "blind/marking/answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "core/error.h"
#include "own_folder.h"

namespace tera::blind {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

/// The diagnosis of a boom with a dead band, without the keys that follow the brace.
constexpr const char* kRest = R"(
  "verdict": ["named", "untestable"],
  "findings": [
    {
      "channel": "digger/encoders/boom_radps",
      "intervals_s": [[41.5, 63.0]],
      "regime": {"variable": "lever/boom", "low": -0.18, "high": 0.18, "shape": "odd threshold"},
      "mechanism": "dead_band",
      "slot": "lever_map",
      "target": "boom",
      "parameters": {"width": {"value": 0.18, "sigma": 0.02, "unit": "1"}},
      "class": [],
      "confidence": 0.99
    }
  ],
  "held_out": [{"channel": "digger/encoders/boom_radps", "rmse_before": 0.05, "rmse_after": 0.01}],
  "untestable": [{"mechanism": "backlash", "target": "boom"}]
})";

Answer ReadText(const std::string& text) {
  const auto file = OwnFolder() / "diagnosis.json";
  std::ofstream(file) << text;
  return ReadAnswer(file);
}

void ExpectTheDeadBand(const Answer& answer) {
  EXPECT_THAT(answer.verdicts, ElementsAre("named", "untestable"));
  ASSERT_EQ(answer.findings.size(), 1u);
  const Finding& finding = answer.findings.front();
  EXPECT_EQ(finding.mechanism, "dead_band");
  EXPECT_EQ(finding.variable, "lever/boom");
  EXPECT_THAT(finding.intervals_s, ElementsAre(Pair(41.5, 63.0)));
  EXPECT_EQ(finding.parameters.at("width").sigma, 0.02);
  EXPECT_THAT(answer.untestable, ElementsAre(Pair("backlash", "boom")));
  EXPECT_THAT(answer.rmse_after, ElementsAre(Pair("digger/encoders/boom_radps", 0.01)));
}

TEST(Answer, OfFormat2IsRead) {
  ExpectTheDeadBand(ReadText(R"({"format": 2, "proxies": [], "excluded_samples": [],
  "discrepancy_correction": [],)" +
                             std::string(kRest)));
}

/// Form before the numbering of formats.
TEST(Answer, OfFormat1IsRead) {
  ExpectTheDeadBand(
      ReadText(R"({"stand_ins": [], "left_out": [], "taken_off": [],)" + std::string(kRest)));
}

TEST(Answer, OfALaterFormatIsRefused) {
  try {
    ReadText(R"({"format": 3,)" + std::string(kRest));
    FAIL() << "format 3 was read";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("diagnosis.json: format 3; need 1 to 2"));
  }
}

}  // namespace
}  // namespace tera::blind
