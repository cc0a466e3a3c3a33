#include "layout/measures/sky_view.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/config/config.h"
#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "own_folder.h"
#include "sim/simulation.h"

namespace tera {
namespace {

constexpr double kAntennaHeight_m = 1.6;

/// An invisible post, whose top is turned by 40 deg and carries an antenna.
constexpr const char* kPost = R"(
kind: post
fixed_base: true
links:
  base: {mass_kg: 100, com_m: [0, 0, 0.2], inertia_kgm2: [10, 10, 10], label: structureVISUALS}
  top: {mass_kg: 10, com_m: [0, 0, 0.2], inertia_kgm2: [1, 1, 1], label: structure}
joints:
  turn: {type: revolute, parent: base, child: top, xyz_m: [0, 0, 1.2], axis: [0, 0, 1],
         limits_deg: [-170, 170], max_rate_degps: 60, max_effort_nm: 500, initial_deg: 40}
levers: [turn]
)";

/// A wall of 400 m in x from z = 0 to `height_m`, whose face of -y is the plane y = `distance_m`.
std::string WallMesh(double distance_m, double height_m) {
  std::string mesh = "o body\n";
  for (const double y_m : {distance_m, distance_m + 0.2}) {
    mesh +=
        fmt::format("v -200 {0} 0\nv 200 {0} 0\nv 200 {0} {1}\nv -200 {0} {1}\n", y_m, height_m);
  }
  return mesh + "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 4 3 7 8\nf 5 6 2 1\n";
}

enum class WallOf { kNobody, kMachine, kSite };

/// The sky view of an antenna 1.6 m above the ground next to a wall.
SkyView Seen(WallOf whose, double distance_m, double height_m, double mask_deg) {
  const auto folder = OwnFolder();
  WriteWholeFile(folder / "wall.obj", WallMesh(distance_m, height_m));
  const std::string wall = (folder / "wall.obj").string();
  std::string post = kPost, obstacles;
  post.replace(post.find("VISUALS"), 7,
               whose == WallOf::kMachine ? ", visuals: [{mesh: " + wall + "}]" : "");
  WriteWholeFile(folder / "post.yaml", post);
  if (whose == WallOf::kSite) {
    obstacles = "obstacles: [{name: wall1, label: structure, mesh: " + wall +
                ", xy_m: [3, -2], yaw_deg: 30}]\n";
  }
  const Config config = Config::FromText(
      "name: post\nduration_s: 1\nterrain: {size_m: [20, 20], cell_m: 0.5, soil: asphalt}\n"
      "machines:\n  - name: post1\n    machine: " +
          (folder / "post.yaml").string() +
          "\n    start: {xy_m: [3, -2], yaw_deg: 30}\n    operator: {type: idle}\n    rig:\n"
          "      sensors:\n        - {name: roof, preset: tera:config/sensors/rtk_f9p.yaml, "
          "link: top, xyz_m: [0, 0, 0.4]}\n" +
          obstacles,
      "post.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const Simulation simulation(scenario);
  const SceneAssembly assembly(scenario);
  Sighting sighting(scenario, assembly, 1);
  sighting.Show(simulation.state(), simulation.ground());
  const ScenarioMachine& machine = scenario.machines[0];
  SkyView view(machine.placement.model, 0, machine.sensors, mask_deg);
  view.Add(simulation.state().machines[0], sighting);
  return view;
}

double ShareOf(const SkyView& view, const std::string& name) {
  for (const Figure& figure : view.Figures()) {
    if (NameOf(figure.id) == name) return figure.at.at(0);
  }
  ADD_FAILURE() << "no figure " << name;
  return -1;
}

// Directions are drawn one in each of 72 by 18 cells (16 above the mask), so that only cells on the
// border of the hidden part are uncertain. These are some 2 * 18 of 1296, each by at most half. The
// standard error is sqrt(36) / 2 / 1296 = 0.0023; for cells of twice the mean solid angle 0.0046,
// two of that.
constexpr double kWithin = 0.0092;

TEST(SkyView, NothingAroundHidesNothing) {
  const SkyView view = Seen(WallOf::kNobody, 0, 0, SkyView::kMask_deg);
  EXPECT_EQ(ShareOf(view, "sky/roof/hidden"), 0);
  EXPECT_EQ(ShareOf(view, "sky/roof/hidden_by_site"), 0);
}

TEST(SkyView, AWallWithoutEndBesideTheAntennaHidesHalfOfTheSky) {
  // 200 m high at 0.4 m: up to 89.9 deg. Half of the azimuths are hidden, for any mask.
  for (const double mask_deg : {0.0, 10.0, 37.0}) {
    const SkyView view = Seen(WallOf::kMachine, 0.4, 200, mask_deg);
    EXPECT_NEAR(ShareOf(view, "sky/roof/hidden"), 0.5, kWithin) << mask_deg;
    // At the horizon lies the land around the site.
    if (mask_deg > 0) {
      EXPECT_EQ(ShareOf(view, "sky/roof/hidden_by_site"), 0) << mask_deg;
    }
  }
}

TEST(SkyView, ALongWallHidesTheLuneBetweenTheGroundAndItsEdge) {
  // An infinite straight edge and the horizon through the antenna are two great half-circles with
  // common ends. Between them lies a lune, whose share of the hemisphere is its angle over pi. The
  // wall's ends, 200 m to each side of 2.5 m, leave less than (2.5 / 200)^2 of it open.
  for (const double above_m : {0.8, 2.5, 9.0}) {
    const SkyView view = Seen(WallOf::kMachine, 2.5, kAntennaHeight_m + above_m, 0);
    EXPECT_NEAR(ShareOf(view, "sky/roof/hidden"), std::atan(above_m / 2.5) / kPi, kWithin)
        << above_m;
  }
}

TEST(SkyView, WhatTheSiteHidesIsCountedApart) {
  const SkyView view = Seen(WallOf::kSite, 0.4, 200, SkyView::kMask_deg);
  EXPECT_EQ(ShareOf(view, "sky/roof/hidden"), 0);
  EXPECT_NEAR(ShareOf(view, "sky/roof/hidden_by_site"), 0.5, kWithin);
}

TEST(SkyView, TheMapIsTurnedToTheHeadingOfTheAntennasLink) {
  // The wall is left of the base, at azimuth 90 deg. The top is turned 40 deg to the left, so that
  // the wall's foot is at 50 deg. Seen at right angles it reaches up to 45 deg.
  const std::vector<PolarMap> maps =
      Seen(WallOf::kMachine, 2.5, kAntennaHeight_m + 2.5, SkyView::kMask_deg).Maps();
  ASSERT_EQ(maps.size(), 1u);
  EXPECT_EQ(NameOf(maps[0].id), "sky/roof/hidden");
  const auto at = [&](int azimuth_deg, int ring) {
    return maps[0].value[SkyGrid::Index(azimuth_deg / 5, ring)];
  };
  constexpr int kUp40To45 = 9, kUp45To50 = 8, kUp5To10 = 16, kUp10To15 = 15;
  EXPECT_EQ(at(50, kUp40To45), 1);
  EXPECT_EQ(at(50, kUp45To50), 0);
  EXPECT_EQ(at(230, kUp10To15), 0);
  EXPECT_EQ(at(50, kUp5To10), -1);
  // 60 deg off the right angle the edge is at atan(cos 60) = 26.6 deg.
  EXPECT_EQ(at(110, kUp10To15), 1);
  EXPECT_EQ(at(110, kUp40To45), 0);
}

TEST(SkyView, ItsStandardErrorCoversTheSpreadOfAKnownShare) {
  const SkyView view = Seen(WallOf::kMachine, 2.5, kAntennaHeight_m + 2.5, 0);
  const Figure hidden = view.Figures().at(0);
  EXPECT_LT(std::abs(hidden.at[0] - 0.25), 2 * hidden.error.at(0));
  // 1296 unstratified directions would have sqrt(0.25 * 0.75 / 1296) = 0.012.
  EXPECT_NEAR(hidden.error[0], 0.012, 0.004);
}

}  // namespace
}  // namespace tera
