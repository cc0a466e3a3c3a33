#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sensors/driven_sensor.h"
#include "sensors/encoder/encoder_slots.h"
#include "sensors/gnss/antenna_pair.h"
#include "sensors/gnss/gnss_slots.h"
#include "sensors/imu/imu.h"
#include "sensors/imu/imu_slots.h"
#include "sensors/sensor_mechanisms.h"
#include "sensors/slots/frame_slots.h"
#include "sensors/slots/given_effects.h"
#include "sensors/slots/true_mount.h"

// Every parameter of every mechanism changes the report of its sensor. A sensor without effects
// reports its measurements.

namespace tera {
namespace {

using testing::Given;

using Output = std::vector<double>;

void Append(const Vec3& v, Output* out) { out->insert(out->end(), {v.x(), v.y(), v.z()}); }

const SiteFrame kSite(46.78, -71.27, 90);

Output OfImu(const Effects& effects) {
  Imu imu({}, TrueMount(MakePose({0.2, 0.1, 0.3}, 0.1, 0.2, 0.3), effects), {100, 0}, 0, 1, "m/s");
  ImuSlots slots(effects, 1, "m/s");
  const auto at = [](int step) {
    BodyState body;
    const double a_rad = 0.01 * step + 2e-4 * step * step;
    body.X_WB = MakePose({3 * std::cos(a_rad), 3 * std::sin(a_rad), 1}, 0.1 * a_rad, 0, a_rad);
    return body;
  };
  std::vector<ImuSample> samples;
  for (int k = 0; k < 200; ++k) {
    imu.Advance(TimeNs{k} * 2'000'000, at(k), TimeNs{k + 1} * 2'000'000, at(k + 1),
                Vec3(0, 0, -9.8), &samples);
  }
  Output out;
  for (ImuSample& sample : samples) {
    slots.Apply(&sample);
    out.push_back(static_cast<double>(sample.t_ns));
    Append(sample.w_WS_S_radps, &out);
    Append(sample.f_S_mps2, &out);
  }
  return out;
}

Output OfGnss(const Effects& effects) {
  const Antenna other{"upper", MakePose({-1, -0.5, 1.2}), {}};
  const AntennaPlace place =
      TrueAntenna({"upper", MakePose({-1, 0.5, 1.2}, 0.1, 0.2, 0.3), effects}, other);
  GnssSlots slots(effects, 1, "m/s");
  Output out;
  for (int k = 0; k < 40; ++k) {
    GnssSample sample;
    sample.t_ns = TimeNs{k} * 100'000'000;
    sample.fix = GnssFix::kRtkFixed;
    sample.enu_m = MakePose({0.3 * k, 1, 2}, 0, 0, 0.05 * k) * place.X_BT.translation();
    slots.Apply({MakePose(Vec3::Zero(), 0, -0.02 * k, 0.1 * k).linear().col(0)}, kSite, &sample);
    out.push_back(static_cast<double>(sample.t_ns));
    Append(sample.enu_m, &out);
  }
  return out;
}

Output OfEncoders(const Effects& effects, bool all) {
  const Effects none;
  EncoderSlots slots(all ? effects : none, {all ? none : effects, all ? none : effects},
                     {false, true}, {"boom", "stick"}, 1, "m/s");
  Output out;
  for (int k = 0; k < 40; ++k) {
    EncoderSample sample{
        TimeNs{k} * 100'000'000, 0, {0.03 * k, 0.05 * k}, {std::sin(k), std::cos(k)}};
    slots.Apply(&sample);
    out.push_back(static_cast<double>(sample.t_ns));
    for (const auto& values : {sample.q_rad, sample.qd_radps}) {
      out.insert(out.end(), values.begin(), values.end());
    }
  }
  return out;
}

template <typename Measure>
Output OfFrames(const Effects& effects, Measure measure) {
  FrameSlots slots(effects, 1, "m/s");
  Output out;
  const Pose X_TB = TrueMount(MakePose({0, 0, 2}, 0.1, 0.2, 0.3), effects).inverse();
  for (int k = 0; k < 40; ++k) measure(k, X_TB, &slots, &out);
  return out;
}

Output OfLidar(const Effects& effects) {
  return OfFrames(effects, [](int k, const Pose& X_TB, FrameSlots* slots, Output* out) {
    LidarScan scan;
    scan.t_ns = TimeNs{k} * 100'000'000;
    const Vec3 p_m = X_TB * Vec3(10 + 0.01 * k, 1, 0);
    scan.points = {{.x_m = float(p_m.x()), .y_m = float(p_m.y()), .z_m = float(p_m.z())}};
    slots->Apply(k, slots->Stamp(k, scan.t_ns), &scan);
    out->push_back(static_cast<double>(scan.t_ns));
    for (const LidarPoint& p : scan.points) Append(Vec3(p.x_m, p.y_m, p.z_m), out);
  });
}

Output OfCamera(const Effects& effects) {
  return OfFrames(effects, [](int k, const Pose& X_TB, FrameSlots* slots, Output* out) {
    CameraFrame frame;
    frame.t_ns = TimeNs{k} * 100'000'000;
    frame.depth_m = Image<float>(3, 1);
    const Vec3 p_m = X_TB * Vec3(10 + 0.01 * k, 1, 0);
    for (int i = 0; i < 3; ++i) frame.depth_m.at(i, 0) = static_cast<float>(20 + p_m[i]);
    slots->Apply(k, slots->Stamp(k, frame.t_ns), &frame);
    out->push_back(static_cast<double>(frame.t_ns));
    out->insert(out->end(), frame.depth_m.data.begin(), frame.depth_m.data.end());
  });
}

/// Output of any kind of row sensor, on a link that drives a circle and rocks.
Output OfAnyKind(const EffectTarget& target, const Effects& effects) {
  const auto kind = std::find_if(kSensorKinds.begin(), kSensorKinds.end(),
                                 [&](const SensorKind* k) { return k->target == target; });
  SensorDescription sensor = testing::SensorOf("type: " + std::string((*kind)->name) +
                                               ", link: upper, xyz_m: [0.2, 0.1, 0.3], "
                                               "rpy_deg: [5, 10, 20], rate_hz: 50");
  sensor.effects = effects;
  const auto motion = [](double t_s) {
    BodyState body;
    const double a_rad = 2 * t_s + 3 * t_s * t_s;
    body.X_WB = MakePose({3 * std::cos(a_rad), 3 * std::sin(a_rad), 1}, 0.1 * a_rad,
                         0.2 * std::sin(5 * t_s), a_rad);
    return body;
  };
  Output out;
  for (const RowSample& row : testing::RowsOf(sensor, motion, 1)) {
    out.push_back(static_cast<double>(row.t_ns));
    out.insert(out.end(), row.values.begin(), row.values.end());
  }
  return out;
}

Output OutputOf(EffectTarget target, const Effects& effects) {
  if (target == EffectTarget::kImu) return OfImu(effects);
  if (target == EffectTarget::kGnss) return OfGnss(effects);
  if (target == EffectTarget::kLidar) return OfLidar(effects);
  if (target == EffectTarget::kCamera) return OfCamera(effects);
  if (target == EffectTarget::kEncoder || target == EffectTarget::kEncoderAxis) {
    return OfEncoders(effects, target == EffectTarget::kEncoder);
  }
  return OfAnyKind(target, effects);
}

/// Two values of every parameter that must give different results.
struct TwoValues {
  std::string_view parameter;
  double a, b;
};

/// Parameters for which the two halves of the default's neighbourhood do not differ.
std::vector<TwoValues> Chosen(const Mechanism& mechanism) {
  static const std::vector<TwoValues> chosen = {
      {"gyro_limit_degps", 200, 100},
      {"accel_limit_mps2", 5, 10},
      {"probability", 0.5, 0.2},
      {"time_constant_s", 3, 5},
      {"window_s", 0.5, 5},
      {"angle_limit_deg", 30, 40},
      {"rate_limit_degps", 10, 20},
      {"travel_limit_m", 0.5, 1},
      {"speed_limit_mps", 0.5, 0.6},
      {"interval_s", 0.3, 3},
      {"duration_s", 0.3, 3},
      {"x", 1, 0},
      {"y", 1, 0},
      {"z", 1, 0},
      {"drift_ppm", 20, 21},
  };
  std::vector<TwoValues> values;
  for (const EffectParameter& p : mechanism.parameters) {
    const auto found = std::find_if(chosen.begin(), chosen.end(),
                                    [&](const TwoValues& t) { return t.parameter == p.name; });
    const double span = p.upper - p.lower;
    values.push_back(found == chosen.end()
                         ? TwoValues{p.name, p.lower + 0.6 * span, p.lower + 0.7 * span}
                         : *found);
  }
  return values;
}

Effects With(const Mechanism& mechanism, const std::vector<TwoValues>& values, std::size_t other) {
  Effect effect{&mechanism, {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    effect.values.push_back(i == other ? values[i].b : values[i].a);
  }
  return {effect};
}

/// Whether every number is finite; NaN differs from everything, itself included.
bool AllFinite(const Output& output) {
  return std::all_of(output.begin(), output.end(), [](double x) { return std::isfinite(x); });
}

TEST(SensorMechanisms, EveryOneActsOnEverySensorThatItIsFor) {
  for (const Mechanism& mechanism : SensorMechanisms()) {
    for (const EffectTarget target : mechanism.targets) {
      const auto values = Chosen(mechanism);
      EXPECT_NE(OutputOf(target, With(mechanism, values, values.size())), OutputOf(target, {}))
          << mechanism.id << " of " << target.name;
    }
  }
}

TEST(SensorMechanisms, EveryParameterChangesWhatTheSensorReports) {
  int parameters = 0;
  for (const Mechanism& mechanism : SensorMechanisms()) {
    for (const EffectTarget target : mechanism.targets) {
      const auto values = Chosen(mechanism);
      const Output plain = OutputOf(target, With(mechanism, values, values.size()));
      EXPECT_TRUE(AllFinite(plain)) << mechanism.id << " of " << target.name;
      for (std::size_t i = 0; i < values.size(); ++i, ++parameters) {
        const Output other = OutputOf(target, With(mechanism, values, i));
        const std::string what =
            fmt::format("{}.{} of {}", mechanism.id, values[i].parameter, target.name);
        EXPECT_NE(other, plain) << what;
        EXPECT_TRUE(AllFinite(other)) << what;
      }
    }
  }
  EXPECT_GT(parameters, 100);
}

TEST(SensorMechanisms, AtTheCornersOfTheirRangesMeasurementsStayFinite) {
  for (const Mechanism& mechanism : SensorMechanisms()) {
    for (const EffectTarget target : mechanism.targets) {
      // All at their lower bounds, all at their upper ones, and each alone at the opposite bound.
      std::vector<TwoValues> up, down;
      for (const EffectParameter& p : mechanism.parameters) {
        up.push_back({p.name, p.lower, p.upper});
        down.push_back({p.name, p.upper, p.lower});
      }
      for (const auto& corner : {up, down}) {
        for (std::size_t i = 0; i <= corner.size(); ++i) {
          EXPECT_TRUE(AllFinite(OutputOf(target, With(mechanism, corner, i))))
              << mechanism.id << " of " << target.name << ", parameter " << i;
        }
      }
    }
  }
}

TEST(SensorMechanisms, DefaultsLieInTheirRangesAndIdsAreReadOnceForEachTarget) {
  std::vector<EffectTarget> targets = {EffectTarget::kEncoderAxis};
  for (const SensorKind* kind : kSensorKinds) targets.push_back(kind->target);
  for (const EffectTarget target : targets) {
    std::vector<std::string_view> ids;
    for (const Mechanism& mechanism : SensorMechanisms()) {
      if (!mechanism.ActsOn(target)) continue;
      EXPECT_EQ(std::count(ids.begin(), ids.end(), mechanism.id), 0) << mechanism.id;
      ids.push_back(mechanism.id);
      for (const EffectParameter& p : mechanism.parameters) {
        EXPECT_LT(p.lower, p.upper) << mechanism.id << "." << p.name;
        if (!p.otherwise) continue;
        EXPECT_GE(*p.otherwise, p.lower) << mechanism.id << "." << p.name;
        EXPECT_LE(*p.otherwise, p.upper) << mechanism.id << "." << p.name;
      }
    }
    EXPECT_GT(ids.size(), 4u);
  }
}

TEST(SensorMechanisms, OfTheThreeSlotsAreAllThatTheTableNames) {
  for (const std::string id : {"mount_rotation",
                               "axis_flip",
                               "imu_lever_arm",
                               "gnss_lever_arm",
                               "antenna_swap",
                               "antenna_yaw",
                               "extrinsic",
                               "bias",
                               "scale",
                               "saturation",
                               "quantisation",
                               "outliers",
                               "temperature_drift",
                               "vibration_rectification",
                               "height_datum",
                               "position_datum",
                               "float_jump",
                               "multipath",
                               "range_bias",
                               "clock_offset",
                               "clock_drift",
                               "latency",
                               "filter_delay"}) {
    EXPECT_TRUE(std::any_of(SensorMechanisms().begin(), SensorMechanisms().end(),
                            [&](const Mechanism& m) { return m.id == id; }))
        << id;
  }
}

TEST(SensorSlots, WithoutEffectsEveryMeasurementPassesUnchanged) {
  ImuSample imu{1'000'003, 7, Vec3(0.1, -0.0, 1e-300), Vec3(-1e9, 0.3, 9.8)};
  const ImuSample imu_before = imu;
  ImuSlots({}, 1, "m/s").Apply(&imu);
  EXPECT_EQ(imu.w_WS_S_radps, imu_before.w_WS_S_radps);
  EXPECT_TRUE(std::signbit(imu.w_WS_S_radps.y()));
  EXPECT_EQ(imu.f_S_mps2, imu_before.f_S_mps2);
  EXPECT_EQ(imu.t_ns, 1'000'003);
  EXPECT_EQ(imu.t_available_ns, 7);

  // A latitude that differs from its ENU also stays.
  GnssSample gnss{3, 4, 46.5, -71, 90, Vec3(1, 2, 3), GnssFix::kSingle, Vec3(1, 1, 1)};
  GnssSlots({}, 1, "m/s").Apply({Vec3(0.6, 0, 0.8)}, kSite, &gnss);
  EXPECT_EQ(gnss.lat_deg, 46.5);
  EXPECT_EQ(gnss.enu_m, Vec3(1, 2, 3));

  EncoderSample encoder{3, 4, {0.1}, {-0.0}};
  EncoderSlots({}, {}, {false}, {"boom"}, 1, "m/s").Apply(&encoder);
  EXPECT_EQ(encoder.q_rad, std::vector<double>{0.1});
  EXPECT_TRUE(std::signbit(encoder.qd_radps[0]));

  LidarScan scan;
  scan.t_ns = 5;
  scan.points = {{.x_m = 0.1f, .y_m = 0, .z_m = 0.7f, .time_offset_ns = 4'000'000'000u}};
  FrameSlots slots({}, 1, "m/s");
  slots.Apply(0, slots.Stamp(0, scan.t_ns), &scan);
  EXPECT_EQ(scan.t_ns, 5);
  EXPECT_EQ(scan.points.at(0).z_m, 0.7f);
  EXPECT_EQ(scan.points.at(0).time_offset_ns, 4'000'000'000u);

  const Pose X_BS = MakePose({0.1, 0.2, 0.3}, 0.4, 0.5, 0.6);
  EXPECT_EQ(TrueMount(X_BS, {}).matrix(), X_BS.matrix());
}

}  // namespace
}  // namespace tera
