#include "sim/scenario/randomise.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "own_folder.h"
#include "sim/scenario/load_scenario.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kEpisodes = 4000;

/// The values of an episode, by key.
std::map<std::string, std::string> Drawn(const std::string& randomise, std::uint64_t episode,
                                         std::uint64_t seed = 3) {
  const Config config = Config::FromText("randomise:\n" + randomise, "s.yaml");
  std::map<std::string, std::string> values;
  for (const auto& [path, yaml, place] : DrawEpisode(config.root(), seed, episode)) {
    values[path] = yaml;
  }
  config.Finish();
  return values;
}

/// The values of many episodes for one key.
std::vector<double> Numbers(const std::string& randomise, const std::string& key) {
  std::vector<double> numbers;
  for (int e = 0; e < kEpisodes; ++e) numbers.push_back(std::stod(Drawn(randomise, e).at(key)));
  return numbers;
}

double MeanOf(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double x : numbers) sum += x;
  return sum / static_cast<double>(numbers.size());
}

double CovarianceOf(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - MeanOf(a)) * (b[i] - MeanOf(b));
  return sum / static_cast<double>(a.size());
}

TEST(Randomise, DrawsUniformNumbers) {
  const std::vector<double> of = Numbers("  - {key: a, uniform: [2, 6]}\n", "a");
  EXPECT_NEAR(MeanOf(of), 4, 5 * 4 / std::sqrt(12.0 * kEpisodes));
  EXPECT_NEAR(CovarianceOf(of, of), 16.0 / 12, 0.1);
  EXPECT_GE(*std::min_element(of.begin(), of.end()), 2);
  EXPECT_LE(*std::max_element(of.begin(), of.end()), 6);
}

TEST(Randomise, DrawsNumbersThatAreUniformInTheirLogarithm) {
  std::vector<double> of = Numbers("  - {key: a, log_uniform: [0.01, 100]}\n", "a");
  int below_one = 0;
  for (double& x : of) below_one += x < 1;
  EXPECT_NEAR(below_one, kEpisodes / 2, 5 * std::sqrt(kEpisodes) / 2);
}

TEST(Randomise, DrawsNormalNumbersThatMayBeCut) {
  const std::vector<double> of = Numbers("  - {key: a, normal: [10, 2]}\n", "a");
  EXPECT_NEAR(MeanOf(of), 10, 5 * 2 / std::sqrt(kEpisodes));
  EXPECT_NEAR(CovarianceOf(of, of), 4, 0.5);
  const std::vector<double> cut = Numbers("  - {key: a, normal: [0, 1], within: [0, 9]}\n", "a");
  EXPECT_GE(*std::min_element(cut.begin(), cut.end()), 0);
  // Mean of a half normal distribution: the root of 2 / pi.
  EXPECT_NEAR(MeanOf(cut), std::sqrt(2 / 3.14159265), 5 * 0.6 / std::sqrt(kEpisodes));
}

TEST(Randomise, StaysWithinACutFarOutInATail) {
  for (const double x : Numbers("  - {key: a, normal: [0, 1], within: [7.9, 8.6]}\n", "a")) {
    ASSERT_GE(x, 7.9);
    ASSERT_LE(x, 8.6);
  }
}

TEST(Randomise, DrawsWholeNumbersWithBothEnds) {
  std::map<double, int> counts;
  for (const double x : Numbers("  - {key: a, integer: [-1, 2]}\n", "a")) ++counts[x];
  ASSERT_EQ(counts.size(), 4u);
  for (const auto& [value, count] : counts) {
    EXPECT_NEAR(count, kEpisodes / 4, 5 * std::sqrt(kEpisodes * 0.25 * 0.75)) << value;
  }
}

TEST(Randomise, ChoosesByWeights) {
  std::map<std::string, int> counts;
  for (int e = 0; e < kEpisodes; ++e) {
    ++counts[Drawn("  - {key: a, choice: [sand, [1, 2], {b: c}], weights: [1, 0, 3]}\n", e)["a"]];
  }
  ASSERT_EQ(counts.size(), 2u);
  EXPECT_NEAR(counts["sand"], kEpisodes / 4, 5 * std::sqrt(kEpisodes * 0.25 * 0.75));
  EXPECT_EQ(counts.count("{b: c}"), 1u);
}

TEST(Randomise, ChoosesSetsOfKeysTogether) {
  for (int e = 0; e < 20; ++e) {
    const auto values = Drawn("  - {together: [{a.b: 1, c: x}, {a.b: 2, c: y}]}\n", e);
    EXPECT_EQ(values.at("c"), values.at("a.b") == "1" ? "x" : "y");
  }
}

TEST(Randomise, DrawsNumbersThatAreCorrelated) {
  const std::string entry = "  - {keys: [a, b, c], mean: [0, 5, 0], sigma: [1, 2, 1], ";
  const std::vector<double> a = Numbers(entry + "correlation: 0.8}\n", "a"),
                            b = Numbers(entry + "correlation: 0.8}\n", "b"),
                            c = Numbers(entry + "correlation: -0.45}\n", "c"),
                            d = Numbers(entry + "correlation: -0.45}\n", "a");
  EXPECT_NEAR(CovarianceOf(a, b), 0.8 * 2, 0.15);
  EXPECT_NEAR(CovarianceOf(b, b), 4, 0.4);
  EXPECT_NEAR(MeanOf(b), 5, 0.2);
  EXPECT_NEAR(CovarianceOf(c, d), -0.45, 0.08);
  const auto alike = Drawn("  - {keys: [a, b], mean: [0, 0], sigma: [1, 1], correlation: 1}\n", 0);
  EXPECT_NEAR(std::stod(alike.at("a")), std::stod(alike.at("b")), 1e-9);
}

Vec2 PlaceOf(const std::string& yaml) {
  Vec2 at;
  EXPECT_EQ(std::sscanf(yaml.c_str(), "[%lf, %lf]", &at.x(), &at.y()), 2) << yaml;
  return at;
}

TEST(Randomise, PlacesThingsApart) {
  for (int e = 0; e < 200; ++e) {
    const auto values = Drawn(
        "  - {places: ['o[0]', 'o[1]', 'o[2]'], x_m: [-5, 5], y_m: [0, 8], yaw_deg: [0, 90],\n"
        "     apart_m: 3, clear_m: 2, clear_of_m: [[0, 4]]}\n",
        e);
    std::vector<Vec2> at = {PlaceOf(values.at("o[0].xy_m")), PlaceOf(values.at("o[1].xy_m")),
                            PlaceOf(values.at("o[2].xy_m"))};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(std::abs(at[i].x()), 5);
      EXPECT_GE((at[i] - Vec2(0, 4)).norm(), 2);
      for (std::size_t j = 0; j < i; ++j) EXPECT_GE((at[i] - at[j]).norm(), 3);
    }
    EXPECT_GE(std::stod(values.at("o[1].yaw_deg")), 0);
  }
}

TEST(Randomise, OfAnEpisodeIsTheSameWhateverStandsBeside) {
  const std::string one = "  - {key: a, uniform: [0, 1]}\n";
  const std::string other = "  - {key: b, uniform: [0, 1]}\n";
  EXPECT_EQ(Drawn(one, 5).at("a"), Drawn(other + one, 5).at("a"));
  EXPECT_NE(Drawn(one, 5).at("a"), Drawn(one, 6).at("a"));
  EXPECT_NE(Drawn(one, 5, 3).at("a"), Drawn(one, 5, 4).at("a"));
  EXPECT_NE(Drawn(one + other, 5).at("a"), Drawn(one + other, 5).at("b"));
}

class RandomisedFile : public ::testing::Test {
 protected:
  LoadedScenario Load(const std::string& randomise, std::uint64_t episode,
                      const std::vector<std::string>& overrides = {}) {
    Write(kSite + std::string(kExcavator) + "\nrandomise:\n" + randomise);
    return LoadScenario(file_, overrides, {}, {}, episode);
  }
  void Write(const std::string& text) { std::ofstream(file_) << text; }
  std::string Refused(const std::string& randomise) {
    try {
      Load(randomise, 0);
    } catch (const InputError& e) {
      return e.what();
    }
    return "nothing";
  }

  const std::filesystem::path file_ = OwnFolder() / "randomise.yaml";
};

constexpr const char* kSun = "  - {key: environment.turbidity, uniform: [2, 8]}\n";

TEST_F(RandomisedFile, HasTheDrawnValuesBelowOverrides) {
  const double drawn = Load(kSun, 4).scenario.environment.turbidity;
  EXPECT_EQ(fmt::format("{}", drawn),
            Drawn(kSun, 4, 1).at("environment.turbidity"));  // 1 is the seed of a scenario without
  EXPECT_NE(drawn, Load(kSun, 5).scenario.environment.turbidity);
  EXPECT_EQ(Load(kSun, 4, {"environment.turbidity=3"}).scenario.environment.turbidity, 3);
  EXPECT_NE(Load(kSun, 4, {"seed=9"}).scenario.environment.turbidity, drawn);
}

TEST_F(RandomisedFile, ReachesItemsOfLists) {
  const std::string yaw = "  - {key: 'machines[0].start.yaw_deg', choice: [30]}\n";
  const Pose& X_WB = Load(yaw, 0).scenario.machines[0].placement.X_WB;
  EXPECT_NEAR(std::atan2(X_WB.linear()(1, 0), X_WB.linear()(0, 0)) * 180 / 3.14159265358979, 30,
              1e-9);
}

TEST_F(RandomisedFile, IsWrittenSoThatTheEpisodeCanBeMadeAgain) {
  const std::string text = "  - {key: name, choice: [\"it's a: name\"]}\n";
  const LoadedScenario first = Load(std::string(kSun) + text, 7);
  EXPECT_THAT(first.resolved_yaml, AllOf(Not(HasSubstr("randomise")), HasSubstr("episode: 7")));
  Write(first.resolved_yaml);
  const LoadedScenario again = LoadScenario(file_, {});
  EXPECT_EQ(again.scenario.environment.turbidity, first.scenario.environment.turbidity);
  EXPECT_EQ(again.scenario.name, "it's a: name");
  EXPECT_TRUE(again.resolved_yaml == first.resolved_yaml);
}

TEST_F(RandomisedFile, WithAKeyThatIsNotThereOrAValueOutOfRangeIsRefusedByTheEntrysPlace) {
  EXPECT_THAT(
      Refused("  - {key: environment.turbiditi, uniform: [2, 8]}\n"),
      AllOf(HasSubstr(".yaml:12:5: randomise[0] (drawn): environment.turbiditi: unknown key"),
            HasSubstr("did you mean 'turbidity'?")));
  EXPECT_THAT(Refused("  - {key: environment.turbidity, uniform: [20, 30]}\n"),
              AllOf(HasSubstr(".yaml:12:5: randomise[0] (drawn): environment.turbidity: "),
                    HasSubstr("out of range, need 1.5 to 10")));
  EXPECT_THAT(Refused("  - {key: 'obstacles[2].xy_m', choice: [[0, 0]]}\n"),
              HasSubstr("an item of a list that is not there"));
  EXPECT_THAT(Refused("  - {key: 'machines[', choice: [1]}\n"), HasSubstr("is no key path"));
  EXPECT_THAT(Refused("  - {key: seed, integer: [1, 5]}\n"), HasSubstr("'seed' cannot be drawn"));
}

TEST_F(RandomisedFile, ThatDrawsNothingHasNoOtherEpisode) {
  Write(kSite + std::string(kExcavator));
  EXPECT_NO_THROW(LoadScenario(file_, {}));
  EXPECT_THROW(LoadScenario(file_, {}, {}, {}, 2), InputError);
}

TEST_F(RandomisedFile, OfNoSuchDistributionIsRefused) {
  EXPECT_THAT(
      Refused("  - {key: duration_s}\n"),
      HasSubstr("nothing found, need one of uniform, log_uniform, normal, integer, choice"));
  EXPECT_THAT(Refused("  - {key: duration_s, uniform: [1, 2], choice: [1]}\n"),
              HasSubstr("several of these found, need one of uniform"));
  EXPECT_THAT(Refused("  - {uniform: [1, 2]}\n"), HasSubstr("need one of key, together"));
  EXPECT_THAT(Refused("  - {key: duration_s, uniform: [2, 1]}\n"),
              HasSubstr("the ends are swapped"));
  EXPECT_THAT(Refused("  - {key: duration_s, log_uniform: [0, 1]}\n"), HasSubstr("log_uniform"));
  EXPECT_THAT(Refused("  - {key: duration_s, normal: [1, 0]}\n"), HasSubstr("sigma > 0"));
  EXPECT_THAT(Refused("  - {key: duration_s, normal: [1, 0.1], within: [90, 91]}\n"),
              HasSubstr("contains no value of the distribution"));
  EXPECT_THAT(Refused("  - {key: duration_s, choice: [1, 2], weights: [1]}\n"),
              HasSubstr("weights"));
  EXPECT_THAT(Refused("  - {key: duration_s, choice: []}\n"), HasSubstr("nothing to choose from"));
  EXPECT_THAT(Refused("  - {key: duration_s, uniform: [1, 2], unifrom: 3}\n"),
              HasSubstr("unknown key"));
  EXPECT_THAT(Refused("  - {places: ['obstacles[0]', 'obstacles[1]'], x_m: [0, 1], y_m: [0, 1], "
                      "apart_m: 5}\n"),
              HasSubstr("no place found for 'obstacles[1]'"));
}

}  // namespace
}  // namespace tera
