#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "core/random.h"
#include "core/units.h"
#include "diagnose/blocks/axis_block.h"
#include "diagnose/diagnose_blocks.h"
#include "diagnose/tolerances/within_tolerance.h"
#include "physics/actuation/actuation.h"
#include "physics/actuation/actuation_mechanisms.h"
#include "physics/machine_fixture.h"

// Whole valves: several strong causes at once in one joint, as in hydraulic machines, under steps
// and a ladder of steps of its lever alone.

namespace tera {
namespace {

using ::testing::IsEmpty;

constexpr double kPlantStep_s = 0.002;
constexpr int kStepsPerSample = 5;
constexpr double kNoise_radps = 0.003;

using Numbers = std::map<std::string, std::vector<double>>;

/// An operator who moves a lever in steps of irregular length with rests, towards the middle of the
/// joint's range. The number of sizes is odd, so that each occurs in both directions.
class Stepper {
 public:
  double At(double t_s, double beyond_middle_rad) {
    if (t_s >= end_s_) {
      const std::array sizes = {0.2, 0.3, 0.4,  0.5,  0.6,  0.7, 0.8,
                                0.9, 1.0, 0.35, 0.55, 0.75, 0.95};
      lever_ = (beyond_middle_rad < 0 ? 1 : -1) * sizes[turn_ % sizes.size()];
      push_s_ = end_s_ + 0.6 + 0.4 * draw_.Uniform(2 * turn_);
      end_s_ = push_s_ + 0.8 + 0.7 * draw_.Uniform(2 * turn_ + 1);
      ++turn_;
    }
    return t_s < push_s_ ? 0 : lever_;
  }

 private:
  const Stream draw_ = Stream(5, "steps of a lever");
  std::size_t turn_ = 0;
  double lever_ = 0, push_s_ = 0, end_s_ = 0;
};

/// Friction of a joint that has a peak at one angle, as lost rate.
struct FrictionPeak {
  double loss_radps = 0, beyond_middle_rad = 0, half_width_rad = 1;

  double Left(double rate_radps, double beyond_rad) const {
    const double off = (beyond_rad - beyond_middle_rad) / half_width_rad;
    const double loss = loss_radps / (1 + off * off);
    return std::copysign(std::max(0.0, std::abs(rate_radps) - loss), rate_radps);
  }
};

/// The arm of the 3.5 t machine with some effects, under steps of its lever alone.
class SteppedArm {
 public:
  explicit SteppedArm(const Numbers& effects, double noise_radps = kNoise_radps,
                      FrictionPeak friction = {})
      : model_(ShippedMachine("tb235")),
        arm_(static_cast<std::size_t>(model_.JointIndex("arm"))),
        noise_radps_(noise_radps),
        friction_(friction) {
    MachineModel real = model_;
    real.effects.joints.resize(model_.joints.size());
    for (const auto& [id, values] : effects) {
      for (const Mechanism& one : ActuationMechanisms()) {
        if (one.id == id) real.effects.joints[arm_].push_back({&one, values});
      }
    }
    Record(real);
  }

  BlockDiagnosis Diagnose() {
    const AxisLog log = MakeAxisLog(model_, commands_, {encoders_}, 0.01);
    std::vector<ReplayBlock> blocks;
    blocks.push_back(*MakeAxisBlock(model_, log, 0));
    StateTolerances({}, &blocks);
    const SearchOptions options = WithTotalsOf({}, blocks);
    diagnosed_ = DiagnoseBlocks(std::move(blocks), options, 1, [](const BlockProgress&) {});
    return diagnosed_.front().diagnosis;
  }

 private:
  void Record(const MachineModel& real) {
    const Joint& joint = real.joints[arm_];
    AxisActuation chain = AxisActuationOf(real, arm_, {.machine = "whole valve"});
    const Stream noise(3, "whole valve");
    commands_.columns = {"arm"};
    encoders_.recording.axes = {{"arm"}};
    double q_rad = 0.5 * (joint.lower_rad + joint.upper_rad);
    const double middle_rad = q_rad;
    Stepper operator_of_arm;
    double rate_radps = 0;
    for (std::size_t step = 0; step < 50000; ++step) {
      const double t_s = static_cast<double>(step) * kPlantStep_s;
      const double lever = operator_of_arm.At(t_s, q_rad - middle_rad);
      if (step % 10 == 0) {
        commands_.t_ns.push_back(FromSeconds(t_s));
        commands_.rows.push_back({lever});
      }
      if (step % kStepsPerSample == 0) {
        encoders_.recording.samples.push_back(
            {.t_ns = FromSeconds(t_s),
             .q_rad = {q_rad},
             .qd_radps = {rate_radps + noise_radps_ * noise.Gaussian(step)}});
      }
      rate_radps = chain.DeliveredRate(chain.Demand(commands_.rows.back()[0], kPlantStep_s),
                                       {q_rad, rate_radps, 0}, kPlantStep_s);
      rate_radps = friction_.Left(rate_radps, q_rad - middle_rad);
      q_rad += kPlantStep_s * rate_radps;
    }
  }

  MachineModel model_;
  std::size_t arm_;
  double noise_radps_;
  FrictionPeak friction_;
  TableRecording commands_;
  NamedEncoders encoders_{"excavator1/encoders", {}};
  std::vector<DiagnosedBlock> diagnosed_;
};

/// The parameters of each finding, by mechanism.
Numbers FoundIn(const BlockDiagnosis& diagnosis) {
  Numbers found;
  for (const Finding& finding : diagnosis.findings) {
    found[std::string(finding.term.candidate->mechanism->id)] = finding.term.values;
  }
  return found;
}

TEST(WholeValve, ADeadBandWithAGainFarBeyondTheOwnersIsBoth) {
  SteppedArm arm({{"dead_band", {0.3, 0}}, {"rate_gain", {2.3}}});
  const Numbers found = FoundIn(arm.Diagnose());
  ASSERT_EQ(found.size(), 2u) << testing::PrintToString(found);
  EXPECT_NEAR(found.at("dead_band")[0], 0.3, 0.01);
  EXPECT_NEAR(found.at("rate_gain")[0], 2.3, 0.07);
}

TEST(WholeValve, FiveEffectsAtOnceAreFoundWithTheirNumbers) {
  SteppedArm arm({{"dead_band", {0.3, 0}},
                  {"lever_saturation", {0.8, 0.1}},
                  {"command_delay", {0.15, 0}},
                  {"actuator_lag", {0.3, 0}},
                  {"rate_gain", {1.9}}});
  const Numbers found = FoundIn(arm.Diagnose());
  ASSERT_EQ(found.size(), 5u) << testing::PrintToString(found);
  EXPECT_NEAR(found.at("dead_band")[0], 0.3, 0.02);
  EXPECT_NEAR(found.at("lever_saturation")[0], 0.8, 0.03);
  EXPECT_NEAR(found.at("lever_saturation")[1], 0.1, 0.03);
  EXPECT_NEAR(found.at("command_delay")[0], 0.15, 0.02);
  EXPECT_NEAR(found.at("actuator_lag")[0], 0.3, 0.03);
  EXPECT_NEAR(found.at("rate_gain")[0], 1.9, 0.1);
}

TEST(WholeValve, EachDirectionHasABandAndAGainOfItsOwn) {
  SteppedArm arm(
      {{"dead_band", {0.3, 0.3}}, {"asymmetric_gain", {0.6}}, {"command_delay", {0.2, 0}}});
  const Numbers found = FoundIn(arm.Diagnose());
  ASSERT_EQ(found.size(), 3u) << testing::PrintToString(found);
  EXPECT_NEAR(found.at("dead_band")[0], 0.3, 0.02);
  EXPECT_NEAR(found.at("dead_band")[1], 0.3, 0.05);
  EXPECT_NEAR(found.at("asymmetric_gain")[0], 0.6, 0.03);
  EXPECT_NEAR(found.at("command_delay")[0], 0.2, 0.02);
}

TEST(WholeValve, OfAJointAsItsOwnerSaysNothingIsFound) {
  SteppedArm arm({});
  const BlockDiagnosis diagnosis = arm.Diagnose();
  EXPECT_THAT(FoundIn(diagnosis), IsEmpty());
  EXPECT_THAT(diagnosis.unexplained, IsEmpty());
}

TEST(WholeValve, AJointThatRubsAtAnAngleIsUnexplainedOverItsAngle) {
  // The arm crosses the angle in a small share of its samples, so that the error of the whole
  // recording is less than twice the noise.
  const FrictionPeak peak{.loss_radps = 0.35, .beyond_middle_rad = 0.15, .half_width_rad = 0.02};
  const BlockDiagnosis diagnosis = SteppedArm({}, 0.05, peak).Diagnose();
  EXPECT_THAT(FoundIn(diagnosis), IsEmpty());
  ASSERT_EQ(diagnosis.unexplained.size(), 1u);
  EXPECT_LT(diagnosis.unexplained[0].rmse, 2 * diagnosis.unexplained[0].noise);
  EXPECT_LT(diagnosis.unexplained[0].p.value_or(1), 0.01);
  ASSERT_FALSE(diagnosis.unexplained[0].location.regimes.empty());
  EXPECT_EQ(diagnosis.unexplained[0].location.regimes[0].variable, "position/arm");
}

TEST(WholeValve, FrictionWithinTheToleranceOfRatesIsNoErrorOverAnyAngle) {
  const FrictionPeak peak{.loss_radps = 0.02, .beyond_middle_rad = 0.15, .half_width_rad = 0.02};
  const BlockDiagnosis diagnosis = SteppedArm({}, kNoise_radps, peak).Diagnose();
  EXPECT_THAT(FoundIn(diagnosis), IsEmpty());
  EXPECT_THAT(diagnosis.unexplained, IsEmpty());
}

}  // namespace
}  // namespace tera
