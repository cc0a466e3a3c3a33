#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/program.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The boom up and down in the air, 40 s of steps from a tenth to full lever.
std::string BoomLevers() {
  std::ostringstream csv;
  csv << "t_s,boom\n0,0\n";
  const double size[] = {0.1, 0.25, 0.6, 0.15, 1.0, 0.4, 0.2, 0.8, 0.12, 0.5, 0.3, 0.7, 0.1};
  double t_s = 1;
  for (const double lever : size) {
    const double hold_s = std::min(1.2, 0.5 / lever);
    csv << t_s << ',' << lever << '\n' << t_s + hold_s << ",0\n";
    csv << t_s + hold_s + 0.3 << ',' << -lever << '\n' << t_s + 2 * hold_s + 0.3 << ",0\n";
    t_s += 2 * hold_s + 0.6;
  }
  return csv.str();
}

class DiagnoseCommand : public testing::Test {
 protected:
  DiagnoseCommand() {
    Write("levers.csv", BoomLevers());
    Write("boom.yaml", R"(
name: boom
duration_s: 32
terrain: {size_m: [16, 16], cell_m: 0.2, soil: asphalt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 45, arm: -90, bucket: -40, blade: 20}}
    operator: {type: lever_replay, csv: levers.csv, time_column: t_s}
    rig: {sensors: [{name: encoders, preset: tera:config/sensors/encoder.yaml, joints: [boom]}]}
)");
  }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(scratch_.path() / name) << text;
  }
  std::string Read(const std::string& name) const {
    std::ifstream file(scratch_.path() / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  Outcome Run(const Arguments& arguments) const { return RunTera(arguments, {scratch_.path()}); }
  void Record(const std::string& out, const Arguments& more = {}) const {
    Arguments arguments = {"generate", "boom.yaml", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = Run(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  const ScratchDirectory scratch_;
};

TEST_F(DiagnoseCommand, NamesADeadBandThatTheScenarioLacksAndWritesTheOverlayThatHasIt) {
  Record("real", {"--set", "effects.excavator1.boom.dead_band.width=0.08"});
  const Outcome outcome = Run({"diagnose", "boom.yaml", "real", "--out", "why"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("dead band 0.08"));
  const auto json = nlohmann::json::parse(Read("why/diagnosis.json"));
  EXPECT_EQ(json["verdict"][0], "named");
  ASSERT_EQ(json["findings"].size(), 1u) << outcome.out;
  const auto& finding = json["findings"][0];
  EXPECT_EQ(finding["mechanism"], "dead_band");
  EXPECT_EQ(finding["target"], "boom");
  EXPECT_EQ(finding["channel"], "excavator1/encoders/boom_radps");
  EXPECT_NEAR(finding["parameters"]["width"]["value"].get<double>(), 0.08, 0.005);
  // The replay of a single joint leaves the same residual without any concealed effect
  // (docs/reference/diagnose.md).
  EXPECT_GT(finding["held_out"]["excess_variance_removed"].get<double>(), 0.3);
  EXPECT_THAT(Read("why/report.html"), HasSubstr("</html>"));
  // The whole simulation matches the recording as well as the replay does.
  const auto& whole = json["whole_simulation"]["channels"];
  ASSERT_EQ(whole.size(), 1u) << json["whole_simulation"];
  EXPECT_EQ(whole[0]["channel"], "excavator1/encoders/boom_radps");
  EXPECT_TRUE(whole[0]["follows"].get<bool>());
  EXPECT_LT(whole[0]["rmse_after"].get<double>(), 0.3 * whole[0]["rmse_before"].get<double>());
  EXPECT_THAT(outcome.out, HasSubstr("The whole simulation as it was and with what was found"));

  // With the overlay nothing remains to be reported.
  const Outcome again =
      Run({"diagnose", "boom.yaml", "real", "--effects", "why/effects.yaml", "--out", "nothing"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(nlohmann::json::parse(Read("nothing/diagnosis.json"))["findings"].size(), 0u);
}

TEST_F(DiagnoseCommand, CorrectsAWrongNumberThatTheScenarioHas) {
  Record("real", {"--set", "effects.excavator1.boom.dead_band.width=0.12"});
  Write("wrong.yaml", "effects: {excavator1: {boom: {dead_band: {width: 0.05}}}}\n");
  const Outcome outcome =
      Run({"diagnose", "boom.yaml", "real", "--effects", "wrong.yaml", "--out", "why"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("dead band 0.12"), HasSubstr("instead of 0.05")));
  const auto json = nlohmann::json::parse(Read("why/diagnosis.json"));
  ASSERT_EQ(json["findings"].size(), 1u) << outcome.out;
  const auto& width = json["findings"][0]["parameters"]["width"];
  EXPECT_NEAR(width["value"].get<double>(), 0.12, 0.005);
  EXPECT_EQ(width["instead_of"], 0.05);
}

TEST_F(DiagnoseCommand, FindsAnInertialUnitThatSitsAskew) {
  Write("boom.yaml",
        Edited(Read("boom.yaml"), "joints: [boom]}",
               "joints: [slew, swing, boom]}, {name: imu, preset: "
               "tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.2]}"));
  Record("real", {"--set", "effects.excavator1.imu.mount_rotation={roll_deg: 1.5, pitch_deg: -2}"});
  const Outcome outcome = Run({"diagnose", "boom.yaml", "real", "--out", "why"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(Read("why/diagnosis.json"));
  ASSERT_EQ(json["findings"].size(), 1u) << outcome.out;
  const auto& finding = json["findings"][0];
  EXPECT_EQ(finding["mechanism"], "mount_rotation");
  EXPECT_EQ(finding["target"], "imu");
  EXPECT_NEAR(finding["parameters"]["roll_deg"]["value"].get<double>(), 1.5, 0.3);
  // The encoders' zeros and the tilt of the poses may absorb part of the pitch.
  const auto& pitch = finding["parameters"]["pitch_deg"];
  EXPECT_NEAR(pitch["value"].get<double>(), -2, 3 * pitch["sigma"].get<double>());
  EXPECT_THAT(Read("why/effects.yaml"), HasSubstr("mount_rotation: {roll_deg: 1."));
}

TEST_F(DiagnoseCommand, SaysNothingOfARecordingThatIsAsItsScenario) {
  Record("real");
  const Outcome outcome = Run({"diagnose", "boom.yaml", "real", "--out", "why"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(Read("why/diagnosis.json"));
  EXPECT_EQ(json["verdict"][0], "none");
  EXPECT_EQ(json["findings"].size(), 0u);
}

TEST_F(DiagnoseCommand, RefusesAReportFolderThatIsThere) {
  Record("real");
  std::filesystem::create_directory(scratch_.path() / "why");
  const Outcome outcome = Run({"diagnose", "boom.yaml", "real", "--out", "why"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("why"), HasSubstr("exists already")));
}

TEST_F(DiagnoseCommand, SaysWhichMachinesARecordingHas) {
  Record("real");
  Write("other.yaml", Edited(Read("boom.yaml"), "name: excavator1", "name: digger") +
                          "  - {name: second, machine: tera:config/machines/tb235.yaml, start: "
                          "{xy_m: [0, 6]}, operator: {type: idle}}\n");
  const Outcome outcome = Run({"diagnose", "other.yaml", "real", "--out", "why"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("digger"), HasSubstr("excavator1")));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "why"));
}

TEST_F(DiagnoseCommand, AsksForEncoders) {
  Write("boom.yaml",
        Edited(Read("boom.yaml"),
               "{name: encoders, preset: tera:config/sensors/encoder.yaml, joints: [boom]}",
               "{name: tilt, preset: tera:config/sensors/inclinometer.yaml, link: upper}"));
  Record("real", {"--duration", "21"});
  const Outcome outcome = Run({"diagnose", "boom.yaml", "real", "--out", "why"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("no encoder channel of excavator1")));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "why"));
}

}  // namespace
}  // namespace tera
