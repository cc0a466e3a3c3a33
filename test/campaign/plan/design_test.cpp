#include "campaign/plan/design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/parse_number.h"

namespace tera {
namespace {

using testing::ElementsAre;

Campaign Over(Design design, int episodes, std::vector<DesignFactor> factors) {
  Campaign campaign;
  campaign.name = "over";
  campaign.design = design;
  campaign.episodes = episodes;
  campaign.factors = std::move(factors);
  return campaign;
}

std::vector<std::string> YamlAt(const Campaign& campaign, int number) {
  std::vector<std::string> yaml;
  for (const SetValue& value : DesignPoint(campaign, number)) yaml.push_back(value.yaml);
  return yaml;
}

std::vector<double> NumbersOf(const Campaign& campaign, std::size_t factor) {
  std::vector<double> numbers;
  for (int n = 0; n < campaign.episodes; ++n) {
    numbers.push_back(*ParseFinite(YamlAt(campaign, n).at(factor)));
  }
  return numbers;
}

TEST(DesignPoint, AFullFactorialGoesThroughAllCombinationsAndBeginsAnew) {
  const Campaign campaign =
      Over(Design::kFull, 12,
           {{.key = "a", .levels = {"1", "2"}}, {.key = "b", .levels = {"x", "y", "z"}}});
  EXPECT_THAT(YamlAt(campaign, 0), ElementsAre("1", "x"));
  EXPECT_THAT(YamlAt(campaign, 1), ElementsAre("1", "y"));
  EXPECT_THAT(YamlAt(campaign, 5), ElementsAre("2", "z"));
  EXPECT_THAT(YamlAt(campaign, 6), ElementsAre("1", "x"));
}

TEST(DesignPoint, ALatinHypercubeMeetsEachStratumOfEachFactorOnce) {
  const Campaign campaign = Over(Design::kLatinHypercube, 10,
                                 {{.key = "a", .least = 20, .most = 30},
                                  {.key = "b", .least = 1, .most = 1024, .is_log = true}});
  std::vector<double> a = NumbersOf(campaign, 0), b = NumbersOf(campaign, 1);
  EXPECT_FALSE(std::is_sorted(a.begin(), a.end()));
  std::set<int> strata_a, strata_b;
  for (const double value : a) strata_a.insert(static_cast<int>(std::floor(value - 20)));
  for (const double value : b) strata_b.insert(static_cast<int>(std::floor(std::log2(value))));
  EXPECT_EQ(strata_a.size(), 10u);
  EXPECT_EQ(strata_b.size(), 10u);  // a decade of 2 each
  EXPECT_EQ(*strata_b.rbegin(), 9);
}

TEST(DesignPoint, EpisodesOfALargeLatinHypercubeHaveStrataOfTheirOwn) {
  constexpr int kEpisodes = 300'000;
  const Campaign campaign =
      Over(Design::kLatinHypercube, kEpisodes, {{.key = "a", .least = 0, .most = kEpisodes}});
  std::set<int> strata;
  for (int n = 0; n < 3000; ++n) {
    strata.insert(static_cast<int>(*ParseFinite(YamlAt(campaign, n).at(0))));
  }
  EXPECT_EQ(strata.size(), 3000u);
}

// Sobol' 1967: the first points of the first dimension are 1/2, 3/4, 1/4.
TEST(DesignPoint, SobolBeginsAfterTheOrigin) {
  const Campaign campaign =
      Over(Design::kSobol, 3,
           {{.key = "a", .least = 0, .most = 8}, {.key = "b", .levels = {"low", "high"}}});
  EXPECT_THAT(NumbersOf(campaign, 0), ElementsAre(4, 6, 2));
  EXPECT_EQ(YamlAt(campaign, 0).at(1), "high");
}

}  // namespace
}  // namespace tera
