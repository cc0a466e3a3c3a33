#include "core/config/config_peek.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/config.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kText = R"(
site:
  piles: [{xy_m: [1, 2], soil: 'sand'}]
  things:
    - name: a
      start: {xy_m: [3, -4]}
      nested:
        - 1
        - {deep: true}
    - text
)";

TEST(ConfigPeek, ItemsAreYamlOnOneLineHoweverTheyAreWritten) {
  const Config config = Config::FromText(kText, "x.yaml");
  const std::vector<std::string> things = ItemsAt(config.root(), {"site", "things"});
  ASSERT_EQ(things.size(), 2u);
  const Config alone = Config::FromText(things[0], "item");
  EXPECT_EQ(alone.root().Text("name"), "a");
  EXPECT_EQ(alone.root().Map("start").Vector2("xy_m", Any("m")), Vec2(3, -4));
  EXPECT_EQ(things[0], "{name: a, start: {xy_m: [3, -4]}, nested: [1, {deep: true}]}");
  EXPECT_EQ(things[1], "text");
  EXPECT_THAT(ItemsAt(config.root(), {"site", "none"}), IsEmpty());
  EXPECT_THAT(ItemsAt(config.root(), {"site", "piles", "xy_m"}), IsEmpty());
}

TEST(ConfigPeek, LooksPastPatchesOfItemsAndLeavesAllAsItWas) {
  const Config config = Config::FromText(kText, "x.yaml", {"site.things[0].name=b"});
  EXPECT_EQ(ItemsAt(config.root(), {"site", "things"}).size(), 2u);
  EXPECT_TRUE(HasBelow(config.root(), "site", "piles"));
  EXPECT_FALSE(HasBelow(config.root(), "site", "pile"));
  EXPECT_FALSE(HasBelow(config.root(), "sites", "piles"));
  // Nothing was read by that.
  EXPECT_EQ(config.ResolvedYaml(), Config::FromText(kText, "x.yaml").ResolvedYaml());
  EXPECT_ANY_THROW(config.Finish());
}

}  // namespace
}  // namespace tera
