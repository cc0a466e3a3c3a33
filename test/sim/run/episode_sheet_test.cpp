#include "sim/run/episode_sheet.h"

#include <gtest/gtest.h>

#include "sim/run/first_look.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

TEST(EpisodeSheet, ValuesAreToldInFewLetters) {
  EXPECT_EQ(DrawnInShort("environment.sun_elevation_deg: 31.245678901"),
            "environment.sun_elevation_deg: 31.25");
  EXPECT_EQ(DrawnInShort("machines[0].start.joints_deg.boom: 40"), "joints_deg.boom: 40");
  EXPECT_EQ(DrawnInShort("terrain.soil: dirt"), "terrain.soil: dirt");
  EXPECT_EQ(DrawnInShort("obstacles: [{name: a, xy_m: [1, 2]}, {name: b, xy_m: [3, 4]}]"),
            "obstacles: 2 items");
}

Scenario Read(const std::string& obstacles) {
  const Config config =
      Config::FromText(std::string(kSite) + kExcavator + "obstacles: [" + obstacles + "]\n", "s");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

TEST(FirstLook, ShowsWhatStandsBesideTheMachine) {
  const auto red_of = [](const Image<std::uint8_t>& picture) {
    int red = 0;
    for (std::size_t p = 0; p < picture.data.size(); p += 3) {
      const std::uint8_t* at = &picture.data[p];
      if (at[0] > 2 * at[1] && at[0] > 3 * at[2]) ++red;  // no soil is so orange
    }
    return red;
  };
  const Image<std::uint8_t> bare = FirstLook(Read(""), 160, 120, {});
  EXPECT_EQ(bare.width_px, 160);
  const Image<std::uint8_t> with_cones = FirstLook(
      Read("{name: a, preset: 'tera:config/obstacles/cone.yaml', xy_m: [-4, -4], scale: 2}"), 160,
      120, {});
  EXPECT_GT(red_of(with_cones), red_of(bare) + 8);
}

}  // namespace
}  // namespace tera
