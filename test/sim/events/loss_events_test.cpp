#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "sim/drive_fixture.h"
#include "sim/events/contact_events.h"
#include "sim/events/fall_events.h"
#include "sim/events/spill_events.h"
#include "sim/events/tip_events.h"

/// Tips, spills, falls and strikes of states made by hand.

namespace tera {
namespace {

const Scenario& Parked() {
  static const Scenario scenario =
      Drive::Read("tb235.yaml", "{xy_m: [0, 0]}", "cell_m: 0.1, soil: asphalt", "");
  return scenario;
}

const MachineModel& Model() { return Parked().machines[0].placement.model; }

/// The machine with its root at X_WB, on its gears.
Instant At(TimeNs t_ns, const Pose& X_WB) {
  Instant now;
  now.t_ns = t_ns;
  MachineState& machine = now.machines.emplace_back();
  machine.q_rad = Parked().machines[0].placement.q_rad;
  for (const Pose& X_WL : ForwardKinematics(Model(), X_WB, machine.q_rad)) {
    machine.links.push_back({.X_WB = X_WL});
  }
  machine.gear_sinkage_m.assign(Model().ground_tools.gears.size(), 0.01);
  machine.shovel_load.resize(Model().ground_tools.shovels.size());
  return now;
}

/// Lean to the left at which the centre of mass is above the outer edge of the left track.
double Limit_rad() {
  const Instant level = At(0, Pose::Identity());
  Vec3 centre_m = Vec3::Zero();
  for (std::size_t i = 0; i < Model().links.size(); ++i) {
    const Link& link = Model().links[i];
    centre_m += link.mass_kg * (level.machines[0].links[i].X_WB * link.com_B_m);
  }
  centre_m /= Model().TotalMass_kg();
  double outer_m = 0, under_m = 1;
  for (const RunningGear& gear : Model().ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      if (patch.outward_B.z() > -0.999) continue;
      outer_m = std::max(outer_m, patch.p_B_m.y() + 0.5 * patch.width_m);
      under_m = std::min(under_m, patch.p_B_m.z());
    }
  }
  return std::atan2(outer_m - centre_m.y(), centre_m.z() - under_m);
}

std::vector<RecordedEvent> Leaning(double lean_rad) {
  TipEvents tips(Parked());
  tips.Observe(At(0, MakePose(Vec3(1, 2, 3))));
  for (int k = 1; k <= 5; ++k) {
    const Pose X_WB = MakePose(
        Vec3(1, 2, 3), RotationFromRpy(0, 0, 0.7) * RotationFromRpy(-lean_rad * k / 5, 0, 0));
    tips.Observe(At(k * 1'000'000, X_WB));
  }
  return tips.All();
}

TEST(TipEvents, BeginWhereTheCentreOfMassLeavesTheTracks) {
  const double limit_rad = Limit_rad();
  EXPECT_GT(limit_rad, 30 * kDeg);
  EXPECT_TRUE(Leaning(limit_rad - 1 * kDeg).empty());
  const auto tips = Leaning(limit_rad + 1 * kDeg);
  ASSERT_EQ(tips.size(), 1u);
  EXPECT_EQ(tips[0].begin_ns, 5'000'000);
  EXPECT_NEAR(tips[0].value, limit_rad + 1 * kDeg, 1e-9);
  EXPECT_EQ(tips[0].part, Model().links[0].name);
}

TEST(TipEvents, ATrackLiftsWhenTheGroundHasNotBorneItForATenthOfASecond) {
  TipEvents tips(Parked());
  const auto lift = [&](TimeNs from_ms, TimeNs to_ms, double sinkage_m) {
    for (TimeNs t_ms = from_ms; t_ms < to_ms; t_ms += 10) {
      Instant now = At(t_ms * 1'000'000, MakePose(Vec3::Zero(), 0.1));
      now.machines[0].gear_sinkage_m[1] = sinkage_m;
      tips.Observe(now);
    }
  };
  lift(0, 60, 0);
  lift(60, 500, 0.01);
  EXPECT_TRUE(tips.All().empty());
  lift(500, 710, 0);
  lift(710, 1200, 0.01);
  ASSERT_EQ(tips.All().size(), 1u);
  EXPECT_EQ(tips.All()[0].begin_ns, 500'000'000);
  EXPECT_EQ(tips.All()[0].end_ns, 700'000'000);
  EXPECT_EQ(tips.All()[0].part, Model().ground_tools.gears[1].name);
  EXPECT_NEAR(tips.All()[0].value, 0.1, 1e-9);
}

TEST(TipEvents, TwoLiftsOfOneStepEachAreNoTip) {
  TipEvents tips(Parked());
  for (TimeNs t_ms = 0; t_ms < 600; t_ms += 10) {
    Instant now = At(t_ms * 1'000'000, MakePose(Vec3::Zero(), 0.1));
    if (t_ms == 100 || t_ms == 250) now.machines[0].gear_sinkage_m[1] = 0;
    tips.Observe(now);
  }
  EXPECT_TRUE(tips.All().empty());
}

TEST(FallEvents, HaveTheirHeightAlsoBelowZero) {
  const Scenario scenario =
      Drive::Read("tb235.yaml", "{xy_m: [0, 0]}", "cell_m: 0.1, soil: asphalt",
                  "obstacles:\n  - {name: box, label: structure, mesh: tera:assets/rock.glb, xy_m: "
                  "[4, 0], collision: [{xyz_m: [0, 0, 0.2], size_m: [0.4, 0.4, 0.4]}], dynamic: "
                  "{mass_kg: 50}}\n");
  constexpr double kGround_m = -5, kHeight_m = 1.5, kStep_s = 0.01;
  const double fall_s = std::sqrt(2 * kHeight_m / kStandardGravity_mps2);
  FallEvents falls(scenario);
  Instant before;
  for (int k = 0; k < 100; ++k) {
    const double t_s = k * kStep_s;
    Instant now;
    now.t_ns = FromSeconds(t_s);
    BodyState& box = now.obstacles.emplace_back();
    const double fallen_m = 0.5 * kStandardGravity_mps2 * t_s * t_s;
    const bool flies = t_s < fall_s;
    box.X_WB = MakePose(Vec3(4, 0, kGround_m + (flies ? kHeight_m - fallen_m : 0)));
    if (flies) box.v_WB_mps.z() = -kStandardGravity_mps2 * t_s;
    if (k > 0) falls.Observe(before, now);
    before = now;
  }
  ASSERT_EQ(falls.All().size(), 1u);
  // The last step of the flight ends on the ground, at most a step of the fall away.
  EXPECT_NEAR(falls.All()[0].value, kHeight_m, kStandardGravity_mps2 * fall_s * kStep_s);
}

/// Strike of a shovel that hits a wall with an impulse and then presses on it.
RecordedEvent StrikeAt(double rate_hz, double impulse_n_s, double force_n) {
  ContactEvents contacts(Parked());
  const auto link = static_cast<std::size_t>(Model().ground_tools.shovels[0].link);
  Instant before = At(0, MakePose(Vec3(1, 2, 3), 0.4));
  for (int k = 1; k * 10 <= rate_hz; ++k) {
    Instant now = At(FromSeconds(k / rate_hz), MakePose(Vec3(1, 2, 3), 0.4));
    now.machines[0].links[link].v_WB_mps = Vec3(1, 0, 0);
    if (k > 1) {
      const double mean_n = force_n + (k == 2 ? impulse_n_s * rate_hz : 0);
      now.contacts = {{.a = {.link = static_cast<int>(link)},
                       .b = {.kind = BodyContact::Kind::kWall},
                       .p_W_m = now.machines[0].links[link].X_WB.translation(),
                       .force_W_n = Vec3(-mean_n, 0, 0)}};
    }
    contacts.Observe(before, now);
    before = now;
  }
  std::vector<RecordedEvent> strikes = contacts.All();
  std::erase_if(strikes, [](const auto& event) { return event.kind != EventKind::kStrike; });
  EXPECT_EQ(strikes.size(), 1u);
  return strikes.empty() ? RecordedEvent() : strikes[0];
}

TEST(ContactEvents, AStrikesImpulseDoesNotDependOnThePhysicsStep) {
  for (const double rate_hz : {100.0, 300.0, 500.0, 1000.0}) {
    const RecordedEvent strike = StrikeAt(rate_hz, 150, 4000);
    EXPECT_NEAR(strike.value, 150 + 4000 * 0.02, 1e-3) << rate_hz;
    EXPECT_EQ(strike.begin_ns, FromSeconds(1 / rate_hz)) << rate_hz;
    EXPECT_EQ(strike.end_ns - strike.begin_ns, 20'000'000) << rate_hz;
  }
}

/// A bucket's way: places along x with a load at each, 0.1 s apart.
struct Stop {
  double x_m, z_m, load_kg;
};

std::vector<RecordedEvent> Carried(const std::vector<Stop>& stops) {
  const TerrainSurface ground = [] {
    TerrainGrid grid;
    grid.origin_W_m = Vec2(-20, -20);
    grid.cell_m = 0.5;
    grid.nx = grid.ny = 81;
    return TerrainSurface(grid);
  }();
  const auto& shovels = Model().ground_tools.shovels;
  std::size_t bucket = 0;
  while (shovels[bucket].capacity_m3 <= 0) ++bucket;
  SpillEvents spills(Parked());
  Instant before;
  for (std::size_t k = 0; k < stops.size(); ++k) {
    Instant now =
        At(static_cast<TimeNs>(k) * 100'000'000, MakePose(Vec3(stops[k].x_m, 0, stops[k].z_m)));
    now.machines[0].shovel_load[bucket].mass_kg = stops[k].load_kg;
    if (k > 0) spills.Observe(before, now, ground);
    before = now;
  }
  return spills.All();
}

constexpr double kHigh_m = 5, kLow_m = -2;

TEST(SpillEvents, AreTheMassThatFallsFarFromTheDump) {
  const auto spills = Carried({{0, kHigh_m, 200},
                               {0, kHigh_m, 200},
                               {1, kHigh_m, 197},
                               {2, kHigh_m, 194.5},
                               {8, kHigh_m, 194.5},
                               {8, kHigh_m, 100},
                               {8.3, kHigh_m, 3},
                               {8.3, kHigh_m, 0}});
  ASSERT_EQ(spills.size(), 1u);
  EXPECT_NEAR(spills[0].value, 5.5, 1e-9);
  EXPECT_EQ(spills[0].begin_ns, 100'000'000);
  EXPECT_EQ(spills[0].end_ns, 300'000'000);
  EXPECT_EQ(spills[0].machine, "m");
  EXPECT_EQ(spills[0].part, "bucket");
}

TEST(SpillEvents, LeaveOutWhatFallsAtTheDumpAndInTheGround) {
  EXPECT_TRUE(Carried({{8, kHigh_m, 200},
                       {8, kHigh_m, 195},
                       {8, kHigh_m, 195},
                       {8.2, kHigh_m, 60},
                       {8.3, kHigh_m, 0}})
                  .empty());
  EXPECT_TRUE(
      Carried({{0, kLow_m, 200}, {1, kLow_m, 190}, {8, kHigh_m, 190}, {8, kHigh_m, 0}}).empty());
}

TEST(SpillEvents, LeaveOutSoilThatSticksUntilTheNextFilling) {
  EXPECT_TRUE(Carried({{8, kHigh_m, 140},
                       {8, kHigh_m, 140},
                       {8.2, kHigh_m, 60},
                       {8.3, kHigh_m, 30},
                       {0, kHigh_m, 30},
                       {0, kLow_m, 100},
                       {0, kLow_m, 150},
                       {6, kHigh_m, 150},
                       {6, kHigh_m, 20},
                       {0, kHigh_m, 20},
                       {0, kLow_m, 90}})
                  .empty());
}

TEST(SpillEvents, OfALoadThatIsNotYetDumpedCountFromWhereItIsAtTheEnd) {
  const auto spills =
      Carried({{0, kHigh_m, 200}, {0, kHigh_m, 190}, {6, kHigh_m, 190}, {7, kHigh_m, 190}});
  ASSERT_EQ(spills.size(), 1u);
  EXPECT_NEAR(spills[0].value, 10, 1e-9);
}

}  // namespace
}  // namespace tera
