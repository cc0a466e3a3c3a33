#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/program.h"
#include "core/faults.h"
#include "dataset/format/png.h"

// `tera check --sample --sheet` and `tera realism` from a user's view.

namespace tera {
namespace {

using testing::HasSubstr;

constexpr const char* kVaried = R"(name: varied
seed: 3
duration_s: 0.4
settle_s: 0
terrain: {size_m: [20, 20], cell_m: 0.2, soil: dirt}
machines:
  - name: rover
    machine: tera:config/machines/warthog.yaml
    operator: {type: idle}
    rig: {sensors: [{name: camera, preset: tera:config/sensors/rgb_640.yaml, link: chassis, xyz_m: [0.8, 0, 1],
                     width_px: 96, height_px: 72, rate_hz: 5}]}
randomise:
  - {key: environment.sun_elevation_deg, uniform: [10, 60]}
  - site: {x_m: [-9, 9], y_m: [-9, 9], clear_m: 3, things: {count: [1, 3], size_m: [1, 1], of: ['tera:config/obstacles/cone.yaml']}}
)";

class SheetOfEpisodes : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(Path("s.yaml")) << kVaried; }
  Outcome Run(const Arguments& arguments) const { return RunTera(arguments, {scratch_.path()}); }
  std::filesystem::path Path(const std::string& file) const { return scratch_.path() / file; }

  ScratchDirectory scratch_;
};

TEST_F(SheetOfEpisodes, IsWrittenWithATileForEach) {
  const Outcome outcome = Run({"check", "s.yaml", "--sample", "3", "--sheet", "sheet.png"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("episode 2:"));
  EXPECT_THAT(outcome.out, HasSubstr("sheet.png: 3 episodes"));
  const Image<std::uint8_t> sheet = ReadRgbPng(Path("sheet.png"));
  EXPECT_EQ(sheet.width_px, 2 * 324 + 4);
  // Two values differ between episodes.
  EXPECT_EQ(sheet.height_px, 2 * (244 + 2 * 13) + 4);
}

TEST_F(SheetOfEpisodes, WithoutASampleIsRefusedAndNothingIsWritten) {
  const Outcome outcome = Run({"check", "s.yaml", "--sheet", "sheet.png"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, TellsOf("--sheet"));
  EXPECT_FALSE(std::filesystem::exists(Path("sheet.png")));
  EXPECT_EQ(Run({"check", "s.yaml", "--sample", "1", "--sheet", "no/sheet.png"}).status, 2);
}

TEST_F(SheetOfEpisodes, RealismTellsOfTheirPictures) {
  ASSERT_EQ(Run({"generate", "s.yaml", "--episode", "1", "--out", "d"}).status, 0);
  const Outcome outcome = Run({"realism", "d", "--json", "d.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("amplitude slope"));
  EXPECT_THAT(outcome.out, HasSubstr("terrain"));
  EXPECT_TRUE(std::filesystem::exists(Path("d.json")));
  const Outcome absent = Run({"realism", "none"});
  EXPECT_EQ(absent.status, 2);
  EXPECT_THAT(absent.err, HasSubstr("none"));
}

}  // namespace
}  // namespace tera
