#include "physics/dynamics/inertial_effort.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "physics/machine_fixture.h"

namespace tera {
namespace {

/// A mast that turns on a moving base, and on it a sliding stick with a shovel at its end.
const std::string kCrane = R"(
kind: crane
links:
  base: {mass_kg: 6, inertia_kgm2: [1, 1, 1]}
  mast: {mass_kg: 6, inertia_kgm2: [1, 1, 1]}
  eye: {mass_kg: 6, inertia_kgm2: [1, 1, 1]}
  stick: {mass_kg: 6, inertia_kgm2: [1, 1, 1]}
joints:
  turn: {type: revolute, parent: base, child: mast, xyz_m: [0.4, -0.2, 1.1], rpy_deg: [10, 20, 30], axis: [0, 0, 1], limits_deg: [-90, 90], max_rate_degps: 20, max_effort_nm: 100}
  weld: {type: fixed, parent: mast, child: eye, xyz_m: [0.1, 0.3, 0.2], rpy_deg: [0, 40, 0]}
  slide: {type: prismatic, parent: mast, child: stick, xyz_m: [0.2, 0, 0.7], rpy_deg: [0, -35, 0], axis: [1, 0, 0], limits_m: [-1, 2], max_rate_mps: 1, max_effort_n: 100}
levers: [turn, slide]
shovels:
  scoop: {link: stick, profile_m: [[1.8, 0], [1.6, -0.2], [1.4, 0]], width_m: 0.5, capacity_m3: 0.05}
)";

constexpr double kInertialEffortMass_kg = 1.5;
/// Four such masses represent a link; no three of them are collinear.
const std::array<Vec3, 4> kPoints_B_m = {Vec3(0.3, 0.1, -0.2), Vec3(-0.4, 0.2, 0.1),
                                         Vec3(0.1, -0.5, 0.3), Vec3(0.6, 0.4, 0.2)};
constexpr double kSoil_kg = 9;
const Vec3 kSoil_B_m(1.6, 0.05, -0.1);

MachineModel Crane() {
  MachineModel model = MachineFromText(kCrane);
  for (Link& link : model.links) {
    link.com_B_m = Vec3::Zero();
    for (const Vec3& p : kPoints_B_m) link.com_B_m += p / 4;
    link.inertia_B_kgm2 = Mat3::Zero();
    for (const Vec3& p : kPoints_B_m) {
      const Vec3 r = p - link.com_B_m;
      link.inertia_B_kgm2 +=
          kInertialEffortMass_kg * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
  }
  return model;
}

/// Poses of all links at a time: base, mast and stick all move.
std::vector<Pose> PosesAt(const MachineModel& model, double t_s) {
  const Pose X_WB = MakePose(Vec3(5 + 2 * t_s, -3 + std::sin(3 * t_s), t_s * t_s),
                             0.2 * std::sin(2 * t_s), 0.3 * std::cos(t_s), 1.2 + 0.7 * t_s);
  const std::vector<double> q = {0.4 + 0.9 * std::sin(2 * t_s), 0, 0.5 + 0.6 * std::cos(3 * t_s)};
  return ForwardKinematics(model, X_WB, q);
}

constexpr double kNow_s = 0.37, kApart_s = 1e-4;

/// Second difference in time.
template <typename At>
Vec3 Acceleration(const At& at) {
  return (at(kNow_s + kApart_s) - 2 * at(kNow_s) + at(kNow_s - kApart_s)) / (kApart_s * kApart_s);
}

/// Angular velocity between two poses `apart_s` from each other.
Vec3 Turning_radps(const Pose& a, const Pose& b, double apart_s) {
  const Eigen::AngleAxisd turn(Mat3(b.linear() * a.linear().transpose()));
  return turn.angle() * turn.axis() / apart_s;
}

MachineState StateNow(const MachineModel& model) {
  MachineState state;
  const auto before = PosesAt(model, kNow_s - kApart_s), now = PosesAt(model, kNow_s),
             after = PosesAt(model, kNow_s + kApart_s);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    BodyState body;
    body.X_WB = now[i];
    body.v_WB_mps = (after[i].translation() - before[i].translation()) / (2 * kApart_s);
    body.a_WB_mps2 =
        Acceleration([&](double t_s) -> Vec3 { return PosesAt(model, t_s)[i].translation(); });
    const Vec3 early = Turning_radps(before[i], now[i], kApart_s),
               late = Turning_radps(now[i], after[i], kApart_s);
    body.w_WB_radps = 0.5 * (early + late);
    body.alpha_WB_radps2 = (late - early) / kApart_s;
    state.links.push_back(body);
  }
  state.shovel_load = {{.mass_kg = kSoil_kg, .com_B_m = kSoil_B_m, .volume_m3 = 0.01}};
  return state;
}

/// Change of momentum of the links `first` to the last, all their points and the soil, and of its
/// moment about `about_W_m`.
Wrench ChangeOfMomentum(const MachineModel& model, std::size_t first, const Vec3& about_W_m) {
  Wrench change;
  const auto add = [&](std::size_t link, const Vec3& p_B, double mass_kg) {
    const auto at = [&](double t_s) -> Vec3 { return PosesAt(model, t_s)[link] * p_B; };
    change.AddForceAt(mass_kg * Acceleration(at), at(kNow_s), about_W_m);
  };
  for (std::size_t i = first; i < model.links.size(); ++i) {
    for (const Vec3& p : kPoints_B_m) add(i, p, kInertialEffortMass_kg);
  }
  add(3, kSoil_B_m, kSoil_kg);
  return change;
}

TEST(InertialEfforts, AreTheChangeOfMomentumBeyondEachJoint) {
  const MachineModel model = Crane();
  const MachineState state = StateNow(model);
  InertialEfforts inertial(model);
  inertial.Update(state);

  const BodyState &mast = state.links[1], &stick = state.links[3];
  const Vec3 pin_W = mast.X_WB.translation();
  const double turn_nm =
      mast.X_WB.linear().col(2).dot(ChangeOfMomentum(model, 1, pin_W).torque_W_nm);
  const double slide_n =
      stick.X_WB.linear().col(0).dot(ChangeOfMomentum(model, 3, pin_W).force_W_n);
  ASSERT_GT(std::abs(turn_nm), 10);
  ASSERT_GT(std::abs(slide_n), 10);
  EXPECT_NEAR(inertial.joints_nm()[0], turn_nm, 1e-3);
  EXPECT_EQ(inertial.joints_nm()[1], 0);
  EXPECT_NEAR(inertial.joints_nm()[2], slide_n, 1e-3);

  const Wrench all = ChangeOfMomentum(model, 0, state.links[0].X_WB.translation());
  EXPECT_LT((inertial.machine().force_W_n - all.force_W_n).norm(), 1e-3);
  EXPECT_LT((inertial.machine().torque_W_nm - all.torque_W_nm).norm(), 1e-3);
}

TEST(InertialEfforts, AreAllThatADriveDoesWithoutWeightAndContact) {
  // Thrown through empty space with both drives active: only masses take their efforts. The step
  // takes velocities at its start or end, first order in its length.
  const MachineModel model = Crane();
  MachineRun run(model, MakePose(Vec3(4, -1, 2), 0.1, 0.2, 2.0), 0.0);
  run.input.levers = {1, -0.7};
  run.input.soil.shovel_load = {{.mass_kg = kSoil_kg, .com_B_m = kSoil_B_m, .volume_m3 = 1e-9}};
  run.input.soil.link_wrench[0].force_W_n = Vec3(300, -200, 100);
  run.StepFor(0.2);
  InertialEfforts inertial(model);
  for (int i = 0; i < 50; ++i) {
    run.Step();
    const MachineState& state = run.state();
    inertial.Update(state);
    for (const int joint : {0, 2}) {
      EXPECT_NEAR(inertial.joints_nm()[joint], state.effort_nm[joint], 2) << joint;
    }
    EXPECT_LT((inertial.machine().force_W_n - Vec3(300, -200, 100)).norm(), 6);
  }
}

}  // namespace
}  // namespace tera
