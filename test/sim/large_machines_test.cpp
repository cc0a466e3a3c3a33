#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "core/config/config.h"
#include "core/units.h"
#include "sim/simulation.h"

/// The excavator of 20 t and the dozer at typical work.

namespace tera {
namespace {

using Positions = std::map<std::string, double>;

/// Lever positions as a function of time in seconds; levers not named stay neutral.
class Programme : public Operator {
 public:
  explicit Programme(std::function<Positions(double)> levers) : levers_(std::move(levers)) {}
  std::vector<double> Levers(const OperatorView& view) override {
    std::vector<double> levers(view.model.levers.size(), 0.0);
    for (const auto& [name, position] : levers_(ToSeconds(view.t_ns))) {
      levers.at(view.model.LeverIndex(name)) = position;
    }
    return levers;
  }

 private:
  std::function<Positions(double)> levers_;
};

/// One machine on level dirt, started away from the origin and turned.
struct WorkSite {
  WorkSite(const std::string& machine, const std::string& start, const std::string& operator_yaml,
           const std::string& effects = "")
      : scenario(Read(machine, start, operator_yaml, effects)), simulation(scenario) {}
  WorkSite(const std::string& machine, const std::string& start,
           std::function<Positions(double)> levers, const std::string& effects = "")
      : scenario(Read(machine, start, "{type: idle}", effects)),
        simulation(scenario, ByProgramme(std::move(levers))) {}

  static Operators ByProgramme(std::function<Positions(double)> levers) {
    Operators operators;
    operators.push_back(std::make_unique<Programme>(std::move(levers)));
    return operators;
  }

  static Scenario Read(const std::string& machine, const std::string& start,
                       const std::string& operator_yaml, const std::string& effects = "") {
    const Config config = Config::FromText(
        "name: site\nduration_s: 60\nterrain: {size_m: [40, 30], cell_m: 0.1, soil: dirt}\n"
        "machines:\n  - name: m\n    machine: tera:config/machines/" +
            machine + ".yaml\n    start: " + start + "\n    operator: " + operator_yaml + "\n" +
            effects,
        "site.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return scenario;
  }

  void Run(
      double duration_s, const std::function<void()>& after_step = [] {}) {
    const TimeNs end_ns = simulation.state().t_ns + FromSeconds(duration_s);
    while (simulation.state().t_ns < end_ns) {
      simulation.Step();
      after_step();
    }
  }

  const MachineState& machine() const { return simulation.state().machines[0]; }
  const MachineModel& model() const { return scenario.machines[0].placement.model; }
  const Pose& X_WB() const { return machine().links[0].X_WB; }
  double Tilt_rad() const { return std::acos(std::min(1.0, X_WB().linear()(2, 2))); }
  double Joint_rad(const std::string& name) const {
    return machine().q_rad[model().JointIndex(name)];
  }
  double Fastest_mps() const {
    double fastest_mps = 0;
    for (const BodyState& link : machine().links) {
      fastest_mps = std::max(fastest_mps, link.v_WB_mps.norm());
    }
    return fastest_mps;
  }

  const Scenario scenario;
  Simulation simulation;
};

const std::string kReach =
    "{xy_m: [-3, 2], yaw_deg: 25, joints_deg: {boom: 45, arm: -100, bucket: -60}}";

TEST(LargeMachines, WeighWhatTheirClassesDo) {
  EXPECT_NEAR(WorkSite("excavator20t", kReach, "{type: idle}").model().TotalMass_kg(), 19900, 1e-6);
  EXPECT_NEAR(WorkSite("dozer", "{xy_m: [2, 1]}", "{type: idle}").model().TotalMass_kg(), 12710,
              1e-6);
}

TEST(LargeMachines, StandLevelInRutsOfTheirGroundPressure) {
  // Bekker's sinkage of sandy loam under the mean pressure, (p / (k_c / b + k_phi))^(1 / n), plus
  // an elastic settlement of 0.88 (1 - 0.3^2) p b / E.
  const auto expected_m = [](double mass_kg, double length_m, double width_m) {
    const double pressure_pa = mass_kg * 9.81 / (2 * length_m * width_m);
    return std::pow(pressure_pa / (5270 / width_m + 1515040), 1 / 0.7) +
           0.88 * 0.91 * pressure_pa * width_m / 6.5e6;
  };
  WorkSite excavator("excavator20t", kReach, "{type: idle}");
  WorkSite dozer("dozer", "{xy_m: [2, 1], yaw_deg: 130}", "{type: idle}");
  for (WorkSite* site : {&excavator, &dozer}) {
    const Vec3 start = site->X_WB().translation();
    site->Run(2.0);
    EXPECT_LT(site->Tilt_rad(), 0.6 * kDeg);
    EXPECT_LT((site->X_WB().translation() - start).norm(), 0.005);
    EXPECT_LT(site->Fastest_mps(), 0.01);
  }
  // The weight lies off the middle of the tracks; the noses carry a small part.
  EXPECT_NEAR(-excavator.X_WB().translation().z() / expected_m(19900, 3.275, 0.60), 1, 0.2);
  EXPECT_NEAR(-dozer.X_WB().translation().z() / expected_m(12710, 2.745, 0.51), 1, 0.2);
}

TEST(LargeMachines, DriveAtTheSpeedOfTheirDataSheets) {
  // 5.5 km/h and 9.0 km/h.
  const std::map<std::string, double> speed_mps = {{"excavator20t", 5.5 / 3.6}, {"dozer", 2.5}};
  for (const auto& [machine, expected_mps] : speed_mps) {
    WorkSite site(machine, "{xy_m: [-14, -4], yaw_deg: 20}", [](double) {
      return Positions{{"left_track", 1}, {"right_track", 1}};
    });
    site.Run(3.0);
    const Vec3 from = site.X_WB().translation();
    site.Run(4.0);
    const Vec3 way_m = site.X_WB().translation() - from;
    EXPECT_NEAR(way_m.norm() / 4.0 / expected_mps, 1, 0.02) << machine;
    EXPECT_NEAR(std::atan2(way_m.y(), way_m.x()) / kDeg, 20, 0.5) << machine;
    EXPECT_LT(site.Tilt_rad(), 3 * kDeg) << machine;
  }
}

TEST(LargeMachines, TracksAndBoomShareTheFlowOfThePump) {
  // At full levers the tracks take all of 439 l/min. So does the boom, whose cylinders of 2 x 113
  // cm2 extend by 1.334 m over 111 deg, at 27 deg/s. Together each gets half.
  const std::string enough = "effects: {m: {main: {flow_sharing: none}}}\n";
  // The arm reaches out, so that the bucket clears the ground under the tracks.
  const std::string start =
      "{xy_m: [-14, -4], yaw_deg: 20, joints_deg: {boom: 10, arm: -40, bucket: -120}}";
  const auto speed_mps = [&](double boom, const std::string& effects) {
    const auto levers = [boom](double t_s) {
      return Positions{{"left_track", 1}, {"right_track", 1}, {"boom", t_s > 2.5 ? boom : 0.0}};
    };
    WorkSite site("excavator20t", start, levers, effects);
    site.Run(3.2);
    const Vec3 from = site.X_WB().translation();
    site.Run(0.8);
    return (site.X_WB().translation() - from).norm() / 0.8;
  };
  EXPECT_NEAR(speed_mps(0, ""), 1.528, 0.05);
  EXPECT_NEAR(speed_mps(1, enough), 1.528, 0.08);
  EXPECT_NEAR(speed_mps(1, "") / 1.528, 0.5, 0.1);
}

const std::string kDig =
    "{type: dig_cycle, reach_m: 7.8, cut_length_m: 3.0, cut_depth_m: 0.45, cut_speed_mps: 0.8, "
    "dump_azimuth_deg: 80, dump_reach_m: 6.8, dump_height_m: 2.6, cycles: 1, patience_s: 8, "
    "servo_gain_1ps: 2";

TEST(LargeMachines, TheExcavatorDigsLiftsAndDumps) {
  WorkSite site("excavator20t", kReach, kDig + ", slew_braking_degps2: 25}");
  double most_kg = 0, highest_m = 0, most_tilt_rad = 0;
  site.Run(25, [&] {
    const SoilReaction::Load& load = site.machine().shovel_load[0];
    most_kg = std::max(most_kg, load.mass_kg);
    most_tilt_rad = std::max(most_tilt_rad, site.Tilt_rad());
    const int bucket = site.model().LinkIndex("bucket");
    if (load.mass_kg > 300) {
      highest_m = std::max(highest_m, site.machine().links[bucket].X_WB.translation().z());
    }
  });
  // Struck, 0.56 m3 of loose dirt, 1474 kg/m3 over 1.1, are 750 kg; heaped 1:1, 1070 kg.
  EXPECT_GT(most_kg, 600);
  EXPECT_LT(most_kg, 1070);
  EXPECT_GT(highest_m, 2.5);
  EXPECT_LT(site.machine().shovel_load[0].mass_kg, 0.2 * most_kg);
  EXPECT_LT(most_tilt_rad, 8 * kDeg);
  const MassLedger ledger = site.simulation.state().ground().ledger();
  EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
}

TEST(LargeMachines, TheExcavatorStandsInItsPlaceAsItSlews) {
  // Its slew's 65 kN m are less than half of the (c A + W tan phi) 1.4 m that locked tracks hold in
  // dirt. For two buckets from the same place, the machine's rotation is less than half of 1.05 m
  // at 7.8 m, which would move its bucket out of its trench.
  std::string twice = kDig + ", slew_braking_degps2: 20}";
  twice.replace(twice.find("cycles: 1"), 9, "cycles: 2");
  WorkSite site("excavator20t", kReach, twice);
  double most_rad = 0;
  site.Run(36, [&] {
    const Mat3 R_WB = site.X_WB().linear();
    const double yaw_rad = std::atan2(R_WB(1, 0), R_WB(0, 0)) - 25 * kDeg;
    most_rad = std::max(most_rad, std::abs(yaw_rad));
  });
  EXPECT_LT(most_rad, 0.5 * 1.045 / 7.8);
}

TEST(LargeMachines, TheExcavatorLoadsATruck) {
  const Config config = Config::FromFile("config/scenarios/load_truck.yaml", {});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  Simulation simulation(scenario);
  const int slew = scenario.machines[0].placement.model.JointIndex("slew");
  // Load above the bed, and soil in the bed after each of two dumps.
  double over_bed_kg = 0, sum_kg = 0;
  int dumps = 0;
  for (bool full = false; dumps < 2 && simulation.state().t_ns < FromSeconds(60);) {
    simulation.Step();
    const double held_kg = simulation.state().machines[0].shovel_load[0].mass_kg;
    const double slew_rad = simulation.state().machines[0].q_rad[slew];
    if (slew_rad > 70 * kDeg) over_bed_kg = std::max(over_bed_kg, held_kg);
    full = full || (over_bed_kg > 300 && slew_rad > 70 * kDeg);
    if (full && slew_rad < 60 * kDeg) {
      sum_kg += over_bed_kg - held_kg;
      EXPECT_GT(simulation.state().beds[0].mass_kg, 0.9 * sum_kg);
      full = false, over_bed_kg = 0;
      ++dumps;
    }
  }
  EXPECT_EQ(dumps, 2);
  EXPECT_GT(sum_kg, 1000);
  const MassLedger ledger = simulation.state().ground().ledger();
  EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
  EXPECT_NEAR(ledger.beds_kg / simulation.state().beds[0].mass_kg, 1, 1e-9);
}

TEST(LargeMachines, TheExcavatorDigsThroughDeadBandsOfItsLevers) {
  const auto most_kg = [](const std::string& width) {
    std::string effects = "effects:\n  m:\n";
    for (const char* joint : {"slew", "boom", "arm", "bucket"}) {
      effects += std::string("    ") + joint + ": {dead_band: {width: " + width + "}}\n";
    }
    WorkSite site("excavator20t", kReach, kDig + ", slew_braking_degps2: 20}", effects);
    double most_kg = 0;
    site.Run(25, [&] { most_kg = std::max(most_kg, site.machine().shovel_load[0].mass_kg); });
    EXPECT_LT(site.machine().shovel_load[0].mass_kg, 0.2 * most_kg) << width;
    return most_kg;
  };
  const double ideal_kg = most_kg("0");
  EXPECT_GT(most_kg("0.1"), 0.8 * ideal_kg);
  EXPECT_GT(most_kg("0.25"), 0.8 * ideal_kg);
}

/// Overshoot of the slew beyond 80 deg, where it dumps the load.
double Overshoot_deg(const std::string& more) {
  WorkSite site("excavator20t", kReach, kDig + more + "}");
  double most_rad = 0;
  site.Run(18, [&] { most_rad = std::max(most_rad, site.Joint_rad("slew")); });
  return most_rad / kDeg - 80;
}

TEST(LargeMachines, AnOperatorWhoBrakesInTimeDoesNotSwingPastTheDump) {
  // 65 kN m decelerate some 130 t m2 of upper structure, arm and load at 28 deg/s2.
  EXPECT_GT(Overshoot_deg(""), 15);
  const double braked_deg = Overshoot_deg(", slew_braking_degps2: 20");
  EXPECT_GT(braked_deg, -6);
  EXPECT_LT(braked_deg, 6);
}

TEST(LargeMachines, TheDozerLiftsAndTiltsItsBladeOverTheRangesOfItsClass) {
  // 0.97 m above the ground and 0.6 m below it; 0.38 m between the ends of 3.045 m.
  const auto ends_m = [](const WorkSite& site) {
    const Pose& X_WL = site.machine().links[site.model().LinkIndex("blade")].X_WB;
    return Vec2((X_WL * Vec3(0.42, 1.5225, -0.42)).z(), (X_WL * Vec3(0.42, -1.5225, -0.42)).z());
  };
  WorkSite site("dozer", "{xy_m: [2, 1], yaw_deg: 40}", [](double t_s) {
    return Positions{{"lift", 1}, {"tilt", t_s < 5 ? 1 : -1}};
  });
  site.Run(5);
  const double sunk_m = -site.X_WB().translation().z();
  EXPECT_NEAR(ends_m(site).mean() + sunk_m, 0.97, 0.05);
  EXPECT_NEAR(ends_m(site)[0] - ends_m(site)[1], 0.38, 0.03);
  site.Run(5);
  EXPECT_NEAR(ends_m(site)[0] - ends_m(site)[1], -0.38, 0.03);
  const Joint& lift = site.model().joints[site.model().JointIndex("lift")];
  const double reach_m = 2.15 + 0.42;
  EXPECT_NEAR(0.42 + reach_m * std::sin(lift.lower_rad) - 0.42 * std::cos(lift.lower_rad), -0.6,
              0.02);
}

/// Height of the blade's edge above the dozer's undisturbed ground.
double Edge_m(const WorkSite& site) {
  const NamedFrame& edge = site.model().frames[0];
  return (site.machine().links[edge.link].X_WB * edge.X_BF).translation().z();
}

TEST(LargeMachines, TheDozerPushesAWindrowBeforeItsBlade) {
  // The blade descends to 5 cm and is held there by hand: raised where it sinks, lowered where it
  // rises.
  WorkSite* dozer = nullptr;
  WorkSite site("dozer", "{xy_m: [-10, 2], yaw_deg: 15}", [&](double t_s) {
    const double lift = std::clamp(8 * (-0.05 - Edge_m(*dozer)), -0.5, 0.5);
    const double drive = t_s < 3 ? 0.0 : 0.3;
    return Positions{{"lift", lift}, {"left_track", drive}, {"right_track", drive}};
  });
  dozer = &site;
  const TerrainSurface start = site.simulation.ground();
  site.Run(11.0);
  const Pose X_WB = site.X_WB();
  ASSERT_GT((X_WB.translation() - Vec3(-10, 2, 0)).norm(), 4.0);
  // Soil within 1.5 m ahead of the blade, and soil removed from its path.
  double heaped_m3 = 0, cut_m3 = 0;
  const TerrainSurface& end = site.simulation.ground();
  for (int j = 0; j < end.ny; ++j) {
    for (int i = 0; i < end.nx; ++i) {
      const Vec2 p_W = end.origin_W_m + end.cell_m * Vec2(i, j);
      const Vec3 p_B = X_WB.inverse() * Vec3(p_W.x(), p_W.y(), 0);
      if (std::abs(p_B.y()) > 2.2) continue;
      const double rise_m3 = (end.height_m(i, j) - start.height_m(i, j)) * end.cell_m * end.cell_m;
      if (p_B.x() > 2.3 && p_B.x() < 4.2) heaped_m3 += std::max(0.0, rise_m3);
      if (p_B.x() < 2.3) cut_m3 -= std::min(0.0, rise_m3);
    }
  }
  EXPECT_GT(heaped_m3 * 1474 / 1.1, 300);  // kg
  EXPECT_GT(cut_m3, 0.5 * heaped_m3);
  const MassLedger ledger = site.simulation.state().ground().ledger();
  EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9);
}

TEST(LargeMachines, ABladeDrivenTooDeepStallsTheDozer) {
  WorkSite site("dozer", "{xy_m: [-10, 2], yaw_deg: 15}", [](double t_s) {
    return Positions{
        {"lift", -1}, {"left_track", t_s < 1 ? 0 : 0.6}, {"right_track", t_s < 1 ? 0 : 0.6}};
  });
  double fastest_mps = 0, most_tilt_rad = 0;
  site.Run(8.0, [&] {
    fastest_mps = std::max(fastest_mps, site.Fastest_mps());
    most_tilt_rad = std::max(most_tilt_rad, site.Tilt_rad());
  });
  EXPECT_LT(fastest_mps, 2.5);  // full speed of the tracks
  EXPECT_LT(most_tilt_rad, 20 * kDeg);
  // It stands, with its tracks spinning or stalled at full torque.
  const Vec3 from = site.X_WB().translation();
  double most_slip = 0, most_torque_nm = 0;
  site.Run(2.0, [&] {
    for (const int gear : {0, 1}) {
      most_slip = std::max(most_slip, site.machine().gear_slip[gear]);
      most_torque_nm = std::max(most_torque_nm, site.machine().gear_torque_nm[gear]);
    }
  });
  EXPECT_LT((site.X_WB().translation() - from).norm(), 0.2);
  EXPECT_TRUE(most_slip > 0.5 || most_torque_nm > 24000) << most_slip << ' ' << most_torque_nm;
}

}  // namespace
}  // namespace tera
