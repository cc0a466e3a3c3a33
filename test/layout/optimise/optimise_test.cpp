#include "layout/optimise/optimise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "core/error.h"
#include "dataset/files/whole_folder.h"
#include "layout/evaluate.h"
#include "layout/optimise/walled_site.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

/// A row of front.csv.
struct Row {
  std::string rig;
  std::vector<double> values;
};

std::vector<Row> RowsOf(const fs::path& csv) {
  std::istringstream lines(ReadWholeFile(csv));
  std::vector<Row> rows;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    Row row;
    std::getline(cells, row.rig, ',');
    for (std::string cell; std::getline(cells, cell, ',');) row.values.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

class Optimising : public testing::Test {
 protected:
  OptimiseResult Run(const fs::path& search, const std::string& out, bool resume = false,
                     int stop_after = 0) {
    OptimiseOptions options{.out = site_.path() / out, .threads = 1, .resume = resume};
    options.progress = [=](const OptimiseProgress& now) {
      if (now.generation == stop_after) throw std::runtime_error("stopped");
    };
    return Optimise(LoadSearch(search), ReadWholeFile(search), options);
  }
  std::map<std::string, std::string> Files(const std::string& out) const {
    const auto files = AllFiles(site_.path() / out);
    return {files.begin(), files.end()};
  }
  LayoutReport Evaluated(const fs::path& rig) const {
    const Cycle cycle(site_.path() / "site.yaml", {});
    return Evaluate(cycle, LoadStudy(site_.path() / "study.yaml"), {LoadLayout(rig, cycle, 0)},
                    {.threads = 1})
        .front();
  }

  WalledSite site_;
};

TEST_F(Optimising, FindsThePlaceFromWhichGeometrySaysThatMostIsSeen) {
  const OptimiseResult result = Run(site_.OneLidar(), "out");
  double best_m3 = BlindThroughSlit_m3(0), best_y_m = 0;
  for (double y_m = -4; y_m <= 4; y_m += 0.01) {
    if (BlindThroughSlit_m3(y_m) >= best_m3) continue;
    best_m3 = BlindThroughSlit_m3(y_m);
    best_y_m = y_m;
  }
  // An optimum inside the bounds, much better than a place before the slit.
  ASSERT_GT(best_y_m, -3.9);
  ASSERT_LT(best_y_m, -0.1);
  ASSERT_LT(best_m3, 0.8 * BlindThroughSlit_m3(0));
  ASSERT_EQ(result.front.size(), 1u);
  const Cycle cycle(site_.path() / "site.yaml", {});
  const Layout layout = LoadLayout(site_.path() / "out/front/01.yaml", cycle, 0);
  ASSERT_EQ(layout.viewers.size(), 1u);
  const Vec3 p_B_m = layout.viewers[0].X_BS.translation();
  EXPECT_NEAR(p_B_m.x(), 0, 1e-9);
  EXPECT_NEAR(p_B_m.z(), kLidarHeight_m, 1e-9);
  EXPECT_LT(BlindThroughSlit_m3(p_B_m.y()), 1.03 * best_m3) << p_B_m.y() << " beside " << best_y_m;
  // The blind volume equals that of geometry, by the share of 400 places.
  const double zone_m3 = (kZoneFar_m - kZoneNear_m) * (kZoneLeft_m - kZoneRight_m) * kZoneHeight_m;
  EXPECT_NEAR(result.front[0].objectives[0], BlindThroughSlit_m3(p_B_m.y()),
              3 * zone_m3 * std::sqrt(0.25 / 400));
}

TEST_F(Optimising, FromTheWorstItComesAsFarAsFromTheGreedyLayout) {
  const double from_greedy = Run(site_.OneLidar(), "out").front[0].objectives[0];
  const OptimiseResult worst =
      Run(site_.OneLidar("generations: 12\npopulation: 16\nstart: worst\n"), "worst");
  ASSERT_EQ(worst.front.size(), 1u);
  EXPECT_NEAR(worst.front[0].objectives[0], from_greedy, 0.1 * from_greedy);
}

// The walls hide most from the worst places: a single generation finds little more.
TEST_F(Optimising, TheWorstStartIsWorseThanARandomOne) {
  const std::string one_step = "generations: 1\npopulation: 16\nstart: ";
  const double worst = Run(site_.OneLidar(one_step + "worst\n"), "worst").front[0].objectives[0];
  const double random = Run(site_.OneLidar(one_step + "random\n"), "random").front[0].objectives[0];
  EXPECT_GT(worst, 1.1 * random);
}

TEST_F(Optimising, ASearchThatWasStoppedGoesOnToTheSameEnd) {
  const fs::path search = site_.TwoLidars();
  Run(search, "whole");
  for (const int stop_after : {1, 4, 5}) {
    const std::string out = "resumed" + std::to_string(stop_after);
    EXPECT_THROW(Run(search, out, false, stop_after), std::runtime_error);
    EXPECT_FALSE(fs::exists(site_.path() / out));
    Run(search, out, true);
    EXPECT_EQ(Files(out), Files("whole")) << stop_after;
    EXPECT_FALSE(fs::exists(IncompleteOf(site_.path() / out)));
  }
}

TEST_F(Optimising, ASearchThatWasStoppedTwiceGoesOnToTheSameEnd) {
  const fs::path search = site_.TwoLidars();
  Run(search, "whole");
  EXPECT_THROW(Run(search, "out", false, 2), std::runtime_error);
  EXPECT_THROW(Run(search, "out", true, 3), std::runtime_error);
  Run(search, "out", true);
  EXPECT_EQ(Files("out"), Files("whole"));
}

TEST_F(Optimising, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const fs::path one = site_.TwoLidars("seed: 7\n");
  Run(one, "one");
  Run(one, "again");
  EXPECT_EQ(Files("one"), Files("again"));
  Run(site_.TwoLidars("seed: 8\n"), "other");
  EXPECT_NE(Files("one").at("hypervolume.csv"), Files("other").at("hypervolume.csv"));
  EXPECT_NE(Files("one").at("front.csv"), Files("other").at("front.csv"));
}

TEST_F(Optimising, NoneOfTheFrontIsBeatenByAnother) {
  Run(site_.TwoLidars(), "out");
  std::vector<Row> rows = RowsOf(site_.path() / "out/front.csv");
  ASSERT_GE(rows.size(), 2u);
  EXPECT_EQ(rows.back().rig, "greedy.yaml");
  for (const Row& one : rows) {
    if (one.rig == "greedy.yaml") continue;
    // Both objectives are minimised. The greedy layout is listed next to the front and may be on
    // it.
    for (const Row& other : rows) {
      const bool beats = other.values[0] <= one.values[0] && other.values[1] <= one.values[1] &&
                         other.values != one.values;
      EXPECT_FALSE(beats) << other.rig << " beats " << one.rig;
    }
  }
}

TEST_F(Optimising, EachOfTheFrontIsARigThatDoesWhatItsRowSays) {
  const OptimiseResult result = Run(site_.TwoLidars(), "out");
  const std::vector<Row> rows = RowsOf(site_.path() / "out/front.csv");
  ASSERT_EQ(rows.size(), result.front.size() + 1);
  for (const Row& row : rows) {
    // Nothing moves, so that other moments than the search's give the same.
    const LayoutReport report = Evaluated(site_.path() / "out" / row.rig);
    EXPECT_NEAR(row.values[0], WorstOf(*FindFigure(report, {Measure::kBlindVolume, "behind_wall"})),
                1e-7)
        << row.rig;
    EXPECT_EQ(row.values[1], report.expense.cost) << row.rig;
  }
}

TEST_F(Optimising, LimitsAreKeptByTheKeptAndThePlacedTogether) {
  Run(site_.TwoLidars("seed: 3\n"), "out");
  const Cycle cycle(site_.path() / "site.yaml", {});
  std::size_t found = 0;
  for (const Row& row : RowsOf(site_.path() / "out/front.csv")) {
    const Layout layout = LoadLayout(site_.path() / "out" / row.rig, cycle, 0);
    EXPECT_LE(ExpenseOf(layout).cost, 420) << row.rig;
    EXPECT_EQ(layout.sensors.front().name, "imu") << row.rig;
    ++found;
  }
  EXPECT_GE(found, 2u);
}

TEST_F(Optimising, WhatIsOptionalIsLeftOutWhereItDoesNotPayAndNoOther) {
  Run(site_.TwoLidars(), "out");
  const Cycle cycle(site_.path() / "site.yaml", {});
  // The cheapest layout: the inertial unit and one lidar of the cheap type.
  double least = 1e9;
  for (const Row& row : RowsOf(site_.path() / "out/front.csv")) {
    const Layout layout = LoadLayout(site_.path() / "out" / row.rig, cycle, 0);
    least = std::min(least, row.values[1]);
    ASSERT_GE(layout.viewers.size(), 1u) << row.rig;
    EXPECT_EQ(layout.viewers[0].name, "first") << row.rig;
  }
  EXPECT_EQ(least, 110);
}

TEST_F(Optimising, ALayoutThatSeesNothingIsNotFoundHoweverLittleItCosts) {
  const fs::path search = site_.TwoLidars();
  std::string text = ReadWholeFile(search);
  text.replace(text.find("optional: false"), 15, "optional: true");
  for (const bool keeps : {true, false}) {
    if (!keeps) text.erase(text.find("keep: keep.yaml\n"), 16);
    WriteWholeFile(search, text);
    const std::string out = keeps ? "keeps" : "alone";
    Run(search, out);
    const Cycle cycle(site_.path() / "site.yaml", {});
    for (const Row& row : RowsOf(site_.path() / out / "front.csv")) {
      EXPECT_NO_THROW(LoadLayout(site_.path() / out / row.rig, cycle, 0)) << row.rig;
    }
  }
}

TEST_F(Optimising, APresetThatIsShippedKeepsItsName) {
  Run(site_.OneLidar("generations: 1\npopulation: 8\n"), "out");
  EXPECT_THAT(Files("out").at("front/01.yaml"),
              HasSubstr("preset: \"tera:config/sensors/vlp16.yaml\""));
}

TEST_F(Optimising, ASearchThatCameToItsEndIsNotGoneOnWith) {
  const fs::path search = site_.OneLidar("generations: 1\npopulation: 8\n");
  Run(search, "out");
  const auto before = Files("out");
  EXPECT_THAT(
      [&] { Run(search, "out", true); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("holds a finished search"), HasSubstr("out"))));
  EXPECT_EQ(Files("out"), before);
}

TEST_F(Optimising, MountsStayWithinTheirBounds) {
  Run(site_.TwoLidars(), "out");
  const Cycle cycle(site_.path() / "site.yaml", {});
  for (const Row& row : RowsOf(site_.path() / "out/front.csv")) {
    for (const Viewer& viewer : LoadLayout(site_.path() / "out" / row.rig, cycle, 0).viewers) {
      const Vec3 p_B_m = viewer.X_BS.translation();
      EXPECT_NEAR(p_B_m.x(), 0, 1e-9);
      EXPECT_LE(std::abs(p_B_m.y()), 4 + 1e-9);
      EXPECT_NEAR(p_B_m.z(), kLidarHeight_m, 1e-9);
      // z of S in B: a roll of 5 degrees at most.
      EXPECT_GE(viewer.X_BS.linear()(2, 2), std::cos(5 * kDeg) - 1e-9);
    }
  }
}

TEST_F(Optimising, HypervolumeIsKnownOfEveryGenerationAndTheFirstIsBeforeAny) {
  Run(site_.TwoLidars(), "out");
  const std::vector<Row> rows = RowsOf(site_.path() / "out/hypervolume.csv");
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t g = 0; g < rows.size(); ++g) {
    EXPECT_EQ(rows[g].rig, std::to_string(g));
    EXPECT_GE(rows[g].values[0], 0);
  }
  EXPECT_GE(rows.back().values[0], rows.front().values[0]);
}

TEST_F(Optimising, AFigureThatIsBelowZeroIsWrittenSo) {
  // People only at the mast, where the lidar sees them with hundreds of points. By 2 ln(sigma) + 1
  // + ln(2 pi), a sigma of 0.001 gives an entropy of about -11.
  const fs::path study = site_.path() / "study.yaml";
  WriteWholeFile(study, ReadWholeFile(study) + "person: {farthest_m: 12}\n");
  fs::path search = site_.OneLidar();
  std::string text = ReadWholeFile(search);
  const std::string figure = "information/perception_entropy";
  text.replace(text.find("zone/behind_wall/blind_m3"), 25, figure);
  text.replace(text.find("generations: 12\npopulation: 16"), 30, "generations: 1\npopulation: 8");
  WriteWholeFile(search, text);
  Run(search, "out");
  for (const Row& row : RowsOf(site_.path() / "out/front.csv")) {
    const LayoutReport report = Evaluated(site_.path() / "out" / row.rig);
    const double value = MeanOf(*FindFigure(report, {Measure::kPerceptionEntropy}));
    ASSERT_LT(value, 0);
    EXPECT_NEAR(row.values[0], value, 1e-6 * std::abs(value)) << row.rig;
  }
}

TEST_F(Optimising, MoreOfAFigureThatIsToBeLargeIsFoundAndWrittenAsItIs) {
  fs::path search = site_.OneLidar();
  std::string text = ReadWholeFile(search);
  text.replace(text.find("zone/behind_wall/blind_m3"), 25, "zone/behind_wall/seen_by_1");
  WriteWholeFile(search, text);
  Run(search, "out");
  const std::vector<Row> rows = RowsOf(site_.path() / "out/front.csv");
  const double zone_m3 = (kZoneFar_m - kZoneNear_m) * (kZoneLeft_m - kZoneRight_m) * kZoneHeight_m;
  const double before_slit = 1 - BlindThroughSlit_m3(0) / zone_m3;
  EXPECT_GT(rows.front().values[0], before_slit + 0.1);
  EXPECT_LE(rows.front().values[0], 1);
}

TEST_F(Optimising, AnotherSearchIsNoneToGoOnWith) {
  EXPECT_THROW(Run(site_.TwoLidars(), "out", false, 2), std::runtime_error);
  const fs::path other = site_.TwoLidars("seed: 2\n");
  EXPECT_THAT([&] { Run(other, "out", true); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("out.incomplete"), HasSubstr("search"))));
}

TEST_F(Optimising, ASearchWhoseInputsChangedIsNoneToGoOnWith) {
  const fs::path search = site_.TwoLidars();
  EXPECT_THROW(Run(search, "out", false, 2), std::runtime_error);
  for (const char* input : {"study.yaml", "keep.yaml", "site.yaml"}) {
    const fs::path file = site_.path() / input;
    const std::string before = ReadWholeFile(file);
    std::string after = before;
    const std::string from = input == std::string("site.yaml") ? "yaw_deg: 40" : "mast, xyz_m: [";
    after.replace(after.find(from), from.size(),
                  input == std::string("site.yaml") ? "yaw_deg: 41" : "mast, xyz_m: [0.00");
    WriteWholeFile(file, after);
    EXPECT_THAT([&] { Run(search, "out", true); },
                ThrowsMessage<InputError>(HasSubstr("another search")))
        << input;
    WriteWholeFile(file, before);
  }
  EXPECT_NO_THROW(Run(search, "out", true));
}

TEST_F(Optimising, ADamagedStateIsNoneToGoOnWith) {
  const fs::path search = site_.TwoLidars();
  EXPECT_THROW(Run(search, "out", false, 2), std::runtime_error);
  const fs::path state = IncompleteOf(site_.path() / "out") / "search_state.json";
  const std::string good = ReadWholeFile(state);
  ASSERT_FALSE(good.empty());
  for (const std::string& bad : {std::string(), good.substr(0, good.size() / 2), std::string("{}"),
                                 std::string("[1, 2]"), std::string("null")}) {
    WriteWholeFile(state, bad);
    EXPECT_THAT([&] { Run(search, "out", true); },
                ThrowsMessage<InputError>(HasSubstr("search_state.json")))
        << bad;
  }
  WriteWholeFile(state, good);
  EXPECT_NO_THROW(Run(search, "out", true));
}

TEST_F(Optimising, AFolderThatHoldsSomethingIsRefused) {
  const fs::path search = site_.TwoLidars();
  fs::create_directories(site_.path() / "full");
  WriteWholeFile(site_.path() / "full/mine.txt", "keep me");
  for (const bool resume : {false, true}) {
    EXPECT_THAT([&] { Run(search, "full", resume); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("full"), HasSubstr("empty"))));
  }
  EXPECT_EQ(Files("full"), (std::map<std::string, std::string>{{"mine.txt", "keep me"}}));
}

TEST_F(Optimising, AStoppedSearchIsNotBegunAnewUnasked) {
  const fs::path search = site_.TwoLidars();
  EXPECT_THROW(Run(search, "out", false, 2), std::runtime_error);
  EXPECT_THAT([&] { Run(search, "out"); }, ThrowsMessage<InputError>(HasSubstr("--resume")));
}

TEST_F(Optimising, ToGoOnWithWhatWasNeverBegunBeginsIt) {
  const fs::path search = site_.TwoLidars();
  Run(search, "whole");
  Run(search, "out", true);
  EXPECT_EQ(Files("out"), Files("whole"));
}

}  // namespace
}  // namespace tera
