#include "soil/track/hull_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "soil/columns/soil_type.h"
#include "soil/shaped_ground.h"

namespace tera {
namespace {

using testing_soil::kStep_s;
using testing_soil::LevelColumns;
using testing_soil::ShapedColumns;

constexpr double kMachine_kg = 3500;  ///< that the points are said to belong to

SoilType Sand() { return testing_soil::Shipped("sand"); }

/// A plate that only moves, on points at its four corners.
class Plate {
 public:
  explicit Plate(double z_m, double mass_kg = kMass_kg, double machine_kg = kMachine_kg)
      : mass_kg_(mass_kg) {
    body_.X_WB.translation() = Vec3(0, 0, z_m);
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5})
        contacts_.emplace_back(GroundTools::HullPoint{0, {x, y, 0}}, machine_kg);
    }
  }

  void Move(const Columns& ground, double seconds) {
    for (int k = 0; k < seconds / kStep_s; ++k) {
      force_W_n_ = Vec3::Zero();
      for (HullContact& contact : contacts_) {
        force_W_n_ += contact.Act(body_, kStep_s, ground, LowObstacles()).force_W_n;
      }
      body_.v_WB_mps += (force_W_n_ / mass_kg_ - Vec3(0, 0, kStandardGravity_mps2)) * kStep_s;
      body_.X_WB.translation() += body_.v_WB_mps * kStep_s;
    }
  }

  double z_m() const { return body_.X_WB.translation().z(); }
  Vec3 force_W_n() const { return force_W_n_; }
  BodyState& body() { return body_; }
  static constexpr double kMass_kg = 1000;

 private:
  double mass_kg_;
  BodyState body_;
  std::vector<HullContact> contacts_;
  Vec3 force_W_n_ = Vec3::Zero();
};

void HeapOver(double height_m, Columns* ground, const SoilType& soil) {
  const double volume_m3 = height_m * ground->area_m2();
  for (int j = 0; j < ground->ny(); ++j) {
    for (int i = 0; i < ground->nx(); ++i) {
      ground->Deposit(ground->Touch(i, j),
                      Spoil{volume_m3 * LooseDensity_kgpm3(soil), volume_m3, 0, 0});
    }
  }
}

TEST(HullContact, CarriesWhatLiesOnIt) {
  const Columns ground = LevelColumns(Sand(), 0.1, 41);
  Plate plate(0.05);
  plate.Move(ground, 3);
  EXPECT_NEAR(plate.force_W_n().z(), Plate::kMass_kg * kStandardGravity_mps2, 1);
  EXPECT_LT(plate.z_m(), 0);
  EXPECT_GT(plate.z_m(), -0.02);
}

// A spring of 4e5 N/m let a compact machine that rolled over 0.11 m into the ground, several times
// what a corner of steel goes into soil of a few megapascals.
TEST(HullContact, ATonneThatFallsOnOneCornerGoesInLessThanATenthOfAMetre) {
  const Columns ground = LevelColumns(Sand(), 0.1, 41);
  HullContact corner({0, Vec3::Zero()}, kMachine_kg);
  BodyState body;
  body.v_WB_mps = Vec3(0, 0, -std::sqrt(2 * kStandardGravity_mps2 * 0.3));
  double deepest_m = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 force_W_n = corner.Act(body, kStep_s, ground, LowObstacles()).force_W_n;
    body.v_WB_mps += (force_W_n / Plate::kMass_kg - Vec3(0, 0, kStandardGravity_mps2)) * kStep_s;
    body.X_WB.translation() += body.v_WB_mps * kStep_s;
    deepest_m = std::max(deepest_m, -body.X_WB.translation().z());
  }
  EXPECT_LT(deepest_m, 0.1);
  EXPECT_NEAR(body.v_WB_mps.norm(), 0, 0.05);  // and it comes to rest
}

TEST(HullContact, SoilHeapedOverItLiftsNothing) {
  const SoilType sand = Sand();
  Columns ground = LevelColumns(sand, 0.1, 41);
  Plate plate(0.0);
  plate.Move(ground, 3);
  const double before_m = plate.z_m();
  HeapOver(0.4, &ground, sand);
  plate.Move(ground, 3);
  EXPECT_NEAR(plate.z_m(), before_m, 1e-3);
  EXPECT_NEAR(plate.force_W_n().z(), Plate::kMass_kg * kStandardGravity_mps2, 1);
}

/// Sand heaped 5 cm high along y about x = 0.5 m, its flanks at 32 deg.
Columns GroundWithARidge(double cell_m) {
  const SoilType sand = Sand();
  Columns ground = LevelColumns(sand, cell_m, static_cast<int>(2 / cell_m) + 1);
  for (int j = 0; j < ground.ny(); ++j) {
    for (int i = 0; i < ground.nx(); ++i) {
      const double height_m = 0.05 - 0.625 * std::abs(ground.x_m(i) - 0.5);
      if (height_m <= 0) continue;
      const double volume_m3 = height_m * ground.area_m2();
      ground.Deposit(ground.Touch(i, j),
                     Spoil{volume_m3 * LooseDensity_kgpm3(sand), volume_m3, 0, 0});
    }
  }
  return ground;
}

/// Force in N that sand of 1600 kg/m3 and 39 deg, heaped loosely, bears on a square footing, the
/// contact of a corner of width b_0 that stands d deep.
///
///     F = b^2 rho g (d N_q + b N_gamma / 2),    b = b_0 + 2 d
///
/// Terzaghi's local shear leaves tan(phi) = 2/3 tan 39 deg, phi = 28.4 deg. There N_q is 15.3 and
/// N_gamma 17.6. Vesic's table (1973) has 14.72 and 16.72 at 28 deg, 16.44 and 19.34 at 29 deg.
double FootingOfSand_n(double corner_m, double depth_m) {
  const double width_m = corner_m + 2 * depth_m;
  return width_m * width_m * 1600 * 9.81 * (depth_m * 15.3 + width_m * 17.6 / 2);
}

/// Mass of a machine and the width of its corners, which goes with its length: 0.15 m for 3.5 t.
struct Corner {
  double machine_kg, width_m;
};
constexpr Corner kCorners[] = {{3500, 0.150}, {20000, 0.268}};

// The way out lies between the normal of a flank, 0.030 m long, and straight up, 0.035 m. Coulomb's
// friction across adds at most an eighth.
TEST(HullContact, PloughsThroughARidgeOfLooseSoil) {
  for (const Corner& machine : kCorners) {
    for (const double cell_m : {0.025, 0.05}) {
      const Columns ground = GroundWithARidge(cell_m);
      HullContact corner({0, Vec3::Zero()}, machine.machine_kg);
      BodyState body;
      body.X_WB.translation() = Vec3(0.3, 0.3, 0.015);
      body.v_WB_mps = Vec3(0.8, 0, 0);
      double most_n = 0;
      for (int k = 0; k < 250; ++k) {
        most_n =
            std::max(most_n, corner.Act(body, kStep_s, ground, LowObstacles()).force_W_n.norm());
        body.X_WB.translation() += body.v_WB_mps * kStep_s;
      }
      EXPECT_GT(most_n, FootingOfSand_n(machine.width_m, 0.030))
          << machine.machine_kg << " " << cell_m;
      EXPECT_LT(most_n, 1.12 * FootingOfSand_n(machine.width_m, 0.035))
          << machine.machine_kg << " " << cell_m;
    }
  }
}

// A quarter of each plate lies on a corner: 2.45 and 14.0 kN, in proportion to the machines. The
// footings bear it at 0.044 and 0.078 m. The load comes at once and sinks on until the soil has
// taken the work of its weight, at 0.078 and 0.140 m. There it springs back by some millimetres.
TEST(HullContact, SinksIntoLooseFillUntilItBears) {
  const SoilType sand = Sand();
  for (const Corner& machine : kCorners) {
    Columns ground = LevelColumns(sand, 0.1, 41);
    HeapOver(0.6, &ground, sand);
    const double mass_kg = machine.machine_kg / 3.5, weight_n = mass_kg * kStandardGravity_mps2;
    Plate plate(0.6, mass_kg, machine.machine_kg);
    plate.Move(ground, 5);
    const bool light = machine.machine_kg < 4000;
    const double bears_m = light ? 0.0439 : 0.0784, stops_m = light ? 0.078 : 0.140;
    EXPECT_NEAR(FootingOfSand_n(machine.width_m, bears_m) / (weight_n / 4), 1, 0.01);
    EXPECT_GT(0.6 - plate.z_m(), bears_m) << mass_kg;
    EXPECT_NEAR((0.6 - plate.z_m()) / stops_m, 1, 0.05) << mass_kg;
    EXPECT_NEAR(plate.force_W_n().z() / weight_n, 1, 1e-4) << mass_kg;
  }
}

TEST(HullContact, BuriedStructureThatIsLiftedIsCarriedAgainWhereItComesDown) {
  const SoilType sand = Sand();
  Columns ground = LevelColumns(sand, 0.1, 41);
  Plate plate(0.0);
  plate.Move(ground, 3);
  HeapOver(0.4, &ground, sand);
  plate.body().v_WB_mps.z() = 1;  // flies up by 5 cm
  plate.Move(ground, 3);
  EXPECT_NEAR(plate.force_W_n().z(), Plate::kMass_kg * kStandardGravity_mps2, 1);
  EXPECT_GT(plate.z_m(), -0.02);
  EXPECT_LT(plate.z_m(), 0.06);
}

TEST(HullContact, FrictionStopsWhatSlides) {
  const Columns ground = LevelColumns(Sand(), 0.1, 101);
  Plate plate(-0.005);
  plate.Move(ground, 1);
  plate.body().v_WB_mps.x() = 2;
  // v^2 / (2 mu g) = 0.41 m
  plate.Move(ground, 3);
  EXPECT_NEAR(plate.body().X_WB.translation().x(), 0.41, 0.02);
  EXPECT_LT(plate.body().v_WB_mps.norm(), 1e-4);
}

// Steel on soil holds up to atan(0.5) = 26.6 deg.
TEST(HullContact, OnASlopeItStaysOrSlidesAsFrictionSays) {
  for (const double slope_deg : {-24.0, 20.0, 35.0}) {
    const double gradient = std::tan(slope_deg * kDeg);
    const Columns ground =
        ShapedColumns(Sand(), 0.1, 201, [&](double x, double) { return gradient * x; });
    HullContact foot({0, Vec3::Zero()}, kMachine_kg);
    BodyState body;
    constexpr double kMass_kg = 800;
    Vec3 force_W_n = Vec3::Zero();
    const auto move = [&](double seconds) {
      for (int k = 0; k < seconds / kStep_s; ++k) {
        force_W_n = foot.Act(body, kStep_s, ground, LowObstacles()).force_W_n;
        body.v_WB_mps += (force_W_n / kMass_kg - Vec3(0, 0, kStandardGravity_mps2)) * kStep_s;
        body.X_WB.translation() += body.v_WB_mps * kStep_s;
      }
    };
    move(1);
    const double before_mps = body.v_WB_mps.norm();
    move(1);
    const double gained_mps = body.v_WB_mps.norm() - before_mps;
    if (std::abs(slope_deg) < 26) {
      EXPECT_LT(body.v_WB_mps.norm(), 1e-4) << slope_deg;  // and it does not creep
      EXPECT_TRUE(force_W_n.isApprox(Vec3(0, 0, kMass_kg * kStandardGravity_mps2), 1e-3))
          << slope_deg;
    } else {
      EXPECT_NEAR(
          gained_mps,
          kStandardGravity_mps2 * (std::sin(slope_deg * kDeg) - 0.5 * std::cos(slope_deg * kDeg)),
          0.02)
          << slope_deg;
    }
  }
}

// The ground's wall is one cell wide: from the floor at x = 0.5 to a metre above at x = 0.6.
TEST(HullContact, WhatSlidesIntoTheWallOfAPitIsPushedBackSideways) {
  const Columns ground =
      ShapedColumns(Sand(), 0.1, 101, [](double x, double) { return x > 0.55 ? 1.0 : 0.0; });
  for (const double height_m : {0.15, 0.45, 0.75}) {
    HullContact corner({0, Vec3(1, 0.5, 0.2)}, kMachine_kg);
    BodyState body;
    body.X_WB = MakePose(Vec3(0.2, -0.8, height_m), 0, 0, 90 * kDeg);  // the point at x -0.3
    body.v_WB_mps = Vec3(1.1, 0, 0);
    double deepest_m = 0;
    for (int k = 0; k < 1500; ++k) {
      const Vec3 force_W_n = corner.Act(body, kStep_s, ground, LowObstacles()).force_W_n;
      // The wall leans by a tenth, and on the way out friction turns.
      EXPECT_LE(std::abs(force_W_n.z()), 0.12 * force_W_n.norm() + 200);
      body.v_WB_mps.x() += force_W_n.x() / 1750 * kStep_s;  // half a machine, on a rail along x
      body.X_WB.translation() += body.v_WB_mps * kStep_s;
      const double x_m = (body.X_WB * Vec3(1, 0.5, 0.2)).x();
      deepest_m = std::max(deepest_m, x_m - (0.5 + 0.1 * (height_m + 0.2)));
    }
    // v sqrt(m / k) = 4.6 cm undamped
    EXPECT_GT(deepest_m, 0.02) << height_m;
    EXPECT_LT(deepest_m, 0.05) << height_m;
    EXPECT_LT(body.v_WB_mps.x(), 0) << height_m;
    EXPECT_GT(body.v_WB_mps.x(), -1.1) << height_m;
  }
}

// Both are pushed: down on the floor, and against the wall.
TEST(HullContact, InTheCornerOfFloorAndWallBothBear) {
  const Columns ground =
      ShapedColumns(Sand(), 0.05, 101, [](double x, double) { return x > 0.525 ? 1.0 : 0.0; });
  HullContact corner({0, Vec3::Zero()}, kMachine_kg);
  BodyState body;
  body.X_WB.translation() = Vec3(0.45, 0.3, 0.02);
  constexpr double kMass_kg = 800, kPush_n = 12000;
  Vec3 force_W_n;
  for (int k = 0; k < 1500; ++k) {
    force_W_n = corner.Act(body, kStep_s, ground, LowObstacles()).force_W_n;
    body.v_WB_mps +=
        (force_W_n / kMass_kg + Vec3(kPush_n / kMass_kg, 0, -kStandardGravity_mps2)) * kStep_s;
    body.X_WB.translation() += body.v_WB_mps * kStep_s;
  }
  EXPECT_NEAR(force_W_n.x(), -kPush_n, 50);
  EXPECT_NEAR(force_W_n.z(), kMass_kg * kStandardGravity_mps2, 50);
  EXPECT_LT(body.v_WB_mps.norm(), 1e-3);
  EXPECT_NEAR(body.X_WB.translation().x(), 0.5, 0.03);
  EXPECT_NEAR(body.X_WB.translation().z(), 0, 0.02);
}

TEST(HullContact, AlikeMachinesOfAnyMassGoInAlike) {
  const Columns ground = LevelColumns(Sand(), 0.1, 41);
  std::vector<double> depth_m;
  for (const double mass_kg : {470.0, 3500.0, 20000.0}) {
    HullContact corner({0, Vec3::Zero()}, mass_kg);
    BodyState body;
    body.v_WB_mps = Vec3(0, 0, -1.5);
    double deepest_m = 0;
    for (int k = 0; k < 500; ++k) {
      const Vec3 force_W_n = corner.Act(body, kStep_s, ground, LowObstacles()).force_W_n;
      body.v_WB_mps += (4 * force_W_n / mass_kg - Vec3(0, 0, kStandardGravity_mps2)) * kStep_s;
      body.X_WB.translation() += body.v_WB_mps * kStep_s;
      deepest_m = std::max(deepest_m, -body.X_WB.translation().z());
    }
    depth_m.push_back(deepest_m);
    EXPECT_NEAR(deepest_m, depth_m.front(), 1e-9);
    EXPECT_LT(deepest_m, 0.07);
  }
}

// However a point is led through uneven ground and out again, it is not given work.
TEST(HullContact, GroundNeverGivesWork) {
  const Stream random(3, "test/uneven");
  std::uint64_t cell = 0;
  const Columns ground = ShapedColumns(Sand(), 0.05, 101, [&](double x, double y) {
    return 0.05 * random.Uniform(cell++) + (x > 0.3 ? 0.6 : 0.0) + 0.3 * std::sin(2 * y);
  });
  for (std::uint64_t path = 0; path < 100; ++path) {
    HullContact point({0, Vec3::Zero()}, kMachine_kg);
    const Stream shape(path, "test/path");
    BodyState body;
    double work_j = 0, most_j = 0;
    constexpr int kSteps = 1000;
    // Lissajous paths from above the ground, through it, and back.
    Vec3 reach, turns, phase;
    for (int axis = 0; axis < 3; ++axis) {
      reach[axis] = shape.Uniform(axis, 0) * (axis == 2 ? 0.3 : 0.6);
      turns[axis] = 1 + 3 * shape.Uniform(axis, 1);
      phase[axis] = 2 * kPi * shape.Uniform(axis, 2);
    }
    const auto place = [&](double s) {
      Vec3 p(0.2, 0.1, 1.2 - 1.6 * std::sin(kPi * s));
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] +=
            reach[axis] * std::sin(2 * kPi * turns[axis] * s + phase[axis]) * std::sin(kPi * s);
      }
      return p;
    };
    for (int k = 0; k < kSteps; ++k) {
      body.X_WB.translation() = place(static_cast<double>(k) / kSteps);
      const Vec3 step_m = place((k + 1.0) / kSteps) - body.X_WB.translation();
      body.v_WB_mps = step_m / kStep_s;
      const double given_j = point.Act(body, kStep_s, ground, LowObstacles()).force_W_n.dot(step_m);
      work_j += given_j;
      most_j = std::max(most_j, work_j);
    }
    EXPECT_LT(work_j, -100) << path;  // it has been in the ground
    EXPECT_LT(most_j, 1e-9) << path;
  }
}

// At the time step used, whatever it lies on: a plate dropped on ground as uneven as spoil never
// has more energy than it had, and comes to rest.
TEST(HullContact, APlateDroppedOnUnevenGroundOnlyLosesEnergyAndComesToRest) {
  const Stream random(5, "test/uneven");
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    std::uint64_t cell = 0;
    const Columns ground = ShapedColumns(Sand(), 0.1, 81, [&](double x, double) {
      return 0.08 * random.Uniform(cell++, trial) + (x > 0.85 ? 0.7 : 0.0);
    });
    Plate plate(0.4);
    plate.body().v_WB_mps = Vec3(1.5, 0.5, 0);
    const auto energy_j = [&] {
      return Plate::kMass_kg *
             (0.5 * plate.body().v_WB_mps.squaredNorm() + kStandardGravity_mps2 * plate.z_m());
    };
    const double start_j = energy_j();
    double most_j = 0;
    for (int k = 0; k < 2000; ++k) {
      plate.Move(ground, kStep_s);
      most_j = std::max(most_j, energy_j());
    }
    // An explicit step of free fall is out by m g v dt / 2.
    EXPECT_LT(most_j, start_j + 30) << trial;
    EXPECT_LT(plate.body().v_WB_mps.norm(), 1e-3) << trial;
    EXPECT_GT(plate.z_m(), -0.03) << trial;
  }
}

}  // namespace
}  // namespace tera
