#include "core/config/model_archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/config.h"
#include "core/faults.h"
#include "core/units.h"

namespace tera {
namespace {

struct Hinge {
  double play_rad = 0;
};

struct Gate {
  double width_m = 0;
  double open_rad = 30 * kDeg;
  int leaves = 2;
  bool locked = false;
  Vec3 post_m = Vec3(1, 2, 3);
  std::vector<double> bars_m;
  std::vector<std::string> keys;
  std::string wood = "oak";
  std::optional<double> bell_hz;
  std::optional<Hinge> hinge;
};

void Serialize(ModelArchive* archive, Hinge* hinge) {
  archive->Visit("play_deg", &hinge->play_rad, Between(0, 5, "deg"), kDeg);
}

void Serialize(ModelArchive* archive, Gate* gate) {
  archive->Need("width_m", &gate->width_m, Positive("m"));
  archive->Visit("open_deg", &gate->open_rad, Between(0, 120, "deg"), kDeg);
  archive->Visit("leaves", &gate->leaves, Between(1, 2, ""));
  archive->Visit("locked", &gate->locked);
  archive->Visit("post_cm", &gate->post_m, Any("cm"), 0.01);
  gate->bars_m.resize(static_cast<std::size_t>(gate->leaves));
  archive->Visit("bars_m", &gate->bars_m, AtLeast(0, "m"));
  archive->Visit("keys", &gate->keys);
  archive->Visit("wood", &gate->wood, {"oak", "ash"});
  archive->Visit("bell_hz", &gate->bell_hz, Positive("Hz"));
  archive->Visit("hinge", &gate->hinge);
  archive->Check(!gate->locked || !gate->keys.empty(), "locked", "true without keys");
}

TEST(ModelArchive, ReadsKeysInTheirUnitsAndLeavesTheRestAsItIs) {
  const Config config = Config::FromText(
      "{width_m: 2.5, open_deg: 90, bars_m: [1, 4], hinge: {play_deg: 3}}", "a.yaml");
  const auto gate = ReadModel<Gate>(config.root());
  config.Finish();
  EXPECT_EQ(gate.width_m, 2.5);
  EXPECT_NEAR(gate.open_rad, kPi / 2, 1e-15);
  EXPECT_EQ(gate.leaves, 2);
  EXPECT_EQ(gate.post_m, Vec3(1, 2, 3));
  EXPECT_EQ(gate.bars_m, (std::vector<double>{1, 4}));
  EXPECT_EQ(gate.wood, "oak");
  EXPECT_FALSE(gate.bell_hz);
  ASSERT_TRUE(gate.hinge);
  EXPECT_NEAR(gate.hinge->play_rad, kPi / 60, 1e-15);
}

TEST(ModelArchive, TellsFaultsOfKeysOfPartsAndOfTheWhole) {
  const Config config =
      Config::FromText("{locked: true, bars_m: [1], hinge: {play_deg: 9}}", "a.yaml");
  ReadModel<Gate>(config.root());
  EXPECT_THAT(FaultsIn([&] { config.Finish(); }),
              testing::UnorderedElementsAre(IsFault(FaultKind::kMissing, "width_m"),
                                            IsFault(FaultKind::kMistyped, "bars_m"),
                                            IsFault(FaultKind::kOutOfRange, "hinge.play_deg"),
                                            IsFault(FaultKind::kInconsistent, "locked")));
}

TEST(ModelArchive, WritesWhatItReadsAgain) {
  Gate gate;
  gate.width_m = 0.1;
  gate.open_rad = 0.7 * kDeg;
  gate.bars_m = {0.5, 1e-7};
  gate.keys = {"first", "second"};
  gate.wood = "ash";
  gate.bell_hz = 440;
  gate.hinge = Hinge{2 * kDeg};
  const std::string yaml = ModelYaml(gate, 0);
  EXPECT_EQ(yaml,
            "width_m: 0.1\nopen_deg: 0.7\nleaves: 2\nlocked: false\npost_cm: [100, 200, 300]\n"
            "bars_m: [0.5, 1e-07]\nkeys: [first, second]\nwood: ash\nbell_hz: 440\n"
            "hinge:\n  play_deg: 2\n");
  const Config config = Config::FromText(yaml, "a.yaml");
  EXPECT_EQ(ModelYaml(ReadModel<Gate>(config.root()), 0), yaml);
  config.Finish();
}

TEST(ModelArchive, LeavesOutPartsThatAModelHasNot) {
  EXPECT_EQ(ModelYaml(Hinge{kDeg}, 4), "    play_deg: 1\n");
  EXPECT_THAT(ModelYaml(Gate{}, 2), testing::Not(testing::ContainsRegex("hinge|bell")));
}

}  // namespace
}  // namespace tera
