#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "app/perceived_site.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Json = nlohmann::json;

/// Value of a GeoTIFF, by GDAL's own program.
double ValueAt(const std::filesystem::path& file, double x_m, double y_m) {
  const std::string command =
      fmt::format("gdallocationinfo -valonly -geoloc {} {} {}", file.string(), x_m, y_m);
  FILE* pipe = popen(command.c_str(), "r");
  double value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(std::fscanf(pipe, "%lf", &value), 1) << command;
  pclose(pipe);
  return value;
}

TEST_F(PerceivedSite, ALidarOfAnotherRangeIsNamedAndItsOverlayLeavesNothing) {
  Record({"--set", "effects.mast1.lidar.range_bias.range_m=0.06"});
  const Json json = Diagnosed();
  ASSERT_EQ(json["findings"].size(), 1u) << json;
  EXPECT_EQ(json["verdict"][0], "named");
  const Json& finding = json["findings"][0];
  EXPECT_EQ(finding["channel"], "mast1/lidar");
  EXPECT_EQ(finding["mechanism"], "range_bias");
  EXPECT_EQ(finding["target"], "lidar");
  EXPECT_NEAR(finding["parameters"]["range_m"]["value"].get<double>(), 0.06, 0.003);
  EXPECT_THAT(Read("why/effects.yaml"), HasSubstr("range_bias: {range_m: 0.0"));
  const Outcome again =
      Run({"diagnose", "site.yaml", "real", "--effects", "why/effects.yaml", "--out", "nothing"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("nothing found"));
  EXPECT_TRUE(Json::parse(Read("nothing/diagnosis.json"))["findings"].empty());
}

TEST_F(PerceivedSite, APitThatTheScenarioHasNotIsOnTheMap) {
  Record({"--set",
          "terrain.pits=[{outline_m: [[2, -6], [5, -6], [5, -4.5], [2, -4.5]], "
          "depth_m: 0.5}]"});
  const Json json = Diagnosed();
  ASSERT_EQ(json["findings"].size(), 1u) << json;
  const Json& finding = json["findings"][0];
  EXPECT_EQ(finding["mechanism"], "terrain_height");
  EXPECT_EQ(finding["target"], "ground");
  EXPECT_NEAR(finding["place"]["centre_m"][0].get<double>(), 3.5, 0.4);
  EXPECT_NEAR(finding["place"]["centre_m"][1].get<double>(), -5.25, 0.4);
  EXPECT_NEAR(finding["parameters"]["lowest_m"]["value"].get<double>(), -0.5, 0.1);
  EXPECT_THAT(Read("why/report.html"), HasSubstr("Measured ground over simulated ground"));
  EXPECT_NEAR(ValueAt(scratch_.path() / "why/ground_lidar.tif", 3.4, -5.3), -0.5, 0.1);
  EXPECT_NEAR(ValueAt(scratch_.path() / "why/ground_lidar.tif", 3.4, -3.4), 0, 0.03);
}

TEST_F(PerceivedSite, ATruckThatStandsElsewhereIsMissingHereAndAddedThere) {
  Record({"--set", "obstacles[1].xy_m=[7, 5.5]"});
  const Json json = Diagnosed();
  bool missing = false, added = false;
  for (const Json& finding : json["findings"]) {
    missing =
        missing || (finding["mechanism"] == "object_missing" && finding["target"] == "truck1");
    if (finding["mechanism"] == "object_added") {
      added = added || std::hypot(finding["place"]["centre_m"][0].get<double>() - 7,
                                  finding["place"]["centre_m"][1].get<double>() - 5.5) < 2;
    }
    EXPECT_NE(finding["mechanism"], "terrain_height") << finding;
    EXPECT_NE(finding["target"], "lidar") << finding;
  }
  EXPECT_TRUE(missing) << json["findings"];
  EXPECT_TRUE(added) << json["findings"];
}

TEST_F(PerceivedSite, AsDescribedGivesNoFinding) {
  Record();
  const Json json = Diagnosed();
  EXPECT_TRUE(json["findings"].empty()) << json;
  EXPECT_EQ(json["verdict"][0], "none");
}

TEST_F(PerceivedSite, ALidarOfOtherBeamsIsNotJudgedAndToldWhy) {
  Record();
  Write("site.yaml", Edited(Edited(Read("site.yaml"), "rate_hz: 2,",
                                   "rate_hz: 2, elevation_deg: "
                                   "[15, 5, -5, -15],"),
                            "firing_offset_us: [0, 0, 0, 0, 0, 0, 0, 0,\n           0, 0, 0, 0, 0, "
                            "0, 0, 0]",
                            "firing_offset_us: [0, 0, 0, 0]"));
  const Outcome outcome = Run({"diagnose", "site.yaml", "real", "--out", "why"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("not judged"), HasSubstr("4 beams")));
  EXPECT_EQ(Json::parse(Read("why/diagnosis.json"))["not_judged"][0], "mast1/lidar");
}

TEST_F(PerceivedSite, ATruncatedScanIsOneErrorAndNoReport) {
  Record();
  const std::filesystem::path scan = scratch_.path() / "real/mast1/lidar/scans/0.pcd";
  std::filesystem::resize_file(scan, std::filesystem::file_size(scan) / 2);
  const Outcome outcome = Run({"diagnose", "site.yaml", "real", "--out", "why"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("0.pcd"), HasSubstr("truncated")));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "why"));
}

}  // namespace
}  // namespace tera
