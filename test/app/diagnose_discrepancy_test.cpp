#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "app/diagnosed_scenario.h"

namespace tera {
namespace {

/// Boom, arm and bucket simultaneously at full levers, up and down, 60 s.
std::string FullLevers() {
  std::ostringstream csv;
  csv << "t_s,boom,arm,bucket\n0,0,0,0\n";
  double t_s = 1;
  for (int k = 0; t_s < 57; ++k) {
    const int boom = k % 2 == 0 ? 1 : -1, arm = k % 3 == 0 ? 1 : -1, bucket = k % 5 < 2 ? 1 : -1;
    const double hold_s = 0.4 + 0.2 * (k % 3);
    for (const int way : {1, -1}) {
      csv << t_s << ',' << way * boom << ',' << way * arm << ',' << way * bucket << '\n';
      csv << t_s + hold_s << ",0,0,0\n";
      t_s += hold_s + 0.7;
    }
  }
  return csv.str();
}

/// An excavator on dirt that shears under its tracks.
class DiagnoseOnSoil : public DiagnoseByScenario {
 protected:
  DiagnoseOnSoil() {
    Write("levers.csv", TrackLevers());
    Write("library.yaml", "only: [track_scale, track_asymmetry, effective_gauge, icr_shift]\n");
    Write("scenario.yaml", R"(
name: drive
duration_s: 61
terrain: {size_m: [40, 40], cell_m: 0.2, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 55, arm: -130, bucket: -40, blade: 20}}
    operator: {type: lever_replay, csv: levers.csv, time_column: t_s}
    rig: {sensors: [{name: encoders, preset: tera:config/sensors/encoder.yaml,
                     joints: [left_track, right_track]}]}
)");
  }
};

TEST_F(DiagnoseOnSoil, SaysNothingOfARecordingThatIsAsItsScenario) {
  Record("real");
  EXPECT_EQ(Diagnose("real", "why"), Names{});
  bool yaw_is_corrected = false;
  const Json report = Report("why");
  for (const Json& one : report["discrepancy_corrections"]) {
    if (one["channel"] == "excavator1/base/yaw_radps") yaw_is_corrected = one["applied"];
  }
  EXPECT_TRUE(yaw_is_corrected);
  // Soil slows tracks in turns: without a simulation, that resembles a wider gauge.
  const Names alone = Diagnose("real", "alone", {"--no-simulation"});
  ASSERT_FALSE(alone.empty());
  EXPECT_EQ(alone[0], "effective_gauge");
}

TEST_F(DiagnoseOnSoil, TakesNothingFromASimulationOfAnotherDrive) {
  // Driven by hand: the tracks move while the recorded levers rest and a simulation under them
  // stands.
  Record("real");
  Write("real/excavator1/commands.csv",
        "t_ns,left_track,right_track,slew,swing,boom,arm,bucket,blade\n0,0,0,0,0,0,0,0,0\n");
  Diagnose("real", "why");
  const Json report = Report("why");
  EXPECT_EQ(report["missing_input"].size(), 2u);
  ASSERT_GT(report["discrepancy_corrections"].size(), 0u);
  for (const Json& one : report["discrepancy_corrections"]) {
    EXPECT_FALSE(one["applied"].get<bool>()) << one["channel"];
  }
}

TEST_F(DiagnoseOnSoil, NamesAWrongRadiusOfTheSprocketsAndSimulatesIt) {
  Record("real", {"--set", "effects.excavator1.base.track_scale.scale=0.85"});
  EXPECT_EQ(Diagnose("real", "why"), Names{"track_scale"});
  const Json report = Report("why");
  const Json& finding = report["findings"][0];
  EXPECT_NEAR(finding["parameters"]["scale"]["value"].get<double>(), 0.85, 0.03);
  EXPECT_GT(finding["held_out"]["excess_variance_removed"].get<double>(), 0.7);
  const Json& whole = report["whole_simulation"]["channels"][0];
  EXPECT_LT(whole["rmse_after"].get<double>(), 0.5 * whole["rmse_before"].get<double>());
}

/// Joints in the air that pull on each other.
class DiagnoseFullLevers : public DiagnoseByScenario {
 protected:
  DiagnoseFullLevers() {
    Write("levers.csv", FullLevers());
    Write("library.yaml", "only: [dead_band, rate_gain]\n");
    Write("scenario.yaml", R"(
name: several
duration_s: 60
terrain: {size_m: [16, 16], cell_m: 0.2, soil: asphalt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 45, arm: -90, bucket: -40, blade: 20}}
    operator: {type: lever_replay, csv: levers.csv, time_column: t_s}
    rig: {sensors: [{name: encoders, preset: tera:config/sensors/encoder.yaml, joints: [boom, arm, bucket]}]}
)");
  }
};

TEST_F(DiagnoseFullLevers, OfSeveralJointsTogetherLeaveNothingThatTheSimulationHasToo) {
  Record("real");
  EXPECT_EQ(Diagnose("real", "why"), Names{});
  EXPECT_FALSE(Diagnose("real", "alone", {"--no-simulation"}).empty());
}

}  // namespace
}  // namespace tera
