#include "campaign/sweep/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>

#include "campaign/campaign_files.h"
#include "campaign/sweep/report_figure.h"
#include "campaign/sweep/sweep_plot.h"
#include "core/faults.h"

namespace tera {
namespace {

constexpr char kReport[] = R"({"summary": {"rmse_m": 0.25, "note": "of all", "none": null},
 "figures": [{"name": "zone/around/seen_by_1", "mean": 0.5}, {"name": "a.b", "mean": -2}],
 "values": [1, 2.5]})";

double Figure(const std::string& figure) {
  WriteWholeFile(OwnFolder() / "report.json", kReport);
  return ReportFigure(OwnFolder() / "report.json", figure, "campaign.yaml:5:11");
}

TEST(ReportFigure, FollowsKeysIndicesAndNames) {
  EXPECT_EQ(Figure("summary.rmse_m"), 0.25);
  EXPECT_EQ(Figure("figures[zone/around/seen_by_1].mean"), 0.5);
  EXPECT_EQ(Figure("figures[a.b].mean"), -2);
  EXPECT_EQ(Figure("figures[1].mean"), -2);
  EXPECT_EQ(Figure("values[1]"), 2.5);
}

TEST(ReportFigure, RefusesWhatIsNoFigureAtItsPlaceWithTheNamesThatThereAre) {
  const auto refused = [](const std::string& figure, FaultKind kind) {
    EXPECT_THAT([&] { Figure(figure); }, ThrowsFault(kind, "campaign.yaml:5:11")) << figure;
  };
  refused("summary.rmse", FaultKind::kNoSuchName);
  refused("figures[zone/around/seen_by_9].mean", FaultKind::kNoSuchName);
  refused("values[2]", FaultKind::kNoSuchName);
  refused("summary.rmse_m.x", FaultKind::kNoSuchName);
  refused("summary.note", FaultKind::kMistyped);
  refused("summary.none", FaultKind::kMistyped);
  refused("summary", FaultKind::kMistyped);
  try {
    Figure("summary.rmse");
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("rmse_m"));
  }
}

std::vector<SweptRun> Runs(const std::vector<std::pair<std::string, double>>& of) {
  std::vector<SweptRun> runs;
  for (const auto& [value, outcome] : of) {
    runs.push_back({static_cast<int>(runs.size()), {value}, outcome});
  }
  return runs;
}

// Three numbers 4, 5, 6: mean 5, standard deviation 1; t(0.975, 2) = 4.302653 (Student 1908,
// printed tables), so that the interval is 5 +- 4.302653 / sqrt(3) = 5 +- 2.484138.
TEST(Effects, AMeanHasStudentsInterval) {
  const FactorEffect effect =
      EffectsOf({"soil"}, Runs({{"dirt", 4}, {"sand", 9}, {"dirt", 6}, {"dirt", 5}})).at(0);
  ASSERT_EQ(effect.levels.size(), 2u);
  EXPECT_EQ(effect.levels[0].level, "dirt");
  EXPECT_EQ(effect.levels[0].runs, 3);
  EXPECT_NEAR(effect.levels[0].mean, 5, 1e-12);
  EXPECT_NEAR(effect.levels[0].low.value(), 5 - 2.484138, 1e-5);
  EXPECT_NEAR(effect.levels[0].high.value(), 5 + 2.484138, 1e-5);
  EXPECT_FALSE(effect.levels[1].low.has_value());
  EXPECT_FALSE(effect.is_numeric);
  EXPECT_FALSE(effect.slope.has_value());
}

// Points (1, 2), (2, 4), (3, 5), (4, 4), (5, 5), a textbook's example of least squares: slope 0.6,
// residual sum 2.4, so that its standard error is sqrt(2.4 / 3 / 10) = 0.282843; t(0.975, 3) =
// 3.182446.
TEST(Effects, NumbersHaveASlopeWithItsInterval) {
  const FactorEffect effect =
      EffectsOf({"h_m"}, Runs({{"5", 5}, {"1", 2}, {"2", 4}, {"3", 5}, {"4", 4}})).at(0);
  EXPECT_TRUE(effect.is_numeric);
  EXPECT_EQ(effect.levels.front().level, "1");
  EXPECT_EQ(effect.levels.back().level, "5");
  ASSERT_TRUE(effect.slope.has_value());
  EXPECT_NEAR(effect.slope->per_unit, 0.6, 1e-12);
  EXPECT_NEAR(effect.slope->low, 0.6 - 3.182446 * 0.282843, 1e-5);
  EXPECT_NEAR(effect.slope->high, 0.6 + 3.182446 * 0.282843, 1e-5);
}

TEST(Effects, APlotHasAPanelForEachFactorAndAPointForEachRun) {
  std::vector<SweptRun> runs = Runs({{"1", 4}, {"2", 6}, {"1", 5}, {"2", 7}});
  for (SweptRun& run : runs) run.values.push_back("<dirt>");
  const std::string svg = SweepPlot(EffectsOf({"h_m", "soil"}, runs), runs, "seen");
  const auto count = [&](const std::string& word) {
    int found = 0;
    for (std::size_t at = 0; (at = svg.find(word, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  EXPECT_EQ(count("r=\"3\""), 8);
  EXPECT_EQ(count(">h_m<"), 1);
  EXPECT_EQ(count("&lt;dirt&gt;"), 1);
  EXPECT_EQ(count("nan"), 0);
}

TEST(Effects, APlotOfManyNamesLabelsSomeOfThem) {
  std::vector<std::pair<std::string, double>> of;
  for (int k = 0; k < 12; ++k) of.emplace_back("soil" + std::to_string(k), k);
  const std::vector<SweptRun> runs = Runs(of);
  const std::string svg = SweepPlot(EffectsOf({"soil"}, runs), runs, "seen");
  for (int k = 0; k < 12; ++k) {
    const std::string label = "middle\">soil" + std::to_string(k) + "<";
    EXPECT_EQ(svg.find(label) != std::string::npos, k % 2 == 0) << k;
  }
}

// The shell stands for a command of TERA.
TEST(SweepOutcome, AReportOfACommandThatFailedIsNotTakenLater) {
  const std::string lines =
      "outcome: {run: 'write.sh {episode} {out}', report: r.json, figure: a}\n";
  const Plan plan = MakePlan(WriteCampaign(std::string(kSoils) + lines), OwnFolder() / "out");
  WriteWholeFile(OwnFolder() / "write.sh",
                 "echo \"{\\\"a\\\": $(cat value)}\" > \"$2/r.json\"; test $(cat value) != 1\n");
  const SweepOptions options{.worker = {"/bin/sh", {}}};
  const auto with_value = [&](const std::string& value) {
    WriteWholeFile(OwnFolder() / "value", value);
    return OutcomeOf(plan, 0, options);
  };
  for (int k = 0; k < 2; ++k) {
    EXPECT_THAT([&] { with_value("1"); }, ThrowsFault(FaultKind::kInconsistent, "run")) << k;
  }
  EXPECT_EQ(with_value("2"), 2);
  EXPECT_EQ(with_value("3"), 2);  // the report is there
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(plan.folder / "outcomes"), {}), 1);
}

TEST(SweepOutcome, NeedsAnEpisodeAndAPlaceToWrite) {
  const std::string lines = "outcome: {run: lint x, report: r.json, figure: a}\n";
  EXPECT_THAT([&] { MakePlan(WriteCampaign(std::string(kSoils) + lines), OwnFolder() / "out"); },
              ThrowsFault(FaultKind::kMissing, "outcome.run"));
}

}  // namespace
}  // namespace tera
