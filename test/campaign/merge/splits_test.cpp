#include "campaign/merge/splits.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "core/faults.h"

namespace tera {
namespace {

/// `groups` soils with ten episodes each, in three parts by soil.
struct Soils {
  explicit Soils(int groups) {
    campaign.name = "soils";
    campaign.splits = {{"terrain.soil"}, {{"train", 0.8}, {"val", 0.1}, {"test", 0.1}}};
    for (int number = 0; number < 10 * groups; ++number) {
      records[number].number = number;
      records[number].values["terrain.soil"] = "soil" + std::to_string(number % groups);
    }
  }
  Campaign campaign;
  std::map<int, EpisodeRecord> records;
};

TEST(Splits, FewGroupsLeaveNoPartEmptyAndShareNone) {
  for (const int groups : {3, 4, 7}) {
    const Soils soils(groups);
    std::map<std::string, std::set<std::string>> parts_of_soil;
    std::set<std::string> filled;
    for (const auto& [number, part] : PartsOf(soils.campaign, soils.records)) {
      parts_of_soil[soils.records.at(number).values.at("terrain.soil")].insert(part);
      filled.insert(part);
    }
    EXPECT_EQ(filled.size(), 3u) << groups;
    for (const auto& [soil, parts] : parts_of_soil) EXPECT_EQ(parts.size(), 1u) << soil;
  }
}

TEST(Splits, ManyGroupsComeNearTheirShares) {
  const Soils soils(100);
  std::map<std::string, int> count;
  for (const auto& [_, part] : PartsOf(soils.campaign, soils.records)) ++count[part];
  EXPECT_NEAR(count["train"], 800, 10);
  EXPECT_NEAR(count["val"], 100, 10);
}

TEST(Splits, FewerGroupsThanPartsAreRefused) {
  const Soils soils(2);
  EXPECT_THAT([&] { PartsOf(soils.campaign, soils.records); },
              ThrowsFault(FaultKind::kInconsistent, "splits"));
}

}  // namespace
}  // namespace tera
