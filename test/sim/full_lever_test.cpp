#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "drive_fixture.h"

// A machine that is driven into the ground with all it has.

namespace tera {
namespace {

double KineticEnergy_j(const MachineModel& model, const MachineState& state) {
  double energy_j = 0;
  for (std::size_t k = 0; k < model.links.size(); ++k) {
    const Link& link = model.links[k];
    const BodyState& body = state.links[k];
    const Vec3 w_B_radps = body.X_WB.linear().transpose() * body.w_WB_radps;
    energy_j += 0.5 * link.mass_kg * PointVelocity(body, link.com_B_m).squaredNorm() +
                0.5 * w_B_radps.dot(link.inertia_B_kgm2 * w_B_radps);
  }
  return energy_j;
}

/// What joints and running gears have put in over a step, braking not counted back.
double WorkIn_j(const MachineState& state, double dt_s) {
  double power_w = 0;
  for (std::size_t k = 0; k < state.q_rad.size(); ++k) {
    power_w += std::max(0.0, state.effort_nm[k] * state.qd_radps[k]);
  }
  for (std::size_t k = 0; k < state.gear_rate_radps.size(); ++k) {
    power_w += std::max(0.0, state.gear_torque_nm[k] * state.gear_rate_radps[k]);
  }
  return power_w * dt_s;
}

/// All levers at one end or the other from some pose, for `duration_s`.
void DriveIntoTheGround(int trial, double duration_s) {
  const Stream random(17, "test/full_lever");
  const auto uniform = [&](int lane, double low, double high) {
    return low + (high - low) * random.Uniform(trial, lane);
  };
  const char* soils[] = {"dirt", "gravel", "sand", "wet_sand"};
  Drive drive(
      "tb235.yaml",
      fmt::format("{{xy_m: [{}, {}], yaw_deg: {}, joints_deg: {{slew: {}, boom: {}, arm: {}, "
                  "bucket: {}}}}}",
                  uniform(0, -3, 3), uniform(1, -3, 3), uniform(2, -180, 180),
                  uniform(3, -180, 180), uniform(4, 20, 70), uniform(5, -150, -40),
                  uniform(6, -100, 20)),
      fmt::format("cell_m: 0.1, soil: {}", soils[trial % 4]), 0, 0);
  drive.Operate([&](double) {
    NamedLevers levers;
    int lane = 10;
    for (const Lever& lever : drive.scenario.machines[0].placement.model.levers) {
      levers.emplace_back(lever.name, uniform(lane++, -1, 1) > 0 ? 1.0 : -1.0);
    }
    return levers;
  });
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const double weight_n = model.TotalMass_kg() * kStandardGravity_mps2;
  const double dt_s = 1.0 / drive.scenario.physics_rate_hz;
  const double start_m = drive.CentreOfMass().z();
  double work_j = KineticEnergy_j(model, drive.machine()), worst_j = -1e9;
  drive.Run(duration_s, [&] {
    const MachineState& state = drive.machine();
    ASSERT_TRUE(drive.place().allFinite()) << "trial " << trial;
    work_j += WorkIn_j(state, dt_s);
    const double height_j = weight_n * (drive.CentreOfMass().z() - start_m);
    worst_j = std::max(worst_j, KineticEnergy_j(model, state) + height_j - work_j);
    for (std::size_t k = 0; k < state.qd_radps.size(); ++k) {
      const Joint& joint = model.joints[k];
      const double most_radps =
          std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps);
      ASSERT_LT(std::abs(state.qd_radps[k]), 1.5 * most_radps + 0.2)
          << "trial " << trial << ' ' << joint.name;
    }
    for (const BodyState& link : state.links) ASSERT_LT(link.v_WB_mps.norm(), 6) << trial;
  });
  // 100 J: the elastic ground gives back what it held at the start.
  EXPECT_LT(worst_j, 100) << "trial " << trial;
  const MassLedger ledger = drive.scenario.soil->ledger();
  EXPECT_LT(std::abs(ledger.total_kg()), 1e-9 * std::max(1.0, ledger.shifted_kg)) << trial;
}

TEST(FullLever, FromAHundredPosesNothingGainsMoreEnergyThanTheDrivesGive) {
  constexpr int kPoses = 100;
  for (int trial = 0; trial < kPoses; ++trial) {
    DriveIntoTheGround(trial, 1.5);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(FullLever, TheBoomPressedDownLiftsTheMachineOrStalls) {
  for (const double bucket_deg : {-90.0, -40.0, 0.0}) {
    Drive drive(
        "tb235.yaml",
        fmt::format("{{xy_m: [1, 2], yaw_deg: 30, joints_deg: {{boom: 20, arm: -70, bucket: "
                    "{}}}}}",
                    bucket_deg),
        "cell_m: 0.1, soil: dirt", 0, 0);
    drive.Operate([](double) { return NamedLevers{{"boom", -1.0}}; });
    const auto tilt_rad = [&] {
      return std::acos(std::min(1.0, drive.body().X_WB.linear()(2, 2)));
    };
    double lifted_rad = 0;
    drive.Run(4.0, [&] { lifted_rad = std::max(lifted_rad, tilt_rad()); });
    const int boom = drive.scenario.machines[0].placement.model.JointIndex("boom");
    const double rate_radps = drive.machine().qd_radps[boom];
    EXPECT_TRUE(lifted_rad > 2 * kDeg || std::abs(rate_radps) < 1 * kDeg)
        << bucket_deg << ": tilt " << lifted_rad / kDeg << ", rate " << rate_radps / kDeg;
    EXPECT_LT(lifted_rad, 40 * kDeg) << bucket_deg;
  }
}

}  // namespace
}  // namespace tera
