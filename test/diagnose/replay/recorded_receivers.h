#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.h"
#include "diagnose/blocks/gnss_block.h"
#include "sensors/gnss/gnss_slots.h"
#include "sensors/sensor_mechanisms.h"
#include "sim/drive_fixture.h"

namespace tera {

/// A base on a winding path with stops, in closed form.
inline Pose BaseAt(double t_s) {
  const double moving_s = t_s - 1.5 * std::sin(2 * kPi * t_s / 12);
  const double yaw_rad = 0.9 * std::sin(0.23 * moving_s) + 0.04 * moving_s;
  return MakePose({4 * std::sin(0.11 * moving_s), 0.25 * moving_s - 6, 0.2 * std::sin(0.05 * t_s)},
                  0.02 * std::sin(0.7 * t_s), 0.03 * std::sin(0.5 * t_s), yaw_rad);
}

inline SensorDescription AntennaAt(const std::string& name, const Vec3& p_m) {
  SensorDescription sensor;
  sensor.name = name;
  sensor.X_BS = MakePose(p_m);
  sensor.clock = {5, 0};
  sensor.model = GnssModel{.white_horizontal_m = 0.005,
                           .white_vertical_m = 0.009,
                           .correlated_horizontal_m = 0.007,
                           .correlated_vertical_m = 0.012};
  return sensor;
}

inline Effect Named(std::string_view id, std::vector<double> values) {
  for (const Mechanism& mechanism : SensorMechanisms()) {
    if (mechanism.id == id && mechanism.ActsOn(EffectTarget::kGnss)) return {&mechanism, values};
  }
  ADD_FAILURE() << id;
  return {};
}

/// Two antennas on the base of a machine whose boom leads ahead and up by 30 deg; the receivers
/// have effects of their own.
struct Receivers {
  Receivers(const Effects& left, const Effects& right) {
    model = Drive::Read("tb235.yaml", "{}", "soil: asphalt", "").machines[0].placement.model;
    sensors = {AntennaAt("left", {-0.9, 0.5, 2.1}), AntennaAt("right", {-0.9, -0.5, 2.1})};
    for (SensorDescription& sensor : sensors) sensor.link = model.links[0].name;
    for (int k = 0; k <= 1600; ++k) {
      const TimeNs t_ns = k * 50'000'000LL;
      poses.push_back({.t_ns = t_ns, .X_WB = BaseAt(ToSeconds(t_ns))});
      encoders[0].recording.samples.push_back({.t_ns = t_ns,
                                               .q_rad = std::vector<double>(model.joints.size()),
                                               .qd_radps = std::vector<double>(8)});
    }
    for (const Joint& joint : model.joints) {
      const bool is_boom = joint.name == "boom";
      encoders[0].recording.axes.push_back({joint.name});
      for (EncoderSample& sample : encoders[0].recording.samples) {
        sample.q_rad[encoders[0].recording.axes.size() - 1] = is_boom ? 30 * kDeg : 0;
      }
    }
    std::vector<SensorDescription> real = sensors;
    real[0].effects = left;
    real[1].effects = right;
    for (const SensorDescription& one : real) samples.push_back(SamplesOf(one, real));
  }
  /// Fixes of a receiver at the closed-form positions.
  static std::vector<GnssSample> SamplesOf(const SensorDescription& real,
                                           const std::vector<SensorDescription>& all) {
    const Vec3 p_B_m = TrueMounting(real, all).X_BT.translation();
    Gnss gnss(std::get<GnssModel>(real.model), real.clock, 0, 7, "m/" + real.name);
    GnssSlots slots(real.effects, 7, "m/" + real.name);
    const SiteFrame site(46.8, -71.3, 90);
    std::vector<GnssSample> samples;
    for (std::int64_t k = 0; k <= 400; ++k) {
      const Pose X_WB = BaseAt(ToSeconds(real.clock.Due(k)));
      GnssSample sample = gnss.Measure(k, X_WB * p_B_m, site);
      slots.Apply({X_WB.linear() * Vec3(std::cos(30 * kDeg), 0, std::sin(30 * kDeg))}, site,
                  &sample);
      samples.push_back(sample);
    }
    return samples;
  }
  GnssLog Log() const { return MakeGnssLog(model, sensors, samples, encoders, poses); }

  MachineModel model;
  std::vector<SensorDescription> sensors;
  std::vector<NamedEncoders> encoders{{"m/encoders", {}}};
  std::vector<TruthPose> poses;
  std::vector<std::vector<GnssSample>> samples;
};

}  // namespace tera
