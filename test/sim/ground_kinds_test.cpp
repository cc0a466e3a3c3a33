#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/faults.h"
#include "core/units.h"
#include "drive_fixture.h"
#include "own_folder.h"
#include "physics/traction/track_kinematics.h"

/// The ground model of a scenario, and the effects of the machine's base.

namespace tera {
namespace {

using enum FaultKind;

constexpr const char* kGroundKindsExcavator = "tb235.yaml";
constexpr const char* kRover = "warthog.yaml";
constexpr double kGroundKindsG_mps2 = 9.80665;
constexpr const char* kStart = "{xy_m: [-6, -3], yaw_deg: 25}";

std::string GroundOf(const std::string& ground, const std::string& base = "") {
  return "    ground: " + ground + "\n" +
         (base.empty() ? "" : "effects: {m: {base: {" + base + "}}}\n");
}

/// Velocity of the root in its own frame, and its yaw rate.
PlanarTwist TwistOf(const Drive& drive) {
  const BodyState& body = drive.body();
  const Mat3 R_BW = body.X_WB.linear().transpose();
  const Vec3 v_B = R_BW * body.v_WB_mps;
  return {v_B.x(), v_B.y(), (R_BW * body.w_WB_radps).z()};
}

/// State after 2 s with these levers, at constant speed.
PlanarTwist Steady(const std::string& machine, const std::string& terrain, double left,
                   double right, const std::string& more) {
  Drive drive(machine, kStart, terrain, left, right, more);
  drive.Run(2.0);
  return TwistOf(drive);
}

TEST(TrackDrive, IdealTracksMoveAsADifferentialDrive) {
  // Full speed and gauge of the machines' descriptions.
  const struct {
    const char* machine;
    double full_mps, gauge_m;
  } machines[] = {{kGroundKindsExcavator, 1.25, 1.148}, {kRover, 5.0, 1.08}};
  for (const auto& [machine, full_mps, gauge_m] : machines) {
    for (const char* soil : {"asphalt", "dirt"}) {
      for (const auto& [left, right] :
           std::vector<std::pair<double, double>>{{0.1, 0.25}, {-0.2, 0.2}, {-0.2, -0.2}}) {
        const PlanarTwist twist = Steady(machine, fmt::format("cell_m: 0.1, soil: {}", soil), left,
                                         right, GroundOf("ideal"));
        EXPECT_NEAR(twist.forward_mps, 0.5 * (left + right) * full_mps, 1e-3) << machine << soil;
        EXPECT_NEAR(twist.left_mps, 0, 1e-3) << machine << soil;
        EXPECT_NEAR(twist.yaw_radps, (right - left) * full_mps / gauge_m, 1e-3) << machine << soil;
      }
    }
  }
}

TEST(TrackDrive, KinematicTracksWithoutEffectsAreIdealOnes) {
  for (const char* ground : {"ideal", "kinematic"}) {
    const PlanarTwist twist =
        Steady(kGroundKindsExcavator, "cell_m: 0.1, soil: dirt", 0.3, 0.5, GroundOf(ground));
    EXPECT_NEAR(twist.forward_mps, 0.5, 1e-3) << ground;
    EXPECT_NEAR(twist.yaw_radps, 0.25 / 1.148, 1e-3) << ground;
  }
}

TEST(TrackDrive, EffectsOfSlipActOnAMachineThatDrives) {
  const std::string flat = "cell_m: 0.1, soil: asphalt";
  const auto with = [&](const std::string& base) {
    return Steady(kGroundKindsExcavator, flat, 0.3, 0.5, GroundOf("kinematic", base));
  };
  const double yaw_radps = 0.25 / 1.148;
  EXPECT_NEAR(with("track_slip: {slip: 0.1}").forward_mps, 0.45, 1e-3);
  EXPECT_NEAR(with("slope_slip: {slip: 0.2, slip_per_slope: 0}").forward_mps, 0.4, 1e-3);
  EXPECT_NEAR(with("effective_gauge: {ratio: 1.6}").yaw_radps, yaw_radps / 1.6, 1e-3);
  EXPECT_NEAR(with("icr_shift: {forward_m: -0.4}").left_mps, 0.4 * yaw_radps, 1e-3);
  EXPECT_NEAR(with("rolling_resistance: {coefficient: 0.2, slip_stiffness: 10}").forward_mps,
              0.5 * (1 - 0.02), 1e-3);
  // 1.5 % more and less, at 0.375 and 0.625 m/s.
  EXPECT_NEAR(with("track_asymmetry: {difference: 0.03}").yaw_radps,
              (0.25 + 0.015 * (0.375 + 0.625)) / 1.148, 1e-3);
  EXPECT_NEAR(with("track_scale: {scale: 0.95}").forward_mps, 0.475, 1e-3);
}

TEST(TrackDrive, SlopesMakeAMachineSlipAndDrift) {
  // Rises towards +y by tan = 0.2; heading along it and across it. The machine leans some tenths
  // of a degree more than the ground.
  const std::string slope =
      fmt::format("cell_m: 0.1, soil: asphalt, relief: {{slope_deg: {}, slope_direction_deg: 90}}",
                  std::atan(0.2) / kDeg);
  const auto heading = [&](double yaw_deg, const std::string& base) {
    Drive drive(kGroundKindsExcavator, fmt::format("{{xy_m: [0, -4], yaw_deg: {}}}", yaw_deg),
                slope, 0.4, 0.4, GroundOf("kinematic", base));
    drive.Run(2.0);
    return TwistOf(drive);
  };
  EXPECT_NEAR(heading(90, "slope_slip: {slip_per_slope: 0.5}").forward_mps, 0.5 * 0.9, 0.005);
  EXPECT_NEAR(heading(0, "side_slip: {drift_per_slope: 0.5}").left_mps, -0.5 * 0.1, 0.005);
  // mu of asphalt, K / L = 1 / 80: thrust share 0.2 / 0.8, 1 - (1 - e^-x) / x = 0.25 at x = 0.607.
  EXPECT_NEAR(heading(90, "track_slip: {shear_modulus_m: 0.02, friction: 0.8}").forward_mps,
              0.5 * (1 - 0.607 / 80), 0.002);
}

TEST(TrackDrive, ScaleAndAsymmetryActOnTheSoilToo) {
  const std::string flat = "cell_m: 0.1, soil: asphalt";
  const auto with = [&](const std::string& base) {
    return Steady(kRover, flat, 0.1, 0.1, GroundOf("terramechanics", base));
  };
  EXPECT_NEAR(with("track_scale: {scale: 0.9}").forward_mps, 0.45, 0.01);
  EXPECT_GT(with("track_asymmetry: {difference: 0.1}").yaw_radps, 0.01);
}

TEST(TrackDrive, ScaleAndAsymmetryLieBetweenSprocketsAndShoes) {
  // 0.1 of 1.25 m/s on sprockets of 0.25 m is 0.5 rad/s, independent of the shoes' slip.
  for (const char* ground : {"terramechanics", "ideal", "kinematic"}) {
    Drive drive(kGroundKindsExcavator, kStart, "cell_m: 0.1, soil: asphalt", 0.1, 0.1,
                GroundOf(ground, "track_scale: {scale: 0.9}, track_asymmetry: {difference: 0.1}"));
    drive.Run(2.0);
    EXPECT_NEAR(drive.machine().gear_rate_radps[0], 0.5, 1e-3) << ground;
    EXPECT_NEAR(drive.machine().gear_rate_radps[1], 0.5, 1e-3) << ground;
    EXPECT_NEAR(TwistOf(drive).forward_mps, 0.1125, 0.002) << ground;
    EXPECT_GT(TwistOf(drive).yaw_radps, 1e-3) << ground;
  }
}

TEST(TrackDrive, TheGroundHoldsNoMoreThanItsStrength) {
  // Locked tracks on wet pavement of friction 20 deg: at rest on 14 deg; on 24 deg sliding with g
  // (sin 24 - tan 20 cos 24) = 0.728 m/s^2.
  const auto slide = [](double slope_deg) {
    Drive drive(kGroundKindsExcavator, "{xy_m: [0, 3], yaw_deg: 90}",
                fmt::format("cell_m: 0.1, soil: wet, custom_soils: [{{preset: "
                            "tera:config/soils/asphalt.yaml, name: wet, friction_angle_deg: 20}}], "
                            "relief: {{slope_deg: {}, slope_direction_deg: 90}}",
                            slope_deg),
                0, 0, GroundOf("ideal"));
    const Vec3 before = drive.body().v_WB_mps;
    drive.Run(1.0);
    return (drive.body().v_WB_mps - before).norm();
  };
  EXPECT_NEAR(slide(14), 0, 1e-3);
  EXPECT_NEAR(slide(24) / 0.728, 1, 0.15);
}

TEST(TrackDrive, SprocketsCarryTheWeightOnTheSlope) {
  // Uphill at 10 deg, 3500 kg, two sprockets of 0.25 m.
  Drive drive(kGroundKindsExcavator, "{xy_m: [0, -4], yaw_deg: 90}",
              "cell_m: 0.1, soil: asphalt, relief: {slope_deg: 10, slope_direction_deg: 90}", 0.4,
              0.4, GroundOf("kinematic", "rolling_resistance: {coefficient: 0.1}"));
  drive.Run(2.0);
  double torque_nm = 0;
  drive.Run(0.5, [&] {
    torque_nm += (drive.machine().gear_torque_nm[0] + drive.machine().gear_torque_nm[1]) / 250;
  });
  const double expected_nm =
      0.25 * 3500 * kGroundKindsG_mps2 * (std::sin(10 * kDeg) + 0.1 * std::cos(10 * kDeg));
  EXPECT_NEAR(torque_nm / expected_nm, 1, 0.03);
}

TEST(TrackDrive, StrengthOfTheSoilDecidesWhatHolds) {
  // Pavement of friction 38.7 deg at half its strength holds up to atan(0.40) = 21.8 deg.
  for (const char* ground : {"terramechanics", "ideal"}) {
    const auto creep = [&](double slope_deg) {
      Drive drive(kGroundKindsExcavator, "{xy_m: [0, 3], yaw_deg: 90}",
                  fmt::format("cell_m: 0.1, soil: asphalt, relief: {{slope_deg: {}, "
                              "slope_direction_deg: 90}}",
                              slope_deg),
                  0, 0, GroundOf(ground, "soil_strength: {strength: 0.5}"));
      drive.Run(1.0);
      return drive.body().v_WB_mps.norm();
    };
    EXPECT_LT(creep(18), 0.01) << ground;
    EXPECT_GT(creep(26), 0.1) << ground;
  }
}

TEST(TrackDrive, StiffnessOfTheSoilDecidesTheSinkage) {
  const auto sinkage = [](double stiffness) {
    Drive drive(kGroundKindsExcavator, kStart, "cell_m: 0.1, soil: loose", 0, 0,
                GroundOf("ideal", fmt::format("soil_strength: {{stiffness: {}}}", stiffness)));
    return -drive.place().z();
  };
  // Bekker: z scales with modulus^(-1/n), n = 0.7; the elastic part with modulus^-1.
  const double ratio = sinkage(0.5) / sinkage(1.0);
  EXPECT_GT(ratio, 2.0 * 0.95);
  EXPECT_LT(ratio, std::pow(2.0, 1 / 0.7) * 1.05);
}

TEST(TrackDrive, RaisedGroundLiftsWhatStandsOnItAndWhatDrivesOntoIt) {
  const std::string raised =
      "terrain_height: {x_m: 3, y_m: 0, radius_m: 2.5, height_m: 0.4, edge_m: 2}";
  Drive on("tb235.yaml", "{xy_m: [3, 0], yaw_deg: 15}", "cell_m: 0.1, soil: asphalt", 0, 0,
           GroundOf("ideal", raised));
  EXPECT_NEAR(on.place().z(), 0.4, 0.02);
  EXPECT_NEAR(on.simulation->ground().HeightAt(3, 2.4), 0.4, 1e-6);
  EXPECT_NEAR(on.simulation->ground().HeightAt(3, 3.5), 0.2, 1e-6);  // amid its edge
  EXPECT_NEAR(on.simulation->ground().HeightAt(3, 4.6), 0, 1e-6);
  Drive onto(kRover, "{xy_m: [-4, 0], yaw_deg: 0}", "cell_m: 0.1, soil: asphalt", 0.3, 0.3,
             GroundOf("terramechanics", raised));
  onto.Run(7 / 1.5);
  EXPECT_NEAR(onto.place().x(), 3, 0.5);
  EXPECT_NEAR(onto.place().z(), 0.4, 0.03);
}

std::vector<InputFault> FaultOf(const std::string& machine, const std::string& more) {
  return FaultsIn([&] { Drive::Read(machine, "{xy_m: [0, 0]}", "cell_m: 0.2, soil: dirt", more); });
}

TEST(TrackDrive, FaultsOfTheChoiceSayWhatIsNeeded) {
  EXPECT_THAT(FaultOf(kGroundKindsExcavator, GroundOf("kinematik")),
              HasFault(kNoSuchName, "ground"));
  EXPECT_THAT(FaultOf("mast.yaml", GroundOf("ideal")), HasFault(kInconsistent, "ground"));
  for (const char* ground : {"terramechanics", "ideal"}) {
    EXPECT_THAT(FaultOf(kGroundKindsExcavator, GroundOf(ground, "track_slip: {slip: 0.1}")),
                HasFault(kInconsistent, "base.track_slip"));
  }
  EXPECT_THAT(FaultOf(kGroundKindsExcavator, GroundOf("kinematic", "track_slip: {slip: 1.5}")),
              HasFault(kOutOfRange, "track_slip.slip"));
  EXPECT_THAT(FaultOf(kGroundKindsExcavator, GroundOf("kinematic", "effective_gauge: {}")),
              HasFault(kMissing, "effective_gauge.ratio"));
  EXPECT_THAT(FaultOf(kGroundKindsExcavator, GroundOf("kinematic", "trak_slip: {slip: 0.1}")),
              HasFault(kUnknown, "base.trak_slip"));
  EXPECT_THAT(FaultOf(kGroundKindsExcavator, GroundOf("kinematic", "track_slip: {slip: 0.1}")),
              testing::IsEmpty());
}

/// A file of a tracked cart with a blade on that link.
std::string CartWithBladeOn(const std::string& link) {
  const std::filesystem::path path = OwnFolder() / (link + ".yaml");
  std::ofstream(path) << R"(
kind: cart
links:
  chassis: {mass_kg: 900, com_m: [0, 0, 0.5], inertia_kgm2: [300, 500, 600]}
  mount: {mass_kg: 50, inertia_kgm2: [5, 5, 5]}
joints:
  weld: {type: fixed, parent: chassis, child: mount, xyz_m: [1.2, 0, 0.4]}
gauge_m: 1.2
tracks:
  left_track: {link: chassis, center_m: [0, 0.6, 0.3], wheelbase_m: 2, radius_m: 0.3,
               width_m: 0.3, max_speed_mps: 1, max_torque_nm: 5000, inertia_kgm2: 10}
  right_track: {link: chassis, center_m: [0, -0.6, 0.3], wheelbase_m: 2, radius_m: 0.3,
                width_m: 0.3, max_speed_mps: 1, max_torque_nm: 5000, inertia_kgm2: 10}
levers: [left_track, right_track]
shovels:
  blade: {link: )" << link
                      << R"(, profile_m: [[0.5, -0.3], [0.4, 0], [0.5, 0.3]], width_m: 2}
)";
  return path.string();
}

TEST(TrackDrive, AToolOfTheRootLinkIsRefusedWhereItsForceCannotBeTold) {
  const std::string pusher = CartWithBladeOn("chassis"), welded = CartWithBladeOn("mount");
  EXPECT_THAT(FaultOf(pusher, GroundOf("kinematic")), HasFault(kInconsistent, "ground"));
  EXPECT_THAT(FaultOf(pusher, GroundOf("ideal")), testing::IsEmpty());
  EXPECT_THAT(FaultOf(welded, GroundOf("kinematic")), testing::IsEmpty());
}

}  // namespace
}  // namespace tera
