#include "soil/track/side_faces.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "soil/block_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

/// The block leaning by 45 deg on the left track's outer edge, which lies along x.
class OnEdge {
 public:
  explicit OnEdge(double depth_m) : block_(FineDrySand(), Vec2(0, 0)) {
    links().X_WB = MakePose(Vec3::Zero(), RotationFromRpy(-45 * kDeg, 0, 0));
    links().X_WB.translation() = -(links().X_WB.linear() * Vec3(0, kEdge_m, 0));
    links().X_WB.translation().y() += 0.0125;  // between columns
    Move(Vec3(0, 0, -kSpeed_mps), depth_m);
  }
  /// Goes on by `way_m` and stops; returns the force at rest.
  Vec3 Move(const Vec3& v_W_mps, double way_m) {
    links().v_WB_mps = v_W_mps;
    const int steps = static_cast<int>(std::lround(way_m / v_W_mps.norm() / kStep_s));
    for (int k = 0; k < steps; ++k) {
      links().X_WB.translation() += kStep_s * v_W_mps;
      block_.Act();
    }
    links().v_WB_mps.setZero();
    force_n_ = block_.Act();
    return force_n_;
  }
  Vec3 force_n() const { return force_n_; }
  static constexpr double kSpeed_mps = 0.05;

 private:
  static std::string FineDrySand() { return fmt::format("{}cell_m: 0.025\n", kDrySand); }
  BodyState& links() { return block_.links[0]; }
  static constexpr double kEdge_m = kGauge_m / 2 + kWidth_m / 2;
  Block block_;
  Vec3 force_n_ = Vec3::Zero();
};

TEST(SideFaces, ALeaningTrackPressesOnBothFacesOfItsEdge) {
  // At 45 deg the edge is a wedge that both faces make alike, so that no force is left across it.
  // At depth d, each presses with N = L K h^n dh / c over h from 0 to d, as plates do at the depth
  // h that they have, c = cos 45 deg, and shears upwards with N tan phi + A c'. K = k_c / b + k_phi
  // of a plate 0.275 m wide. Ground that rebounds bears less, soil that one face presses out and
  // that comes to lie before the other more.
  constexpr double kDeep_m = 0.12, kExponent = 1.1, kModulus = 990 / 0.275 + 1528430;
  const double c = std::cos(45 * kDeg);
  const double normal_n =
      kLength_m * kModulus * std::pow(kDeep_m, kExponent + 1) / (kExponent + 1) / c;
  const double shear_n = normal_n * std::tan(28 * kDeg) + 1040 * kLength_m * kDeep_m / c;
  const OnEdge edge(kDeep_m);
  EXPECT_NEAR(edge.force_n().z() / (2 * c * (normal_n + shear_n)), 1, 0.15);
  EXPECT_NEAR(edge.force_n().y() / edge.force_n().z(), 0, 0.02);
}

TEST(SideFaces, HoldALeaningTrackAgainstBeingPulledSideways) {
  // 2 cm outwards, as a bucket does that digs there: the side face presses on alone. It meets at
  // least the passive pressure of a wall as deep, rho g h^2 / 2 tan^2(45 deg + phi / 2).
  OnEdge edge(0.1);
  const Vec3 outwards_n = edge.Move(Vec3(0, OnEdge::kSpeed_mps, 0), 0.02);
  const double passive_n =
      kLength_m * 0.5 * 1500 * 9.81 * 0.01 * std::pow(std::tan((45 + 14) * kDeg), 2);
  EXPECT_LT(outwards_n.y(), -passive_n);
}

TEST(SideFaces, CoverALyingTracksLowerHalf) {
  // A rectangle and two quarter discs, but for the last 10 deg of each: R^2 (a + sin a cos a) / 2.
  const RunningGear track = NosedTrack(0.6, 1.6, 0.3, 8, 0.25);
  const RunningGear with = SideFaces::AddedTo(track);
  ASSERT_EQ(with.patches.size(), 3 * track.patches.size());
  double area_m2 = 0;
  for (std::size_t k = track.patches.size(); k < with.patches.size(); ++k) {
    const ContactPatch& face = with.patches[k];
    EXPECT_TRUE(SideFaces::IsOne(face));
    EXPECT_NEAR(face.p_B_m.y(), 0.6 + 0.15 * face.outward_B.y(), 1e-12);
    EXPECT_NEAR(face.p_B_m.z() + 0.5 * face.width_m, 0.25, 1e-12);
    area_m2 += face.length_m * face.width_m;
  }
  const double a = 80 * kDeg;
  const double quarter_m2 = 0.25 * 0.25 * 0.5 * (a + std::sin(a) * std::cos(a));
  EXPECT_NEAR(area_m2 / (2 * (1.6 * 0.25 + 2 * quarter_m2)), 1, 0.005);
}

TEST(SideFaces, BearOnlyWhenTheMachineLeansFurtherThanItStands) {
  EXPECT_EQ(SideFaces::Bearing(std::sin(19.5 * kDeg)), 0);
  EXPECT_EQ(SideFaces::Bearing(std::sin(30.1 * kDeg)), 1);
  EXPECT_EQ(SideFaces::Bearing(1), 1);
  EXPECT_EQ(SideFaces::Bearing(-0.7), 0);
}

TEST(SideFaces, WheelsHaveNone) {
  RunningGear wheel;
  wheel.drive_radius_m = 0.5;
  for (const double angle_rad : {-0.4, 0.0, 0.4}) {
    ContactPatch patch;
    patch.outward_B = Vec3(std::sin(angle_rad), 0, -std::cos(angle_rad));
    patch.p_B_m = 0.5 * patch.outward_B;
    wheel.patches.push_back(patch);
  }
  EXPECT_EQ(SideFaces::AddedTo(wheel).patches.size(), wheel.patches.size());
}

}  // namespace
}  // namespace tera
