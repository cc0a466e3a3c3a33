#include "sim/events/event_log.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "sim/drive_fixture.h"

/// Events of driven machines, with times, forces and distances from geometry and momentum.

namespace tera {
namespace {

constexpr double kGravity_mps2 = 9.80665, kFriction = 0.5, kStep_s = 0.002;

/// A drive whose events are kept.
struct Watched {
  Watched(const std::string& start, double lever, const std::string& more)
      : drive("tb235.yaml", start, "cell_m: 0.1, soil: asphalt", lever, lever, more),
        log(drive.scenario, drive.simulation->state()) {}

  void Run(double duration_s) {
    drive.Run(duration_s, [&] { log.Observe(drive.simulation->last_step()); });
  }
  double t_s() const { return ToSeconds(drive.simulation->state().t_ns); }
  std::vector<RecordedEvent> Of(EventKind kind) const {
    std::vector<RecordedEvent> all = log.All();
    std::erase_if(all, [&](const RecordedEvent& event) { return event.kind != kind; });
    std::ranges::sort(all);
    return all;
  }

  Drive drive;
  EventLog log;
};

std::string BoxAt(const std::string& name, double x_m, const Vec3& size_m,
                  const std::string& more) {
  return fmt::format(
      "obstacles:\n  - {{name: {}, label: structure, mesh: tera:assets/rock.glb, xy_m: [{}, 0], "
      "collision: [{{xyz_m: [0, 0, {}], size_m: [{}, {}, {}]}}], {}}}\n",
      name, x_m, 0.5 * size_m.z(), size_m.x(), size_m.y(), size_m.z(), more);
}

/// Corners of the collision boxes of one link in W.
std::vector<Vec3> CornersOf(const Drive& drive, const std::string& link) {
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const auto i = static_cast<std::size_t>(model.LinkIndex(link));
  std::vector<Vec3> corners;
  for (const CollisionBox& box : model.links[i].collision) {
    for (int k = 0; k < 8; ++k) {
      const Vec3 sign(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5);
      corners.push_back(drive.machine().links[i].X_WB * box.X_BG *
                        Vec3(sign.cwiseProduct(box.size_m)));
    }
  }
  return corners;
}

constexpr char kBladeAhead[] =
    "{xy_m: [-2.5, 0], joints_deg: {boom: 55, arm: -130, bucket: -40, blade: 25}}";

TEST(Events, AContactBeginsWhenTheBladeHasDrivenTheWayToTheObstacle) {
  constexpr double kFace_m = 1.0;
  Watched run(kBladeAhead, 0.5, BoxAt("post", kFace_m + 0.2, {0.4, 0.4, 0.5}, "yaw_deg: 0"));
  run.Run(1.5);
  EXPECT_TRUE(run.log.All().empty());
  double front_m = -10;
  for (const Vec3& corner_m : CornersOf(run.drive, "blade"))
    front_m = std::max(front_m, corner_m.x());
  const double v_mps = run.drive.body().v_WB_mps.x(),
               expected_s = run.t_s() + (kFace_m - front_m) / v_mps;
  EXPECT_NEAR(v_mps, 0.625, 0.03);
  run.Run(expected_s - run.t_s() + 1);
  const auto contacts = run.Of(EventKind::kContact);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(ToSeconds(contacts[0].begin_ns), expected_s, 0.05);  // 3 cm of shape and pitch
  EXPECT_NEAR(ToSeconds(contacts[0].end_ns), run.t_s(), 0.2);
  EXPECT_EQ(contacts[0].machine, "m");
  EXPECT_EQ(contacts[0].part, "blade");
  EXPECT_EQ(contacts[0].other, "post");
  EXPECT_EQ(run.log.Touched(0), std::vector<std::string>{"post"});
}

TEST(Events, AStrikeHasTheMomentumThatAFreeBoxTakes) {
  constexpr double kMass_kg = 200;
  Watched run(
      kBladeAhead, 0.5,
      BoxAt("box", 1.2, {0.4, 0.6, 0.5}, fmt::format("dynamic: {{mass_kg: {}}}", kMass_kg)));
  for (int k = 0; k < 3000 && run.Of(EventKind::kStrike).empty(); ++k) run.Run(kStep_s);
  ASSERT_EQ(run.Of(EventKind::kStrike).size(), 1u);
  run.Run(0.02);
  const BodyState& box = run.drive.simulation->state().obstacles[0];
  const double after_mps = PointVelocity(box, Vec3(0, 0, 0.25)).x();  // of its centre of mass
  const RecordedEvent strike = run.Of(EventKind::kStrike)[0];
  EXPECT_NEAR(after_mps, run.drive.body().v_WB_mps.x(), 0.1);
  // The blade's impulse is the box's momentum and what friction takes in 20 ms. The tilted face
  // also presses the box down, which adds friction.
  const double friction_n_s = kFriction * kMass_kg * kGravity_mps2 * 0.02;
  EXPECT_GT(strike.value, 0.9 * kMass_kg * after_mps);
  EXPECT_LT(strike.value, 1.2 * (kMass_kg * after_mps + friction_n_s));
  EXPECT_NEAR(ToSeconds(strike.end_ns - strike.begin_ns), 0.02, 0.003);
  EXPECT_EQ(strike.part, "blade");
  EXPECT_EQ(strike.other, "box");
}

TEST(Events, ADroppedBoxFallsByHalfGTimesTheSquareOfTheTime) {
  constexpr double kHeight_m = 1.5;
  Watched run(
      "{xy_m: [-10, 7]}", 0,
      "settle_s: 0\n" +
          BoxAt("box", 3, {0.5, 0.5, 0.4},
                fmt::format("height_above_ground_m: {}, dynamic: {{mass_kg: 50}}", kHeight_m)));
  run.Run(1.5);
  const auto drops = run.Of(EventKind::kDrop);
  ASSERT_GE(drops.size(), 1u);
  const double fall_s = ToSeconds(drops[0].end_ns - drops[0].begin_ns);
  EXPECT_NEAR(drops[0].value, kHeight_m, 0.02);
  EXPECT_NEAR(fall_s, std::sqrt(2 * kHeight_m / kGravity_mps2), 0.006);
  EXPECT_EQ(drops[0].begin_ns, 0);
  EXPECT_EQ(drops[0].machine, "");
  EXPECT_EQ(drops[0].other, "box");
  // It may bounce once; a bounce is a drop too.
  EXPECT_LE(drops.size(), 2u);
  EXPECT_LT(drops.back().value, drops.size() == 1 ? 2 : 0.1 * kHeight_m);
}

TEST(Events, AMachineThatStandsOrDrivesAloneHasNone) {
  Watched run("{xy_m: [0, 0]}", 0.8, "settle_s: 0.5\n");
  run.Run(3);
  EXPECT_TRUE(run.log.All().empty());
}

/// A worker straight behind the machine, `beyond_m` beyond the radius of its reach.
std::vector<RecordedEvent> PersonAt(double beyond_m, double* distance_m) {
  const auto person = [](double x_m) {
    return fmt::format(
        "obstacles:\n  - {{name: worker, preset: tera:config/obstacles/person.yaml, "
        "xy_m: [{}, 0]}}\n",
        x_m);
  };
  const MachineModel model =
      Drive::Read("tb235.yaml", "{xy_m: [0, 0]}", "cell_m: 0.1, soil: asphalt", "")
          .machines[0]
          .placement.model;
  const SweptCircle circle = CircleOf(model);
  const double x_m = circle.axis_B_m.x() - circle.radius_m - beyond_m;
  Watched run("{xy_m: [0, 0]}", 0, person(x_m));
  run.Run(0.1);
  double rear_m = 10;
  for (const Link& link : model.links) {
    for (const Vec3& corner_m : CornersOf(run.drive, link.name))
      rear_m = std::min(rear_m, corner_m.x());
  }
  *distance_m = rear_m - (x_m + 0.2);  // the person's box is 0.4 m long
  return run.Of(EventKind::kPersonNear);
}

TEST(Events, APersonIsNearWithinTheSweptCircle) {
  double distance_m = 0;
  const auto near = PersonAt(-0.1, &distance_m);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].begin_ns, 0);
  EXPECT_EQ(near[0].machine, "m");
  EXPECT_EQ(near[0].other, "worker");
  EXPECT_NEAR(near[0].value, distance_m, 0.01);
  EXPECT_TRUE(PersonAt(0.1, &distance_m).empty());
}

TEST(Events, TheSweptCircleHoldsEveryPoseOfTheArmAndLittleMore) {
  const MachineModel model =
      Drive::Read("tb235.yaml", "{xy_m: [0, 0]}", "cell_m: 0.1, soil: asphalt", "")
          .machines[0]
          .placement.model;
  const SweptCircle circle = CircleOf(model);
  double farthest_m = 0;
  constexpr int kShares = 12;
  std::vector<double> q_rad(model.joints.size(), 0.0);
  const auto boom = static_cast<std::size_t>(model.JointIndex("boom")),
             arm = static_cast<std::size_t>(model.JointIndex("arm")),
             bucket = static_cast<std::size_t>(model.JointIndex("bucket"));
  const auto at = [&](std::size_t j, int k) {
    const Joint& joint = model.joints[j];
    return joint.lower_rad + k * (joint.upper_rad - joint.lower_rad) / kShares;
  };
  for (int k = 0; k <= kShares; ++k) {
    for (int l = 0; l <= kShares; ++l) {
      for (int n = 0; n <= kShares; ++n) {
        q_rad[boom] = at(boom, k);
        q_rad[arm] = at(arm, l);
        q_rad[bucket] = at(bucket, n);
        const std::vector<Pose> poses = ForwardKinematics(model, Pose::Identity(), q_rad);
        for (std::size_t i = 0; i < poses.size(); ++i) {
          for (const CollisionBox& box : model.links[i].collision) {
            const Vec3 tip_m = poses[i] * box.X_BG * Vec3(0.5 * box.size_m);
            farthest_m = std::max(farthest_m, (tip_m - circle.axis_B_m).head<2>().norm());
          }
        }
      }
    }
  }
  EXPECT_GE(circle.radius_m, farthest_m);
  EXPECT_LT(circle.radius_m, 1.15 * farthest_m);
}

TEST(Events, TheSweptCircleIsThatOfTheFarthestUprightJointAndHoldsTheRoot) {
  const auto box = [](const Vec3& centre_m, const Vec3& size_m) {
    return std::vector{CollisionBox{.X_BG = MakePose(centre_m), .size_m = size_m}};
  };
  const auto upright = [](int child, const Vec3& p_m) {
    Joint joint;
    joint.type = JointType::kContinuous;
    joint.parent = 0;
    joint.child = child;
    joint.X_PJ = MakePose(p_m);
    return joint;
  };
  MachineModel model;
  model.links.resize(3);
  model.links[0].collision = box(Vec3::Zero(), Vec3(1, 1, 0.5));
  model.links[1].collision = box(Vec3::Zero(), Vec3(0.2, 0.2, 0.2));  // a beacon
  model.links[2].collision = box(Vec3(2, 0, 5), Vec3(4, 0.6, 1));
  model.joints = {upright(1, Vec3(0.5, 0, 1)), upright(2, Vec3(-0.2, 0.1, 0.8))};
  EXPECT_TRUE(CircleOf(model).axis_B_m.isApprox(Vec3(-0.2, 0.1, 0.8)));
  EXPECT_NEAR(CircleOf(model).radius_m, std::hypot(4, 0.3), 1e-9);
  model.links[0].collision = box(Vec3::Zero(), Vec3(12, 2, 0.5));
  EXPECT_TRUE(CircleOf(model).axis_B_m.isApprox(Vec3(-0.2, 0.1, 0.8)));
  EXPECT_NEAR(CircleOf(model).radius_m, std::hypot(6.2, 1.1), 1e-9);
}

}  // namespace
}  // namespace tera
