#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "blind/mujoco/plant/course.h"
#include "blind/mujoco/plant/model.h"
#include "blind/mujoco/plant/slew_ring.h"
#include "blind/mujoco/plant/some_course.h"

namespace tera::blind::mujoco {
namespace {

/// Both tracks, eased within half a second, left times `left`.
Operator Travels(double left, double right, double length_s) {
  return [=](double t_s, const Instant&) {
    PerAxis<double> levers{};
    const double share = std::clamp(2 * std::min(t_s, length_s - t_s), 0.0, 1.0);
    levers[kLeftTrack] = left * share, levers[kRightTrack] = right * share;
    return levers;
  };
}

struct Travelled {
  double left_m, right_m;  ///< of the sprockets
  double ahead_m, turned_rad;
};

Travelled Of(const Course& course, double from_s, double to_s) {
  const Instant &from = course.At(from_s), &to = course.At(to_s);
  const Vec3 ahead = from.q_WB * Vec3::UnitX(), later = to.q_WB * Vec3::UnitX();
  Travelled out{0.225 * (to.angle_rad[kLeftTrack] - from.angle_rad[kLeftTrack]),
                0.225 * (to.angle_rad[kRightTrack] - from.angle_rad[kRightTrack]), 0,
                std::atan2(ahead.cross(later).z(), ahead.dot(later))};
  for (double t_s = from_s; t_s < to_s - 0.005; t_s += 0.01) {
    const Instant &now = course.At(t_s), &next = course.At(t_s + 0.01);
    out.ahead_m += (next.p_WB_m - now.p_WB_m).dot(now.q_WB * Vec3::UnitX());
  }
  return out;
}

TEST(ReservedForms, AJointRingsAsItsOilDoes) {
  PlantForm form;
  form.drives[kBucket].oil = {30, 0.25};
  form.drives[kBoom].oil =
      form.drives[kArm].oil = {200, 0.7};  // so that they hold the bucket still
  const Course course = DriveBy(
      [](double t_s, const Instant&) {
        PerAxis<double> levers{};
        if (t_s >= 0.5) levers[kBucket] = 0.5;
        return levers;
      },
      1.2, form);
  double most_radps = 0, at_s = 0;
  for (double t_s = 0.5; t_s < 0.75; t_s += 0.001) {
    const double rate_radps = course.At(t_s).rate_radps[kBucket];
    if (rate_radps > most_radps) most_radps = rate_radps, at_s = t_s;
  }
  // A step of x'' + 2 z w x' + w^2 x: the peak is at pi / (w sqrt(1 - z^2)), 0.004 s behind the
  // pilot, and overshoots by exp(-pi z / sqrt(1 - z^2)). The support yields slightly.
  const double root = std::sqrt(1 - 0.25 * 0.25);
  EXPECT_NEAR(at_s - 0.5, M_PI / (30 * root) + 0.004, 0.008);
  const double full_radps = 0.5 * FourTons().full_rate_radps[kBucket];
  EXPECT_NEAR(most_radps / full_radps, 1 + std::exp(-M_PI * 0.25 / root), 0.05);
}

/// x of a link's centre of mass, all in one plane.
double Reach_m(const MachineNumbers& n, double boom, double arm, double bucket) {
  const auto turned = [](const Vec3& v, double up) {
    return v.x() * std::cos(up) - v.z() * std::sin(up);
  };
  const double boom_pin_m = n.joints[kBoom].pin_m.x();
  const double arm_pin_m = boom_pin_m + turned(n.joints[kArm].pin_m, boom);
  const double bucket_pin_m = arm_pin_m + turned(n.joints[kBucket].pin_m, boom + arm);
  const double x_m[] = {n.links[kUpper].com_m.x(),
                        boom_pin_m + turned(n.links[kBoomLink].com_m, boom),
                        arm_pin_m + turned(n.links[kArmLink].com_m, boom + arm),
                        bucket_pin_m + turned(n.links[kBucketLink].com_m, boom + arm + bucket)};
  double mass_kg = 0, moment_kgm = 0;
  for (std::size_t i = kUpper; i < kLinkCount; ++i) {
    mass_kg += n.links[i].mass_kg;
    moment_kgm += n.links[i].mass_kg * x_m[i - kUpper];
  }
  return moment_kgm / mass_kg;
}

TEST(ReservedForms, ARingRubsByTheMomentThatTiltsIt) {
  constexpr double kDiameter_m = 0.8;
  for (const double arm_rad : {-2.3, -0.7}) {
    Start start = SomeStart();
    start.joints_rad = {0.9, 0.35, arm_rad, -0.3};
    const Model model = BuildModel(FourTons(), {}, start);
    const DataPtr data(mj_makeData(model.model.get()));
    PlaceAt(model, start, data.get());
    mj_forward(model.model.get(), data.get());
    // (4.4 M + D F) / (4.4 F D / 4 + D F), M being weight times reach.
    const double reach_m = std::abs(Reach_m(FourTons(), 0.35, arm_rad, -0.3));
    const double expected = (4.4 * reach_m + kDiameter_m) / (2.1 * kDiameter_m);
    EXPECT_NEAR(RingFriction(*model.model, *data, model.joint[kSlew], kDiameter_m), expected,
                0.003 * expected);
  }
}

/// Lag of a slew behind its motor after motion to and fro, by a start at the ring's position.
double Lost_rad(double slew_rad, const PlantForm& form) {
  Start start = SomeStart();
  start.joints_rad[0] = slew_rad;
  const Operator back_and_forth = [](double t_s, const Instant&) {
    PerAxis<double> levers{};
    if (t_s < 3.2) levers[kSlew] = 0.3 * std::sin(2 * M_PI * t_s / 3.2);
    return levers;
  };
  return DriveBy(back_and_forth, 4, form, start).At(4).angle_rad[kSlew] -
         DriveBy(back_and_forth, 4, {}, start).At(4).angle_rad[kSlew];
}

TEST(ReservedForms, ARingThatIsWornOnOneSideHasItsPlayThere) {
  EXPECT_NEAR(HalfPlay_rad(0.04, 0.6, 0.3, 0.3), 0.032, 1e-12);
  EXPECT_NEAR(HalfPlay_rad(0.04, 0.6, 0.3, 0.3 + M_PI), 0.008, 1e-12);
  EXPECT_NEAR(HalfPlay_rad(0.04, 0.6, 0.3, 0.3 - M_PI / 2), 0.02, 1e-12);
  PlantForm form;
  form.drives[kSlew].gap_rad = 0.03;
  form.drives[kSlew].gap_worn = 0.6;
  // As in MujocoCourse.AGapIsCrossedBeforeALinkFollows: from 0.4 of the play to all of it.
  const double worst_rad = Lost_rad(0, form), across_rad = Lost_rad(M_PI, form);
  EXPECT_GT(worst_rad, 0.4 * 0.048);
  EXPECT_LT(worst_rad, 0.048);
  EXPECT_GT(across_rad, 0.4 * 0.012);
  EXPECT_LT(across_rad, 0.0125);
}

TEST(ReservedForms, ABladeCostsSlipByWhatItDrags) {
  PlantForm form;
  form.shoes.drag_ahead = 0.2;
  form.shoes.drag_back = 0.1;
  form.shoes.relaxation_m = 0.004;
  const Travelled ahead = Of(DriveBy(Travels(0.5, 0.5, 6), 6, form), 1, 5);
  const Travelled back = Of(DriveBy(Travels(-0.5, -0.5, 6), 6, form), 1, 5);
  // Each track carries half the drag. Bristles of half the mass times (70 rad/s)^2 are bent by slip
  // times the ground until they are renewed.
  const double slip = 0.1 * 9.81 / (0.5 * 70 * 70 * 0.004);
  EXPECT_NEAR(1 - ahead.ahead_m / ahead.left_m, slip, 0.05 * slip);
  EXPECT_NEAR(1 - back.ahead_m / back.left_m, slip / 2, 0.05 * slip);
}

TEST(ReservedForms, MudPacksOnASprocketUnderWay) {
  PlantForm form;
  form.packs = {0.06, 0.06};
  const Travelled way = Of(DriveBy(Travels(0.6, 0.6, 9), 9.5, form), 0, 9.5);
  // Over a way w the mean of 1 - e^(-w / 3 m) is 1 - 3 m / w (1 - e^(-w / 3 m)).
  const double w_m = way.ahead_m, packed = 0.06 * (1 - 3 / w_m * (1 - std::exp(-w_m / 3)));
  EXPECT_GT(w_m, 6);
  EXPECT_NEAR(way.ahead_m / way.left_m, 1 + packed, 0.003);
}

TEST(ReservedForms, ATurnOnOneSoftTrackIsLessAndCreepsToTheHardOnesWay) {
  const double gauge_m = FourTons().gauge_m, contact_m = FourTons().contact_m;
  PlantForm form;
  form.shoes.grip_across = 0.6;
  form.shoes.soft = {1.6, 0.4};
  const double slip = 0.15, thrust = 0.6 * contact_m / 4 / gauge_m;
  form.shoes.relaxation_m = thrust * 9.81 / (slip * 70 * 70 / 2);
  const Travelled way = Of(DriveBy(Travels(-0.3, 0.3, 6), 6, form), 1, 5);
  // Left moves 1 - 1.6 slip of its path back, right 1 - 0.4 slip ahead. Where the machine creeps,
  // its shoes slide less sideways than in a turn on the spot, and the thrust is slightly smaller.
  const double ideal_rad = (way.right_m - way.left_m) / gauge_m;
  EXPECT_NEAR(way.turned_rad / ideal_rad, 1 - slip, 0.04);
  EXPECT_NEAR(way.ahead_m / way.right_m, (1.6 - 0.4) / 2 * slip, 0.03);
}

}  // namespace
}  // namespace tera::blind::mujoco
