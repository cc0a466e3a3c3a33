#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/faults.h"
#include "core/units.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/suggest/suggest.h"

/// Suggestions for tables; each test runs them.

namespace tera {

class SuggestedTable : public ::testing::Test {
 protected:
  std::string Suggest(const std::string& text, const std::vector<std::string>& overrides = {}) {
    WriteWholeFile(scratch_.path() / "log.csv", text);
    yaml_ = SuggestMapping(scratch_.path() / "log.csv", overrides);
    return yaml_;
  }
  /// The recording that results from a table's suggestion, unchanged.
  Recording Imported(const std::string& text) {
    Suggest(text);
    return Import();
  }
  Recording Import() {
    WriteWholeFile(scratch_.path() / "mapping.yaml", yaml_);
    std::filesystem::remove_all(Out());
    try {
      ImportCsv(scratch_.path() / "mapping.yaml", Out());
    } catch (const InputError& fault) {
      ADD_FAILURE() << fault.what() << "\n" << yaml_;
    }
    return Recording(Out());
  }
  /// Faults of importing a suggestion with open entries.
  std::vector<InputFault> Refusal(const std::string& text) {
    WriteWholeFile(scratch_.path() / "mapping.yaml", Suggest(text));
    std::filesystem::remove_all(Out());
    const auto faults = FaultsIn([&] { ImportCsv(scratch_.path() / "mapping.yaml", Out()); });
    EXPECT_FALSE(faults.empty()) << yaml_;
    EXPECT_FALSE(std::filesystem::exists(Out()));
    return faults;
  }
  EncoderRecording Joints(const std::string& text) {
    return Imported(text).LoadEncoder("machine/joints");
  }
  std::filesystem::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
  std::string yaml_;
};

/// 50 Hz, the boom from 20 degrees on at 5 degrees/s.
inline void ExpectFiftyHertz(const EncoderRecording& joints) {
  ASSERT_EQ(joints.samples.size(), 3u);
  EXPECT_EQ(joints.samples[0].t_ns, 0);
  EXPECT_EQ(joints.samples[2].t_ns, 40'000'000);
  EXPECT_NEAR(joints.samples[0].q_rad[0], 20 * kDeg, 1e-12);
  EXPECT_NEAR(joints.samples[1].qd_radps[0], 5 * kDeg, 1e-9);
}

}  // namespace tera
