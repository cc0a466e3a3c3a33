#include "layout/measures/occupancy_entropy.h"

#include <gtest/gtest.h>

#include "layout/yard.h"

namespace tera {
namespace {

constexpr double kVoxel_m = 0.5;

/// A person's point in H, at the middle of the only voxel that it occupies.
Occupant PersonAt(const Pose& X_WH, const Vec3& p_H_m) {
  return {X_WH * MakePose(p_H_m), Vec3::Zero(), Vec3::Zero()};
}

/// Two voxels of 0.5 m about H, far from the machine's own boxes.
const Vec3 kOften_m(3.25, 2.25, 0.75), kSeldom_m(-3.25, 2.25, 0.75);

/// Four moments: a person at one place in two of them, at the other in one.
std::vector<Figure> FiguresOf(const Yard& yard, const std::vector<Viewer>& viewers) {
  OccupancyEntropy entropy(4, 1, kVoxel_m);
  const Pose X_WH = yard.X_WH();
  const std::vector<std::vector<Occupant>> moments = {
      {PersonAt(X_WH, kOften_m), PersonAt(X_WH, kSeldom_m)}, {PersonAt(X_WH, kOften_m)}, {}, {}};
  for (const std::vector<Occupant>& occupants : moments) {
    entropy.Add(X_WH, occupants, LayoutOf(viewers), 0.2, yard.sighting());
  }
  return entropy.Figures();
}

/// Above the origin of H.
Viewer Lidar(
    const Yard& yard, double per_sr,
    std::function<bool(const Vec3&)> looks = [](const Vec3&) { return true; }) {
  return ViewerOf(ViewField::Samples::kPoints, per_sr, yard.X_WH() * MakePose(Vec3(0, 0, 2.0)),
                  std::move(looks));
}

TestBox OccupancyEntropyNothing() { return {Vec3(0, 0, -0.5), Vec3(0.01, 0.01, -0.4)}; }

// -0.5 ln 0.5 - 0.5 ln 0.5 = ln 2 = 0.693147;
// -0.25 ln 0.25 - 0.75 ln 0.75 = 0.346574 + 0.215762 = 0.562335.
constexpr double kOften_nat = 0.693147, kSeldom_nat = 0.562335;

TEST(OccupancyEntropy, OfAYesOrNo) {
  EXPECT_NEAR(BinaryEntropy(0.5), kOften_nat, 1e-6);
  EXPECT_NEAR(BinaryEntropy(0.25), kSeldom_nat, 1e-6);
  EXPECT_NEAR(BinaryEntropy(0.75), kSeldom_nat, 1e-6);
  EXPECT_EQ(BinaryEntropy(0), 0);
  EXPECT_EQ(BinaryEntropy(1), 0);
}

TEST(OccupancyEntropy, IsSummedOverTheVoxelsThatAreCovered) {
  const Yard yard(OccupancyEntropyNothing());
  const auto figures = FiguresOf(yard, {Lidar(yard, 1e4)});
  EXPECT_NEAR(FigureOf(figures, "information/smig").at[2], kOften_nat + kSeldom_nat, 1e-5);
  EXPECT_NEAR(FigureOf(figures, "information/smig_occluded").at[2], kOften_nat + kSeldom_nat, 1e-5);
  const auto ahead =
      FiguresOf(yard, {Lidar(yard, 1e4, [](const Vec3& d_S) { return d_S.x() > 0; })});
  EXPECT_NEAR(FigureOf(ahead, "information/smig").at[2], kOften_nat, 1e-5);
}

TEST(OccupancyEntropy, NeedsARayInTheVoxel) {
  // The voxels are sqrt(3.25^2 + 2.25^2 + 1.25^2) = 4.146 m away: 0.25 / 4.146^2 = 0.01454 sr, one
  // ray at 68.8 per steradian.
  const Yard yard(OccupancyEntropyNothing());
  EXPECT_EQ(FigureOf(FiguresOf(yard, {Lidar(yard, 68)}), "information/smig").at[0], 0);
  EXPECT_GT(FigureOf(FiguresOf(yard, {Lidar(yard, 69.5)}), "information/smig").at[0], 1);
  Viewer near_sighted = Lidar(yard, 1e4);
  near_sighted.field.max_distance_m = 4.1;
  EXPECT_EQ(FigureOf(FiguresOf(yard, {near_sighted}), "information/smig").at[0], 0);
}

TEST(OccupancyEntropy, IsLessWithOcclusionThanWithout) {
  const Yard yard({Vec3(1.8, -2, -1), Vec3(1.9, 4, 3)});  // across the line to the voxel ahead
  const auto figures = FiguresOf(yard, {Lidar(yard, 1e4)});
  EXPECT_NEAR(FigureOf(figures, "information/smig").at[0], kOften_nat + kSeldom_nat, 1e-5);
  EXPECT_NEAR(FigureOf(figures, "information/smig_occluded").at[0], kSeldom_nat, 1e-5);
}

TEST(OccupancyEntropy, OneMoreSensorNeverTakesAnyAway) {
  const Yard yard(OccupancyEntropyNothing());
  const Viewer left = Lidar(yard, 1e4, [](const Vec3& d_S) { return d_S.x() < 0; });
  const Viewer all = Lidar(yard, 1e4);
  const auto one = FiguresOf(yard, {left}), both = FiguresOf(yard, {left, all});
  EXPECT_NEAR(FigureOf(one, "information/smig").at[0], kSeldom_nat, 1e-5);
  EXPECT_NEAR(FigureOf(both, "information/smig").at[0], kOften_nat + kSeldom_nat, 1e-5);
}

TEST(OccupancyEntropy, IsNoneOfWhatMeasuresNoRange) {
  const Yard yard(OccupancyEntropyNothing());
  Viewer camera = Lidar(yard, 1e4);
  camera.field.ranges = false;
  EXPECT_EQ(FigureOf(FiguresOf(yard, {camera}), "information/smig").at[0], 0);
}

TEST(OccupancyEntropy, OccupantsArePeopleAndVehiclesAndNotTheMachineItself) {
  const Config config = Config::FromText(R"(
name: site
duration_s: 1
terrain: {size_m: [30, 30], cell_m: 0.5, soil: asphalt}
machines:
  - {name: digger, machine: tera:config/machines/tb235.yaml, operator: {type: idle}}
obstacles:
  - {name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [5, 3]}
  - {name: person1, preset: tera:config/obstacles/person_standing.yaml, xy_m: [6, -4], yaw_deg: 50}
)",
                                         "site.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const SceneAssembly assembly(scenario);
  const Simulation simulation(scenario);
  const auto occupants = OccupantsAt(simulation.state(), scenario, assembly, 0);
  ASSERT_EQ(occupants.size(), 1u);
  EXPECT_NEAR((occupants[0].X_WB.translation() - Vec3(6, -4, 0)).head<2>().norm(), 0, 1e-6);
  EXPECT_NEAR(occupants[0].high_B_m.z(), 1.8, 0.15);  // as tall as a person
}

}  // namespace
}  // namespace tera
