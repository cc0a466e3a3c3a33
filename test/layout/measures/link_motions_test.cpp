#include "layout/measures/link_motions.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

/// A root, a link that turns on it about an oblique axis, one that slides on that, and one fixed to
/// it.
MachineModel Chain() {
  MachineModel model;
  for (const char* name : {"root", "turning", "sliding", "fixed"}) {
    model.links.emplace_back().name = name;
  }
  Joint turn, slide, fixed;
  turn = {.name = "turn", .type = JointType::kRevolute, .parent = 0, .child = 1};
  turn.X_PJ = MakePose({0.4, -0.2, 0.9}, 0.3, -0.5, 1.1);
  turn.axis_J = Vec3(1, 2, 2) / 3;
  slide = {.name = "slide", .type = JointType::kPrismatic, .parent = 1, .child = 2};
  slide.X_PJ = MakePose({1.2, 0.1, -0.3}, -0.2, 0.6, 0.4);
  slide.axis_J = Vec3(2, -1, 2) / 3;
  fixed = {.name = "fixed", .type = JointType::kFixed, .parent = 2, .child = 3};
  fixed.X_PJ = MakePose({0.2, 0.5, 0.7}, 0.1, 0.2, 0.3);
  model.joints = {turn, slide, fixed};
  return model;
}

struct Course {
  Vec3 place_m = Vec3(3, -2, 1), speed_mps = Vec3(0.6, -0.4, 0.3), push_mps2 = Vec3(-1, 2, 0.5);
  Vec3 axis = Vec3(0.36, 0.48, 0.8);
  double rate_radps = 0.7, growth_radps2 = -1.3;

  /// The root's pose and the joints' positions at a time near 0.
  Pose RootAt(double t) const {
    const Mat3 R_start = RotationFromRpy(0.2, -0.1, 0.8);
    const double turned = rate_radps * t + 0.5 * growth_radps2 * t * t;
    return MakePose(place_m + t * speed_mps + 0.5 * t * t * push_mps2,
                    Mat3(Eigen::AngleAxisd(turned, axis)) * R_start);
  }
  std::vector<double> JointsAt(double t) const {
    return {0.5 + 0.9 * t + 0.5 * 2.2 * t * t, 0.3 - 0.8 * t + 0.5 * 1.7 * t * t, 0};
  }
};

TEST(LinkMotions, AreTheDerivativesOfThePoses) {
  // Central differences of the poses over h = 1e-3 s: off by h^2 times the next derivatives, some
  // 10 m/s^3 and m/s^4, 1e-5.
  const MachineModel model = Chain();
  const Course course;
  BodyState root;
  root.X_WB = course.RootAt(0);
  root.v_WB_mps = course.speed_mps;
  root.a_WB_mps2 = course.push_mps2;
  root.w_WB_radps = course.rate_radps * course.axis;
  root.alpha_WB_radps2 = course.growth_radps2 * course.axis;
  const std::vector<BodyState> links =
      MotionOfLinks(model, root, {course.JointsAt(0), {0.9, -0.8, 0}, {2.2, 1.7, 0}});
  const double h = 1e-3;
  const auto poses = [&](double t) {
    return ForwardKinematics(model, course.RootAt(t), course.JointsAt(t));
  };
  const auto before = poses(-h), now = poses(0), after = poses(h);
  const auto rate = [&](const Pose& a, const Pose& b) -> Vec3 {
    const Eigen::AngleAxisd turn(Mat3(b.linear() * a.linear().transpose()));
    return turn.axis() * turn.angle() / h;
  };
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Vec3 a_m = before[k].translation(), b_m = now[k].translation(),
               c_m = after[k].translation();
    const Vec3 early_radps = rate(before[k], now[k]), late_radps = rate(now[k], after[k]);
    EXPECT_LT((links[k].X_WB.matrix() - now[k].matrix()).norm(), 1e-12) << k;
    EXPECT_LT((links[k].v_WB_mps - (c_m - a_m) / (2 * h)).norm(), 2e-5) << k;
    EXPECT_LT((links[k].a_WB_mps2 - (c_m - 2 * b_m + a_m) / (h * h)).norm(), 2e-5) << k;
    EXPECT_LT((links[k].w_WB_radps - 0.5 * (early_radps + late_radps)).norm(), 2e-5) << k;
    EXPECT_LT((links[k].alpha_WB_radps2 - (late_radps - early_radps) / h).norm(), 2e-5) << k;
  }
}

}  // namespace
}  // namespace tera
