#include "diagnose/motion/kinematic_chain.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "core/units.h"
#include "diagnose/motion/link_motion.h"
#include "diagnose/motion/random_machine.h"

// Chains against the forward kinematics of the whole machine, and their rates and forces against
// differences of its poses.

namespace tera {
namespace {

using enum JointType;

const std::vector<std::vector<JointType>> kMachines = {
    {kRevolute},
    {kPrismatic},
    {kRevolute, kPrismatic},
    {kPrismatic, kContinuous},
    {kContinuous, kFixed, kRevolute, kRevolute},
    {kFixed, kPrismatic, kRevolute, kFixed, kPrismatic, kRevolute, kFixed},
    {kRevolute, kRevolute, kRevolute, kRevolute, kRevolute, kRevolute},
};

/// The places of all joints that move, in their order.
std::vector<int> AllPlaces(const MachineModel& model) {
  std::vector<int> places;
  int next = 0;
  for (const Joint& joint : model.joints) places.push_back(joint.type == kFixed ? -1 : next++);
  return places;
}

/// Positions of the chain's steps, selected from those of all joints.
std::vector<double> OfSteps(const KinematicChain& chain, const std::vector<double>& q) {
  std::vector<double> of_steps;
  for (const KinematicChain::Step& step : chain.steps) of_steps.push_back(q[step.joint]);
  return of_steps;
}

TEST(KinematicChain, PutsPointsWhereForwardKinematicsDoes) {
  std::uint64_t seed = 0;
  for (const std::vector<JointType>& kinds : kMachines) {
    const MachineModel model = RandomMachine(++seed, kinds);
    const Stream draw(seed, "positions");
    for (int link = 0; link < static_cast<int>(model.links.size()); ++link) {
      const auto chain = ChainTo(model, link, AllPlaces(model));
      ASSERT_TRUE(chain) << link;
      std::vector<double> q;
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        q.push_back(kinds[k] == kFixed ? 0 : draw.Gaussian(k));
      }
      const std::vector<Pose> poses = ForwardKinematics(model, Pose::Identity(), q);
      const Vec3 p_L = draw.Gaussian3(link, 5);
      const Vec3 found = PointInBase<double>(*chain, p_L, OfSteps(*chain, q).data());
      EXPECT_LT((found - poses[link] * p_L).norm(), 1e-12) << "machine " << seed << " " << link;
    }
  }
}

TEST(KinematicChain, FoldsJointsThatRestAtTheirFirstPositions) {
  const MachineModel model =
      RandomMachine(21, {kRevolute, kPrismatic, kRevolute, kFixed, kPrismatic, kContinuous});
  const std::vector<int> places = {-1, 1, -1, -1, -1, 0};
  const auto chain = ChainTo(model, 6, places);
  ASSERT_TRUE(chain);
  ASSERT_EQ(chain->steps.size(), 2u);
  EXPECT_EQ(chain->steps[0].joint, 1);
  EXPECT_EQ(chain->steps[0].place, 1);
  EXPECT_TRUE(chain->steps[0].slides);
  EXPECT_EQ(chain->steps[1].joint, 5);
  EXPECT_EQ(chain->steps[1].place, 0);
  EXPECT_FALSE(chain->steps[1].slides);
  std::vector<double> q;
  for (const Joint& joint : model.joints) q.push_back(joint.initial_rad);
  q[1] = 0.7;
  q[5] = -1.1;
  const Vec3 p_L(0.3, -0.2, 0.5);
  const double of_steps[] = {q[1], q[5]};
  const Vec3 expected = ForwardKinematics(model, Pose::Identity(), q)[6] * p_L;
  EXPECT_LT((PointInBase<double>(*chain, p_L, of_steps) - expected).norm(), 1e-12);
}

TEST(KinematicChain, ToTheBaseHasNoSteps) {
  const MachineModel model = RandomMachine(3, {kRevolute});
  const auto chain = ChainTo(model, 0, AllPlaces(model));
  ASSERT_TRUE(chain);
  EXPECT_TRUE(chain->steps.empty());
  EXPECT_TRUE(chain->X_PL.isApprox(Pose::Identity()));
}

TEST(KinematicChain, OfMoreThanSixMovingJointsIsNotLookedAt) {
  const MachineModel model = RandomMachine(4, std::vector<JointType>(7, kRevolute));
  EXPECT_TRUE(ChainTo(model, 6, AllPlaces(model)));
  EXPECT_FALSE(ChainTo(model, 7, AllPlaces(model)));
  // Joints at rest do not count.
  std::vector<int> places = AllPlaces(model);
  places[3] = -1;
  EXPECT_TRUE(ChainTo(model, 7, places));
}

/// A base and joints in simultaneous smooth motion.
struct MovingMachine {
  MovingMachine(std::uint64_t seed, const std::vector<JointType>& kinds)
      : model(RandomMachine(seed, kinds)) {
    const Stream draw(seed, "motion");
    for (int k = 0; k < 3; ++k) place[k] = SmoothNumber(draw, k, 1);
    for (int k = 0; k < 3; ++k) rpy[k] = SmoothNumber(draw, 3 + k, 0.3);
    rpy[2].slope += 0.8;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      joints.push_back(kinds[k] == kFixed ? SmoothNumber() : SmoothNumber(draw, 10 + k, 0.5));
    }
  }
  static Vec3 Of(const SmoothNumber (&numbers)[3], double t, int derivative = 0) {
    return {numbers[0].Of(t, derivative), numbers[1].Of(t, derivative),
            numbers[2].Of(t, derivative)};
  }
  std::vector<double> Joints(double t, int derivative = 0) const {
    std::vector<double> q;
    for (const SmoothNumber& joint : joints) q.push_back(joint.Of(t, derivative));
    return q;
  }
  Pose Link(int link, double t) const {
    const Vec3 angles = Of(rpy, t);
    const Pose X_WB = MakePose(Of(place, t), RotationFromRpy(angles[0], angles[1], angles[2]));
    return ForwardKinematics(model, X_WB, Joints(t))[link];
  }
  Inertial<double> InertialAt(const KinematicChain& chain, double t) const {
    const Inertial<double> base =
        InertialOfBase<double>(Of(rpy, t), Of(rpy, t, 1), Of(rpy, t, 2), Of(place, t, 2));
    return InertialOfLink<double>(chain, base, OfSteps(chain, Joints(t)).data(),
                                  OfSteps(chain, Joints(t, 1)).data(),
                                  OfSteps(chain, Joints(t, 2)).data());
  }
  /// The turn rate of a link in its own frame by a difference of rotations.
  Vec3 RateByDifference(int link, double t, double step) const {
    const Mat3 R = Link(link, t).linear(), R0 = Link(link, t - step).linear(),
               R1 = Link(link, t + step).linear();
    const Eigen::AngleAxisd turn(R0.transpose() * R1);
    return R.transpose() * R0 * (turn.axis() * turn.angle()) / (2 * step);
  }

  MachineModel model;
  SmoothNumber place[3], rpy[3];
  std::vector<SmoothNumber> joints;
};

TEST(InertialOfLink, OfChainsOfHingesAndSlidesIsThatOfDifferencesOfPoses) {
  std::uint64_t seed = 100;
  for (const std::vector<JointType>& kinds : kMachines) {
    const MovingMachine moving(++seed, kinds);
    const int link = static_cast<int>(kinds.size());
    const auto chain = ChainTo(moving.model, link, AllPlaces(moving.model));
    ASSERT_TRUE(chain);
    for (const double t : {0.0, 0.83, 2.9}) {
      const Inertial<double> found = moving.InertialAt(*chain, t);
      const double h = 1e-4;
      EXPECT_LT((found.w - moving.RateByDifference(link, t, h)).norm(), 1e-5) << seed << " " << t;
      const double wide = 1e-3;
      const Vec3 alpha = (moving.RateByDifference(link, t + wide, h) -
                          moving.RateByDifference(link, t - wide, h)) /
                         (2 * wide);
      EXPECT_LT((found.alpha - alpha).norm(), 1e-3 * (1 + alpha.norm())) << seed << " " << t;
      const auto place = [&](double at) { return Vec3(moving.Link(link, at).translation()); };
      const Vec3 a_W = (place(t + h) - 2 * place(t) + place(t - h)) / (h * h);
      const Vec3 f_L =
          moving.Link(link, t).linear().transpose() * (a_W + Vec3(0, 0, kStandardGravity_mps2));
      EXPECT_LT((found.f - f_L).norm(), 1e-4 * (1 + a_W.norm())) << seed << " " << t;
    }
  }
}

TEST(InertialOfLink, OfAMachineThatRestsIsGravityInTheLink) {
  const MovingMachine moving(7, {kRevolute, kPrismatic, kRevolute});
  const auto chain = ChainTo(moving.model, 3, AllPlaces(moving.model));
  const Vec3 rpy(0.1, -0.2, 2.9), none = Vec3::Zero();
  const std::vector<double> q = {0.4, -0.3, 1.2};
  const double zero[3] = {0, 0, 0};
  const Inertial<double> found = InertialOfLink<double>(
      *chain, InertialOfBase<double>(rpy, none, none, none), q.data(), zero, zero);
  const Pose X_WB = MakePose(Vec3::Zero(), RotationFromRpy(rpy[0], rpy[1], rpy[2]));
  const Mat3 R_WL = ForwardKinematics(moving.model, X_WB, q)[3].linear();
  EXPECT_LT((found.f - R_WL.transpose() * Vec3(0, 0, kStandardGravity_mps2)).norm(), 1e-12);
  EXPECT_LT(found.w.norm() + found.alpha.norm(), 1e-15);
}

}  // namespace
}  // namespace tera
