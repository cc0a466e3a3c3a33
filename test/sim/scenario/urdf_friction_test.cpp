#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>

#include "own_folder.h"
#include "physics/machine_fixture.h"
#include "sim/scenario/scenario.h"

// <dynamics> of a URDF's joints: damping and friction as effects of the machine.

namespace tera {
namespace {

using testing::HasSubstr;

/// A bar of 4 kg that hangs from a pin 0.6 m above its centre: 1.92 kg m2 about the pin.
std::string Pendulum(const std::string& dynamics, const std::string& type = "continuous",
                     const std::string& axis = "0 1 0") {
  return R"(<robot name="pendulum">
  <link name="post"/>
  <link name="bar"><inertial><origin xyz="0 0 -0.6"/><mass value="4"/>
    <inertia ixx="0.48" iyy="0.48" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="pin" type=")" +
         type + R"("><parent link="post"/><child link="bar"/><origin xyz="0.1 0.2 2"/>
    <axis xyz=")" +
         axis + R"("/><limit lower="-9" upper="9" effort="0" velocity="0"/>)" + dynamics +
         "</joint></robot>";
}

struct FrictionRead {
  Scenario scenario;
  std::string resolved;
};

FrictionRead ReadText(const std::string& text) {
  const Config config = Config::FromText(text, "s.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return {std::move(scenario), config.ResolvedYaml()};
}

/// A scenario with the URDF on a post and `effects` of its machine.
FrictionRead WithUrdf(const std::string& urdf, const std::string& effects,
                      const std::string& start = "initial_deg: 6") {
  const std::string name = std::to_string(std::hash<std::string>{}(urdf)) + ".urdf";
  const std::string file = OwnFolder() / name;
  std::ofstream(file) << urdf;
  return ReadText(R"(
name: test
duration_s: 1
terrain: {size_m: [12, 12], cell_m: 0.2, soil: dirt}
effects: {p: )" + effects +
                  R"(}
machines:
  - name: p
    machine: {kind: pendulum, fixed_base: true, urdf: ')" +
                  file + "', joints: {pin: {" + start + R"(}}}
    operator: {type: idle}
)");
}

/// Position of the pin at every tenth of a second.
std::vector<double> Motion(const Scenario& scenario, double duration_s = 6) {
  MachineRun run(scenario.machines[0].placement);
  std::vector<double> q_rad;
  for (int i = 0; i < std::lround(duration_s / 0.1); ++i) {
    run.StepFor(0.1);
    q_rad.push_back(run.state().q_rad[0]);
  }
  return q_rad;
}

TEST(UrdfFriction, DampingTakesTheSwingAwayByItsLaw) {
  const double c_nmsprad = 1.536, inertia_kgm2 = 1.92, start_rad = 6 * kDeg;
  const auto q_rad = Motion(WithUrdf(Pendulum(R"(<dynamics damping="1.536"/>)"), "{}").scenario);
  // I q'' + c q' + m g l q = 0 from rest.
  const double decay_1ps = c_nmsprad / (2 * inertia_kgm2);
  const double turn_radps =
      std::sqrt(4 * kGravity_mps2 * 0.6 / inertia_kgm2 - decay_1ps * decay_1ps);
  for (std::size_t i = 0; i < q_rad.size(); ++i) {
    const double t_s = 0.1 * static_cast<double>(i + 1);
    const double expected =
        start_rad * std::exp(-decay_1ps * t_s) *
        (std::cos(turn_radps * t_s) + decay_1ps / turn_radps * std::sin(turn_radps * t_s));
    EXPECT_NEAR(q_rad[i], expected, 0.02 * start_rad) << t_s;
  }
}

TEST(UrdfFriction, DryFrictionHoldsTheBar) {
  // At 6 deg its weight turns it by 4 * 9.81 * 0.6 * sin(6 deg) = 2.46 N m.
  const auto held = Motion(WithUrdf(Pendulum(R"(<dynamics friction="2.6"/>)"), "{}").scenario, 1);
  for (const double q_rad : held) EXPECT_NEAR(q_rad, 6 * kDeg, 1e-4);
  const auto slips = Motion(WithUrdf(Pendulum(R"(<dynamics friction="2.3"/>)"), "{}").scenario, 1);
  EXPECT_LT(slips.back(), 5.8 * kDeg);
}

TEST(UrdfFriction, OfAJointThatSlidesIsInNewtons) {
  // It falls along the pin's axis until 80 N s/m and 7.24 N bear its weight of 39.24 N: 0.4 m/s.
  const auto q_m =
      Motion(WithUrdf(Pendulum(R"(<dynamics damping="80" friction="7.24"/>)", "prismatic", "0 0 1"),
                      "{}", "initial_m: 5")
                 .scenario,
             2);
  EXPECT_NEAR((q_m[9] - q_m[19]) / 1.0, 0.4, 1e-3);
}

TEST(UrdfFriction, IsTheEffectOfThatName) {
  const std::string both =
      "{pin: {viscous_friction: {coefficient_nmsprad: 0.9}, "
      "coulomb_friction: {effort_nm: 0.2}}}";
  const FrictionRead urdf = WithUrdf(Pendulum(R"(<dynamics damping="0.9" friction="0.2"/>)"), "{}");
  const auto q_rad = Motion(urdf.scenario);
  EXPECT_EQ(q_rad, Motion(WithUrdf(Pendulum(""), both).scenario));
  EXPECT_NE(q_rad, Motion(WithUrdf(Pendulum(""), "{}").scenario));
  EXPECT_EQ(q_rad, Motion(ReadText(urdf.resolved).scenario));
}

TEST(UrdfFriction, EffectsLieOverIt) {
  const std::string damped = Pendulum(R"(<dynamics damping="0.9"/>)");
  const FrictionRead more = WithUrdf(damped, "{pin: {viscous_friction: {coefficient_nmsprad: 3}}}");
  const auto q_rad = Motion(more.scenario);
  EXPECT_EQ(q_rad, Motion(WithUrdf(Pendulum(R"(<dynamics damping="3"/>)"), "{}").scenario));
  EXPECT_EQ(q_rad, Motion(ReadText(more.resolved).scenario));
  // The coefficient stays if only the oil's temperature is given.
  const auto warm = Motion(WithUrdf(damped, "{pin: {viscous_friction: {oil_degc: 80}}}").scenario);
  const auto own = Motion(WithUrdf(Pendulum(""),
                                   "{pin: {viscous_friction: {coefficient_nmsprad: 0.9, oil_degc: "
                                   "80}}}")
                              .scenario);
  EXPECT_EQ(warm, own);
}

TEST(UrdfFriction, NoneTakesItAwayAlsoWhenTheRunIsRepeated) {
  const FrictionRead taken = WithUrdf(Pendulum(R"(<dynamics damping="0.9" friction="0.2"/>)"),
                                      "{pin: {viscous_friction: none, coulomb_friction: none}}");
  const auto q_rad = Motion(taken.scenario);
  EXPECT_EQ(q_rad, Motion(WithUrdf(Pendulum(""), "{}").scenario));
  EXPECT_EQ(q_rad, Motion(ReadText(taken.resolved).scenario));
}

TEST(UrdfFriction, FaultsOfEffectsStandWhereTheyAreWritten) {
  try {
    WithUrdf(Pendulum(R"(<dynamics damping="0.9"/>)"), "{pin: {viscous_fricton: {}}}");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("s.yaml:5:"));
    EXPECT_THAT(e.what(), testing::Not(HasSubstr("\n")));
  }
}

}  // namespace
}  // namespace tera
