#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/units.h"
#include "drive_fixture.h"

/// A machine, its drive and the ground together, as a driver sees them.

namespace tera {
namespace {

constexpr const char* kDriveExcavator = "tb235.yaml";
/// The excavator: operating weight, two tracks of width b and ground length L, speed at full lever.
constexpr double kMass_kg = 3500, kB_m = 0.3, kL_m = 1.6, kGauge_m = 1.148, kFullSpeed_mps = 1.25;
constexpr double kG_mps2 = 9.80665;
constexpr const char* kDriveStowed = "joints_deg: {boom: 55, arm: -130, bucket: -40}";

std::string StowedAt(double x_m, double y_m, double yaw_deg) {
  return fmt::format("{{xy_m: [{}, {}], yaw_deg: {}, {}}}", x_m, y_m, yaw_deg, kDriveStowed);
}

/// Root mean square of the chassis' acceleration about its mean.
double Shake_mps2(Drive* drive, double duration_s) {
  Vec3 sum = Vec3::Zero();
  double square = 0;
  int n = 0;
  drive->Run(duration_s, [&] {
    const Vec3 a = drive->body().a_WB_mps2;
    sum += a;
    square += a.squaredNorm();
    ++n;
  });
  return std::sqrt(std::max(0.0, square / n - (sum / n).squaredNorm()));
}

/// Sinkage of a plate of width b under pressure p: Bekker's (p / (k_c/b + k_phi))^(1/n), plus the
/// elastic settlement p b (1 - nu^2) I / E of a plate on a half space, nu = 0.3, I = 0.88.
struct Bearing {
  double k_c, k_phi, n, young_pa;
  double Modulus() const { return k_c / kB_m + k_phi; }
  double Rut_m(double pressure_pa) const { return std::pow(pressure_pa / Modulus(), 1 / n); }
  double Sinkage_m(double pressure_pa) const {
    return Rut_m(pressure_pa) + pressure_pa * kB_m * (1 - 0.3 * 0.3) * 0.88 / young_pa;
  }
  /// Pressure under stiff shoes at `depth_m`, where the road wheels press `share` times the mean.
  /// The rut takes the inelastic part.
  double Pressure_pa(double depth_m, double share) const {
    double low_pa = 0, high_pa = Modulus() * std::pow(depth_m, n);
    while (high_pa - low_pa > 1) {
      const double p = 0.5 * (low_pa + high_pa);
      (Rut_m(p) + (Sinkage_m(p) - Rut_m(p)) / share > depth_m ? high_pa : low_pa) = p;
    }
    return low_pa;
  }
  /// Depth of a level track at rest under its mean pressure. Four wheels 0.32 m apart press their
  /// 1.28 m of the run with 1 + cos(2 pi x / pitch) of the mean (Wills 1963), the ends evenly.
  double SinkageUnderWheels_m(double mean_pa) const {
    constexpr int kParts = 64;
    double low_m = 0, high_m = 0.5;
    while (high_m - low_m > 1e-6) {
      const double depth_m = 0.5 * (low_m + high_m);
      double wheels_pa = 0;
      for (int k = 0; k < kParts; ++k) {
        const double share = 1 + std::cos(2 * kPi * (k + 0.5) / kParts);
        wheels_pa += Pressure_pa(depth_m, share) / kParts;
      }
      const double borne_pa = (1.28 * wheels_pa + 0.32 * Pressure_pa(depth_m, 1)) / kL_m;
      (borne_pa > mean_pa ? high_m : low_m) = depth_m;
    }
    return low_m;
  }
  /// Work of pressing a rut of one metre: Bekker's compaction resistance of one track.
  double RutResistance_n(double z_m) const {
    return kB_m * Modulus() * std::pow(z_m, n + 1) / (n + 1);
  }
};

/// Wong 2008, table 2.3 and the moduli of the material
/// library, in order of sinkage.
const std::vector<std::pair<const char*, Bearing>> kBearing = {
    {"gravel", {102000, 5301000, 0.793, 4.6e6}}, {"dirt", {5270, 1515040, 0.7, 6.5e6}},
    {"wet_sand", {74600, 2080000, 1.1, 4.0e6}},  {"loose", {52530, 1127970, 0.9, 1.0e6}},
    {"sand", {990, 1528430, 1.1, 4.5e6}},
};

std::string Level(const std::string& soil) { return "cell_m: 0.05, soil: " + soil; }

/// Ground that rises towards +y by `slope_deg`.
std::string Rising(const std::string& soil, double slope_deg) {
  return fmt::format("cell_m: 0.1, soil: {}, relief: {{slope_deg: {}, slope_direction_deg: 90}}",
                     soil, slope_deg);
}

TEST(Drive, MachineLeansWithTheSlopeItStandsOn) {
  Drive drive(kDriveExcavator, StowedAt(1, 2, 40), Rising("gravel", 12), 0, 0);
  drive.Run(1.0);
  const Vec3 normal(0, -std::sin(12 * kDeg), std::cos(12 * kDeg));
  // The ground yields less than 1 cm, over 1.15 m between the tracks: 0.5 deg.
  EXPECT_LT(std::acos(drive.body().X_WB.linear().col(2).dot(normal)) / kDeg, 0.5);
  EXPECT_NEAR(drive.yaw_rad() / kDeg, 40, 0.5);
}

TEST(Drive, StandsStillOnASlopeWithNeutralLevers) {
  for (const char* soil : {"dirt", "gravel", "sand", "asphalt"}) {
    Drive drive(kDriveExcavator, StowedAt(1, 2, 30), Rising(soil, 15), 0, 0);
    drive.Run(1.0);
    const Vec3 start = drive.place();
    EXPECT_LT(Shake_mps2(&drive, 9.0), 0.01) << soil;
    EXPECT_LT((drive.place() - start).norm(), 0.001) << soil;
  }
}

TEST(Drive, SlidesDownASlopeSteeperThanItsFriction) {
  // Wet pavement of friction 20 deg, tan = 0.364. Locked tracks hold at 14 deg; at 24 deg the
  // machine slides with g (sin 24 - 0.364 cos 24) = 0.728 m/s^2.
  const std::string wet =
      "wet, custom_soils: [{preset: tera:config/soils/asphalt.yaml, name: wet, "
      "friction_angle_deg: 20}]";
  Drive holds(kDriveExcavator, StowedAt(1, 2, 90), Rising(wet, 14), 0, 0);
  holds.Run(1.0);
  EXPECT_LT(holds.Measure(1.0).v_W_mps.norm(), 0.001);
  Drive slides(kDriveExcavator, StowedAt(1, 4, 90), Rising(wet, 24), 0, 0);
  const Vec3 before = slides.body().v_WB_mps;
  slides.Run(1.0);
  const Vec3 gained = slides.body().v_WB_mps - before;
  // The noses press the pavement down as they move, which is damped: a few per cent of the weight.
  EXPECT_NEAR(gained.norm() / 0.728, 1, 0.15);
  EXPECT_NEAR(std::atan2(-gained.z(), -gained.y()) / kDeg, 24, 1);
}

TEST(Drive, SinksAsBekkerSays) {
  double shallower_m = 0;
  for (const auto& [soil, bearing] : kBearing) {
    Drive drive(kDriveExcavator, StowedAt(1, 2, 30), Level(soil), 0, 0);
    drive.Run(0.2);
    const double sinkage_m = -drive.place().z();
    const double expected_m = bearing.SinkageUnderWheels_m(kMass_kg * kG_mps2 / (2 * kB_m * kL_m));
    // The machine's weight lies off the middle of its tracks, and the relation is nonlinear: 10 %.
    EXPECT_NEAR(sinkage_m / expected_m, 1, 0.10) << soil;
    EXPECT_GT(sinkage_m, shallower_m) << soil;
    shallower_m = sinkage_m;
  }
}

TEST(Drive, EqualLeversDriveStraightAtTheTracksSpeed) {
  const double lever = 0.6;
  const Vec3 heading(std::cos(20 * kDeg), std::sin(20 * kDeg), 0);
  for (const char* soil : {"dirt", "gravel", "sand", "wet_sand", "loose", "asphalt"}) {
    Drive drive(kDriveExcavator, StowedAt(-8, -4, 20), Level(soil), lever, lever);
    drive.Run(3.0);  // it starts, and sinks to the depth of its ruts
    const Vec3 start = drive.place();
    double slip = 0, shoes_m = 0;
    int count = 0;
    drive.Run(3.0, [&] {
      slip += drive.machine().gear_slip[0];
      shoes_m += 0.25 * drive.machine().gear_rate_radps[0];
      ++count;
    });
    const Vec3 v_W_mps = (drive.place() - start) / 3.0;
    const double speed_mps = v_W_mps.dot(heading);
    EXPECT_NEAR(speed_mps / (lever * kFullSpeed_mps), 1, 0.02) << soil;
    // Its resistance needs thrust, and thrust needs slip.
    const double lost = 1 - speed_mps / (shoes_m / count);
    EXPECT_GT(lost, 0) << soil;
    EXPECT_NEAR(slip / count, lost, 0.001) << soil;
    EXPECT_LT(heading.cross(v_W_mps).norm(), 0.01) << soil;
    EXPECT_NEAR(drive.yaw_rad() / kDeg, 20, 0.3) << soil;
    // 1 % of g, smoother than any ride: the ground's cells are imperceptible.
    EXPECT_LT(Shake_mps2(&drive, 1.0), 0.25) << soil;
  }
}

TEST(Drive, RidesSmoothlyInRutsDeeperThanItsTracksOuterSidesAreHigh) {
  // Loose sand, with a sinkage of 14 to 18 cm: the shoes press sand aside, where it stands. The
  // raised blade and the car body, 24 cm high, clear the ruts' rims.
  const std::string start =
      "{xy_m: [-8, -4], yaw_deg: 20, joints_deg: {boom: 55, arm: -130, bucket: -40, blade: 25}}";
  for (const double lever : {0.6, 1.0}) {
    Drive drive(kDriveExcavator, start, Level("loose_sand"), lever, lever);
    drive.Run(3.0 / lever);
    double deepest_m = 0;
    for (int k = 0; k < 4; ++k) {
      EXPECT_LT(Shake_mps2(&drive, 1.0), 0.25) << lever << " " << k;  // as on firmer soils, above
      deepest_m = std::max(deepest_m, drive.machine().gear_sinkage_m[0]);
    }
    EXPECT_GT(deepest_m, 0.14);
  }
}

TEST(Drive, DrivingCostsTheWorkOfTheRuts) {
  for (const auto& [soil, bearing] : kBearing) {
    Drive drive(kDriveExcavator, StowedAt(-8, -4, 20), Level(soil), 0.6, 0.6);
    drive.Run(5.0);
    double thrust_n = 0;
    int n = 0;
    drive.Run(2.0, [&] {
      const auto& torque_nm = drive.machine().gear_torque_nm;
      thrust_n += (torque_nm[0] + torque_nm[1]) / 0.25;
      ++n;
    });
    // A track digs in at its nose, deeper than at rest, and both noses also scrape. The thrust is
    // thus at least that of ruts at rest depth, and less than three times that of its real ruts.
    const double still_m = bearing.Rut_m(kMass_kg * kG_mps2 / (2 * kB_m * kL_m));
    const double rut_m = drive.machine().gear_sinkage_m[0];
    EXPECT_GT(thrust_n / n, 2 * bearing.RutResistance_n(still_m)) << soil;
    EXPECT_LT(thrust_n / n, 3 * 2 * bearing.RutResistance_n(rut_m)) << soil;
  }
}

TEST(Drive, LeavesTwoRutsInTheGround) {
  Drive drive(kDriveExcavator, StowedAt(-6, 1, 0), Level("sand"), 0.6, 0.6);
  drive.Run(6.0);  // 4.5 m
  ASSERT_GT(drive.place().x(), -2.0);
  const TerrainSurface& ground = drive.simulation->ground();
  const double x_m = drive.place().x() - 1.5;  // just behind the tracks
  const double stood_m = kBearing.back().second.Sinkage_m(kMass_kg * kG_mps2 / (2 * kB_m * kL_m));
  for (const double side : {1, -1}) {
    EXPECT_LT(ground.HeightAt(x_m, 1 + side * kGauge_m / 2), -0.8 * stood_m);
    EXPECT_GT(ground.HeightAt(x_m, 1 + side * kGauge_m / 2), -3 * stood_m);
    EXPECT_GE(ground.HeightAt(x_m, 1 + side * (kGauge_m / 2 + 0.5)), 0);
    EXPECT_NEAR(ground.HeightAt(x_m, 1 + side * (kGauge_m / 2 + 1)), 0, 1e-6);
  }
  // Incompressible sand heaves up to 0.74 m from each track, Prandtl's b sqrt(N_q): on both sides
  // between them, but less than they sink.
  EXPECT_GT(ground.HeightAt(x_m, 1), 0);
  EXPECT_LT(ground.HeightAt(x_m, 1), stood_m);
}

TEST(Drive, OppositeLeversTurnOnTheSpotSlowerThanWithoutSlip) {
  for (const char* soil : {"dirt", "gravel", "sand", "asphalt"}) {
    Drive drive(kDriveExcavator, StowedAt(1, 2, 20), Level(soil), -0.4, 0.4);
    const Vec3 start = drive.place();
    const double off_centre_m =
        (drive.body().X_WB.inverse() * drive.CentreOfMass()).head<2>().norm();
    drive.Run(1.0);
    const double rate_radps = drive.Measure(3.0).yaw_rate_radps;
    const double no_slip_radps = 2 * 0.4 * kFullSpeed_mps / kGauge_m;
    // Tracks of 1.6 m on a gauge of 1.15 m: measured effective widths are 1.3 to 2 gauges.
    EXPECT_GT(no_slip_radps / rate_radps, 1.2) << soil;
    EXPECT_LT(no_slip_radps / rate_radps, 2.0) << soil;
    // It turns about a point below its weight, off the middle of its tracks; the middle follows a
    // circle of that radius.
    EXPECT_LT((drive.place() - start).norm(), 2 * off_centre_m + 0.1) << soil;
  }
}

TEST(Drive, UnequalLeversSteerBySkidding) {
  Drive drive(kDriveExcavator, StowedAt(-4, -4, 20), Level("dirt"), 0.4, 0.8);
  drive.Run(1.0);
  const double rate_radps = drive.Measure(3.0).yaw_rate_radps;
  const double no_slip_radps = 0.4 * kFullSpeed_mps / kGauge_m;
  EXPECT_GT(rate_radps, 0.3 * no_slip_radps);  // towards the slower track, the left one
  EXPECT_LT(rate_radps, 0.9 * no_slip_radps);
  // The inner track brakes and the outer one drives, on average over a second.
  double torque_nm[2] = {0, 0}, slip[2] = {0, 0};
  drive.Run(1.0, [&] {
    for (int g = 0; g < 2; ++g) {
      torque_nm[g] += drive.machine().gear_torque_nm[g];
      slip[g] += drive.machine().gear_slip[g];
    }
  });
  EXPECT_LT(torque_nm[0], 0);
  EXPECT_GT(torque_nm[1], 0);
  EXPECT_LT(slip[0], 0);
  EXPECT_GT(slip[1], 0);
}

/// Slip of a rigid track at a share of its strength, with its load's centre `behind_m` behind its
/// middle. The pressure is linear in x from its front, and zero before it if the centre lies
/// outside the middle third. share = mean of p(x) (1 - exp(-slip x / K)) over that of p (Wong 2008,
/// ch. 2).
double JanosiSlip(double share, double shear_modulus_m, double behind_m) {
  constexpr int kParts = 400;
  const double bears_m = std::min(kL_m, 3 * (0.5 * kL_m - behind_m));
  const double steepness =
      bears_m < kL_m ? 2 / bears_m : 12 * behind_m / (kL_m * kL_m);  // of p over its mean
  double low = 1e-6, high = 1;
  while (high / low > 1.001) {
    const double slip = std::sqrt(low * high);
    double mobilised = 0;
    for (int k = 0; k < kParts; ++k) {
      const double x_m = (k + 0.5) / kParts * bears_m;
      const double p = 1 + steepness * (x_m - 0.5 * bears_m);
      mobilised -= p * std::expm1(-slip * x_m / shear_modulus_m) / kParts;
    }
    (mobilised > share ? high : low) = slip;
  }
  return low;
}

TEST(Drive, SlipGrowsWithTheSlopeItClimbsAsJanosiSays) {
  const struct {
    const char* soil;
    double friction_deg, cohesion_pa, shear_modulus_m;
    std::vector<double> slopes_deg;
  } soils[] = {{"gravel", 31.1, 1300, 0.012, {10, 15, 20}},
               {"sand", 28, 1040, 0.018, {10, 13, 16}}};
  for (const auto& [soil, friction_deg, cohesion_pa, shear_modulus_m, slopes_deg] : soils) {
    double last_slip = 0;
    for (const double slope_deg : slopes_deg) {
      const std::string where = fmt::format("{} {} deg", soil, slope_deg);
      Drive drive(kDriveExcavator, StowedAt(0, -6, 90), Rising(soil, slope_deg), 0.5, 0.5);
      drive.Run(3.0);
      const double start_z_m = drive.place().z();
      double slip = 0, thrust_n = 0;
      int n = 0;
      drive.Run(3.0, [&] {
        slip += drive.machine().gear_slip[0];
        thrust_n += (drive.machine().gear_torque_nm[0] + drive.machine().gear_torque_nm[1]) / 0.25;
        ++n;
      });
      slip /= n;
      thrust_n /= n;
      const double weight_n = kMass_kg * kG_mps2, slope = slope_deg * kDeg;
      // The thrust lifts the machine; the rest is the rut's resistance.
      const double resistance_n = thrust_n - weight_n * std::sin(slope);
      EXPECT_GT(resistance_n, 0) << where;
      EXPECT_LT(resistance_n, 0.15 * weight_n) << where;
      const double strength_n = weight_n * std::cos(slope) * std::tan(friction_deg * kDeg) +
                                2 * kB_m * kL_m * cohesion_pa;
      const Vec3 com_B = drive.body().X_WB.inverse() * drive.CentreOfMass();
      const double behind_m = com_B.z() * std::tan(slope) - com_B.x();
      const double expected = JanosiSlip(thrust_n / strength_n, shear_modulus_m, behind_m);
      // The noses lengthen the contact by up to a fifth.
      EXPECT_NEAR(slip / expected, 0.9, 0.2) << where << ", load behind by " << behind_m;
      EXPECT_GT(slip, last_slip) << where;
      last_slip = slip;
      EXPECT_NEAR((drive.place().z() - start_z_m) / (3.0 * 0.5 * kFullSpeed_mps * std::sin(slope)),
                  1, 0.05)
          << where;
    }
  }
}

/// A four-wheeled rover: 5 m/s at full lever, gauge 1.08 m.
struct Rover : Drive {
  Rover(double left, double right)
      : Drive("warthog.yaml", "{xy_m: [-3, 1], yaw_deg: 20}", "cell_m: 0.1, soil: asphalt", left,
              right) {}
  static double NoSlipRate_radps(double left, double right) { return (right - left) * 5.0 / 1.08; }
};

TEST(Drive, RoverStandsStillAndDrivesStraight) {
  Rover parked(0, 0);
  const Vec3 start = parked.place();
  EXPECT_LT(Shake_mps2(&parked, 3.0), 0.001);
  EXPECT_LT((parked.place() - start).norm(), 1e-4);

  Rover straight(0.2, 0.2);
  straight.Run(1.0);
  EXPECT_NEAR(straight.Measure(2.0).v_W_mps.norm(), 0.2 * 5.0, 0.02);
  EXPECT_NEAR(straight.yaw_rad() / kDeg, 20, 0.1);
  EXPECT_LT(Shake_mps2(&straight, 1.0), 0.05);
}

TEST(Drive, RoverTurnsSlowerThanWithoutSlip) {
  // Measured on such a rover on asphalt and grass: 1.65 to 1.8 times slower (norlab DRIVE).
  for (const double lever : {0.1, 0.2}) {
    Rover spot(-lever, lever);
    const Vec3 start = spot.place();
    spot.Run(1.0);
    const double slower = Rover::NoSlipRate_radps(-lever, lever) / spot.Measure(3.0).yaw_rate_radps;
    EXPECT_GT(slower, 1.4);
    EXPECT_LT(slower, 2.1);
    EXPECT_LT((spot.place() - start).norm(), 0.01);
  }
  Rover arc(0.15, 0.25);
  arc.Run(1.0);
  const double slower = Rover::NoSlipRate_radps(0.15, 0.25) / arc.Measure(2.0).yaw_rate_radps;
  EXPECT_GT(slower, 1.4);
  EXPECT_LT(slower, 2.1);
}

}  // namespace
}  // namespace tera
