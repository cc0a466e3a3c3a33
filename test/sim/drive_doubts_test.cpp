#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "own_folder.h"
#include "sim/machine_doubts.h"

// The small excavator of the guide, with one implausible value at a time.

namespace tera {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string TextOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A replacement in either file of the machine.
struct Change {
  std::string from, to;
};

MachinePlacement Digger(const Change& in_urdf, const Change& in_yaml) {
  const std::filesystem::path folder = OwnFolder(), from = DataRoot() / "examples/machines";
  const auto write = [&](const char* name, const Change& change) {
    std::string text = TextOf(from / name);
    const std::size_t at = text.find(change.from);
    EXPECT_NE(at, text.npos) << change.from;
    std::ofstream(folder / name) << text.replace(at, change.from.size(), change.to);
  };
  write("digger.urdf", in_urdf);
  write("digger.yaml", in_yaml);
  const Config config = Config::FromText(
      fmt::format("name: t\nduration_s: 1\nterrain: {{size_m: [10, 10], cell_m: 0.2, soil: dirt}}\n"
                  "machines:\n  - {{name: m1, machine: {}, operator: {{type: idle}}}}\n",
                  (folder / "digger.yaml").string()),
      "s.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario.machines.at(0).placement;
}

std::vector<std::string> OfUrdf(const std::string& from, const std::string& to) {
  return DrivesInDoubt(Digger({from, to}, {"", ""}));
}

std::vector<std::string> OfYaml(const std::string& from, const std::string& to) {
  return DrivesInDoubt(Digger({"", ""}, {from, to}));
}

TEST(DriveDoubts, AreNoneOfAMachineThatCanBe) { EXPECT_THAT(OfUrdf("", ""), IsEmpty()); }

TEST(DriveDoubts, NameAVelocityInDegrees) {
  EXPECT_THAT(OfUrdf(R"(velocity="0.6" effort="16000")", R"(velocity="34" effort="16000")"),
              ElementsAre(HasSubstr("joint boom turns 1.9 rad at 34 rad/s")));
}

TEST(DriveDoubts, NameALeverThatMovesNothing) {
  EXPECT_THAT(OfUrdf(R"(velocity="0.6" effort="16000")", R"(velocity="0" effort="0")"),
              ElementsAre(HasSubstr("lever boom moves nothing")));
}

// At 30 deg the boom's own 140 kg are 0.85 m out: 9.81 x 140 x (0.85 cos 30 - 0.1 sin 30) = 0.9 kN
// m of its required effort.
TEST(DriveDoubts, NameAnEffortThatDoesNotHoldWhatHangsOnIt) {
  EXPECT_THAT(OfUrdf(R"(velocity="0.6" effort="16000")", R"(velocity="0.6" effort="16")"),
              ElementsAre(HasSubstr("its effort is 16: is that in kN m?")));
  EXPECT_THAT(OfUrdf(R"(velocity="0.6" effort="16000")", R"(velocity="0.6" effort="900")"),
              ElementsAre(HasSubstr("joint boom needs")));
}

TEST(DriveDoubts, NameRunningGearOfAnotherUnitOrSide) {
  EXPECT_THAT(OfYaml("max_speed_mps: 1.1", "max_speed_mps: 40"),
              ElementsAre(HasSubstr("left_track runs at 40 m/s: is its speed in km/h?")));
  EXPECT_THAT(OfYaml("[0, 0.40, 0.19]", "[0, -0.41, 0.19]"),
              Contains(HasSubstr("left_track is on the right side, at y -0.41 m")));
  EXPECT_THAT(OfYaml("gauge_m: 0.80", "gauge_m: 800"),
              ElementsAre(HasSubstr("gauge_m is 800 m, and its running gear lies 0.8 m apart")));
}

// The undercarriage's box ends 0.2 m above the ground. Tracks of 0.19 m stand on it, about z =
// 0.19.
TEST(DriveDoubts, NameTracksAboveTheChassis) {
  EXPECT_THAT(OfYaml("[0, 0.40, 0.19]", "[0, 0.40, 0.59]"),
              ElementsAre(HasSubstr("left_track ends 0.2 m above the bottom of base_link")));
}

TEST(DriveDoubts, NameASlewAboutALyingAxis) {
  EXPECT_THAT(OfUrdf(R"(<origin xyz="0 0 0.45"/><axis xyz="0 0 1"/>)",
                     R"(<origin xyz="0 0 0.45"/><axis xyz="0 1 0"/>)"),
              Contains(HasSubstr("joint slew turns")));
}

TEST(DriveDoubts, NameAProfileFromItsTop) {
  EXPECT_THAT(OfYaml("[[0.55, 0.0], [0.42, 0.24], [0.14, 0.26], [0.06, -0.02]]",
                     "[[0.06, -0.02], [0.14, 0.26], [0.42, 0.24], [0.55, 0.0]]"),
              ElementsAre(HasSubstr("shovel bucket has its edge nearer to its pin")));
}

TEST(DriveDoubts, NameACapacityInLitres) {
  EXPECT_THAT(OfYaml("capacity_m3: 0.04", "capacity_m3: 40"),
              ElementsAre(HasSubstr("shovel bucket holds 40 m3")));
}

TEST(DriveDoubts, ARotationBeyondATurnIsTold) {
  EXPECT_THAT(Digger({R"(rpy="0 0.7854 0")", R"(rpy="0 45 0")"}, {"", ""}).model.remarks,
              Contains(HasSubstr("rpy of 45 (line ")));
  EXPECT_THAT(Digger({"", ""}, {"", ""}).model.remarks, IsEmpty());
}

}  // namespace
}  // namespace tera
