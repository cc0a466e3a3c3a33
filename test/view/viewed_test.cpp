#include "view/viewed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/faults.h"
#include "view/small_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using nlohmann::json;
using testing::HasSubstr;

std::vector<InputFault> Refusal(const std::filesystem::path& path) {
  return FaultsIn([&] { OpenViewed(path); });
}

TEST(Viewed, TellsOfADatasetWhatThePageNeeds) {
  const Viewed viewed = OpenViewed(SmallRecording("told"));
  EXPECT_EQ(viewed.kind, Viewed::Kind::kDataset);
  const json index = json::parse(IndexJson({viewed}))["viewed"][0];
  EXPECT_EQ(index["name"], "told");
  EXPECT_EQ(index["simulated"], false);
  EXPECT_EQ(index["duration_s"], 2.0);
  EXPECT_EQ(index["origin"]["height_m"], 460.0);
  EXPECT_EQ(index["has_stage"], false);
  EXPECT_EQ(index["machines"], json({"digger"}));
  EXPECT_EQ(index["classes"][10]["name"], "truck");
  EXPECT_EQ(index["instances"][0]["name"], "truck");
  const json& commands = index["channels"][0];
  EXPECT_EQ(commands["file"], "digger/commands.csv");
  EXPECT_EQ(commands["form"], "rows");
  EXPECT_EQ(commands["bytes"], std::string("t_ns,boom\n0,0.5\n1000000000,-1\n").size());
  const json& camera = index["channels"][1];
  EXPECT_EQ(camera["form"], "pictures");
  EXPECT_EQ(camera["pictures"], json({"rgb"}));
  EXPECT_EQ(camera["sheet"]["X_PS"], json({1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(camera["sheet"]["lens"]["cx_px"], 3.5);
  EXPECT_EQ(index["channels"][2]["form"], "scans");
}

/// The small recording with an epoch of UTC, in seconds since 1970.
Viewed WithEpoch(const std::string& name, const std::string& since_1970_ns) {
  const std::filesystem::path folder = SmallRecording(name);
  std::string text = ReadWholeFile(folder / "dataset.yaml");
  text += "epoch: {since_1970_ns: \"" + since_1970_ns + "\", clock: utc}\n";
  WriteWholeFile(folder / "dataset.yaml", text);
  return OpenViewed(folder);
}

// Both begin with 2 s of the same yard, the second half a second later.
TEST(Viewed, LaysTheTimesOfTwoDatasetsBesideEachOtherByTheirEpochs) {
  const json index = json::parse(IndexJson(
      {WithEpoch("first", "1700000000000000000"), WithEpoch("second", "1700000000500000001")}));
  EXPECT_FALSE(index["viewed"][0].contains("shift_ns"));
  EXPECT_EQ(index["viewed"][1]["shift_ns"], 500'000'001);
  EXPECT_THAT(index["times"].get<std::string>(), HasSubstr("by the epochs of both, of UTC"));
}

TEST(Viewed, SaysThatTwoDatasetsCannotBeLaidBesideEachOtherByTime) {
  const json index = json::parse(
      IndexJson({WithEpoch("with", "1700000000000000000"), OpenViewed(SmallRecording("without"))}));
  EXPECT_EQ(index["viewed"][1]["shift_ns"], 0);
  EXPECT_THAT(index["times"].get<std::string>(), HasSubstr("without has none"));
}

TEST(Viewed, TellsOfADiagnosisWhatItFoundAndItsFiles) {
  const std::filesystem::path folder = OwnFolder() / "why";
  WriteFileAt(folder / "diagnosis.json", R"({"format": 2, "verdict": ["named"], "findings": []})");
  WriteFileAt(folder / "ground_lidar.tif", "map");
  WriteFileAt(folder / "report.html", "page");
  const Viewed viewed = OpenViewed(folder);
  EXPECT_EQ(viewed.kind, Viewed::Kind::kDiagnosis);
  const json index = json::parse(IndexJson({viewed}))["viewed"][0];
  EXPECT_EQ(index["diagnosis"]["verdict"], json({"named"}));
  EXPECT_EQ(index["grounds"], json({{"ground_lidar.tif", 3}}));
  EXPECT_EQ(index["series"], json::object());
}

TEST(Viewed, RefusesWhatIsNeither) {
  const std::filesystem::path empty = OwnFolder() / "empty", broken = OwnFolder() / "broken";
  std::filesystem::create_directories(empty);
  EXPECT_THAT(Refusal(empty), HasFault(kMalformed, "empty"));
  EXPECT_THAT(Refusal(OwnFolder() / "none"), HasFault(kUnreadable, "none"));
  WriteFileAt(broken / "diagnosis.json", R"({"findings": [)");
  EXPECT_THAT(Refusal(broken), HasFault(kMalformed, "broken/diagnosis.json"));
  WriteFileAt(broken / "diagnosis.json", R"([1, 2])");
  EXPECT_THAT(Refusal(broken), HasFault(kMalformed, "broken/diagnosis.json"));
}

TEST(Viewed, SaysHowToFinishARunThatWasStopped) {
  const std::filesystem::path stopped = OwnFolder() / "run.incomplete";
  WriteFileAt(stopped / "INCOMPLETE.txt", "finish it");
  EXPECT_THAT(Refusal(stopped), HasFault(kMalformed, "run.incomplete"));
}

TEST(Viewed, TakesNoMoreDatasetsThanStandSideBySide) {
  const Viewed one = OpenViewed(SmallRecording("one"));
  EXPECT_NO_THROW(RequireFewDatasets({one, one}));
  EXPECT_THROW(RequireFewDatasets({one, one, one}), InputError);
}

}  // namespace
}  // namespace tera
