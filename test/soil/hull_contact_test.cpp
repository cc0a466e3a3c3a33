#include "soil/hull_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "soil/soil_type.h"
#include "soil_fixture.h"

namespace tera {
namespace {

using testing_soil::kStep_s;
using testing_soil::LevelColumns;

SoilType Sand() {
  const Config config = Config::FromFile(*ShippedSoilFile("sand"));
  return ReadSoilType(config.root());
}

/// A plate of a tonne that only moves, on points at its four corners.
class Plate {
 public:
  explicit Plate(double z_m) {
    body_.X_WB.translation() = Vec3(0, 0, z_m);
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5})
        contacts_.emplace_back(GroundTools::HullPoint{0, {x, y, 0}});
    }
  }

  void Move(const Columns& ground, double seconds) {
    for (int k = 0; k < seconds / kStep_s; ++k) {
      force_W_n_ = Vec3::Zero();
      for (HullContact& contact : contacts_) {
        force_W_n_ += contact.Act(body_, kStep_s, ground).force_W_n;
      }
      body_.v_WB_mps += (force_W_n_ / kMass_kg - Vec3(0, 0, kStandardGravity_mps2)) * kStep_s;
      body_.X_WB.translation() += body_.v_WB_mps * kStep_s;
    }
  }

  double z_m() const { return body_.X_WB.translation().z(); }
  Vec3 force_W_n() const { return force_W_n_; }
  BodyState& body() { return body_; }
  static constexpr double kMass_kg = 1000;

 private:
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
  HullContact corner({0, Vec3::Zero()});
  BodyState body;
  body.v_WB_mps = Vec3(0, 0, -std::sqrt(2 * kStandardGravity_mps2 * 0.3));
  double deepest_m = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 force_W_n = corner.Act(body, kStep_s, ground).force_W_n;
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
  // v^2 / (2 mu g) = 0.41 m, and a creep at the end.
  plate.Move(ground, 3);
  EXPECT_NEAR(plate.body().X_WB.translation().x(), 0.41, 0.03);
}

}  // namespace
}  // namespace tera
