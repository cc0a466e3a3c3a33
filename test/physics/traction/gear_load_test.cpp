#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/actuation/actuation_faults.h"
#include "physics/machine_fixture.h"

/// Load of tracks on pumps and drives, for every ground model.

namespace tera {
namespace {

/// 1000 kg on two tracks, its contact at the height of its centre of mass, so that nothing pitches.
const std::string kCrawler = R"(
kind: crawler
links:
  chassis: {mass_kg: 1000, com_m: [0.2, 0, 0], inertia_kgm2: [300, 500, 600]}
gauge_m: 1.2
tracks:
  left: {link: chassis, center_m: [0, 0.6, 0.3], wheelbase_m: 2, radius_m: 0.3, width_m: 0.3, max_speed_mps: 1, max_torque_nm: 1000, inertia_kgm2: 25, displacement_m3prad: 1.0e-4}
  right: {link: chassis, center_m: [0, -0.6, 0.3], wheelbase_m: 2, radius_m: 0.3, width_m: 0.3, max_speed_mps: 1, max_torque_nm: 1000, inertia_kgm2: 25, displacement_m3prad: 1.0e-4}
levers: [left, right]
pumps: {main: {max_flow_m3ps: 1.0e-3, feeds: [left, right]}}
)";

constexpr double kRadius_m = 0.3, kGauge_m = 1.2;
constexpr double kFullRate_radps = 1 / kRadius_m;

constexpr GroundModel kGrounds[] = {GroundModel::kTerramechanics, GroundModel::kIdeal,
                                    GroundModel::kKinematic};

/// Resistance to the machine in its root's frame: a force, as of a slope, and a torque.
struct Resistance {
  double force_n = 0, torque_nm = 0;
};

/// The crawler on weightless ground. The terramechanic soil is a damper between shoes and ground,
/// as steep as soils are: 2 % of slip at full speed is 1000 N.
class CrawlerRun {
 public:
  CrawlerRun(const std::string& effects, GroundModel ground, const Resistance& resistance)
      : ground_(ground),
        resistance_(resistance),
        run_(Model(effects, ground), MakePose(Vec3(3, -2, 0), 0, 0, 40 * kDeg), 0.0) {
    if (ground == GroundModel::kTerramechanics) {
      run_.input.soil.gear_traction_n = {0, 0};
    } else {
      run_.input.soil.gear_grip_n = {kGrip_n, kGrip_n};
    }
  }

  static MachineModel Model(const std::string& effects, GroundModel ground) {
    MachineModel model = WithEffects(MachineFromText(kCrawler), effects);
    model.ground = ground;
    return model;
  }

  void Step() {
    const BodyState& base = run_.state().links[0];
    const Mat3 R_WB = base.X_WB.linear();
    Wrench& wrench = run_.input.soil.link_wrench[0];
    wrench.force_W_n = R_WB * Vec3(-resistance_.force_n, 0, 0);
    wrench.torque_W_nm = R_WB * Vec3(0, 0, -resistance_.torque_nm);
    if (ground_ == GroundModel::kTerramechanics) Pull(base, &wrench);
    run_.Step();
  }

  void StepFor(double duration_s) {
    for (int i = 0; i < std::lround(duration_s / kStep_s); ++i) Step();
  }

  void SetLevers(double left, double right) { run_.input.levers = {left, right}; }
  const MachineState& state() const { return run_.state(); }

 private:
  static constexpr double kGrip_n = 20e3, kDamping_nspm = 5e4;

  /// The soil pulls both tracks.
  void Pull(const BodyState& base, Wrench* wrench) {
    for (int gear = 0; gear < 2; ++gear) {
      const Vec3 p_B(0, (gear == 0 ? 0.5 : -0.5) * kGauge_m, 0);
      const Vec3 forward_W = base.X_WB.linear().col(0);
      const double slip_mps =
          kRadius_m * run_.state().gear_rate_radps[gear] - forward_W.dot(PointVelocity(base, p_B));
      const double traction_n = std::clamp(kDamping_nspm * slip_mps, -kGrip_n, kGrip_n);
      run_.input.soil.gear_traction_n[gear] = traction_n;
      wrench->AddForceAt(traction_n * forward_W, base.X_WB * p_B, base.X_WB.translation());
    }
  }

  GroundModel ground_;
  Resistance resistance_;
  MachineRun run_;
};

/// Levers of the left and right track, against 1000 N on each.
struct Travel {
  double left, right;
  Resistance resistance;
};
constexpr Travel kTravels[] = {{1, 1, {2000, 0}}, {-1, 1, {0, 1000 * kGauge_m}}};
constexpr double kLoad_nm = 1000 * kRadius_m;

/// From half a second on, for another half, both tracks turn at `expected_radps` in every step.
void ExpectSteady(const std::string& effects, double expected_radps) {
  for (const GroundModel ground : kGrounds) {
    for (const Travel& travel : kTravels) {
      CrawlerRun run(effects, ground, travel.resistance);
      run.SetLevers(travel.left, travel.right);
      run.StepFor(0.7);
      double worst_radps = 0;
      for (int i = 0; i < 250; ++i) {
        run.Step();
        const std::vector<double>& rate = run.state().gear_rate_radps;
        worst_radps = std::max({worst_radps, std::abs(rate[0] - travel.left * expected_radps),
                                std::abs(rate[1] - travel.right * expected_radps)});
      }
      EXPECT_LT(worst_radps, 0.01 * expected_radps)
          << effects << " ground " << static_cast<int>(ground) << " left " << travel.left;
    }
  }
}

TEST(GearLoad, DroopSettlesOnTheOrificeLawAtItsQuickestToo) {
  for (const char* response_s : {"0", "0.002", "0.05"}) {
    const std::string droop =
        fmt::format("{{pressure_droop: {{stall_nm: 1000, response_s: {}}}}}", response_s);
    ExpectSteady("{left: " + droop + ", right: " + droop + "}",
                 kFullRate_radps * std::sqrt(1 - kLoad_nm / 1000));
  }
}

TEST(GearLoad, APumpsPowerSettlesOnItsLimitAtItsQuickestToo) {
  for (const char* regulator_s : {"0", "0.002", "0.05"}) {
    ExpectSteady(
        fmt::format("main: {{power_limit: {{power_w: 1000, regulator_s: {}}}}}", regulator_s),
        1000 / (2 * kLoad_nm));
  }
}

TEST(GearLoad, ALeakLetsTracksYieldToASlope) {
  const std::string sag = "{sag: {drift_radps: 0.15}}";
  for (const GroundModel ground : kGrounds) {
    CrawlerRun run("{left: " + sag + ", right: " + sag + "}", ground, {2000, 0});
    run.StepFor(0.5);
    for (int i = 0; i < 100; ++i) {
      run.Step();
      ASSERT_NEAR(run.state().gear_rate_radps[0], -0.15 * kLoad_nm / 1000, 1e-3)
          << static_cast<int>(ground);
    }
  }
}

/// The mechanism with every parameter at its lower or at its upper bound.
std::string AtBound(const Mechanism& mechanism, bool upper) {
  std::string text = std::string(mechanism.id) + ": {";
  for (const EffectParameter& parameter : mechanism.parameters) {
    text += fmt::format("{}: {}, ", parameter.name, upper ? parameter.upper : parameter.lower);
  }
  return "{" + text + "}}";
}

bool ReadsLoad(const Mechanism& mechanism) {
  return mechanism.id == "pressure_droop" || mechanism.id == "sag" || mechanism.id == "power_limit";
}

/// Drives back and forth. Counts steps in which a track's rate reverses its change by more than 1 %
/// of the full rate.
int Reversals(const std::string& effects, GroundModel ground) {
  CrawlerRun run(effects, ground, {2000, 0});
  int reversals = 0;
  double before_radps = 0, last_change = 0;
  for (int i = 0; i < 1500; ++i) {
    const double lever = std::sin(i * kStep_s * 2) > 0 ? 1 : -1;
    run.SetLevers(lever, lever);
    run.Step();
    const MachineState& state = run.state();
    const double rate = state.gear_rate_radps[0];
    EXPECT_TRUE(std::isfinite(rate) && std::isfinite(state.gear_torque_nm[0]) &&
                state.links[0].X_WB.translation().allFinite())
        << effects;
    EXPECT_LE(state.gear_friction_nm[0] * rate, 1e-6) << effects;
    if (ground == GroundModel::kTerramechanics) {
      EXPECT_LE(std::abs(state.gear_torque_nm[0]), 1000 + 1e-6) << effects;
    }
    const double change = rate - before_radps, least = 0.01 * kFullRate_radps;
    reversals +=
        std::abs(change) > least && std::abs(last_change) > least && change * last_change < 0;
    before_radps = rate;
    last_change = change;
  }
  return reversals;
}

TEST(GearLoad, EveryMechanismAtItsBoundsKeepsTracksWithinTheirLimits) {
  for (const Mechanism& mechanism : ActuationMechanisms()) {
    const bool pump = mechanism.ActsOn(EffectTarget::kPump);
    if (!pump && !mechanism.ActsOn(EffectTarget::kGear)) continue;
    for (const bool upper : {false, true}) {
      const std::string effect = AtBound(mechanism, upper);
      const std::string effects =
          pump ? "main: " + effect : "{left: " + effect + ", right: " + effect + "}";
      for (const GroundModel ground : kGrounds) {
        const MachineModel model = CrawlerRun::Model(effects, ground);
        const bool refused = !FaultsOfGear(model, 0).empty() || !FaultsOfPump(model, 0).empty();
        // At their upper bounds these cancel all levers.
        const bool leaves_nothing = mechanism.id == "dead_band" || mechanism.id == "drive_friction";
        ASSERT_EQ(refused, leaves_nothing && upper) << effect;
        if (refused) continue;
        const int reversals = Reversals(effects, ground);
        // The lever reverses twice in this time.
        if (ReadsLoad(mechanism)) {
          EXPECT_LE(reversals, 4) << effect << " ground " << static_cast<int>(ground);
        }
      }
    }
  }
}

}  // namespace
}  // namespace tera
