#include "soil/track/side_faces.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "soil/block_fixture.h"
#include "soil/track/gear_contact.h"

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
  // At depth d, each presses with N = L K h^n dh / c over h from 0 to d, c = cos 45 deg, as plates
  // do at their depth h. Each shears upwards with N tan phi + A c'. K = k_c / b + k_phi of a plate
  // 0.275 m wide. Ground that rebounds bears less, soil that one face presses out and that comes to
  // lie before the other more.
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

/// A track alone, without shear, that leans to its left (to its right: by less than 0), its lower
/// edge at first along the surface of level ground which yields at one pressure, whatever the
/// depth. Soil beyond the edge belongs to the side, soil on this side of it to the underside.
class LeaningTrack {
 public:
  LeaningTrack(double lean_rad, const SoilType& soil, double cell_m)
      : ground_(LevelColumns(soil, cell_m, static_cast<int>(1.5 / cell_m) + 1)),
        track_(FlatTrack(0, kLong_m, kWidth_m, 4), false, {soil}),
        left_(lean_rad > 0 ? 1 : -1) {
    TurnTo(lean_rad);
  }
  static SoilType Yielding(double max_density_kgpm3) {
    SoilType soil = SandOf30Deg();
    soil.max_density_kgpm3 = max_density_kgpm3;
    soil.compression_index = 10;  // is pressed together, not aside
    soil.young_modulus_pa = 20e6;
    soil.k_phi_npm_n2 = kYield_pa;
    soil.sinkage_exponent = 1e-3;
    soil.shear_modulus_m = 0.02;
    return soil;
  }
  void PushDown(double way_m) {
    constexpr double kSpeed_mps = 0.005;
    body_.v_WB_mps = Vec3(0, 0, -kSpeed_mps);
    const Vec3 side_W = left_ * body_.X_WB.linear().col(1);
    for (long n = std::lround(way_m / kSpeed_mps / kLongStep_s); n > 0; --n) {
      edge_W_m_ += kLongStep_s * body_.v_WB_mps;
      body_.X_WB.translation() += kLongStep_s * body_.v_WB_mps;
      side_work_j_ -= Act().dot(side_W) * body_.v_WB_mps.dot(side_W) * kLongStep_s;
    }
    body_.v_WB_mps.setZero();
  }
  /// About its lower edge.
  void TurnTo(double lean_rad) {
    body_.X_WB = MakePose(Vec3::Zero(), RotationFromRpy(-lean_rad, 0, kYaw_rad));
    body_.X_WB.translation() = edge_W_m_ - left_ * body_.X_WB.linear() * Vec3(0, kWidth_m / 2, 0);
    Act();
  }
  /// Work of the force on the side: the faces are at right angles.
  double side_work_j() const { return side_work_j_; }
  double SideDisplaces_m3() const {
    double sum_m3 = 0;
    for (int j = 0; j < ground_.ny(); ++j) {
      for (int i = 0; i < ground_.nx(); ++i) {
        const double out_m =
            ground_.y_m(j) * std::cos(kYaw_rad) - ground_.x_m(i) * std::sin(kYaw_rad);
        if (left_ * out_m > 0) sum_m3 += std::max(0.0, -ground_.TopAt(i, j)) * ground_.area_m2();
      }
    }
    return sum_m3;
  }
  /// Volume of ground above its first height, further out from the edge than `from_m`.
  double RaisedBeyond_m3(double from_m) const {
    double sum_m3 = 0;
    for (int j = 0; j < ground_.ny(); ++j) {
      for (int i = 0; i < ground_.nx(); ++i) {
        const double out_m =
            ground_.y_m(j) * std::cos(kYaw_rad) - ground_.x_m(i) * std::sin(kYaw_rad);
        if (left_ * out_m > from_m)
          sum_m3 += std::max(0.0, ground_.TopAt(i, j)) * ground_.area_m2();
      }
    }
    return sum_m3;
  }
  /// Mass that is neither where it was nor where it was put, over all mass put anywhere.
  double Lost() const {
    const Columns::Gain gain = ground_.GroundGain();
    return gain.net_kg / gain.gained_kg;
  }
  static constexpr double kYield_pa = 40e3;
  static constexpr double kLong_m = 0.8;
  static constexpr double kFace_m = 0.25;  ///< height of the side: the sprocket's radius

 private:
  static constexpr double kLongStep_s = 0.2, kYaw_rad = 0.3;
  Vec3 Act() {
    return track_.Act(body_, 0, kLongStep_s, LowObstacles(), &ground_).wrench.force_W_n;
  }
  Columns ground_;
  GearContact track_;
  double left_;
  BodyState body_;
  Vec3 edge_W_m_ = Vec3::Zero();
  double side_work_j_ = 0;
};

TEST(SideFaces, SoilTakesNoMoreWorkThanTheForceDoes) {
  // Loose soil is pressed together and not aside. So the work on it is its yield pressure times the
  // displaced volume. Damping and rebound add to the force. The slope at the rut's rim, a cell
  // wide, bears nothing, which vanishes with the cell.
  for (const double lean_deg : {22.0, -25.0, 28.0}) {
    LeaningTrack track(lean_deg * kDeg, LeaningTrack::Yielding(6000), 0.0125);
    track.PushDown(0.15);
    const double soil_j = LeaningTrack::kYield_pa * track.SideDisplaces_m3();
    EXPECT_GT(soil_j, 50) << lean_deg;
    EXPECT_NEAR(track.side_work_j() / soil_j, 1, 0.1) << lean_deg;
  }
}

TEST(SideFaces, SweepTheSoilThatTheirTouchingPartMeets) {
  // From the edge up the share s of the face touches. Seen from above this is a strip as wide as s
  // h sin a, or as the part in the ground. Over it the depth falls off by cot a. From step to step
  // of lean the volume grows by no more than such a step brings: it does not begin at once at 20
  // deg.
  constexpr double kDeep_m = 0.15;
  const auto swept_m3 = [kDeep_m](double lean_rad) {
    const double height_m = SideFaces::Bearing(std::sin(lean_rad)) * LeaningTrack::kFace_m;
    const double strip_m = std::min(height_m * std::sin(lean_rad), kDeep_m * std::tan(lean_rad));
    return LeaningTrack::kLong_m * strip_m * (kDeep_m - 0.5 * strip_m / std::tan(lean_rad));
  };
  const double whole_m3 = swept_m3(31 * kDeg);
  double before_m3 = 0;
  for (double lean_deg = 19; lean_deg <= 31; lean_deg += 0.5) {
    LeaningTrack track(lean_deg * kDeg, LeaningTrack::Yielding(6000), 0.025);
    track.PushDown(kDeep_m);
    const double now_m3 = track.SideDisplaces_m3();
    EXPECT_NEAR(now_m3 / whole_m3, swept_m3(lean_deg * kDeg) / whole_m3, 0.05) << lean_deg;
    EXPECT_LT((now_m3 - before_m3) / whole_m3, 0.2) << lean_deg;
    before_m3 = now_m3;
  }
}

TEST(SideFaces, PushSoilOutBesideWhatTouches) {
  // Dense soil goes to both sides of the pressing face: some of it out, beyond the part that
  // touches.
  for (const double lean_deg : {22.0, -23.0, 25.0}) {
    const double lean_rad = std::abs(lean_deg) * kDeg;
    const double touching = SideFaces::Bearing(std::sin(lean_rad));
    LeaningTrack track(lean_deg * kDeg, LeaningTrack::Yielding(1600), 0.0125);
    track.PushDown(0.1);
    const double strip_m = touching * LeaningTrack::kFace_m * std::sin(lean_rad);
    EXPECT_GT(track.RaisedBeyond_m3(strip_m), 0.05 * track.SideDisplaces_m3()) << lean_deg;
  }
}

TEST(SideFaces, LeaningFurtherPressesTheSoilBesideBitByBitAndLosesNone) {
  // Dense soil, part of which goes aside.
  LeaningTrack track(15 * kDeg, LeaningTrack::Yielding(1600), 0.0125);
  track.PushDown(0.1);
  const double upright_m3 = track.SideDisplaces_m3();
  double before_m3 = upright_m3, most_m3 = 0;
  for (double lean_deg = 15; lean_deg <= 35; lean_deg += 0.1) {
    track.TurnTo(lean_deg * kDeg);
    most_m3 = std::max(most_m3, std::abs(track.SideDisplaces_m3() - before_m3));
    before_m3 = track.SideDisplaces_m3();
  }
  EXPECT_LT(most_m3 / (before_m3 - upright_m3), 0.1);
  EXPECT_NEAR(track.Lost(), 0, 1e-12);
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
