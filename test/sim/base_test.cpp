#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "drive_fixture.h"

/// A whole machine with its tracks, blade and bucket on the ground.

namespace tera {
namespace {

constexpr const char* kExcavator = "tb235.yaml";
constexpr const char* kStowed = "joints_deg: {boom: 55, arm: -130, bucket: -40}";

std::string At(double x_m, double y_m, double yaw_deg, const std::string& joints = kStowed) {
  return fmt::format("{{xy_m: [{}, {}], yaw_deg: {}, {}}}", x_m, y_m, yaw_deg, joints);
}

std::string Custom(const std::string& name, const std::string& like, double friction_deg) {
  return fmt::format(
      "{{preset: tera:config/soils/{}.yaml, name: {}, shear_friction_deg: {}, "
      "shear_cohesion_pa: 0}}",
      like, name, friction_deg);
}

std::string Ground(const std::string& ground) { return "    ground: " + ground + "\n"; }

double Tilt_rad(const Drive& drive) { return std::acos(drive.body().X_WB.linear()(2, 2)); }

TEST(Base, TipsOverWhereItsWeightPassesTheEdgeOfItsTrack) {
  // Hard, rough ground without sinkage or slip, rising to the left. The right track's outer edge is
  // 0.574 + 0.15 m from the middle.
  const auto lean = [](double slope_deg, const std::string& ground) {
    Drive drive(kExcavator, At(0, 0, 0),
                "cell_m: 0.05, soil: rough, custom_soils: [{preset: "
                "tera:config/soils/asphalt.yaml, name: rough, friction_angle_deg: 80, "
                "young_modulus_pa: 1.0e8, k_phi_npm_n2: 1.0e11}]" +
                    fmt::format(", relief: {{slope_deg: {}, slope_direction_deg: 90}}", slope_deg),
                0, 0, Ground(ground) + "physics_rate_hz: 1000\nsettle_s: 0\n");
    double most_rad = 0;
    drive.Run(2.0, [&] { most_rad = std::max(most_rad, Tilt_rad(drive)); });
    return most_rad / kDeg;
  };
  Drive level(kExcavator, At(0, 0, 0), "cell_m: 0.1, soil: asphalt", 0, 0);
  const Vec3 com_B = level.body().X_WB.inverse() * level.CentreOfMass();
  const double critical_deg = std::atan((0.724 + com_B.y()) / com_B.z()) / kDeg;
  for (const char* ground : {"terramechanics", "ideal"}) {
    EXPECT_NEAR(lean(0.9 * critical_deg, ground), 0.9 * critical_deg, 2) << ground;
    EXPECT_GT(lean(1.1 * critical_deg, ground), 1.1 * critical_deg + 15) << ground;
  }
}

/// A ground, and the model of the base's motion over it.
const std::pair<const char*, const char*> kGrounds[] = {
    {"asphalt", "terramechanics"}, {"dirt", "terramechanics"}, {"dirt", "ideal"}};

TEST(Base, TravelsAlongASideSlope) {
  for (const auto& [soil, ground] : kGrounds) {
    Drive drive(kExcavator, At(-4, 1, 0),
                fmt::format("cell_m: 0.1, soil: {}, relief: {{slope_deg: 15, "
                            "slope_direction_deg: 90}}",
                            soil),
                0.6, 0.6, Ground(ground));
    const Vec3 start = drive.place();
    drive.Run(4.0);
    const Vec3 way = drive.place() - start;
    EXPECT_NEAR(way.x() / (4.0 * 0.75), 1, 0.05) << soil << ' ' << ground;
    // Downhill drift stays below a tenth of the path.
    EXPECT_LT(way.y(), 0.01) << soil << ' ' << ground;
    EXPECT_GT(way.y(), -0.3) << soil << ' ' << ground;
    EXPECT_NEAR(drive.yaw_rad() / kDeg, 0, 5) << soil << ' ' << ground;
  }
}

/// A step of this height across the path, at x = 0.
std::string Step(double height_m) {
  return fmt::format(
      "effects: {{m: {{base: {{terrain_height: {{x_m: 8, y_m: 0, radius_m: 8, height_m: {}, "
      "edge_m: 0.1}}}}}}}}\n",
      height_m);
}

TEST(Base, ClimbsAStepAndNotAWall) {
  for (const auto& [soil, ground] : kGrounds) {
    Drive over(kExcavator, At(-2.0, 0, 0), fmt::format("cell_m: 0.05, soil: {}", soil), 0.5, 0.5,
               Ground(ground) + Step(0.15));
    double most_rad = 0;
    over.Run(6.0, [&] { most_rad = std::max(most_rad, Tilt_rad(over)); });
    EXPECT_NEAR(over.place().x(), -2.0 + 6 * 0.625, 0.3) << soil << ' ' << ground;
    // Road wheels press with twice the mean of 36 kPa: on dirt, by Bekker, a rut of 1.3 cm.
    const double rut_m = soil == std::string("dirt") ? 0.013 : 0;
    EXPECT_NEAR(over.place().z(), 0.15 - rut_m, 0.03) << soil << ' ' << ground;
    // Nose on the step, heel on the ground: 0.15 m over the tracks' 1.6 m. More when it balances on
    // the edge before it tips over; in dirt the edge yields as the heel does.
    EXPECT_GT(most_rad, 0.95 * std::asin(0.15 / 1.6)) << soil << ' ' << ground;
    EXPECT_LT(most_rad, 3 * std::asin(0.15 / 1.6)) << soil << ' ' << ground;

    Drive against(kExcavator, At(-2.0, 0, 0), fmt::format("cell_m: 0.05, soil: {}", soil), 0.5, 0.5,
                  Ground(ground) + Step(1.0));
    against.Run(3.0);
    EXPECT_LT(against.place().x(), -0.9) << soil << ' ' << ground;
  }
}

/// It stands on slick pavement and digs in dirt, with the blade ahead; no track turns.
struct Dig : Drive {
  Dig(const std::string& ground, double blade_lever)
      : Drive(kExcavator, At(0, 0, 0, "joints_deg: {boom: 30, arm: -100, bucket: -30, blade: 8}"),
              "cell_m: 0.05, soils: [slick, dirt], custom_soils: [" +
                  Custom("slick", "asphalt", 12) +
                  "], strips: [{soil: slick, axis: x, from_m: -15, to_m: 1.15}, "
                  "{soil: dirt, axis: x, from_m: 1.15, to_m: 15}]",
              0, 0, Ground(ground)) {
    Operate([=](double t_s) -> NamedLevers {
      if (t_s < 2.0) return {{"blade", blade_lever}};
      if (t_s < 2.6) return {{"boom", -0.6}};
      return {{"arm", -0.7}};
    });
    Run(2.0);
    const Vec3 start = place();
    Run(2.5);
    dragged_m = (place() - start).x();
  }
  double dragged_m = 0;
};

TEST(Base, BucketPullsTheMachineAndTheBladeHoldsIt) {
  for (const char* ground : {"terramechanics", "ideal"}) {
    const Dig up(ground, 0.5), down(ground, -1);
    EXPECT_GT(up.dragged_m, 0.2) << ground;
    EXPECT_LT(down.dragged_m, 0.75 * up.dragged_m) << ground;
    EXPECT_GT(down.dragged_m, 0) << ground;
  }
}

TEST(Base, TracksPushTheBucketIntoAPile) {
  for (const char* ground : {"terramechanics", "ideal"}) {
    Drive drive(kExcavator, At(-2, 0, 0, "joints_deg: {boom: 30, arm: -85, bucket: 30, blade: 20}"),
                "cell_m: 0.05, soil: dirt, piles: [{xy_m: [3.9, 0], height_m: 0.8, soil: dirt}]", 0,
                0, Ground(ground));
    const auto tip = [&]() -> Vec3 {
      const NamedFrame& frame = drive.scenario.machines[0].placement.model.frames[0];
      return drive.machine().links[frame.link].X_WB * frame.X_BF.translation();
    };
    const auto thrust_n = [&] {
      const auto& torque_nm = drive.machine().gear_torque_nm;
      return (torque_nm[0] + torque_nm[1]) / 0.25;
    };
    drive.Operate([](double t_s) -> NamedLevers {
      return t_s < 0.5 ? NamedLevers{} : NamedLevers{{"left_track", 0.4}, {"right_track", 0.4}};
    });
    const TerrainSurface before = drive.simulation->ground();
    EXPECT_GT(tip().z(), 0);
    EXPECT_LT(tip().x(), 2.6);
    double free_n = 0, most_n = 0;
    int n = 0;
    drive.Run(5.0, [&] {
      const bool at_pile = tip().x() > 2.9;
      if (!at_pile && ToSeconds(drive.simulation->state().t_ns) > 1.1) free_n += thrust_n(), ++n;
      if (at_pile) most_n = std::max(most_n, thrust_n());
    });
    double raised_m = 0;
    for (double ahead_m = 0.05; ahead_m < 0.8; ahead_m += 0.05) {
      const double x_m = tip().x() + ahead_m;
      raised_m =
          std::max(raised_m, drive.simulation->ground().HeightAt(x_m, 0) - before.HeightAt(x_m, 0));
    }
    EXPECT_GT(tip().x(), 3.4) << ground;
    EXPECT_GT(raised_m, 0.05) << ground;  // soil pushed ahead
    EXPECT_GT(most_n, free_n / n + 2000) << ground;
    const MassLedger ledger = drive.simulation->state().ground().ledger();
    EXPECT_NEAR(ledger.total_kg() / ledger.shifted_kg, 0, 1e-9) << ground;
  }
}

/// Root mean square of the pitch rate during steady turning.
double PitchRate_radps(const std::string& soil, double left, double right,
                       const std::string& more = "") {
  Drive drive(kExcavator, At(0, 0, 20), "cell_m: 0.05, soil: " + soil, left, right, more);
  drive.Run(2.0);
  double square = 0;
  int n = 0;
  drive.Run(3.0, [&] {
    const Vec3 w_B = drive.body().X_WB.linear().transpose() * drive.body().w_WB_radps;
    square += w_B.y() * w_B.y();
    ++n;
  });
  return std::sqrt(square / n);
}

TEST(Base, TurnsOnFirmGroundWithoutRocking) {
  EXPECT_LT(PitchRate_radps("asphalt", 0.2, 0.8), 0.05);
  EXPECT_LT(PitchRate_radps("asphalt", -0.4, 0.4), 0.05);
  EXPECT_LT(PitchRate_radps("sand", -0.4, 0.4), 0.1);
}

TEST(Base, RocksOnACurveOfMuchFrictionAloneAndAlikeAtEveryStep) {
  const auto gravel = [](double friction_deg) {
    return "g, custom_soils: [" + Custom("g", "gravel", friction_deg) + "]";
  };
  EXPECT_LT(PitchRate_radps(gravel(28), -0.4, 0.4), 0.01);
  const double rocking_radps = PitchRate_radps(gravel(44), -0.4, 0.4);
  EXPECT_NEAR(PitchRate_radps(gravel(44), -0.4, 0.4, "physics_rate_hz: 1000\n") / rocking_radps, 1,
              0.1);
}

}  // namespace
}  // namespace tera
