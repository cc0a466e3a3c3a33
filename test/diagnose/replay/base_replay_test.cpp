#include "diagnose/replay/base_replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "core/error.h"
#include "diagnose/blocks/base_block.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/fit/excluded_samples.h"
#include "physics/traction/track_drive.h"
#include "physics/traction/turning_centre.h"
#include "sim/drive_fixture.h"

namespace tera {
namespace {

struct BaseReplayRecorded {
  NamedEncoders encoders{"m/wheels", {}};
  std::vector<TruthPose> poses;
};

/// Ideal encoders of the gears at 100 Hz, and poses at 20 Hz.
BaseReplayRecorded BaseReplayRecord(Drive* drive, double duration_s) {
  const MachineModel& model = drive->scenario.machines[0].placement.model;
  BaseReplayRecorded recorded;
  for (const RunningGear& gear : model.ground_tools.gears) {
    recorded.encoders.recording.axes.push_back({gear.name});
  }
  drive->Run(duration_s, [&] {
    const TimeNs t_ns = drive->simulation->state().t_ns;
    const MachineState& state = drive->machine();
    if (t_ns % (kNsPerSecond / 100) == 0) {
      recorded.encoders.recording.samples.push_back(
          {.t_ns = t_ns, .q_rad = state.gear_angle_rad, .qd_radps = state.gear_rate_radps});
    }
    if (t_ns % (kNsPerSecond / 20) == 0) {
      recorded.poses.push_back({.t_ns = t_ns, .X_WB = state.links[0].X_WB});
    }
  });
  return recorded;
}

/// Forward, backward, and turning in both directions, slowly changing.
NamedLevers Meander(double t_s) {
  return {{"left_track", 0.35 + 0.4 * std::sin(0.7 * t_s)},
          {"right_track", 0.3 + 0.4 * std::sin(0.9 * t_s + 1)}};
}

Drive Meandering(const std::string& terrain, const std::string& base) {
  Drive drive(
      "tb235.yaml", "{xy_m: [-6, -3], yaw_deg: 25}", "cell_m: 0.1, " + terrain, 0, 0,
      "    ground: kinematic\n" + (base.empty() ? "" : "effects: {m: {base: {" + base + "}}}\n"));
  drive.Operate(Meander);
  return drive;
}

PlanarTwist RmsError(const BaseLog& log, const std::vector<PlanarTwist>& predicted) {
  PlanarTwist sum;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const PlanarTwist& measured = log.intervals[i].twist;
    sum.forward_mps += std::pow(predicted[i].forward_mps - measured.forward_mps, 2);
    sum.left_mps += std::pow(predicted[i].left_mps - measured.left_mps, 2);
    sum.yaw_radps += std::pow(predicted[i].yaw_radps - measured.yaw_radps, 2);
  }
  const auto n = static_cast<double>(predicted.size());
  return {std::sqrt(sum.forward_mps / n), std::sqrt(sum.left_mps / n),
          std::sqrt(sum.yaw_radps / n)};
}

struct BaseReplayCase {
  std::string terrain, base;
};

void PrintTo(const BaseReplayCase& tested, std::ostream* out) {
  *out << tested.terrain << " {" << tested.base << "}";
}

class ReplayOfGround : public ::testing::TestWithParam<BaseReplayCase> {};

TEST_P(ReplayOfGround, TellsHowTheSimulatedMachineMovedAndTheIdealTracksDoNot) {
  Drive drive = Meandering(GetParam().terrain, GetParam().base);
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const BaseReplayRecorded recorded = BaseReplayRecord(&drive, 10);
  const BaseLog log = MakeBaseLog(model, {recorded.encoders}, recorded.poses, 0.1);
  ASSERT_GT(log.intervals.size(), 90u);
  const BaseReplay replay(model, log);
  const PlanarTwist with = RmsError(log, replay.Predict(model.effects.base));
  const PlanarTwist without = RmsError(log, replay.Predict({}));
  EXPECT_LT(with.forward_mps, 0.01);
  EXPECT_LT(with.left_mps, 0.01);
  EXPECT_LT(with.yaw_radps, 0.01);
  EXPECT_GT(without.forward_mps + without.left_mps + without.yaw_radps,
            5 * (with.forward_mps + with.left_mps + with.yaw_radps));
}

INSTANTIATE_TEST_SUITE_P(
    Mechanisms, ReplayOfGround,
    ::testing::Values(BaseReplayCase{"soil: asphalt", "track_slip: {slip: 0.15}"},
                      BaseReplayCase{"soil: asphalt", "track_slip: {slip: 0.05, turn_slip: 0.6}"},
                      BaseReplayCase{"soil: asphalt", "effective_gauge: {ratio: 1.7}"},
                      BaseReplayCase{"soil: asphalt", "track_asymmetry: {difference: 0.2}"},
                      BaseReplayCase{"soil: asphalt", "icr_shift: {forward_m: 0.2, left_m: 0.1}"},
                      BaseReplayCase{"soil: dirt, relief: {slope_deg: 8}",
                                     "slope_slip: {slip: 0.02, slip_per_slope: 1.5}"}));

/// Distance by which a machine exceeds that of its tracks, each of which reverses after 2 s.
double FurtherThanItsTracks(double left_mps, double right_mps, double PlanarTwist::*part,
                            const Grip& grip) {
  Drive drive = Meandering("soil: asphalt", "");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const double radius_m = model.ground_tools.gears[0].drive_radius_m;
  std::vector<TruthPose> poses;
  EncoderRecording tracks;
  for (const RunningGear& gear : model.ground_tools.gears) tracks.axes.push_back({gear.name});
  for (int k = 0; k <= 400; ++k) {
    const TimeNs t_ns = k * kNsPerSecond / 100;
    const double way = (k < 200 ? 1 : -1) / radius_m;
    Pose X_WB = Pose::Identity();
    X_WB.translation().x() = 0.5 * (left_mps + right_mps) * ToSeconds(t_ns);
    X_WB.rotate(
        Eigen::AngleAxisd((right_mps - left_mps) / model.gauge_m * ToSeconds(t_ns), Vec3::UnitZ()));
    poses.push_back({.t_ns = t_ns, .X_WB = X_WB});
    tracks.samples.push_back(
        {.t_ns = t_ns, .q_rad = {0, 0}, .qd_radps = {way * left_mps, way * right_mps}});
  }
  const BaseLog log = MakeBaseLog(model, {{"m/tracks", tracks}}, poses, 0.1);
  const BaseReplay replay(model, log);
  const std::vector<PlanarTwist> at_once = replay.Predict({});
  const std::vector<PlanarTwist> held_back = replay.Predict({}, {}, grip);
  double further = 0;
  for (std::size_t i = 0; i < at_once.size(); ++i) {
    const BaseInterval& interval = log.intervals[i];
    further +=
        (held_back[i].*part - at_once[i].*part) * ToSeconds(interval.to_ns - interval.from_ns);
  }
  return further;
}

TEST(BaseBlock, LetsPassWhatGroundThatHoldsLittleChanges) {
  Drive drive = Meandering("soil: asphalt", "");
  drive.Operate([](double t_s) {
    const double lever = std::fmod(t_s, 2.0) < 1 ? 0.9 : -0.9;
    return NamedLevers{{"left_track", lever}, {"right_track", lever}};
  });
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const BaseReplayRecorded recorded = BaseReplayRecord(&drive, 22);
  const BaseLog log = MakeBaseLog(model, {recorded.encoders}, recorded.poses, 0.2);
  const auto block = MakeBaseBlock(model, log, "m/base", false);
  ASSERT_TRUE(block);
  const std::vector<std::vector<double>> at_once = block->predict({});
  const auto held_back = BaseReplay(model, log).Predict({}, {}, Grip{0.35, 3000});
  const Eigen::MatrixXd& columns = block->channels[0].nominal;  // on firm ground, and on loose
  ASSERT_EQ(columns.cols(), 3);                                 // and turning about another point
  ASSERT_EQ(static_cast<std::size_t>(columns.rows()), held_back.size());
  double largest_mps = 0;
  for (std::size_t k = 0; k < held_back.size(); ++k) {
    const double change_mps = held_back[k].forward_mps - at_once[0][k];
    EXPECT_NEAR(columns(static_cast<Eigen::Index>(k), 1), change_mps, 1e-9);
    largest_mps = std::max(largest_mps, std::abs(change_mps));
  }
  EXPECT_GT(largest_mps, 0.2);
  EXPECT_EQ(block->channels[1].nominal.cols(), 2);  // sideways, about another point
  EXPECT_EQ(block->channels[2].nominal.cols(), 0);  // turning
}

// A left turn at 0.3 rad/s on a side slope of 0.1 rad, left side up. The centre is the middle of
// the load, shifted downhill until friction of 0.7 under a contact of length L holds the weight.
TEST(BaseBlock, LetsPassThatAMachineTurnsAboutTheMiddleOfItsLoad) {
  Drive drive = Meandering("soil: asphalt", "");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  std::vector<TruthPose> poses;
  EncoderRecording wheels;
  for (const RunningGear& gear : model.ground_tools.gears) wheels.axes.push_back({gear.name});
  for (int k = 0; k <= 300; ++k) {
    const TimeNs t_ns = k * kNsPerSecond / 10;
    poses.push_back({.t_ns = t_ns, .X_WB = MakePose(Vec3::Zero(), 0.1, 0, 0.03 * k)});
    wheels.samples.push_back({.t_ns = t_ns, .q_rad = {0, 0}, .qd_radps = {-1, 1}});
  }
  const auto block =
      MakeBaseBlock(model, MakeBaseLog(model, {{"m/wheels", wheels}}, poses, 0.2), "m/base", false);
  ASSERT_TRUE(block);
  std::vector<double> q_rad;
  for (const Joint& joint : model.joints) q_rad.push_back(joint.initial_rad);
  const Vec2 centre_m = TurningCentre_m(model, TrackDrive(model).contact_B_m(), q_rad);
  ASSERT_GT(centre_m.norm(), 0.01);
  const double length_m = TrackDrive(model).geometry().contact_length_m;
  const Eigen::MatrixXd& forward = block->channels[0].nominal;
  const Eigen::MatrixXd& left = block->channels[1].nominal;
  EXPECT_NEAR(forward(50, 2), 0.3 * centre_m.y(), 1e-6);
  EXPECT_NEAR(left(50, 0), -0.3 * centre_m.x(), 1e-6);
  EXPECT_NEAR(left(50, 1), -0.3 * length_m * std::tan(0.1) / (2 * 0.7), 1e-6);
}

TEST(BaseBlock, JudgesNoTurningThatLooseGroundCannotGiveAtOnce) {
  Drive drive = Meandering("soil: asphalt", "");
  drive.Operate([](double t_s) {
    const double lever = std::fmod(t_s, 4.0) < 2 ? 0.2 : -0.2;
    return NamedLevers{{"left_track", -lever}, {"right_track", lever}};
  });
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const BaseReplayRecorded recorded = BaseReplayRecord(&drive, 24);
  BaseLog log = MakeBaseLog(model, {recorded.encoders}, recorded.poses, 0.1);
  std::vector<ReplayBlock> blocks(1, MakeBaseBlock(model, log, "m/base", false).value());
  const std::vector<ExcludedSamples> excluded = ExcludeLaggingSamples(&blocks);
  const ReplayBlock& block = blocks.front();
  const Series& yaw = block.channels[2].measured;
  std::size_t after_reversal = 0, later = 0;
  for (std::size_t k = 0; k < yaw.size(); ++k) {
    const double t_s = ToSeconds(block.first_ns) + static_cast<double>(k) * yaw.period_s;
    if (t_s < 2) continue;
    const double since_s = std::fmod(t_s, 2.0);
    if (since_s > 0.15 && since_s < 0.35) after_reversal += yaw.valid[k] ? 1 : 0;
    if (since_s > 1.2 && since_s < 1.9) later += yaw.valid[k] ? 0 : 1;
    EXPECT_TRUE(block.channels[0].measured.valid[k]) << "forward speed";
  }
  EXPECT_EQ(after_reversal, 0u);
  EXPECT_EQ(later, 0u);
  ASSERT_EQ(excluded.size(), 1u);
  EXPECT_EQ(excluded[0].channel, "m/base/yaw_radps");
  const auto judged = std::count(yaw.valid.begin(), yaw.valid.end(), true);
  EXPECT_NEAR(excluded[0].share, 1 - static_cast<double>(judged) / log.intervals.size(), 1e-12);
  log.may_be_arrivals = true;
  blocks = {MakeBaseBlock(model, log, "m/base", true).value()};
  EXPECT_TRUE(ExcludeLaggingSamples(&blocks).empty()) << "it tells when the poses were";
}

TEST(BaseBlock, ExcludesTheSameTurningHoweverLongTheMachineStandsAfterwards) {
  const auto lags_within = [](double duration_s) {
    Drive drive = Meandering("soil: asphalt", "");
    drive.Operate([](double t_s) {
      const double turned = std::fmod(t_s, 4.0) < 2 ? 0.2 : -0.2;
      const double lever = t_s > 20 ? 0 : turned;
      return NamedLevers{{"left_track", -lever}, {"right_track", lever}};
    });
    const BaseReplayRecorded recorded = BaseReplayRecord(&drive, duration_s);
    const MachineModel& model = drive.scenario.machines[0].placement.model;
    const BaseLog log = MakeBaseLog(model, {recorded.encoders}, recorded.poses, 0.1);
    return MakeBaseBlock(model, log, "m/base", false).value().channels[2].is_lagging;
  };
  std::vector<bool> lags = lags_within(24), longer = lags_within(60);
  ASSERT_GT(std::count(lags.begin(), lags.end(), true), 10);
  longer.resize(lags.size());
  EXPECT_EQ(lags, longer);
}

TEST(BaseReplay, AReversalIsHeldBackByTheFrictionOfTheGround) {
  // 1 m/s decays at 0.2 g: the machine moves v^2 / 2 a further than its tracks.
  const double further_m = FurtherThanItsTracks(0.5, 0.5, &PlanarTwist::forward_mps, {0.2, 3000});
  EXPECT_NEAR(further_m, 1 / (2 * 0.2 * kStandardGravity_mps2), 0.025);  // of half a step
}

TEST(BaseReplay, ATurnIsHeldBackByFrictionAtHalfTheGaugeAndTheInertia) {
  Drive drive = Meandering("soil: asphalt", "");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const double weight_n = model.TotalMass_kg() * kStandardGravity_mps2;
  const double slowing_radps2 = 0.2 * weight_n * 0.5 * model.gauge_m / 5000;
  const double change_radps = 2 * (0.3 + 0.3) / model.gauge_m;
  const double further_rad = FurtherThanItsTracks(-0.3, 0.3, &PlanarTwist::yaw_radps, {0.2, 5000});
  EXPECT_NEAR(further_rad, change_radps * change_radps / (2 * slowing_radps2),
              0.025 * change_radps);
}

TEST(BaseLog, TellsHowFarOnAnArc) {
  // A quarter of a circle of 2 m radius in 4 s, in steps of 0.25 s.
  Drive drive = Meandering("soil: asphalt", "");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  std::vector<TruthPose> poses;
  EncoderRecording wheels;
  for (const RunningGear& gear : model.ground_tools.gears) wheels.axes.push_back({gear.name});
  for (int k = 0; k <= 16; ++k) {
    const double turned_rad = k * kPi / 32;
    Pose X_WB = Pose::Identity();
    X_WB.rotate(Eigen::AngleAxisd(turned_rad, Vec3::UnitZ()));
    X_WB.translation() = Vec3(2 * std::sin(turned_rad), 2 - 2 * std::cos(turned_rad), 0);
    const TimeNs t_ns = k * kNsPerSecond / 4;
    poses.push_back({.t_ns = t_ns, .X_WB = X_WB});
    wheels.samples.push_back({.t_ns = t_ns, .q_rad = {0, 0}, .qd_radps = {1, 1}});
  }
  const BaseLog log = MakeBaseLog(model, {{"m/wheels", wheels}}, poses, 0.5);
  ASSERT_EQ(log.intervals.size(), 8u);
  for (const BaseInterval& interval : log.intervals) {
    EXPECT_NEAR(interval.twist.forward_mps, kPi / 4, 1e-9);  // the contact is at the middle of the
                                                             // root
    EXPECT_NEAR(interval.twist.yaw_radps, kPi / 8, 1e-9);
    EXPECT_NEAR(interval.twist.left_mps, 0, 1e-9);
  }
}

/// Rates of the first gear over a minute at 2 rad/s, with an encoder error of 0.5 rad/s of
/// alternating sign. `angle_rad` is its reported angle at a time.
std::vector<double> GearRates(const std::function<double(double t_s)>& angle_rad) {
  Drive drive = Meandering("soil: asphalt", "");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  std::vector<TruthPose> poses;
  EncoderRecording wheels;
  for (const RunningGear& gear : model.ground_tools.gears) wheels.axes.push_back({gear.name});
  for (int k = 0; k <= 3000; ++k) {
    const TimeNs t_ns = k * kNsPerSecond / 50;
    const double q = angle_rad(ToSeconds(t_ns)), qd = 2 + (k / 3 % 2 == 0 ? 0.5 : -0.5);
    wheels.samples.push_back({.t_ns = t_ns, .q_rad = {q, q}, .qd_radps = {qd, qd}});
    if (k % 5 == 0) poses.push_back({.t_ns = t_ns, .X_WB = Pose::Identity()});
  }
  std::vector<double> rates;
  for (const BaseInstant& one : MakeBaseLog(model, {{"m", wheels}}, poses, 0.2).instants) {
    rates.push_back(one.gear_rate_radps[0]);
  }
  return rates;
}

TEST(BaseLog, TakesTheRateOfAGearFromItsAngle) {
  const std::vector<double> rates = GearRates([](double t_s) { return 7 + 2 * t_s; });
  ASSERT_GT(rates.size(), 1190u);
  for (std::size_t k = 1; k + 1 < rates.size(); ++k) EXPECT_NEAR(rates[k], 2, 1e-9) << k;
}

// Angles that wrap at each turn, that belong to the motor instead of the sprocket, and none.
TEST(BaseLog, TakesTheRateAsItWasMeasuredWhereTheAngleIsAnother) {
  const std::function<double(double)> angles[] = {
      [](double t_s) { return std::fmod(2 * t_s, 2 * kPi); }, [](double t_s) { return 60 * t_s; },
      [](double) { return 0.0; }, [](double) { return std::nan(""); }};
  for (const auto& angle_rad : angles) {
    const std::vector<double> rates = GearRates(angle_rad);
    ASSERT_GT(rates.size(), 1190u);
    EXPECT_NEAR(*std::max_element(rates.begin(), rates.end()), 2.5, 1e-9);
    EXPECT_NEAR(*std::min_element(rates.begin(), rates.end()), 1.5, 1e-9);
  }
}

TEST(BaseLog, NamesTheGearThatNoEncoderMeasures) {
  Drive drive = Meandering("soil: asphalt", "");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  BaseReplayRecorded recorded = BaseReplayRecord(&drive, 0.5);
  recorded.encoders.recording.axes[1].name = "idler";
  try {
    MakeBaseLog(model, {recorded.encoders}, recorded.poses, 0.1);
    FAIL() << "a missing gear was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(model.ground_tools.gears[1].name), std::string::npos);
  }
}

/// A machine at rest whose sprockets alternate, over 40 s.
ReplayBlock SprocketsAlone(const MachineModel& model, bool poses_were_measured) {
  std::vector<TruthPose> poses;
  EncoderRecording wheels;
  for (const RunningGear& gear : model.ground_tools.gears) wheels.axes.push_back({gear.name});
  for (int k = 0; k <= 400; ++k) {
    const TimeNs t_ns = k * kNsPerSecond / 10;
    const double rate_radps = std::sin(0.6 * ToSeconds(t_ns));
    poses.push_back({.t_ns = t_ns, .X_WB = Pose::Identity()});
    wheels.samples.push_back({.t_ns = t_ns, .q_rad = {0, 0}, .qd_radps = {rate_radps, rate_radps}});
  }
  const BaseLog log = MakeBaseLog(model, {{"m/wheels", wheels}}, poses, 0.2);
  return *MakeBaseBlock(model, log, "m/base", poses_were_measured);
}

TEST(BaseBlock, BesideLatePosesWouldHaveMovedAsMuchLater) {
  Drive drive = Meandering("soil: asphalt", "");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const ReplayBlock block = SprocketsAlone(model, true);
  const Candidate& late = block.candidates.back();
  ASSERT_EQ(late.target, "poses");
  const auto now = block.predict({})[0], then = block.predict({{&late, {0.4, 0}}})[0];
  ASSERT_GT(now.size(), 190u);
  for (std::size_t k = 2; k < now.size(); ++k) EXPECT_NEAR(then[k], now[k - 2], 1e-9) << k;
  for (const Candidate& candidate : SprocketsAlone(model, false).candidates) {
    EXPECT_EQ(candidate.target, "base");
  }
}

/// The same machine on even ground for 60 s with arrival stamps: poses of the first third of each
/// second wait for its end.
struct Waited {
  Drive drive = Meandering("soil: asphalt", "");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  BaseReplayRecorded recorded = BaseReplayRecord(&drive, 60);

  Waited() {
    TimeNs last_ns = 0;
    const TimeNs second_ns = kNsPerSecond;
    for (TruthPose& pose : recorded.poses) {
      const TimeNs into_ns = pose.t_ns % second_ns;
      const TimeNs at_ns = std::max(pose.t_ns, pose.t_ns - into_ns + second_ns / 3);
      last_ns = pose.t_ns = std::max(at_ns, last_ns + second_ns / 100);
    }
  }
  std::optional<ReplayBlock> Block() const {
    const BaseLog log = MakeBaseLog(model, {recorded.encoders}, recorded.poses, 0.2,
                                    TimesOfArrivals(recorded.poses));
    return MakeBaseBlock(model, log, "m/base", true);
  }
};

double BaseReplayRms(const Series& measured, const std::vector<double>& predicted) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    if (!measured.valid[k]) continue;
    sum += std::pow(measured.value[k] - predicted[k], 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(BaseBlock, FollowsPosesThatWaitedByWhenTheyWereMeasured) {
  const Waited waited;
  const auto block = waited.Block();
  ASSERT_TRUE(block);
  const Candidate& arrivals = block->candidates.back();
  ASSERT_EQ(arrivals.mechanism->id, "arrival_stamps");
  const auto as_stamped = block->predict({}), known = block->predict({{&arrivals, {}}});
  for (const std::size_t c : {0u, 2u}) {
    const Series& measured = block->channels[c].measured;
    EXPECT_GT(BaseReplayRms(measured, as_stamped[c]), 0.1) << c;
    EXPECT_LT(BaseReplayRms(measured, known[c]), 0.02) << c;
  }
}

TEST(BaseBlock, NamesStampsOfArrival) {
  const Waited waited;
  const auto block = waited.Block();
  ASSERT_TRUE(block);
  const BlockDiagnosis diagnosis = DiagnoseBlock(*block, {}, Stream(1, "arrivals"));
  ASSERT_FALSE(diagnosis.findings.empty());
  EXPECT_EQ(diagnosis.findings.front().term.candidate->mechanism->id, "arrival_stamps");
  EXPECT_LT(diagnosis.findings.front().evidence.rivals.size(), 2u);
}

}  // namespace
}  // namespace tera
