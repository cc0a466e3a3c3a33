#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "app/diagnosed_scenario.h"

namespace tera {
namespace {

using testing::ElementsAre;

/// A machine on hard ground with two receivers, without recorded poses.
class DiagnoseWithoutPoses : public DiagnoseByScenario {
 protected:
  DiagnoseWithoutPoses() {
    Write("levers.csv", TrackLevers());
    Write("library.yaml", "only: [track_scale, track_asymmetry, effective_gauge, icr_shift]\n");
    Write("scenario.yaml", R"(
name: drive
duration_s: 61
terrain: {size_m: [40, 40], cell_m: 0.2, soil: asphalt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    ground: kinematic
    start: {joints_deg: {boom: 55, arm: -130, bucket: -40, blade: 20}}
    operator: {type: lever_replay, csv: levers.csv, time_column: t_s}
    rig:
      sensors:
        - {name: encoders, preset: tera:config/sensors/encoder.yaml, joints: [left_track, right_track]}
        - {name: unit, preset: tera:config/sensors/xsens_mti_670.yaml, link: undercarriage}
        - {name: left, preset: tera:config/sensors/rtk_f9p.yaml, link: undercarriage, xyz_m: [0, 0.5, 1.5]}
        - {name: right, preset: tera:config/sensors/rtk_f9p.yaml, link: undercarriage, xyz_m: [0, -0.5, 1.5]}
)");
  }
  /// A recording of the scenario with these settings, without truth.
  void RecordMeasurements(const std::string& out, const Arguments& more) const {
    Record(out, more);
    RemoveTruth(folder() / out);
  }
};

TEST_F(DiagnoseWithoutPoses, ReceiversShowHowTheBaseMoves) {
  RecordMeasurements("real", {"--set", "effects.excavator1.base.effective_gauge.ratio=1.4"});
  EXPECT_THAT(Diagnose("real", "why", {"--no-simulation"}), ElementsAre("effective_gauge"));
  const Json report = Report("why");
  const Json& ratio = report["findings"][0]["parameters"]["ratio"];
  EXPECT_NEAR(ratio["value"].get<double>(), 1.4, 0.05);
}

TEST_F(DiagnoseWithoutPoses, NothingIsSaidOfABaseThatMovesAsItsScenarioSays) {
  RecordMeasurements("real", {});
  EXPECT_THAT(Diagnose("real", "why", {"--no-simulation"}), ElementsAre());
  bool is_compared = false;
  const Json report = Report("why");
  for (const Json& channel : report["channels"]) {
    is_compared = is_compared || channel["channel"] == "excavator1/base/yaw_radps";
  }
  EXPECT_TRUE(is_compared);
}

// Tracks are measured, and a single receiver does not give the machine's heading.
TEST_F(DiagnoseWithoutPoses, ABaseWhoseMotionIsNotKnownIsSaidNotToBeCompared) {
  Write("library.yaml", "only: [rate_gain]\n");  // of the tracks, which are compared
  RecordMeasurements("real", {});
  for (const char* gone : {"unit", "right"}) {
    std::filesystem::remove_all(folder() / "real/excavator1" / gone);
  }
  std::ifstream file(folder() / "real/dataset.yaml");
  std::string kept;
  for (std::string line; std::getline(file, line);) {
    const bool is_gone =
        line.find("excavator1/unit") != line.npos || line.find("excavator1/right") != line.npos;
    if (!is_gone) kept += line + '\n';
  }
  Write("real/dataset.yaml", kept);
  EXPECT_THAT(Diagnose("real", "why", {"--no-simulation"}), ElementsAre());
  EXPECT_THAT(Report("why")["not_compared"].dump(),
              testing::HasSubstr("excavator1/base: its motion is not known"));
}

}  // namespace
}  // namespace tera
