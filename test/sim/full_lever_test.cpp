#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/random.h"
#include "drive_fixture.h"
#include "kinetic_energy.h"
#include "sim/operators/planar_arm.h"

/// A compact excavator that drives its bucket into the ground at full levers.

namespace tera {
namespace {

/// Work of joints and running gears over a step, without energy recovered by braking.
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

MachineModel Excavator() {
  const Config config = Config::FromFile(DataRoot() / "config/machines/tb235.yaml");
  return ReadMachine(config.root());
}

int TipFrame(const MachineModel& model) {
  int frame = 0;
  while (model.frames.at(frame).name != "bucket_tip") ++frame;
  return frame;
}

/// Joint angles with the bucket's edge slightly above level ground, teeth downwards, at random
/// reach and pitch. A falling boom thus drives in the edge, not the back.
std::string PoseAboveTheGround(const MachineModel& model, const Stream& random, int trial) {
  const PlanarArm::Joints joints{model.JointIndex("slew"), model.JointIndex("boom"),
                                 model.JointIndex("arm"), model.JointIndex("bucket")};
  const PlanarArm arm(model, joints, TipFrame(model));
  constexpr double kSlewFrame_m = 0.6, kAboveGround_m = 0.15;  // about
  constexpr double kDown_rad = 90 * kDeg, kSpread_rad = 60 * kDeg;
  const auto is_within = [&](int joint, double q_rad) {
    return q_rad > model.joints[joint].lower_rad && q_rad < model.joints[joint].upper_rad;
  };
  for (std::uint32_t lane = 100;; lane += 2) {
    const PlanarArm::Tip tip{2.0 + 2.5 * random.Uniform(trial, lane), kAboveGround_m - kSlewFrame_m,
                             -kDown_rad + kSpread_rad * (2 * random.Uniform(trial, lane + 1) - 1)};
    const std::optional<PlanarArm::Angles> angles = arm.Inverse(tip);
    if (!angles || !is_within(joints.boom, angles->boom_rad) ||
        !is_within(joints.arm, angles->arm_rad) || !is_within(joints.bucket, angles->bucket_rad)) {
      continue;
    }
    return fmt::format("slew: {}, boom: {}, arm: {}, bucket: {}",
                       360 * random.Uniform(trial, 3) - 180, angles->boom_rad / kDeg,
                       angles->arm_rad / kDeg, angles->bucket_rad / kDeg);
  }
}

struct Outcome {
  bool is_finite = true;
  double most_gained_j = -1e9;  ///< kinetic and potential energy beyond the work of the drives
  double fastest_link_mps = 0;
  double lifted_m = 0;    ///< highest rise of a corner of the undercarriage
  double boom_share = 0;  ///< of its greatest rate, mean over the last quarter second
  double deepest_tip_m = 0;
  double last_tip_m = 0;  ///< depth at the end
  double lost_share = 0;  ///< of the soil shifted
};

/// Resistance of the ground to a boom that descends at full lever.
enum class FullLeverWay { kLiftsTheMachine, kStallsTheBoom, kThrowsTheBucketOut, kDoesNot };

FullLeverWay HowItEnds(const Outcome& outcome) {
  if (outcome.lifted_m > 0.05) return FullLeverWay::kLiftsTheMachine;
  if (outcome.boom_share < 0.1) return FullLeverWay::kStallsTheBoom;
  // Arm and bucket withdraw the edge while the boom continues down.
  if (outcome.last_tip_m < outcome.deepest_tip_m - 0.05) return FullLeverWay::kThrowsTheBucketOut;
  return FullLeverWay::kDoesNot;
}

/// Boom down at full lever, every other lever at an end or neutral.
Outcome DriveIntoTheGround(const MachineModel& model, const std::string& soil, int trial) {
  const Stream random(17, "test/full_lever");
  const auto uniform = [&](int lane, double low, double high) {
    return low + (high - low) * random.Uniform(trial, lane);
  };
  Drive drive("tb235.yaml",
              fmt::format("{{xy_m: [{}, {}], yaw_deg: {}, joints_deg: {{{}}}}}", uniform(0, -3, 3),
                          uniform(1, -3, 3), uniform(2, -180, 180),
                          PoseAboveTheGround(model, random, trial)),
              "cell_m: 0.1, soil: " + soil, 0, 0, "settle_s: 0.3\n");
  drive.Operate([&](double) {
    NamedLevers levers;
    for (std::size_t k = 0; k < model.levers.size(); ++k) {
      const double third = uniform(10 + static_cast<int>(k), 0, 3);
      const double position = third < 1 ? -1 : third < 2 ? 0 : 1;
      levers.emplace_back(model.levers[k].name, model.levers[k].name == "boom" ? -1 : position);
    }
    return levers;
  });
  constexpr double kLength_s = 2.0, kEnd_s = 0.25;
  const int boom = model.JointIndex("boom");
  const NamedFrame& tip = model.frames[TipFrame(model)];
  const double weight_n = model.TotalMass_kg() * kStandardGravity_mps2;
  const double dt_s = 1.0 / drive.scenario.physics_rate_hz;
  const std::array<Vec3, 4> corners_B_m{Vec3(-1, -0.7, 0), Vec3(-1, 0.7, 0), Vec3(1, -0.7, 0),
                                        Vec3(1, 0.7, 0)};
  std::array<double, 4> lowest_m;
  lowest_m.fill(std::numeric_limits<double>::infinity());
  const double start_m = drive.CentreOfMass().z();
  double given_j = KineticEnergy_j(model, drive.machine());
  Outcome outcome;
  drive.Run(kLength_s, [&] {
    const MachineState& state = drive.machine();
    outcome.is_finite =
        outcome.is_finite && drive.place().allFinite() && drive.body().v_WB_mps.allFinite();
    given_j += WorkIn_j(state, dt_s);
    const double held_j =
        KineticEnergy_j(model, state) + weight_n * (drive.CentreOfMass().z() - start_m);
    outcome.most_gained_j = std::max(outcome.most_gained_j, held_j - given_j);
    for (const BodyState& link : state.links) {
      outcome.fastest_link_mps = std::max(outcome.fastest_link_mps, link.v_WB_mps.norm());
    }
    for (std::size_t k = 0; k < lowest_m.size(); ++k) {
      // In soft ground a corner sinks first.
      const double height_m = (drive.body().X_WB * corners_B_m[k]).z();
      lowest_m[k] = std::min(lowest_m[k], height_m);
      outcome.lifted_m = std::max(outcome.lifted_m, height_m - lowest_m[k]);
    }
    const Vec3 tip_m = state.links[tip.link].X_WB * tip.X_BF.translation();
    outcome.last_tip_m = -tip_m.z();
    outcome.deepest_tip_m = std::max(outcome.deepest_tip_m, outcome.last_tip_m);
    if (ToSeconds(drive.simulation->state().t_ns) > kLength_s - kEnd_s) {
      outcome.boom_share +=
          -state.qd_radps[boom] / model.joints[boom].max_rate_negative_radps * dt_s / kEnd_s;
    }
  });
  const MassLedger ledger = drive.simulation->state().ground().ledger();
  outcome.lost_share = std::abs(ledger.total_kg()) / std::max(1.0, ledger.shifted_kg);
  return outcome;
}

class FullLever : public testing::TestWithParam<std::string> {};

TEST_P(FullLever, OfAHundredEdgesDrivenIntoTheGroundEachLiftsTheMachineOrStallsAndNoneExplodes) {
  const MachineModel model = Excavator();
  int with_the_edge = 0, trial = 0;  // the others press with the bucket's back
  double deepest_m = 0, most_gained_j = 0;
  std::array<int, 4> ways{};
  for (; with_the_edge < 100 && trial < 200; ++trial) {
    const Outcome outcome = DriveIntoTheGround(model, GetParam(), trial);
    EXPECT_TRUE(outcome.is_finite) << trial;
    deepest_m = std::max(deepest_m, outcome.deepest_tip_m);
    most_gained_j = std::max(most_gained_j, outcome.most_gained_j);
    const FullLeverWay way = HowItEnds(outcome);
    EXPECT_NE(way, FullLeverWay::kDoesNot)
        << trial << ": " << outcome.deepest_tip_m << " m deep, at last " << outcome.last_tip_m
        << " m, lifted " << outcome.lifted_m << " m, at " << outcome.boom_share
        << " of the boom's rate";
    if (outcome.deepest_tip_m > 0.05) {
      ++with_the_edge;
      ++ways[static_cast<int>(way)];
    }
    EXPECT_LT(outcome.deepest_tip_m, 1.3) << trial;
    // The elastic ground returns its initial energy.
    EXPECT_LT(outcome.most_gained_j, 100) << trial;
    EXPECT_LT(outcome.fastest_link_mps, 6) << trial;
    EXPECT_LT(outcome.lost_share, 1e-9) << trial;
  }
  EXPECT_EQ(with_the_edge, 100) << "of " << trial;
  EXPECT_LE(ways[static_cast<int>(FullLeverWay::kThrowsTheBucketOut)], 3);
  const auto record = [](const char* what, auto value) {
    RecordProperty(what, fmt::format("{:.3g}", static_cast<double>(value)));
  };
  record("poses", trial);
  record("edge_in_the_ground", with_the_edge);
  record("lifts_the_machine", ways[static_cast<int>(FullLeverWay::kLiftsTheMachine)]);
  record("stalls_the_boom", ways[static_cast<int>(FullLeverWay::kStallsTheBoom)]);
  record("throws_the_bucket_out", ways[static_cast<int>(FullLeverWay::kThrowsTheBucketOut)]);
  record("deepest_m", deepest_m);
  record("most_gained_j", most_gained_j);
}

INSTANTIATE_TEST_SUITE_P(Soils, FullLever, testing::Values("sand", "dirt", "gravel", "clay"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace tera
