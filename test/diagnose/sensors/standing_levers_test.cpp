#include "diagnose/sensors/standing_levers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/sensors/made_recording.h"

namespace tera {
namespace {

/// A tracked machine at rest, with levers at 10 Hz. The tracks' levers move from 10 to 12 s, and
/// the upper structure with an encoder turns.
struct Standing {
  explicit Standing(double base_moves = 0)
      : made({.duration_s = 30, .base_moves = base_moves, .has_poses = false}) {
    made.model.ground_tools.gears.resize(2);
    made.model.levers.push_back({"left_track", -1, 0});
    made.model.levers.push_back({"right_track", -1, 1});
    TableRecording& levers = made.input.commands;
    levers.columns = {"swing", "left_track", "right_track"};
    for (int k = 0; k <= 300; ++k) {
      const double track = k >= 100 && k < 120 ? 0.4 : 0.01;
      levers.t_ns.push_back(FromSeconds(0.1 * k));
      levers.rows.push_back({std::sin(0.1 * k), track, -track});
    }
  }
  std::vector<TravelWindow> Windows() { return StandingByLevers(made.Input(), made.measured, 0); }
  MadeRecording made;
};

bool IsStillAt(const std::vector<TravelWindow>& windows, double t_s) {
  return std::any_of(windows.begin(), windows.end(), [&](const TravelWindow& one) {
    return one.is_still && one.from_s <= t_s && t_s < one.to_s;
  });
}

TEST(StandingByLevers, IsFromTwoSecondsAfterToHalfASecondBeforeTheTracksAreMoved) {
  const std::vector<TravelWindow> windows = Standing().Windows();
  for (const double t_s : {2.3, 5.0, 9.3, 14.3, 20.0}) EXPECT_TRUE(IsStillAt(windows, t_s)) << t_s;
  for (const double t_s : {9.7, 10.5, 12.0, 13.9}) EXPECT_FALSE(IsStillAt(windows, t_s)) << t_s;
}

TEST(StandingByLevers, NeedsTheLeversOfAllTracks) {
  Standing one;
  one.made.input.commands.columns[2] = "other";
  EXPECT_TRUE(one.Windows().empty());
}

// The base turns at up to 0.38 rad/s, observed by the units but commanded by no lever.
TEST(StandingByLevers, IsNotWhereUnitsTurnByMoreThanTheJointsBeforeThem) {
  Standing turning(1);
  turning.made.Input();
  const std::vector<TravelWindow> still = Standing().Windows(), windows = turning.Windows();
  EXPECT_LT(windows.size(), 0.75 * static_cast<double>(still.size()));
}

TEST(RestingByLever, IsOfAJointWhoseLeverRests) {
  Standing standing;
  EXPECT_TRUE(RestingByLever(standing.made.Input(), standing.made.measured, 0, 0).size() < 10);
  for (std::vector<double>& row : standing.made.input.commands.rows) row[0] = 0;
  const auto rests = RestingByLever(standing.made.Input(), standing.made.measured, 0, 0);
  EXPECT_TRUE(IsStillAt(rests, 11));
  // The boom has no lever in the log.
  EXPECT_TRUE(RestingByLever(standing.made.Input(), standing.made.measured, 1, 0).empty());
}

}  // namespace
}  // namespace tera
