#include "diagnose/motion/link_motion.h"

#include <gtest/gtest.h>

#include "core/motion.h"

// The kinematics of the estimate against differences of poses that Eigen's rotations give.

namespace tera {
namespace {

constexpr double kStep_s = 1e-4;
const Vec3 kGravity_W(0, 0, -kStandardGravity_mps2);

TEST(RotationAbout, IsEigensAboutAnyAxis) {
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.2, -0.7, 0.4), Vec3(-1, 2, 3)}) {
    const Vec3 unit = axis.normalized();
    for (const double angle_rad : {-2.5, -0.3, 0.0, 1.1}) {
      const Mat3 expected = Eigen::AngleAxisd(angle_rad, unit).toRotationMatrix();
      EXPECT_LT((RotationAbout<double>(unit, angle_rad) - expected).norm(), 1e-14);
    }
  }
}

/// A base that travels, rolls, pitches and turns; a boom on a slewing upper structure.
struct Machine {
  static Vec3 Rpy(double t) {
    return {0.1 * std::sin(t), 0.2 + 0.1 * std::cos(2 * t), 3 + 0.5 * t + 0.2 * std::sin(t)};
  }
  static Vec3 Place(double t) { return {t * t, std::sin(2 * t), 0.1 * t}; }
  static double Slew(double t) { return 0.4 + 0.8 * std::sin(1.3 * t); }
  static double Boom(double t) { return -0.3 + 0.6 * std::cos(0.9 * t); }

  static Pose Base(double t) {
    const Vec3 rpy = Rpy(t);
    return MakePose(Place(t), RotationFromRpy(rpy[0], rpy[1], rpy[2]));
  }
  KinematicChain chain;
  Machine() {
    chain.steps.resize(2);
    chain.steps[0].X_PJ = MakePose(Vec3(0.1, 0.02, 0.5), RotationFromRpy(0.05, 0.1, 0.3));
    chain.steps[1].X_PJ = MakePose(Vec3(0.4, -0.1, 0.6), RotationFromRpy(0, -0.2, 0.1));
    chain.steps[1].axis_J = Vec3(0.1, -1, 0.2).normalized();
    chain.X_PL = MakePose(Vec3(0.7, 0.1, 0.2), RotationFromRpy(0.3, 0.2, -0.1));
  }
  Pose Link(double t) const {
    Pose X = Base(t);
    const double q[] = {Slew(t), Boom(t)};
    for (int s = 0; s < 2; ++s) {
      X = X * chain.steps[s].X_PJ *
          Pose(Eigen::AngleAxisd(q[s], chain.steps[s].axis_J).toRotationMatrix());
    }
    return X * chain.X_PL;
  }
};

/// First and second central differences of a function of time.
template <typename F>
auto FirstOf(const F& f, double t) {
  return ((f(t + kStep_s) - f(t - kStep_s)) / (2 * kStep_s)).eval();
}
template <typename F>
auto SecondOf(const F& f, double t) {
  return ((f(t + kStep_s) - 2 * f(t) + f(t - kStep_s)) / (kStep_s * kStep_s)).eval();
}

TEST(InertialOfLink, IsTheTurnRateAndSpecificForceOfItsPoses) {
  const Machine machine;
  const auto joints = [](double t) { return Vec2(Machine::Slew(t), Machine::Boom(t)); };
  for (const double t : {0.0, 0.7, 2.1}) {
    const Vec2 q = joints(t), qd = FirstOf(joints, t), qdd = SecondOf(joints, t);
    const Inertial<double> base =
        InertialOfBase<double>(Machine::Rpy(t), FirstOf(Machine::Rpy, t), SecondOf(Machine::Rpy, t),
                               SecondOf(Machine::Place, t));
    const Inertial<double> link =
        InertialOfLink<double>(machine.chain, base, q.data(), qd.data(), qdd.data());
    const Pose X_WL = machine.Link(t);
    const Eigen::AngleAxisd turn(machine.Link(t - kStep_s).linear().transpose() *
                                 machine.Link(t + kStep_s).linear());
    // A rate by differences is exact to the square of the step; rotated by half of it, to the step.
    EXPECT_LT((link.w - turn.axis() * turn.angle() / (2 * kStep_s)).norm(), 1e-3) << t;
    const auto place = [&](double at) { return Vec3(machine.Link(at).translation()); };
    const Vec3 f_L = X_WL.linear().transpose() * (SecondOf(place, t) - kGravity_W);
    EXPECT_LT((link.f - f_L).norm(), 1e-5) << t;
    EXPECT_GT((link.f + X_WL.linear().transpose() * kGravity_W).norm(), 0.1) << "it accelerates";
  }
}

}  // namespace
}  // namespace tera
