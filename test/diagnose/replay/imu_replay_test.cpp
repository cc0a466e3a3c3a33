#include "diagnose/replay/imu_replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sensors/imu/imu_slots.h"
#include "sensors/sensor_mechanisms.h"
#include "sensors/slots/true_mount.h"
#include "sim/drive_fixture.h"

namespace tera {
namespace {

constexpr TimeNs kMillisecond_ns = 1'000'000;

/// The boom moves, the machine drives and turns.
NamedLevers Work(double t_s) {
  return {{"boom", 0.5 * std::sin(1.1 * t_s)},
          {"slew", 0.4 * std::sin(0.7 * t_s)},
          {"left_track", 0.4 + 0.2 * std::sin(0.4 * t_s)},
          {"right_track", 0.3}};
}

SensorDescription OnTheBoom() {
  SensorDescription sensor;
  sensor.name = "imu_boom";
  sensor.link = "boom";
  sensor.X_BS = MakePose({0.8, 0.1, 0.3}, 0.2, -0.4, 0.9);
  sensor.model = ImuModel{};
  return sensor;
}

/// A recording: the unit at 200 Hz with `effects`, ideal encoders and poses at 100 Hz.
struct ImuReplayRecorded {
  std::vector<ImuSample> imu;
  std::vector<NamedEncoders> encoders{{"m/encoders", {}}};
  std::vector<TruthPose> poses;
};

ImuReplayRecorded ImuReplayRecord(Drive* drive, const Effects& effects, double duration_s) {
  const MachineModel& model = drive->scenario.machines[0].placement.model;
  const SensorDescription sensor = OnTheBoom();
  const auto link = static_cast<std::size_t>(model.LinkIndex(sensor.link));
  ImuReplayRecorded recorded;
  for (const Joint& joint : model.joints) {
    recorded.encoders[0].recording.axes.push_back({joint.name});
  }
  Imu imu({}, TrueMount(sensor.X_BS, effects), {200, 0}, 0, 1, "imu");
  TimeNs before_ns = drive->simulation->state().t_ns;
  BodyState before = drive->machine().links[link];
  drive->Run(duration_s, [&] {
    const TimeNs t_ns = drive->simulation->state().t_ns;
    const MachineState& state = drive->machine();
    imu.Advance(before_ns, before, t_ns, state.links[link], {0, 0, -kStandardGravity_mps2},
                &recorded.imu);
    before_ns = t_ns;
    before = state.links[link];
    if (t_ns % (10 * kMillisecond_ns) != 0) return;
    recorded.encoders[0].recording.samples.push_back(
        {.t_ns = t_ns, .q_rad = state.q_rad, .qd_radps = state.qd_radps});
    recorded.poses.push_back({.t_ns = t_ns, .X_WB = state.links[0].X_WB});
  });
  ImuSlots slots(effects, 1, "imu");
  for (ImuSample& sample : recorded.imu) slots.Apply(&sample);
  return recorded;
}

Drive Working() {
  Drive drive("tb235.yaml", "{xy_m: [-6, -3], yaw_deg: 25, joints_deg: {boom: 40, arm: -80}}",
              "cell_m: 0.1, soil: asphalt", 0, 0, "    ground: kinematic\n");
  drive.Operate(Work);
  return drive;
}

ImuLog LogOf(const Drive& drive, const ImuReplayRecorded& recorded,
             const SensorDescription& sensor) {
  return MakeImuLog(drive.scenario.machines[0].placement.model, sensor, recorded.imu,
                    recorded.encoders, recorded.poses, 0.2);
}

struct ImuReplayRms {
  double w_radps = 0, f_mps2 = 0;
};

/// After the jolt of the start.
ImuReplayRms ErrorOf(const ImuLog& log, const std::vector<ImuSample>& predicted) {
  ImuReplayRms sum;
  double n = 0;
  for (std::size_t k = 10; k < log.known.size(); ++k) {
    if (!log.known[k]) continue;
    sum.w_radps += (predicted[k].w_WS_S_radps - log.w_S_radps[k]).squaredNorm();
    sum.f_mps2 += (predicted[k].f_S_mps2 - log.f_S_mps2[k]).squaredNorm();
    ++n;
  }
  EXPECT_GT(n, 50);
  return {std::sqrt(sum.w_radps / n), std::sqrt(sum.f_mps2 / n)};
}

Effect Named(std::string_view id, std::vector<double> values) {
  for (const Mechanism& mechanism : SensorMechanisms()) {
    if (mechanism.id == id && mechanism.ActsOn(EffectTarget::kImu)) return {&mechanism, values};
  }
  ADD_FAILURE() << id;
  return {};
}

TEST(ImuReplay, MeasuresWhatTheUnitOnTheMovingMachineMeasured) {
  Drive drive = Working();
  const ImuReplayRecorded recorded = ImuReplayRecord(&drive, {}, 15);
  const SensorDescription sensor = OnTheBoom();
  const ImuLog log = LogOf(drive, recorded, sensor);
  const ImuReplayRms error = ErrorOf(log, ImuReplay(sensor, log).Predict({}));
  // The slew alone turns at 0.3 rad/s, gravity is 9.8 m/s^2.
  EXPECT_LT(error.w_radps, 0.001);
  EXPECT_LT(error.f_mps2, 0.03);
}

/// A unit on the root link, turned by 0.9 rad, and its measurements of a motion of 30 s.
struct Carried {
  Drive drive = Working();
  SensorDescription sensor = OnTheBoom();
  ImuReplayRecorded recorded;

  explicit Carried(const std::function<Pose(double t_s)>& motion) {
    sensor.link = drive.scenario.machines[0].placement.model.links[0].name;
    sensor.X_BS = MakePose({0, 0, 0}, 0, 0, 0.9);
    Imu imu({}, sensor.X_BS, {200, 0}, 0, 1, "imu");
    BodyState before;
    before.X_WB = motion(0);
    for (TimeNs t_ns = kMillisecond_ns; t_ns <= 30'000 * kMillisecond_ns; t_ns += kMillisecond_ns) {
      BodyState now;
      now.X_WB = motion(ToSeconds(t_ns));
      imu.Advance(t_ns - kMillisecond_ns, before, t_ns, now, {0, 0, -kStandardGravity_mps2},
                  &recorded.imu);
      before = now;
      if (t_ns % (10 * kMillisecond_ns) == 0)
        recorded.poses.push_back({.t_ns = t_ns, .X_WB = now.X_WB});
    }
  }
};

/// A replay between poses smooths a 2 Hz oscillation more than a mean over an interval does.
/// Measurements need the same smoothing.
TEST(ImuReplay, ComparesForcesThroughTheSameWindow) {
  const Carried carried([](double t_s) {
    return MakePose({0.05 * std::sin(2 * kPi * 2 * t_s), 0, 0}, 0, 0, 0.3 * t_s);
  });
  const ImuLog log = LogOf(carried.drive, carried.recorded, carried.sensor);
  const ImuReplayRms error = ErrorOf(log, ImuReplay(carried.sensor, log).Predict({}));
  // 0.05 m times the square of the rate, over the root of two, is 5.6 m/s^2.
  EXPECT_LT(error.f_mps2, 0.01);
}

/// Intervals long enough for forces from noisy poses do not blur the turn rates of a unit whose
/// clock lags by a fraction of them.
TEST(ImuReplay, TurnsWithinLongIntervalsAsTheLinkDid) {
  Carried carried([](double t_s) {
    return MakePose({0, 0, 0}, 0, 0, 0.3 * std::sin(2 * kPi * 0.5 * t_s));
  });
  for (ImuSample& sample : carried.recorded.imu) sample.t_ns -= 220 * kMillisecond_ns;
  ImuLog log = MakeImuLog(carried.drive.scenario.machines[0].placement.model, carried.sensor,
                          carried.recorded.imu, {}, carried.recorded.poses, 0.4);
  log.known.back() = false;  // the unit had ended before the poses did
  const ImuReplayRms error =
      ErrorOf(log, ImuReplay(carried.sensor, log).Predict({Named("clock_offset", {-0.22})}));
  // of 0.67 rad/s; straight lines over half an interval would leave 0.02
  EXPECT_LT(error.w_radps, 0.004);
}

TEST(ImuReplay, WithTheUnitsOwnErrorsMeasuresAsItDid) {
  const Effects effects = {Named("mount_rotation", {3, -2, 4}),
                           Named("bias", {0.5, 0, -0.5, 0.2, 0, 0.1}),
                           Named("clock_offset", {0.12})};
  Drive drive = Working();
  const ImuReplayRecorded recorded = ImuReplayRecord(&drive, effects, 15);
  const SensorDescription sensor = OnTheBoom();
  const ImuLog log = LogOf(drive, recorded, sensor);
  const ImuReplay replay(sensor, log);
  const ImuReplayRms with = ErrorOf(log, replay.Predict(effects));
  const ImuReplayRms without = ErrorOf(log, replay.Predict({}));
  EXPECT_LT(with.w_radps, 0.003);
  EXPECT_LT(with.f_mps2, 0.03);
  EXPECT_GT(without.w_radps, 0.02);
  EXPECT_GT(without.f_mps2, 0.3);
}

TEST(ImuReplay, SaysNothingWhereAJointOnTheWayWasNotMeasured) {
  Drive drive = Working();
  ImuReplayRecorded recorded = ImuReplayRecord(&drive, {}, 2);
  for (EncoderAxis& axis : recorded.encoders[0].recording.axes) {
    if (axis.name == "slew") axis.name = "other";
  }
  EXPECT_TRUE(LogOf(drive, recorded, OnTheBoom()).known.empty());
}

TEST(ImuReplay, WithoutPosesAMachineWhoseTracksNeverTurnedStandsLevel) {
  Drive drive = Working();
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  ImuReplayRecorded recorded;
  SensorDescription sensor = OnTheBoom();
  sensor.link = model.links[0].name;
  sensor.X_BS = Pose::Identity();
  recorded.encoders[0].recording.axes = {{"left_track"}, {"right_track"}};
  for (int k = 0; k < 100; ++k) {
    recorded.imu.push_back({.t_ns = 10 * k * kMillisecond_ns, .f_S_mps2 = {0, 0, 9.8}});
    recorded.encoders[0].recording.samples.push_back(
        {.t_ns = 10 * k * kMillisecond_ns, .q_rad = {0, 0}, .qd_radps = {0, 0}});
  }
  const ImuLog log = LogOf(drive, recorded, sensor);
  ASSERT_FALSE(log.known.empty());
  const std::vector<ImuSample> predicted = ImuReplay(sensor, log).Predict({});
  EXPECT_NEAR(predicted.front().f_S_mps2.z(), kStandardGravity_mps2, 1e-9);
  recorded.encoders[0].recording.samples[50].qd_radps = {0.2, 0};
  EXPECT_TRUE(LogOf(drive, recorded, sensor).known.empty());
}

}  // namespace
}  // namespace tera
