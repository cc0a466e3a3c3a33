#include "sensors/sensor_mechanisms.h"

#include <string>

namespace tera {
namespace {

using enum EffectTarget;
using enum Slot;

using Targets = std::vector<EffectTarget>;
using Parameters = std::vector<EffectParameter>;

const Targets kEncoders = {kEncoder, kEncoderAxis};
/// A sensor writes one time on each of its measurements.
const Targets kStamped = {kImu, kGnss, kCamera, kLidar, kEncoder};

/// One range for several names, all ideal unless stated otherwise.
Parameters Alike(const std::vector<std::string_view>& names, std::string_view unit, double lower,
                 double upper, double otherwise) {
  Parameters parameters;
  for (const std::string_view name : names) {
    parameters.push_back({name, unit, lower, upper, otherwise});
  }
  return parameters;
}

Parameters Shift() { return Alike({"x_m", "y_m", "z_m"}, "m", -20, 20, 0); }

Parameters Turn() { return Alike({"roll_deg", "pitch_deg", "yaw_deg"}, "deg", -180, 180, 0); }

Parameters operator+(Parameters a, const Parameters& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Mechanism> Geometry() {
  const EffectParameter flip_x = {"x", "1", 0, 1, 0, true}, flip_y = {"y", "1", 0, 1, 0, true},
                        flip_z = {"z", "1", 0, 1, 0, true};
  return {
      {"mount_rotation", kSensorGeometry, {kImu}, Turn()},
      {"axis_flip", kSensorGeometry, {kImu}, {flip_x, flip_y, flip_z}},
      {"axis_flip", kSensorGeometry, kEncoders, {}},
      {"imu_lever_arm", kSensorGeometry, {kImu}, Shift()},
      {"gnss_lever_arm", kSensorGeometry, {kGnss}, Shift()},
      {"antenna_swap", kSensorGeometry, {kGnss}, {}},
      {"antenna_yaw", kSensorGeometry, {kGnss}, {{"yaw_deg", "deg", -180, 180, {}}}},
      {"extrinsic", kSensorGeometry, {kLidar, kCamera}, Shift() + Turn()},
  };
}

/// The same of every type: how a sensor warms up.
Parameters WarmUpParameters() {
  return {{"warm_up_k", "K", -100, 100, 30}, {"time_constant_s", "s", 1, 1e5, 600}};
}

Parameters Probability() { return {{"probability", "1", 0, 1, {}}}; }

std::vector<Mechanism> StaticOfImu() {
  return {
      {"bias",
       kSensorStatic,
       {kImu},
       Alike({"gyro_x_degps", "gyro_y_degps", "gyro_z_degps"}, "deg/s", -100, 100, 0) +
           Alike({"accel_x_mps2", "accel_y_mps2", "accel_z_mps2"}, "m/s^2", -20, 20, 0)},
      {"scale",
       kSensorStatic,
       {kImu},
       Alike({"gyro_x_factor", "gyro_y_factor", "gyro_z_factor", "accel_x_factor", "accel_y_factor",
              "accel_z_factor"},
             "1", 0.5, 2, 1)},
      // Defaults: 2000 deg/s and 16 g in 16 bit, as common chips have them.
      {"saturation",
       kSensorStatic,
       {kImu},
       {{"gyro_limit_degps", "deg/s", 1, 1e4, 2000},
        {"accel_limit_mps2", "m/s^2", 1, 1e4, 156.9064}}},
      {"quantisation",
       kSensorStatic,
       {kImu},
       {{"gyro_step_degps", "deg/s", 0, 10, 0.06103515625},
        {"accel_step_mps2", "m/s^2", 0, 10, 0.004788403}}},
      {"outliers",
       kSensorStatic,
       {kImu},
       Probability() +
           Parameters{{"gyro_degps", "deg/s", 0, 1e4, 50}, {"accel_mps2", "m/s^2", 0, 1e3, 20}}},
      {"temperature_drift",
       kSensorStatic,
       {kImu},
       WarmUpParameters() +
           Alike({"gyro_x_degpspk", "gyro_y_degpspk", "gyro_z_degpspk"}, "deg/s/K", -1, 1, 0) +
           Alike({"accel_x_mps2pk", "accel_y_mps2pk", "accel_z_mps2pk"}, "m/s^2/K", -0.1, 0.1, 0)},
      {"vibration_rectification",
       kSensorStatic,
       {kImu},
       Alike({"x_s2pm", "y_s2pm", "z_s2pm"}, "s^2/m", -0.1, 0.1, 0) +
           Parameters{{"engine_rms_mps2", "m/s^2", 0, 100, 3}, {"window_s", "s", 0.01, 60, 0.5}}},
  };
}

std::vector<Mechanism> StaticOfGnss() {
  return {
      {"quantisation",
       kSensorStatic,
       {kGnss},
       Alike({"horizontal_step_m", "vertical_step_m"}, "m", 0, 10, 0)},
      {"outliers",
       kSensorStatic,
       {kGnss},
       Probability() +
           Parameters{{"horizontal_m", "m", 0, 1e3, 5}, {"vertical_m", "m", 0, 1e3, 10}}},
      // EGM96 lies 107 m below to 85 m above the ellipsoid.
      {"height_datum", kSensorStatic, {kGnss}, {{"offset_m", "m", -120, 120, {}}}},
      {"position_datum", kSensorStatic, {kGnss}, Alike({"east_m", "north_m"}, "m", -1e3, 1e3, 0)},
      {"float_jump",
       kSensorStatic,
       {kGnss},
       {{"interval_s", "s", 0.1, 1e5, 60},
        {"duration_s", "s", 0.1, 1e4, 10},
        {"horizontal_m", "m", 0, 10, 0.3},
        {"vertical_m", "m", 0, 10, 0.5}}},
      {"multipath",
       kSensorStatic,
       {kGnss},
       {{"horizontal_m", "m", 0, 5, 0.02},
        {"vertical_m", "m", 0, 5, 0.05},
        {"azimuth_deg", "deg", -180, 180, 0}}},
  };
}

std::vector<Mechanism> StaticOfEncoders() {
  return {
      {"bias",
       kSensorStatic,
       kEncoders,
       {{"angle_deg", "deg", -360, 360, 0},
        {"rate_degps", "deg/s", -1e3, 1e3, 0},
        {"travel_m", "m", -10, 10, 0},
        {"speed_mps", "m/s", -10, 10, 0}}},
      {"scale", kSensorStatic, kEncoders,
       Alike({"position_factor", "rate_factor"}, "1", 0.5, 2, 1)},
      {"saturation",
       kSensorStatic,
       kEncoders,
       {{"angle_limit_deg", "deg", 0, 1e6, 1e6},
        {"rate_limit_degps", "deg/s", 0, 1e5, 1e5},
        {"travel_limit_m", "m", 0, 1e3, 1e3},
        {"speed_limit_mps", "m/s", 0, 1e3, 1e3}}},
      {"quantisation",
       kSensorStatic,
       kEncoders,
       {{"angle_step_deg", "deg", 0, 90, 0},
        {"rate_step_degps", "deg/s", 0, 90, 0},
        {"travel_step_m", "m", 0, 1, 0},
        {"speed_step_mps", "m/s", 0, 1, 0}}},
      {"outliers", kSensorStatic, kEncoders,
       Probability() + Parameters{{"angle_deg", "deg", 0, 360, 10}, {"travel_m", "m", 0, 10, 0.1}}},
      {"temperature_drift", kSensorStatic, kEncoders,
       WarmUpParameters() +
           Parameters{{"angle_degpk", "deg/K", -1, 1, 0}, {"travel_mpk", "m/K", -0.01, 0.01, 0}}},
  };
}

std::vector<Mechanism> StaticOfRanges() {
  return {
      {"range_bias", kSensorStatic, {kLidar}, {{"range_m", "m", -5, 5, {}}}},
      {"range_bias", kSensorStatic, {kCamera}, {{"depth_m", "m", -5, 5, {}}}},
      {"scale", kSensorStatic, {kLidar}, {{"range_factor", "1", 0.5, 2, {}}}},
      {"scale", kSensorStatic, {kCamera}, {{"depth_factor", "1", 0.5, 2, {}}}},
      {"quantisation", kSensorStatic, {kLidar}, {{"range_step_m", "m", 0, 1, 0.004}}},
      {"quantisation", kSensorStatic, {kCamera}, {{"depth_step_m", "m", 0, 1, 0.01}}},
      {"outliers",
       kSensorStatic,
       {kLidar},
       Probability() + Parameters{{"range_m", "m", 0, 100, 5}}},
      {"outliers",
       kSensorStatic,
       {kCamera},
       Probability() + Parameters{{"depth_m", "m", 0, 100, 1}}},
      {"temperature_drift",
       kSensorStatic,
       {kLidar},
       WarmUpParameters() + Parameters{{"range_mpk", "m/K", -0.01, 0.01, {}}}},
  };
}

std::vector<Mechanism> Timing() {
  return {
      {"clock_offset", kSensorTiming, kStamped, {{"offset_s", "s", -40, 40, {}}}},
      {"clock_drift", kSensorTiming, kStamped, {{"drift_ppm", "ppm", -1e3, 1e3, {}}}},
      {"latency",
       kSensorTiming,
       kStamped,
       {{"delay_s", "s", 0, 5, {}}, {"jitter_s", "s", 0, 1, 0}}},
      {"filter_delay",
       kSensorTiming,
       {kImu, kGnss, kEncoder},
       {{"time_constant_s", "s", 1e-4, 10, {}}}},
  };
}

std::vector<Mechanism> All() {
  std::vector<Mechanism> all;
  for (const auto& part : {Geometry(), StaticOfImu(), StaticOfGnss(), StaticOfEncoders(),
                           StaticOfRanges(), Timing()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace

std::span<const Mechanism> SensorMechanisms() {
  static const std::vector<Mechanism> mechanisms = All();
  return mechanisms;
}

}  // namespace tera
