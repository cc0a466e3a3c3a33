#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>

#include "core/units.h"
#include "dig_site.h"
#include "mujoco_model.h"
#include "physics/dynamics/physics_world.h"
#include "verdict.h"

// A machine without soil: levers, actuators, bodies. MuJoCo steps the same tree beside it.

namespace tera::bench {
namespace {

/// Share of full lever or rate at which every joint oscillates.
constexpr double kSway = 0.6;
/// Steps that go by turns to the one and the other.
constexpr int kTurn_steps = 100;

/// A spring and a damper that hold a machine up where the ground would.
Wrench Hold(const Pose& X_WB, const Vec3& v_WB_mps, const Vec3& w_WB_radps, const Pose& X_WB_held,
            double mass_kg) {
  constexpr double kStiffness_1ps2 = 400, kDamping_1ps = 30;  // per kilogram, and square metre
  const Eigen::AngleAxisd turn(X_WB_held.linear() * X_WB.linear().transpose());
  Wrench wrench;
  wrench.force_W_n = mass_kg * (Vec3(0, 0, kStandardGravity_mps2) +
                                kStiffness_1ps2 * (X_WB_held.translation() - X_WB.translation()) -
                                kDamping_1ps * v_WB_mps);
  wrench.torque_W_nm =
      mass_kg * (kStiffness_1ps2 * turn.angle() * turn.axis() - kDamping_1ps * w_WB_radps);
  return wrench;
}

/// The excavator in TERA, all levers swaying.
class InTera {
 public:
  InTera(const MachinePlacement& machine, double dt_s)
      : world_({machine}, {}, kStandardGravity_mps2),
        X_WB_(world_.machines()[0].links[0].X_WB),
        mass_kg_(machine.model.TotalMass_kg()),
        dt_s_(dt_s) {
    const GroundTools& tools = machine.model.ground_tools;
    MachineInput& input = inputs_.emplace_back();
    input.levers.resize(machine.model.levers.size());
    input.soil.link_wrench.resize(machine.model.links.size());
    input.soil.gear_traction_n.assign(tools.gears.size(), 0.0);
    input.soil.shovel_load.resize(tools.shovels.size());
    input.soil.gear_sinkage_m = input.soil.gear_slip = input.soil.gear_traction_n;
  }

  void Step(double sway) {
    const BodyState& base = world_.machines()[0].links[0];
    MachineInput& input = inputs_[0];
    input.soil.link_wrench[0] = Hold(base.X_WB, base.v_WB_mps, base.w_WB_radps, X_WB_, mass_kg_);
    std::fill(input.levers.begin(), input.levers.end(), sway);
    world_.Step(inputs_, {}, dt_s_);
  }

  const MachineState& state() const { return world_.machines()[0]; }

 private:
  PhysicsWorld world_;
  Pose X_WB_;
  double mass_kg_, dt_s_;
  std::vector<MachineInput> inputs_;
};

/// The same excavator in MuJoCo.
class InMujocoWorld {
 public:
  InMujocoWorld(const MachinePlacement& machine, double dt_s)
      : model_(InMujoco(machine.model, dt_s)),
        data_(mj_makeData(model_.get())),
        X_WB_(machine.X_WB),
        mass_kg_(machine.model.TotalMass_kg()) {
    const Vec3 p = X_WB_.translation();
    const Eigen::Quaterniond q(X_WB_.linear());
    const double base[7] = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
    std::copy(base, base + 7, data_->qpos);
    int at = 7;
    for (std::size_t j = 0; j < machine.model.joints.size(); ++j) {
      const Joint& joint = machine.model.joints[j];
      if (joint.type == JointType::kFixed) continue;
      data_->qpos[at++] = machine.q_rad[j];
      full_radps_.push_back(joint.max_rate_positive_radps);
    }
  }

  void Step(double sway) {
    const double* x = data_->qpos;
    const double* v = data_->qvel;  // linear in W, angular in the body
    const Mat3 R_WB = Eigen::Quaterniond(x[3], x[4], x[5], x[6]).toRotationMatrix();
    const Pose X_WB = MakePose(Vec3(x[0], x[1], x[2]), R_WB);
    const Wrench wrench =
        Hold(X_WB, Vec3(v[0], v[1], v[2]), R_WB * Vec3(v[3], v[4], v[5]), X_WB_, mass_kg_);
    // MuJoCo takes the force at the body's centre of mass.
    double* applied = data_->xfrc_applied + 6;
    const double* com = data_->xipos + 3;
    const Vec3 r_W = Vec3(com[0], com[1], com[2]) - X_WB.translation();
    const Vec3 torque_W_nm = wrench.torque_W_nm - r_W.cross(wrench.force_W_n);
    for (int i = 0; i < 3; ++i) {
      applied[i] = wrench.force_W_n[i];
      applied[3 + i] = torque_W_nm[i];
    }
    for (std::size_t a = 0; a < full_radps_.size(); ++a) data_->ctrl[a] = sway * full_radps_[a];
    mj_step(model_.get(), data_.get());
  }

  double z_m() const { return data_->qpos[2]; }

 private:
  MujocoModel model_;
  MujocoData data_;
  Pose X_WB_;
  double mass_kg_;
  std::vector<double> full_radps_;
};

/// Processor time that this program has taken: other programs on the machine do not count.
double Processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// One iteration is a turn of TERA's, whose processor time counts, and one of MuJoCo's.
void PhysicsSteps(benchmark::State& state) {
  const ShippedScenario loaded = Load("quickstart");
  const MachinePlacement& excavator = loaded.scenario.machines.front().placement;
  const double dt_s = 1.0 / loaded.scenario.physics_rate_hz;
  InTera tera(excavator, dt_s);
  InMujocoWorld mujoco(excavator, dt_s);
  double tera_s = 0, mujoco_s = 0;
  std::int64_t turn = 0;
  for (auto _ : state) {
    const auto sway = [&](int k) {
      return kSway * std::sin(static_cast<double>(turn * kTurn_steps + k) * dt_s);
    };
    const double start_s = Processor_s();
    for (int k = 0; k < kTurn_steps; ++k) tera.Step(sway(k));
    const double middle_s = Processor_s();
    for (int k = 0; k < kTurn_steps; ++k) mujoco.Step(sway(k));
    mujoco_s += Processor_s() - middle_s;
    tera_s += middle_s - start_s;
    state.SetIterationTime(middle_s - start_s);
    ++turn;
  }
  const double steps = static_cast<double>(turn * kTurn_steps);
  state.counters["step_us"] = 1e6 * tera_s / steps;
  state.counters["mujoco_us"] = 1e6 * mujoco_s / steps;
  state.counters["of_mujoco"] = tera_s / mujoco_s;
  state.counters["z_m"] = tera.state().links[0].X_WB.translation().z();
  state.counters["mujoco_z_m"] = mujoco.z_m();
  ExpectAtLeast({"real time", 150, " x"}, steps * dt_s / tera_s, &state);
}
BENCHMARK(PhysicsSteps)->Iterations(2000)->UseManualTime()->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tera::bench
